// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/particle_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace tripoint::lammps {

double particle_mass(const InitialState& state, int source, const std::string& name) {
  double mass = 0.0;
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (state.source[i] != source) continue;
    if (mass > 0.0 && std::abs(state.mass[i] - mass) > 1e-12 * mass)
      throw EngineError(
          fmt::format("the particles of {} differ in mass, and a LAMMPS type has one mass", name));
    mass = state.mass[i];
  }
  return mass;
}

Drive drive_at(const JobBody& b, double time, double end) {
  if (b.motion == Motion::fixed) return {{}, end};
  if (b.keyframes.empty()) return {b.velocity, end};
  const double first = b.keyframes.front().time;
  if (time < first * (1.0 - 1e-12)) return {{}, first};
  for (std::size_t k = 1; k < b.keyframes.size(); ++k) {
    const Keyframe &from = b.keyframes[k - 1], &to = b.keyframes[k];
    if (time < to.time - 1e-9 * (to.time - from.time))
      return {(to.position - from.position) / (to.time - from.time), to.time};
  }
  return {{}, end};
}

bool is_turned(const JobBody& b) {
  if (b.motion != Motion::prescribed) return false;
  const auto turns = [](const Keyframe& k) { return std::abs(std::abs(k.rotation.w) - 1.0) > 1e-12; };
  return std::any_of(b.keyframes.begin(), b.keyframes.end(), turns) ||
         (b.keyframes.empty() && norm(b.angular_velocity) > 0.0);
}

bool are_joined(const Body& a, const Body& b) {
  const auto names = [](const Body& x, const Body& y) {
    return std::find(x.joined_to.begin(), x.joined_to.end(), y.name) != x.joined_to.end();
  };
  return names(a, b) || names(b, a);
}

ParticleModel::ParticleModel(const Job& job, const InitialState& state, const Units& units, double limit)
    : job_(job),
      state_(state),
      choice_(choice_for(job)),
      units_(units),
      limit_(wanted_time_step(job).value_or(limit)),
      library_(job.output + "/log.lammps"),
      time_(job.times.front()) {
  units_.origin = job.scene.min.value_or(state.position.front());
}

void ParticleModel::make_particles(const std::string& style, const std::string& extra, double margin,
                                   const std::vector<int>& types) {
  const Scene& scene = job_.scene;
  if (flat_) units_.origin.z = state_.position.front().z;
  Vec3 lo = units_.place(state_.position.front()), hi = lo;
  for (const Vec3& x : state_.position)
    for (std::size_t k = 0; k < 3; ++k) {
      lo[k] = std::min(lo[k], units_.place(x)[k]);
      hi[k] = std::max(hi[k], units_.place(x)[k]);
    }
  std::string edges, letters;
  for (std::size_t k = 0; k < (flat_ ? 2 : 3); ++k) {
    const bool wraps = scene.periodic[k] && scene.min && scene.max;
    edges += fmt::format(" {:.17g} {:.17g}", wraps ? units_.place(*scene.min)[k] : lo[k] - margin,
                         wraps ? units_.place(*scene.max)[k] : hi[k] + margin);
    // shrink-wrapped from no less than this box: a single layer is no flat box
    letters += wraps ? " p" : " m";
  }
  if (flat_) {
    edges += " -0.1 0.1";
    letters += " p";
  }
  library_.run("units lj\n" + std::string(flat_ ? "dimension 2\n" : "") + style +
               "\natom_modify map array sort 0 0.0\nboundary" + letters + "\n");
  library_.run(fmt::format("region box block{}\ncreate_box {} box{}\n", edges,
                           *std::max_element(types.begin(), types.end()), extra));
  std::vector<int> type;
  std::vector<Vec3> position, velocity;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const bool held = job_.bodies[static_cast<std::size_t>(state_.source[i])].motion == Motion::fixed;
    type.push_back(types[static_cast<std::size_t>(state_.source[i])]);
    position.push_back(units_.place(state_.position[i]));
    velocity.push_back(held ? Vec3{} : state_.velocity[i] / units_.speed());
  }
  library_.create_atoms(type, position, velocity);
}

std::vector<std::size_t> ParticleModel::members(std::size_t body) const {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < state_.size(); ++i)
    if (state_.source[i] == static_cast<int>(body)) rows.push_back(i);
  return rows;
}

std::vector<int> ParticleModel::type_a_body() const {
  std::vector<int> types(job_.bodies.size());
  std::iota(types.begin(), types.end(), 1);
  return types;
}

/// Rows are sampled body after body.
std::string ParticleModel::ids_of(std::size_t body) const {
  const auto rows = members(body);
  return rows.empty() ? "" : fmt::format(" {}:{}", rows.front() + 1, rows.back() + 1);
}

void ParticleModel::make_gravity() {
  if (!make_group("free", [](const JobBody& b) { return b.motion == Motion::free; })) {
    gravity_ = job_.scene.gravity;  // acts on nothing
    return;
  }
  const Vec3 g = job_.scene.gravity / units_.acceleration();
  if (norm(g) == 0.0) return;
  library_.run(
      fmt::format("fix weight free gravity {:.17g} vector {:.17g} {:.17g} {:.17g}", norm(g), g.x, g.y, g.z));
  library_.run("pair_style zero 1.0 nocoeff\npair_coeff * *\nrun 0 post no");
  const auto force = library_.vectors("f");
  const auto first = std::find_if(job_.bodies.begin(), job_.bodies.end(),
                                  [](const JobBody& b) { return b.motion == Motion::free; });
  const std::size_t row = members(static_cast<std::size_t>(first - job_.bodies.begin())).front();
  gravity_ = (units_.mass * units_.acceleration() / state_.mass[row]) * force[row];
}

void ParticleModel::advance_to(double time) {
  clock_.run(library_, steps_in((time - time_) / units_.time, limit_ / units_.time));
  time_ = time;
  const std::vector<Vec3> x = library_.vectors("x");
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!finite(x[i]))
      throw Diverged(static_cast<long>(i), -1, "position", "run", time, "the position is not finite");
}

Readback ParticleModel::readback() const {
  Readback back;
  back.gravity = gravity_;
  back.time_step = job_.times.size() > 1 ? steps_in(job_.times[1] - job_.times[0], limit_).size : limit_;
  return back;
}

Snapshot ParticleModel::particles() const {
  Snapshot s;
  s.time = time_;
  s.step = clock_.total();
  s.position = library_.vectors("x");
  s.velocity = library_.vectors("v");
  s.phase = state_.phase;
  s.body = state_.body;
  s.material = state_.material;
  s.mass = state_.mass;
  s.energy["kinetic"] = s.energy["potential"] = 0.0;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    s.position[i] = units_.origin + units_.length * s.position[i];
    s.velocity[i] = units_.speed() * s.velocity[i];
    s.id.push_back(static_cast<int>(i));
    s.total_mass += s.mass[i];
    s.momentum += s.mass[i] * s.velocity[i];
    s.angular_momentum += s.mass[i] * cross(s.position[i], s.velocity[i]);
    s.energy["kinetic"] += 0.5 * s.mass[i] * dot(s.velocity[i], s.velocity[i]);
    if (job_.bodies[static_cast<std::size_t>(state_.source[i])].motion == Motion::free)
      s.energy["potential"] -= s.mass[i] * dot(job_.scene.gravity, s.position[i]);
  }
  return s;
}

}  // namespace tripoint::lammps

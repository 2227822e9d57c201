// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/lammps/rigid_flight.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/lammps/body_fit.hpp"
#include "sampling/sample.hpp"
#include "scene/geometry.hpp"

namespace tripoint::lammps {
namespace {

constexpr double default_step = 1.0 / 240.0;  // [s], Bullet's: rows compare at the same step

class RigidFlight final : public Model {
 public:
  RigidFlight(const Job& job, const InitialState& state)
      : job_(job), state_(state), library_(job.output + "/log.lammps"), time_(job.times.front()) {
    limit_ = wanted_time_step(job).value_or(default_step);
    make_box();
    make_particles();
    make_fixes();
    library_.run(choice_for(job).commands);
    library_.run("run 0 post no");  // the forces of the read-back
  }

  void advance_to(double time) override {
    clock_.run(library_, steps_in(time - time_, limit_));
    time_ = time;
    const Snapshot now = observe();
    for (std::size_t i = 0; i < now.bodies.size(); ++i)
      if (!finite(now.bodies[i].position))
        throw Diverged(-1, static_cast<long>(i), "position", "run", time, "the position is not finite");
    refuse_contact(now);
  }

  [[nodiscard]] Snapshot observe() const override;
  [[nodiscard]] Readback readback() const override;
  void account(Result& result) const override {
    result.steps = clock_.total();
    result.time_step_bound = wanted_time_step(job_) ? "given" : "default 1/240 s";
  }

 private:
  void make_box() {
    const double dx = job_.resolution.spacing;
    Vec3 lo = state_.position.front(), hi = lo;
    for (const Vec3& x : state_.position)
      for (std::size_t k = 0; k < 3; ++k) {
        lo[k] = std::min(lo[k], x[k]);
        hi[k] = std::max(hi[k], x[k]);
      }
    library_.run("units si\natom_style atomic\natom_modify map array sort 0 0.0\nboundary s s s\n");
    library_.run(
        fmt::format("region box block {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} {:.17g}\ncreate_box {} box\n",
                    lo.x - dx, hi.x + dx, lo.y - dx, hi.y + dx, lo.z - dx, hi.z + dx, job_.bodies.size()));
    library_.run(
        fmt::format("pair_style none\ncomm_modify cutoff {0:.17g}\nneighbor {0:.17g} bin\nneigh_modify every "
                    "1 delay 0 check yes\n",
                    dx));
  }

  /// A type a body, so that the body is a set of types.
  void make_particles() {
    std::vector<int> type;
    for (const int body : state_.body) type.push_back(body + 1);
    std::vector<Vec3> velocity;
    for (std::size_t i = 0; i < state_.size(); ++i) {
      const JobBody& b = job_.bodies.at(static_cast<std::size_t>(state_.source[i]));
      velocity.push_back(b.motion == Motion::fixed
                             ? Vec3{}
                             : b.velocity +
                                   cross(b.angular_velocity, state_.position[i] - b.properties.centre));
    }
    for (const JobBody& b : job_.bodies)
      library_.run(fmt::format("mass {} {:.17g}", b.index + 1, particle_mass(b)));
    library_.run("fix tags all property/atom i_bodytag");
    library_.create_atoms(type, state_.position, velocity);
    for (const JobBody& b : job_.bodies) library_.run(fmt::format("set type {0} i_bodytag {0}", b.index + 1));
  }

  [[nodiscard]] double particle_mass(const JobBody& b) const {
    double mass = 0.0;
    for (std::size_t i = 0; i < state_.size(); ++i) {
      if (state_.body[i] != b.index) continue;
      if (mass > 0.0 && std::abs(state_.mass[i] - mass) > 1e-12 * mass)
        throw EngineError(
            fmt::format("the particles of {} differ in mass, and a LAMMPS type has one mass", b.name));
      mass = state_.mass[i];
    }
    return mass;
  }

  [[nodiscard]] std::vector<std::size_t> members(const JobBody& b) const {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < state_.size(); ++i)
      if (state_.body[i] == b.index) rows.push_back(i);
    return rows;
  }

  /// Gravity is defined before fix rigid: after it every body lags by g dt t/2.
  void make_fixes() {
    std::string rigid, points;
    for (const JobBody& b : job_.bodies)
      if (b.motion == Motion::free)
        (members(b).size() > 1 ? rigid : points) += fmt::format(" {}", b.index + 1);
    if (!(rigid + points).empty()) library_.run("group moving type" + rigid + points);
    const double g = norm(job_.scene.gravity);
    if (g > 0.0)
      library_.run(fmt::format("fix weight moving gravity {:.17g} vector {:.17g} {:.17g} {:.17g}", g,
                               job_.scene.gravity.x, job_.scene.gravity.y, job_.scene.gravity.z));
    if (!rigid.empty())
      library_.run("group bodies type" + rigid + "\nfix flight bodies rigid custom i_bodytag");
    if (!points.empty()) library_.run("group points type" + points + "\nfix points points nve");
    library_.run("thermo 0");
  }

  void refuse_contact(const Snapshot& now) const;

  Job job_;
  InitialState state_;
  Library library_;
  Clock clock_;
  double time_, limit_ = default_step;
};

Snapshot RigidFlight::observe() const {
  Snapshot s;
  s.time = time_;
  s.step = clock_.total();
  s.position = library_.vectors("x");
  s.velocity = library_.vectors("v");
  s.phase = state_.phase;
  s.body = state_.body;
  s.material = state_.material;
  s.mass = state_.mass;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    s.id.push_back(static_cast<int>(i));
    s.total_mass += s.mass[i];
    s.momentum += s.mass[i] * s.velocity[i];
    s.angular_momentum += s.mass[i] * cross(s.position[i], s.velocity[i]);
    s.energy["kinetic"] += 0.5 * s.mass[i] * dot(s.velocity[i], s.velocity[i]);
  }
  s.energy["potential"] = 0.0;
  s.bodies.resize(job_.bodies.size());
  for (const JobBody& b : job_.bodies) {
    const BodyState fit = fit_body(b.properties, members(b), state_, s);
    s.bodies.at(static_cast<std::size_t>(b.index)) = fit;
    if (b.motion == Motion::free) s.energy["potential"] -= fit.mass * dot(job_.scene.gravity, fit.position);
  }
  return s;
}

/// From LAMMPS's own masses, places and forces: the latter are the weights, as nothing else acts.
Readback RigidFlight::readback() const {
  Readback back;
  back.gravity = job_.scene.gravity;
  back.time_step = clock_.total() > 0      ? library_.time_step()
                   : job_.times.size() > 1 ? steps_in(job_.times[1] - job_.times[0], limit_).size
                                           : limit_;
  const std::vector<Vec3> at = library_.vectors("x"), force = library_.vectors("f");
  for (const JobBody& b : job_.bodies) {
    const double mass = library_.mass_of_type(b.index + 1);
    std::vector<Vec3> mine;
    for (const std::size_t i : members(b)) mine.push_back(at[i]);
    if (b.motion == Motion::free) back.gravity = force[members(b).front()] / mass;
    const MassProperties p = mass_properties(mine, std::vector<double>(mine.size(), mass));
    back.bodies.push_back({b.name, p.mass, p.centre, p.principal_inertia, 0.0, 0.0, 0.0, 0.0});
  }
  return back;
}

/// Bodies of this model pass through each other; it stops before that becomes a number.
void RigidFlight::refuse_contact(const Snapshot& now) const {
  const double reach = 0.999 * job_.resolution.spacing;
  std::vector<double> radius;
  for (const JobBody& b : job_.bodies) {
    double r = 0.0;
    for (const std::size_t i : members(b)) r = std::max(r, norm(state_.position[i] - b.properties.centre));
    radius.push_back(r);
  }
  for (std::size_t a = 0; a < job_.bodies.size(); ++a)
    for (std::size_t b = a + 1; b < job_.bodies.size(); ++b) {
      const Vec3 apart = now.bodies[a].position - now.bodies[b].position;
      if (norm(apart) > radius[a] + radius[b] + reach) continue;
      if (job_.bodies[a].motion == Motion::fixed && job_.bodies[b].motion == Motion::fixed) continue;
      for (const std::size_t i : members(job_.bodies[a]))
        for (const std::size_t j : members(job_.bodies[b]))
          if (norm(now.position[i] - now.position[j]) < reach)
            throw EngineError(
                fmt::format("{} and {} touch at t = {:.6g} s; fix rigid runs here without contact",
                            job_.bodies[a].name, job_.bodies[b].name, time_));
    }
}

/// Half the shortest side of the box that has the body's principal moments; of a ball 0.775 of its radius
/// [m].
double inner_radius(const JobBody& b) {
  const Vec3& I = b.properties.principal_inertia;  // ascending
  return std::sqrt(std::max(0.0, 1.5 * (I.x + I.y - I.z) / b.properties.mass));
}

bool is_convex(const Body& b) {
  return b.shape.kind == Shape::Kind::box || b.shape.kind == Shape::Kind::sphere ||
         b.shape.kind == Shape::Kind::cylinder;
}

/// Distance of a place from a box; 0 inside [m].
double distance(const Shape& box, const Vec3& x) {
  Vec3 out;
  for (std::size_t k = 0; k < 3; ++k) out[k] = std::max({0.0, box.min[k] - x[k], x[k] - box.max[k]});
  return norm(out);
}

/// A body that flies into a fixed box, whichever way it turns: where its parabola is at the output times.
std::string why_it_lands(const Job& job) {
  for (std::size_t a = 0; a < job.bodies.size(); ++a)
    for (std::size_t b = 0; b < job.bodies.size(); ++b) {
      const JobBody& flying = job.bodies[a];
      if (flying.motion != Motion::free || job.bodies[b].motion != Motion::fixed ||
          !is_convex(job.scene.bodies[a]) || !is_upright_box(job.scene.bodies[b].shape))
        continue;
      for (const double t : job.times) {
        const Vec3 centre =
            flying.properties.centre + t * flying.velocity + (0.5 * t * t) * job.scene.gravity;
        if (distance(job.scene.bodies[b].shape, centre) < inner_radius(flying))
          return fmt::format("{} meets {}, and fix rigid runs here without contact", flying.name,
                             job.bodies[b].name);
      }
    }
  return {};
}

/// Two convex bodies that fly into each other, whichever way they turn: of the same gravity, so that they
/// come together along a line.
std::string why_they_meet(const Job& job) {
  for (std::size_t a = 0; a < job.bodies.size(); ++a)
    for (std::size_t b = a + 1; b < job.bodies.size(); ++b) {
      const JobBody &one = job.bodies[a], &two = job.bodies[b];
      if (one.motion != Motion::free || two.motion != Motion::free || !is_convex(job.scene.bodies[a]) ||
          !is_convex(job.scene.bodies[b]))
        continue;
      const Vec3 apart = two.properties.centre - one.properties.centre, speed = two.velocity - one.velocity;
      if (!(dot(speed, speed) > 0.0)) continue;
      const double when = std::clamp(-dot(apart, speed) / dot(speed, speed), 0.0, job.times.back());
      if (norm(apart + when * speed) < inner_radius(one) + inner_radius(two))
        return fmt::format("{} and {} meet, and fix rigid runs here without contact", one.name, two.name);
    }
  return {};
}

}  // namespace

std::string why_no_rigid(const Job& job) {
  for (const JobBody& b : job.bodies) {
    if (b.phase != Phase::rigid)
      return fmt::format("LAMMPS runs rigid bodies by fix rigid here, and {} is {}", b.name,
                         to_string(b.phase));
    if (b.motion == Motion::prescribed)
      return fmt::format("{} is prescribed; fix rigid follows forces, not keyframes", b.name);
  }
  for (const Body& b : job.scene.bodies)
    if (b.joins || !b.joined_to.empty())
      return fmt::format("bonds are not handed to fix rigid, and {} has some", b.name);
  if (!job.scene.events.empty())
    return "fix rigid keeps its bodies for the whole run: no merge, split or other events";
  if (!job.scene.inflows.empty()) return "no inflow into fix rigid";
  if (job.scene.periodic[0] || job.scene.periodic[1] || job.scene.periodic[2])
    return "rigid bodies across periodic directions are not handed to fix rigid";
  const std::string lands = why_it_lands(job);
  return lands.empty() ? why_they_meet(job) : lands;
}

std::unique_ptr<Model> make_rigid_flight(const Job& job, const InitialState& state) {
  return std::make_unique<RigidFlight>(job, state);
}

}  // namespace tripoint::lammps

// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/bullet/bullet_engine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "adapters/bullet/limits.hpp"
#include "adapters/bullet/pieces.hpp"
#include "adapters/bullet/presets.hpp"
#include "core/not_a_number.hpp"
#include "scene/contact_law.hpp"
#include "scene/motion.hpp"

namespace tripoint::bullet {
namespace {

int material_row(const Scene& scene, const std::string& material) {
  return static_cast<int>(&scene.material(material) - scene.materials.data());
}

/// What the scene does not say of a pair is the preset's.
PairLaws pair_laws(const Job& job) {
  const Preset preset = preset_for(job);
  const auto& materials = job.scene.materials;
  const std::vector<double> row(materials.size());
  PairLaws laws{{materials.size(), row}, {materials.size(), row}};
  for (std::size_t a = 0; a < materials.size(); ++a)
    for (std::size_t b = 0; b < materials.size(); ++b) {
      const ContactLaw* law = contact_law_of(job.scene, materials[a].name, materials[b].name);
      laws.friction[a][b] = law ? law->friction.value_or(preset.friction) : preset.friction;
      laws.restitution[a][b] = law ? law->restitution.value_or(preset.restitution) : preset.restitution;
    }
  return laws;
}

}  // namespace

EngineInfo BulletEngine::info() const {
  EngineInfo info;
  info.name = "bullet";
  info.version = World::version();
  info.build = "float64";
  info.library_path = World::library_path();
  info.capabilities = {"rigid-free-flight", "gravity",       "fixed", "prescribed", "merge", "split",
                       "contact",           "contact-pairs", "force", "joint"};
  info.presets = preset_names();
  info.settings = setting_help();
  return info;
}

std::string BulletEngine::refusal(const Job& job) const { return why_not(job); }

void BulletEngine::load(const Job& job, const InitialState& state) {
  job_ = job;
  state_ = state;
  dt_ = wanted_time_step(job);
  time_ = job.times.empty() ? 0.0 : job.times.front();
  world_ = std::make_unique<World>(preset_for(job), job.scene.gravity);
  if (common_contact(job.scene).differs) world_->use(pair_laws(job));
  for (const JobBody& body : job.bodies) {
    rows_.push_back(start_row(body));
    rows_.back().pieces = start_pieces(rows_.back(), body);
    enter(rows_.back(), start_motion(rows_.back(), body));
  }
  const auto handle = [&](const std::string& name) {
    const auto row = std::ranges::find(rows_, name, &Row::name);
    return row == rows_.end() ? -1 : row->handle;
  };
  for (const Joint& joint : job.scene.joints)
    world_->join(joint, handle(joint.bodies[0]), handle(joint.bodies[1]));
  events_ = job.scene.events;
  std::stable_sort(events_.begin(), events_.end(),
                   [](const Event& a, const Event& b) { return a.time < b.time; });
}

BulletEngine::Row BulletEngine::start_row(const JobBody& body) const {
  Row row;
  row.name = body.name;
  row.motion = body.motion;
  row.material = material_row(job_.scene, body.material);
  row.keyframes = body.keyframes;
  row.start_velocity = body.velocity;
  row.start_spin = body.angular_velocity;
  row.properties = body.properties;
  row.frame = body.properties.principal_axes;
  for (std::size_t i = 0; i < state_.size(); ++i)
    if (state_.body[i] == body.index) row.members.push_back(static_cast<int>(i));
  std::vector<Vec3> at;
  for (const int i : row.members) at.push_back(state_.position[static_cast<std::size_t>(i)]);
  set_arms(row, at, body.properties.centre, body.properties.principal_axes);
  return row;
}

void BulletEngine::set_arms(Row& row, const std::vector<Vec3>& at, const Vec3& centre,
                            const Quaternion& principal) const {
  row.arms.clear();
  for (const Vec3& x : at) row.arms.push_back(rotate_back(principal, x - centre));
}

/// The case's own shape where the preset wants it and Bullet has one for it, else one piece a particle.
std::vector<Piece> BulletEngine::start_pieces(const Row& row, const JobBody& body) const {
  const Quaternion& axes = row.frame;
  if (preset_for(job_).collision == Collision::solid) {
    auto own = pieces_of(job_.scene.body(body.name).shape,
                         {body.properties.centre, axes, body.motion == Motion::free});
    if (!own.empty()) return own;
  }
  std::vector<Piece> pieces(row.arms.size(), particle_piece());
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    pieces[k].centre = row.arms[k];
    pieces[k].rotation = conjugate(axes);
  }
  return pieces;
}

Piece BulletEngine::particle_piece() const {
  // Pieces of particles that jitter do not overlap
  const double half = (0.5 - job_.scene.jitter) * job_.resolution.spacing;
  return {preset_for(job_).collision == Collision::spheres ? Piece::Kind::sphere : Piece::Kind::box,
          {},
          {},
          {half, half, half}};
}

RigidMotion BulletEngine::start_motion(const Row& row, const JobBody& body) const {
  if (row.motion != Motion::prescribed)
    return {body.properties.centre, row.frame, body.velocity, body.angular_velocity};
  const PrescribedState s =
      prescribed_state(row.keyframes, body.properties.centre, body.velocity, body.angular_velocity, time_);
  return {s.position, s.rotation * row.frame, s.velocity, s.angular_velocity};
}

void BulletEngine::enter(Row& row, const RigidMotion& motion) {
  const Drive drive = row.motion == Motion::fixed        ? Drive::fixed
                      : row.motion == Motion::prescribed ? Drive::kinematic
                                                         : Drive::dynamic;
  row.handle = world_->add(
      {row.properties.mass, row.properties.principal_inertia, motion, drive, row.pieces, row.material});
}

void BulletEngine::advance_to(double time) {
  const double late = 1e-12 * std::max(1.0, std::abs(time));
  while (next_event_ < events_.size() && events_[next_event_].time <= time + late) {
    const Event& event = events_[next_event_++];
    integrate_to(std::min(event.time, time));
    apply(event);
  }
  integrate_to(time);
}

namespace {

/// Number of equal steps, none above `limit`, over an interval.
long steps_in(double interval, double limit) {
  return std::max(1L, static_cast<long>(std::ceil(interval / limit * (1.0 - 1e-9))));
}

}  // namespace

/// The step that the first interval will be run with. [s]
double BulletEngine::first_step() const {
  if (job_.times.size() < 2) return dt_;
  const double interval = job_.times[1] - job_.times[0];
  return interval / static_cast<double>(steps_in(interval, dt_));
}

/// Equal steps, none above the wanted one, that end at `time`.
void BulletEngine::integrate_to(double time) {
  const double interval = time - time_, start = time_;
  if (interval <= 0.0) return;
  const long n = steps_in(interval, dt_);
  last_dt_ = interval / static_cast<double>(n);
  for (long k = 1; k <= n; ++k) {
    drive_bodies(start + interval * static_cast<double>(k) / static_cast<double>(n));
    push_bodies();
    world_->step(last_dt_);
    ++steps_;
  }
  time_ = time;
  check_finite();
}

void BulletEngine::drive_bodies(double time) {
  for (const Row& r : rows_) {
    if (r.handle < 0 || r.motion != Motion::prescribed) continue;
    const PrescribedState s =
        prescribed_state(r.keyframes, r.properties.centre, r.start_velocity, r.start_spin, time);
    world_->drive(r.handle, s.position, s.rotation * r.frame);
  }
}

/// Bullet forgets forces after each step.
void BulletEngine::push_bodies() {
  for (const AppliedForce& force : job_.scene.forces)
    for (const Row& r : rows_) {
      if (r.name != force.body || r.handle < 0) continue;
      const Quaternion turned = world_->motion(r.handle).orientation * conjugate(r.frame);
      world_->push(r.handle, force.value,
                   force.point ? rotate(turned, *force.point - r.properties.centre) : Vec3{});
    }
}

void BulletEngine::check_finite() const {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].handle < 0) continue;
    const RigidMotion m = world_->motion(rows_[i].handle);
    if (!finite(m.centre) || !finite(m.velocity) || !finite(m.angular_velocity) ||
        !std::isfinite(norm(m.orientation)))
      throw Diverged(-1, static_cast<long>(i), "position", "stepSimulation", time_,
                     fmt::format("the state of {} is not finite", rows_[i].name));
  }
}

Snapshot BulletEngine::observe() const {
  const std::size_t n = state_.size();
  Snapshot s;
  s.time = time_;
  s.step = steps_;
  s.position.resize(n);
  s.velocity.resize(n);
  s.id.resize(n);
  s.body.resize(n);
  for (std::size_t i = 0; i < n; ++i) s.id[i] = static_cast<int>(i);
  s.phase = state_.phase;
  s.material = state_.material;
  s.mass = state_.mass;
  s.energy = {{"kinetic", 0.0}, {"potential", 0.0}};
  for (const Row& r : rows_) show_body(s, r);
  return s;
}

void BulletEngine::show_body(Snapshot& s, const Row& r) const {
  const Vec3 nan{not_a_number, not_a_number, not_a_number};
  if (r.handle < 0) {
    s.bodies.push_back(
        {nan, nan, nan, {not_a_number, not_a_number, not_a_number, not_a_number}, not_a_number, nan, nan});
    return;
  }
  const RigidMotion m = world_->motion(r.handle);
  const Wrench wrench = last_dt_ > 0.0 ? world_->contact(r.handle, last_dt_) : Wrench{};
  const int index = static_cast<int>(s.bodies.size());
  s.bodies.push_back({m.centre, m.velocity, m.angular_velocity,
                      normalised(m.orientation * conjugate(r.frame)), r.properties.mass, wrench.force,
                      wrench.torque});
  for (std::size_t k = 0; k < r.members.size(); ++k) {
    const auto i = static_cast<std::size_t>(r.members[k]);
    const Vec3 arm = rotate(m.orientation, r.arms[k]);
    s.position[i] = m.centre + arm;
    s.velocity[i] = m.velocity + cross(m.angular_velocity, arm);
    s.body[i] = index;
  }
  const Vec3 w = rotate_back(m.orientation, m.angular_velocity), inertia = r.properties.principal_inertia;
  const Vec3 spin{inertia.x * w.x, inertia.y * w.y, inertia.z * w.z};  // [kg m2/s], principal frame
  s.total_mass += r.properties.mass;
  s.momentum += r.properties.mass * m.velocity;
  s.angular_momentum += r.properties.mass * cross(m.centre, m.velocity) + rotate(m.orientation, spin);
  s.energy["kinetic"] += 0.5 * r.properties.mass * dot(m.velocity, m.velocity) + 0.5 * dot(w, spin);
  if (r.motion != Motion::fixed)
    s.energy["potential"] -= r.properties.mass * dot(world_->gravity(), m.centre);
}

Readback BulletEngine::readback() const {
  Readback back;
  if (!world_) return back;
  back.gravity = world_->gravity();
  back.time_step = last_dt_ > 0.0 ? last_dt_ : first_step();
  for (const Row& r : rows_) {
    if (r.handle < 0) continue;
    const HeldBody held = world_->held(r.handle);
    back.bodies.push_back({r.name, held.mass, held.centre, held.principal_inertia, held.friction,
                           held.restitution, held.linear_damping, held.angular_damping});
  }
  return back;
}

void BulletEngine::account(Result& result) const {
  result.steps = steps_;
  result.time_step_bound =
      job_.resolution.time_step || job_.settings.contains("time_step") ? "given" : "default 1/240 s";
  if (!world_) return;
  result.pairs = world_->contact_points();
  result.iterations = static_cast<double>(steps_) * preset_for(job_).iterations;
}

}  // namespace tripoint::bullet

// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/exact/exact_engine.hpp"

#include <algorithm>

#include "core/not_a_number.hpp"
#include "validation/references/rigid_body.hpp"

namespace tripoint {

EngineInfo ExactEngine::info() const {
  EngineInfo info;
  info.name = "exact";
  info.version = "1";
  info.build = "closed forms in double and long double";
  info.capabilities = {"rigid-free-flight",   "gravity", "force", "merge", "split", "prescribed", "heat",
                       "surface-temperature", "plane",   "joint", "spring"};
  return info;
}

namespace {

/// A reference that knows rigid bodies only: their particles go with them.
bool places_by_bodies(const Snapshot& truth, const InitialState& initial) {
  const auto has = [&](int row) { return row >= 0 && static_cast<std::size_t>(row) < truth.bodies.size(); };
  return truth.position.empty() && std::ranges::all_of(initial.body, has) &&
         std::ranges::all_of(initial.phase, [](int p) { return p == static_cast<int>(Phase::rigid); });
}

void place_by_bodies(const Job& job, const InitialState& initial, Snapshot& frame) {
  std::vector<Vec3> centre(frame.bodies.size());
  for (const auto& b : job.bodies)
    if (b.index >= 0) centre[static_cast<std::size_t>(b.index)] = b.properties.centre;
  for (std::size_t i = 0; i < initial.size(); ++i) {
    const auto row = static_cast<std::size_t>(initial.body[i]);
    const BodyState& b = frame.bodies[row];
    const Vec3 arm = rotate(b.orientation, initial.position[i] - centre[row]);
    frame.position.push_back(b.position + arm);
    frame.velocity.push_back(b.velocity + cross(b.angular_velocity, arm));
  }
}

}  // namespace

std::string ExactEngine::refusal(const Job& job) const {
  try {
    const auto initial = read_particles(job.particles);
    const auto reference = make_reference(job.reference, job, initial);
    Snapshot start = reference->at(0.0);
    if (places_by_bodies(start, initial)) {
      place_by_bodies(job, initial, start);
      for (std::size_t i = 0; i < initial.size(); ++i)
        if (!(norm(start.position[i] - initial.position[i]) <= 1e-6 * job.scene.spacing))
          return "not applicable: the reference `" + job.reference.function +
                 "` knows the end, not the way there";
    }
    return start.position.empty() ? "not applicable: the reference `" + job.reference.function +
                                        "` gives scalar results, not particle positions"
                                  : "";
  } catch (const InputError& e) {
    return e.what();
  }
}

void ExactEngine::load(const Job& job, const InitialState& initial) {
  job_ = job;
  initial_ = initial;
  try {
    reference_ = make_reference(job.reference, job, initial);
  } catch (const InputError& e) {
    throw EngineError(e.what());
  }
  time_ = job.times.empty() ? 0.0 : job.times.front();
}

void ExactEngine::fill_observables(Snapshot& frame) const {
  for (std::size_t i = 0; i < initial_.size(); ++i) {
    frame.total_mass += initial_.mass[i];
    const Vec3 p = initial_.mass[i] * frame.velocity[i];
    frame.momentum += p;
    frame.angular_momentum += cross(frame.position[i], p);
  }
  frame.energy["kinetic"] = kinetic_energy(frame.velocity, initial_.mass);
}

Snapshot ExactEngine::observe() const {
  Snapshot frame = reference_->at(time_);
  if (places_by_bodies(frame, initial_)) place_by_bodies(job_, initial_, frame);
  for (std::size_t i = 0; i < initial_.size(); ++i) frame.id.push_back(static_cast<int>(i));
  if (frame.phase.empty()) frame.phase = initial_.phase;
  if (frame.body.empty()) frame.body = initial_.body;
  frame.material = initial_.material;
  frame.mass = initial_.mass;
  fill_observables(frame);
  return frame;
}

Readback ExactEngine::readback() const {
  Readback held;
  held.gravity = job_.scene.gravity;
  held.precision = "exact";
  for (const auto& b : job_.bodies)
    if (b.index >= 0)
      held.bodies.push_back({b.name, b.properties.mass, b.properties.centre, b.properties.principal_inertia,
                             not_a_number, not_a_number});
  return held;
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/exact/exact_engine.hpp"

#include "validation/references/rigid_body.hpp"

namespace tripoint {

EngineInfo ExactEngine::info() const {
  EngineInfo info;
  info.name = "exact";
  info.version = "1";
  info.build = "closed forms in double and long double";
  info.capabilities = {"rigid-free-flight", "gravity", "merge", "split", "prescribed", "heat"};
  return info;
}

std::string ExactEngine::refusal(const Job& job) const {
  try {
    const auto initial = read_particles(job.particles);
    const auto reference = make_reference(job.reference, job, initial);
    return reference->at(0.0).position.empty() ? "not applicable: the reference `" + job.reference.function + "` gives scalar results, not particle positions" : "";
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
    if (b.index >= 0) held.bodies.push_back({b.name, b.properties.mass, b.properties.centre, b.properties.principal_inertia});
  return held;
}

}  // namespace tripoint

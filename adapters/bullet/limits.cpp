// SPDX-License-Identifier: BSD-3-Clause
#include "adapters/bullet/limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "adapters/bullet/presets.hpp"

namespace tripoint::bullet {
namespace {

std::string refuse_bodies(const Job& job) {
  for (const JobBody& body : job.bodies)
    if (body.phase != Phase::rigid)
      return fmt::format("Bullet knows rigid bodies only, and {} is {}", body.name, to_string(body.phase));
  for (const Body& body : job.scene.bodies) {
    if (body.temperature) return fmt::format("Bullet knows no heat, and {} has a temperature", body.name);
    if (body.joins || !body.joined_to.empty())
      return fmt::format("bonds between bodies are not handed to Bullet, and {} has some", body.name);
  }
  return {};
}

bool is_free(const Job& job, const std::string& name) {
  const auto found =
      std::find_if(job.bodies.begin(), job.bodies.end(), [&](const JobBody& b) { return b.name == name; });
  return found == job.bodies.end() || found->motion == Motion::free;  // a body born by a split is free
}

std::string refuse_events(const Job& job) {
  for (const Event& event : job.scene.events) {
    if (event.kind != Event::Kind::merge && event.kind != Event::Kind::split)
      return "of the events only merge and split are handed to Bullet";
    for (const std::string& name : event.bodies)
      if (!is_free(job, name))
        return fmt::format("Bullet's bodies merge and split in free flight, and {} is held", name);
  }
  return {};
}

std::string refuse_scene(const Scene& scene) {
  if (scene.mode == Mode::paper) return "the paper's forms belong to the particle solver; Bullet has none";
  if (std::any_of(scene.periodic.begin(), scene.periodic.end(), [](bool p) { return p; }))
    return "Bullet has no periodic directions";
  if (!scene.inflows.empty()) return "Bullet has no inflow";
  return {};
}

/// Why a joint or its laws have no constraint of Bullet.
std::string refuse_joints(const Scene& scene) {
  if (!scene.joints.empty() && std::ranges::any_of(scene.events, [](const Event&) { return true; }))
    return "joints are handed to Bullet in scenes without events";
  for (const Joint& j : scene.joints) {
    if (j.kind == Joint::Kind::distance)
      return fmt::format("Bullet has no constraint of a distance, and {} is one", j.name);
    if (j.restitution > 0.0 || j.friction > 0.0 || j.damping > 0.0 || j.spring ||
        (j.motor && j.motor->effort))
      return fmt::format(
          "restitution, friction, damping, springs and efforts of joints are not handed to Bullet, and {} "
          "has "
          "some",
          j.name);
  }
  return {};
}

/// Bullet distorts rotations of more than pi/4 a step, and clamps at pi/2.
std::string refuse_spin(const Job& job) {
  for (const JobBody& body : job.bodies) {
    const double angle = norm(body.angular_velocity) * wanted_time_step(job);
    if (body.motion == Motion::free && angle > std::numbers::pi / 4)
      return fmt::format("{} turns by {:.3g} rad a step; Bullet distorts rotations above pi/4 a step",
                         body.name, angle);
  }
  return {};
}

std::string refuse_settings(const Job& job) {
  try {
    (void)preset_for(job);
    return wanted_time_step(job) > 0.0 ? "" : "bullet: time_step must be above zero";
  } catch (const InputError& error) {
    return error.what();
  }
}

}  // namespace

std::string why_not(const Job& job) {
  for (const std::string& reason : {refuse_settings(job), refuse_scene(job.scene), refuse_joints(job.scene),
                                    refuse_bodies(job), refuse_events(job)})
    if (!reason.empty()) return reason;
  return refuse_spin(job);
}

double wanted_time_step(const Job& job) {
  const auto set = job.settings.find("time_step");
  if (set == job.settings.end()) return job.resolution.time_step.value_or(1.0 / 240.0);
  const auto* value = std::get_if<double>(&set->second);
  return value ? *value : 0.0;
}

}  // namespace tripoint::bullet

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "files/job.hpp"
#include "validation/run/run_one.hpp"

namespace tripoint {
namespace {

/// An engine may hold its inputs as reciprocals or in other units: a few roundings of its own precision, but
/// no more.
double roundings(const Readback& held) { return held.precision == "single" ? 1e-6 : 1e-9; }

bool same(double a, double b, double tolerance) { return std::abs(a - b) <= tolerance; }

std::string text(const Vec3& v) { return fmt::format("({:g}, {:g}, {:g})", v.x, v.y, v.z); }

/// A moment below this share of m dx^2 may be left out. A body of particles in a line, or nearly so, has no
/// rotation about it (model 8.9).
constexpr double truncated_share = 2e-3;

/// @param share of a value that it may be off by
std::string audit_body(const JobBody& given, const ReadbackBody& held, double spacing, double share) {
  const auto& p = given.properties;
  if (!same(p.mass, held.mass, share * p.mass))
    return fmt::format("mass of {} is {:.10g} kg, given were {:.10g} kg", given.name, held.mass, p.mass);
  const double largest = std::max({p.principal_inertia.x, p.principal_inertia.y, p.principal_inertia.z});
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (!same(p.principal_inertia[axis], held.principal_inertia[axis], share * largest) &&
        !(held.principal_inertia[axis] == 0.0 &&
          p.principal_inertia[axis] < truncated_share * p.mass * spacing * spacing))
      return fmt::format("principal inertia of {} is {} kg m2, given was {}", given.name,
                         text(held.principal_inertia), text(p.principal_inertia));
  if (held.linear_damping != 0.0 || held.angular_damping != 0.0)
    return fmt::format("{} is damped, which the scene does not say", given.name);
  return {};
}

/// Compares the contact laws that the engine states with those that all engines were given.
std::string audit_contact(const Settings& asked, const ReadbackBody& held, double share) {
  for (const auto& [law, found] : {std::pair{"friction", held.friction}, {"restitution", held.restitution}}) {
    const auto at = asked.find(law);
    const double* const wanted = at == asked.end() ? nullptr : std::get_if<double>(&at->second);
    if (wanted && std::isfinite(found) && !same(*wanted, found, share * std::max(1.0, *wanted)))
      return fmt::format("{} of {} is {:.6g}, given was {:.6g}", law, held.name, found, *wanted);
  }
  return {};
}

/// Laws that a vendor's joints have as they come are laws of another scene.
std::string audit_joint(const Joint& given, const ReadbackJoint& held, double share) {
  const double stiffness = given.spring ? given.spring->stiffness : 0.0;
  for (const auto& [law, found, asked] : {std::tuple{"damping", held.damping, given.damping},
                                          {"friction", held.friction, given.friction},
                                          {"stiffness", held.stiffness, stiffness},
                                          {"armature", held.armature, 0.0}})
    if (!same(found, asked, share * asked))
      return fmt::format("{} of joint {} is {:.6g}, given was {:.6g}", law, given.name, found, asked);
  return {};
}

}  // namespace

std::string audit_scene(const Job& job, const Readback& held) {
  const Vec3 off = held.gravity - job.scene.gravity;
  if (!(norm(off) <= roundings(held) * norm(job.scene.gravity)))
    return fmt::format("gravity is {} m/s2, given was {}", text(held.gravity), text(job.scene.gravity));
  for (const auto& body : held.bodies) {
    const auto given = std::find_if(job.bodies.begin(), job.bodies.end(),
                                    [&](const auto& b) { return b.name == body.name; });
    if (given == job.bodies.end())
      return fmt::format("it holds a body {} that the scene does not have", body.name);
    if (given->phase != Phase::rigid || given->motion != Motion::free)
      continue;  // a driven body's mass is the engine's own affair
    if (const auto other = audit_body(*given, body, job.scene.spacing, roundings(held)); !other.empty())
      return other;
    if (job.bodies.size() < 2) continue;  // alone: it touches nothing
    if (const auto other = audit_contact(job.settings, body, roundings(held)); !other.empty()) return other;
  }
  for (const ReadbackJoint& joint : held.joints) {
    const auto given = std::ranges::find(job.scene.joints, joint.name, &Joint::name);
    if (given == job.scene.joints.end())
      return fmt::format("it holds a joint {} that the scene does not have", joint.name);
    if (const auto other = audit_joint(*given, joint, roundings(held)); !other.empty()) return other;
  }
  return {};
}

}  // namespace tripoint

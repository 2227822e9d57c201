// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/audit/audit_parts.hpp"

namespace tripoint {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Sums over the particles of a frame, and the sums of their sizes: what rounding is measured by.
struct Sums {
  double mass = 0.0, kinetic = 0.0, momentum_size = 0.0, angular_size = 0.0;
  Vec3 momentum, angular_momentum;
};

Sums sums_of(const Audited& run, const Snapshot& s) {
  Sums sum;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    if (dead(s, i)) continue;
    const double m = i < s.mass.size() ? s.mass[i] : i < run.initial.mass.size() ? run.initial.mass[i] : 0.0;
    sum.mass += m;
    if (i >= s.velocity.size()) continue;
    const Vec3 p = m * s.velocity[i], l = cross(s.position[i], p);
    sum.momentum += p;
    sum.angular_momentum += l;
    sum.momentum_size += norm(p);
    sum.angular_size += norm(l);
    sum.kinetic += 0.5 * dot(s.velocity[i], p);
  }
  return sum;
}

/// An engine that writes no sums leaves them at zero. One that states an energy states its mass, too.
bool states_mass(const Audited& run) {
  return std::any_of(run.frames.begin(), run.frames.end(),
                     [](const Snapshot* s) { return s->total_mass != 0.0 || !s->energy.empty(); });
}

bool states(const Audited& run, Vec3 Snapshot::*sum) {
  return std::ranges::any_of(run.frames, [sum](const Snapshot* s) { return !(norm(s->*sum) == 0.0); });
}

bool has_rigid_matter(const Audited& run) {
  return std::any_of(run.frames.begin(), run.frames.end(),
                     [](const Snapshot* s) { return std::ranges::count(s->phase, 2) > 0; });
}

/// Fractions by which sound sums may differ from those of the particles. A rigid body may turn with moments
/// that are not those of its particles, as metrics then show; a place that was wrapped says nothing of the
/// moment of its momentum.
struct Tolerance {
  double sums, kinetic, angular;
};

Tolerance tolerance_of(const Audited& run) {
  const double rounding = run.is_single() ? 1e-4 : 1e-6;
  const auto& periodic = run.job.scene.periodic;
  const bool rigid = has_rigid_matter(run), wraps = periodic[0] || periodic[1] || periodic[2];
  return {rounding, rigid ? unbounded : rounding, rigid || wraps ? unbounded : rounding};
}

std::string differ(const Snapshot& s, const char* what, double stated, double shown) {
  return "contradicts itself: the sum `" + std::string(what) + "` says " + figure(stated) +
         ", the particles " + figure(shown) + at_time(s);
}

std::string differ(const Snapshot& s, const char* what, const Vec3& stated, const Vec3& shown) {
  std::size_t k = 0;
  for (std::size_t n = 1; n < 3; ++n)
    if (std::abs(stated[n] - shown[n]) > std::abs(stated[k] - shown[k])) k = n;
  return differ(s, (what + std::string(k == 0 ? ".x" : k == 1 ? ".y" : ".z")).c_str(), stated[k], shown[k]);
}

}  // namespace

std::string sums_against_particles(const Audited& run) {
  const bool has_mass = states_mass(run);
  const bool has_momentum = has_mass || states(run, &Snapshot::momentum);
  const bool has_angular = has_mass || states(run, &Snapshot::angular_momentum);
  if (!has_momentum && !has_angular) return {};
  const auto tolerance = tolerance_of(run);
  std::vector<Sums> shown;
  Sums most;
  for (const auto* s : run.frames) {
    const auto& sum = shown.emplace_back(sums_of(run, *s));
    most.mass = std::max(most.mass, sum.mass);
    most.kinetic = std::max(most.kinetic, sum.kinetic);
    most.momentum_size = std::max(most.momentum_size, sum.momentum_size);
    most.angular_size = std::max(most.angular_size, sum.angular_size);
  }
  const auto apart = [](double distance, double size, double share) {
    return share < unbounded && !(distance <= share * size);
  };
  for (std::size_t n = 0; n < run.frames.size(); ++n) {
    const Snapshot& s = *run.frames[n];
    const Sums& of = shown[n];
    if (has_mass && apart(std::abs(s.total_mass - of.mass), most.mass, tolerance.sums))
      return differ(s, "mass", s.total_mass, of.mass);
    if (s.velocity.empty()) continue;
    if (has_momentum && apart(norm(s.momentum - of.momentum), most.momentum_size, tolerance.sums))
      return differ(s, "momentum", s.momentum, of.momentum);
    if (has_angular &&
        apart(norm(s.angular_momentum - of.angular_momentum), most.angular_size, tolerance.angular))
      return differ(s, "angular_momentum", s.angular_momentum, of.angular_momentum);
    const auto kinetic = s.energy.find("kinetic");
    if (kinetic != s.energy.end() &&
        apart(std::abs(kinetic->second - of.kinetic), most.kinetic, tolerance.kinetic))
      return differ(s, "energy_kinetic", kinetic->second, of.kinetic);
  }
  return {};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/case_summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "assembly/plan.hpp"
#include "liquids/carried_density.hpp"
#include "program/bench/trial.hpp"
#include "scene/initial_state.hpp"
#include "scene/scene.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/results/escaped_text.hpp"

namespace tripoint {
namespace {

std::string line(const std::string& name, const std::string& text) {
  return text.empty() ? "" : one_line(fmt::format("  {:10} {}", name, text)) + "\n";
}

std::string matter(const Scene& scene) {
  std::vector<std::string> bodies;
  for (const auto& b : scene.bodies) {
    const std::string motion = b.motion == Motion::free ? "" : std::string(to_string(b.motion)) + " ";
    bodies.push_back(fmt::format("{} ({}{} {})", b.name, motion, to_string(b.phase), b.material));
  }
  constexpr std::size_t shown = 4;
  const std::size_t left = bodies.size() > shown ? bodies.size() - shown : 0;
  bodies.resize(bodies.size() - left);
  std::string text =
      fmt::format("{}{}", fmt::join(bodies, ", "), left > 0 ? fmt::format(" and {} more", left) : "");
  if (!scene.inflows.empty())
    text += fmt::format("; {} inflow{}", scene.inflows.size(), scene.inflows.size() == 1 ? "" : "s");
  if (!scene.events.empty())
    text += fmt::format("; {} event{}", scene.events.size(), scene.events.size() == 1 ? "" : "s");
  return text;
}

std::string simulated(const Scene& scene, const bench::Trial& trial) {
  const std::string particles = trial.particles > 0 ? fmt::format("{} particles, ", trial.particles) : "";
  return fmt::format("{}{:g} m apart, from 0 to {:g} s", particles, scene.spacing, scene.end_time);
}

/// Says how a liquid under gravity starts.
std::string start_of(const Scene& scene) {
  if (scene.settle) return "liquids are let down into equilibrium before time 0 (settle = true)";
  if (scene.gravity == Vec3{} || std::none_of(scene.bodies.begin(), scene.bodies.end(),
                                              [](const Body& b) { return b.phase == Phase::liquid; }))
    return "";
  if (liquid::carries_density(scene))
    return "liquids lie on a lattice, under the pressure of their own weight";
  return "liquids lie on a lattice, which sinks by a tenth of a spacing and breaks up; settle = true lets "
         "them down first, where "
         "solids hold them";
}

std::string effects_of(const Plan& plan) {
  std::vector<std::string> names;
  for (const auto& e : plan.effects) names.push_back(fmt::format("{} ({})", e.name, e.mode));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string truth(const ReferenceChoice& r) {
  if (r.function.empty() && r.file.empty() && r.source.empty()) return "";
  const std::string what = !r.function.empty() ? r.function : r.file;
  return fmt::format("{}{}{}{}{}", r.kind, what.empty() ? "" : " ", what, r.source.empty() ? "" : ": ",
                     r.source);
}

std::string measured_by(const Case& c) {
  std::vector<std::string> names;
  for (const auto& m : c.metrics)
    names.push_back(m.unit.empty() ? m.name : fmt::format("{} [{}]", m.name, m.unit));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string judged_by(const Case& c) {
  if (c.gates.empty()) return "no gate: the case measures and judges nothing";
  std::set<std::string> metrics;
  for (const auto& g : c.gates) metrics.insert(g.metric);
  return fmt::format("{} gate{} on {}{}", c.gates.size(), c.gates.size() == 1 ? "" : "s",
                     fmt::join(metrics, ", "),
                     c.expect == Expect::pass ? "" : fmt::format("; expected: {}", c.expect));
}

std::string engines_of(const Case& c) {
  std::vector<std::string> names;
  const bool listed =
      std::any_of(c.engines.begin(), c.engines.end(), [](const auto& e) { return is_own_solver(e.name); });
  if (!listed) names.push_back(std::string(engine_name::solver) + " (required)");
  for (const auto& e : c.engines) names.push_back(e.name + (e.required ? " (required)" : ""));
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string studies_of(const Case& c) {
  std::vector<std::string> studies;
  for (const auto& s : c.studies)
    studies.push_back(fmt::format("{} levels of {}{}{}", s.levels.size(), s.axes.axis,
                                  s.engine.empty() ? "" : " on ", s.engine));
  return fmt::format("{}", fmt::join(studies, ", "));
}

std::string cost(const bench::Trial& t) {
  if (t.steps == 0) return t.failure.empty() ? "" : "not timed: " + t.failure;
  return fmt::format(
      "about {:.2g} s for the case's own run: {:.0f} steps of {:.3g} s, bound by {}, each computed in {:.2g} "
      "s",
      t.run_seconds(), t.run_steps, t.time_step, t.bound_by, t.step_seconds);
}

}  // namespace

std::string case_summary(const Case& c, const Scene& scene, const Plan& plan, const bench::Trial& trial) {
  return one_line(fmt::format("{}: {}", c.id, c.title)) + "\n" + line("claims", c.claims) +
         line("simulates", simulated(scene, trial)) + line("bodies", matter(scene)) +
         line("starts", start_of(scene)) + line("effects", effects_of(plan)) +
         line("truth", truth(c.reference)) + line("measures", measured_by(c)) +
         line("judged by", judged_by(c)) + line("engines", engines_of(c)) + line("refined", studies_of(c)) +
         line("costs", cost(trial)) + "\n";
}

namespace {

/// Rms speed of a lattice that is let go, over sqrt(g H): the least that was measured
constexpr double stirs = 0.03;

/// The part of gravity that no periodic direction lets through [m/s2]
Vec3 weight(const Scene& s) {
  return {s.periodic[0] ? 0.0 : s.gravity.x, s.periodic[1] ? 0.0 : s.gravity.y,
          s.periodic[2] ? 0.0 : s.gravity.z};
}

bool is_solid(const Body& b, Motion motion) { return b.phase != Phase::liquid && b.motion == motion; }

/// Depth of the liquid of this body along gravity, one spacing more than its particles lie apart [m]; 0 where
/// one of them moves.
double depth_at_rest(const Scene& s, const InitialState& state, std::size_t body, const Vec3& down) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < state.size(); ++i) {
    if (static_cast<std::size_t>(state.source[i]) != body) continue;
    if (norm(state.velocity[i]) > 0.0) return 0.0;
    const double z = dot(state.position[i], down);
    low = std::min(low, z);
    high = std::max(high, z);
  }
  return high < low ? 0.0 : high - low + s.spacing;
}

const Material& material_of(const Scene& s, const Body& b) {
  return *std::ranges::find(s.materials, b.material, &Material::name);
}

}  // namespace

std::vector<Finding> start_notes(const Scene& s, const InitialState& state) {
  const double g = norm(weight(s));
  const auto any = [&](Motion motion) {
    return std::ranges::any_of(s.bodies, [&](const Body& b) { return is_solid(b, motion); });
  };
  if (s.settle || g == 0.0 || liquid::carries_density(s) || any(Motion::free) || !any(Motion::fixed))
    return {};
  for (std::size_t n = 0; n < s.bodies.size(); ++n) {
    const Body& b = s.bodies[n];
    if (b.phase != Phase::liquid) continue;
    const Material& m = material_of(s, b);
    const double speed = stirs * std::sqrt(g * depth_at_rest(s, state, n, weight(s) / g));
    if (m.viscosity >= m.density * speed * s.spacing) continue;  // it is held back within about a spacing
    return {{false,
             fmt::format("liquid \"{}\" starts as a lattice, which is no equilibrium: let go, it moves at "
                         "some {:.1g} m/s rms "
                         "for seconds; where it is to be at rest, scene.settle = true lets it down first",
                         b.name, speed),
             b.place}};
  }
  return {};
}

}  // namespace tripoint

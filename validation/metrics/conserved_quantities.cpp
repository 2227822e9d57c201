// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <optional>

#include "validation/metrics/members.hpp"

namespace tripoint {
namespace {

using Real = long double;  // sums of 1e5 terms stay below 1e-15 of the whole

/// Masses, places and velocities of living particles; empty when the frame does not have them all.
bool has_motion(const Snapshot& s, std::size_t n) {
  return s.position.size() >= n && s.velocity.size() >= n && n > 0;
}
/// A sum is of all particles that are alive, or of those of the metric's body.
bool left_out(const MetricInput& in, const Snapshot& s, std::size_t i) {
  return !is_alive(s, i) || !takes(in, i);
}
double mass_of(const MetricInput& in, const Snapshot& s, std::size_t i) {
  if (i < s.mass.size()) return s.mass[i];
  return i < in.initial.size() ? in.initial.mass[i] : not_a_number;
}

template <class F>
Vec3 vector_sum(const MetricInput& in, const Snapshot& s, F term) {
  Real x = 0, y = 0, z = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    if (left_out(in, s, i)) continue;
    const Vec3 t = term(i);
    x += t.x;
    y += t.y;
    z += t.z;
  }
  return {double(x), double(y), double(z)};
}

double total_mass(const MetricInput& in, const Snapshot& s) {
  Real sum = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i) sum += left_out(in, s, i) ? 0.0 : mass_of(in, s, i);
  return double(sum);
}

Vec3 momentum(const MetricInput& in, const Snapshot& s) {
  return vector_sum(in, s, [&](std::size_t i) { return mass_of(in, s, i) * s.velocity[i]; });
}

/// About the centre of mass of all that is alive: gravity does not change it.
Vec3 angular_momentum(const MetricInput& in, const Snapshot& s) {
  const double M = total_mass(in, s);
  const Vec3 centre = vector_sum(in, s, [&](std::size_t i) { return mass_of(in, s, i) * s.position[i]; }) / M;
  const Vec3 drift = momentum(in, s) / M;
  return vector_sum(in, s, [&](std::size_t i) {
    return mass_of(in, s, i) * cross(s.position[i] - centre, s.velocity[i] - drift);
  });
}

double kinetic(const MetricInput& in, const Snapshot& s) {
  Real sum = 0;
  for (std::size_t i = 0; i < s.velocity.size(); ++i)
    if (!left_out(in, s, i)) sum += Real(0.5) * mass_of(in, s, i) * dot(s.velocity[i], s.velocity[i]);
  return double(sum);
}

double potential(const MetricInput& in, const Snapshot& s) {
  Real sum = 0;
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (!left_out(in, s, i)) sum -= Real(mass_of(in, s, i)) * dot(in.job.scene.gravity, s.position[i]);
  return double(sum);
}

/// Heat, above 0 K.
std::optional<double> thermal(const MetricInput& in, const Snapshot& s) {
  if (s.temperature.size() < in.initial.size() || in.initial.size() == 0) return {};
  Real sum = 0;
  for (std::size_t i = 0; i < in.initial.size(); ++i) {
    if (left_out(in, s, i)) continue;
    const auto row = static_cast<std::size_t>(in.initial.material[i]);
    if (row >= in.job.scene.materials.size() || !in.job.scene.materials[row].heat_capacity) return {};
    sum += Real(mass_of(in, s, i)) * heat_per_mass(in.job.scene.materials[row], s, i);
  }
  return double(sum);
}

/// A ledger term of a frame [J]: kinetic, potential and thermal from the particles themselves, the rest as
/// the engine keeps it.
std::optional<double> term_of(const MetricInput& in, const Snapshot& s, const std::string& term) {
  const bool moves = has_motion(s, in.initial.size());
  if (term == "kinetic") return moves ? std::optional(kinetic(in, s)) : std::nullopt;
  if (term == "potential") return moves ? std::optional(potential(in, s)) : std::nullopt;
  if (term == "thermal") return thermal(in, s);
  if (!in.choice.body.empty()) return {};  // the engine keeps it for the whole scene
  if (term == "residual") {
    if (s.energy.empty()) return {};
    Real sum = 0;
    for (const auto& [name, value] : s.energy) sum += value;
    return double(sum);
  }
  const auto found = s.energy.find(term);
  return found == s.energy.end() ? std::nullopt : std::optional(found->second);
}

FrameError ledger(const FramePair& f) {
  const std::string term = f.in.choice.quantity.substr(std::string("ledger.").size());
  const auto now = term_of(f.in, f.now, term);
  if (!now && !f.in.choice.body.empty())
    return problem("the ledger term `" + term + "` is of the whole scene: leave out `body`");
  if (!now) return problem("the trajectory has no ledger term `" + term + "`");
  auto truth = term_of(f.in, term == "residual" ? f.first : f.truth, term);
  if (!truth && term == "kinetic" && f.in.choice.body.empty())
    truth = f.in.reference.number("kinetic_energy");  // a law of conservation knows it without particles
  if (const auto stated = f.in.reference.number("value"); !truth && stated) return single(*now - *stated);
  if (!truth)
    return problem("the reference does not know the ledger term `" + term + "`: use norm = \"drift\"");
  return single(*now - *truth);
}

/// A sum over all particles, by its component along the stated axis, else by its length, less the number that
/// the case states.
FrameError stated_sum(const FramePair& f, const char* name, const Vec3& sum) {
  const auto axis = f.in.reference.measuring().axis;
  return against_truth(f, name, axis ? sum[*axis] : norm(sum));
}

/// Whether the case states a number where the reference has no particles.
bool is_stated(const FramePair& f) {
  return f.truth.position.empty() && f.in.reference.number_at("value", f.now.time);
}

template <class F>
FrameError vector_change(const FramePair& f, F quantity, const char* name) {
  const auto n = f.in.initial.size();
  if (!has_motion(f.now, n)) return problem("the trajectory has no positions and velocities");
  if (is_stated(f)) return stated_sum(f, name, quantity(f.in, f.now));
  if (!has_motion(f.truth, n))
    return problem(std::string("the reference has no particles to sum the ") + name +
                   " of: use norm = \"drift\"");
  const Vec3 d = quantity(f.in, f.now) - quantity(f.in, f.truth);
  return finite(d) ? single(norm(d)) : problem(std::string(name) + " is not finite");
}

FrameError momentum_change(const FramePair& f) {
  if (is_stated(f) || !f.in.choice.body.empty() || !f.truth.position.empty() || f.truth.total_mass <= 0.0)
    return vector_change(f, momentum, "momentum");
  if (!has_motion(f.now, f.in.initial.size()))
    return problem("the trajectory has no positions and velocities");
  // a law of conservation knows it without particles
  return single(norm(momentum(f.in, f.now) - f.truth.momentum));
}

FrameError mass_change(const FramePair& f) {
  if (f.now.position.empty()) return problem("the trajectory has no particles");
  if (is_stated(f)) return against_truth(f, "mass", total_mass(f.in, f.now));
  const double of_all = f.in.choice.body.empty() ? f.truth.total_mass : 0.0;
  const double truth = f.truth.position.empty() ? of_all : total_mass(f.in, f.truth);
  if (!(truth > 0.0)) return problem("the reference does not know the mass: use norm = \"drift\"");
  return single(total_mass(f.in, f.now) - truth);
}

FrameError energy_change(const FramePair& f) {
  const auto n = f.in.initial.size();
  if (!has_motion(f.now, n)) return problem("the trajectory has no positions and velocities");
  const auto of = [&](const Snapshot& s) { return kinetic(f.in, s) + potential(f.in, s); };
  if (is_stated(f)) return against_truth(f, "energy", of(f.now));
  if (!has_motion(f.truth, n))
    return problem("the reference has no particles to sum the energy of: use norm = \"drift\"");
  return single(of(f.now) - of(f.truth));
}

FrameError energy_ratio(const FramePair& f) {
  const auto ratio = truth_of(f.in, "energy_ratio", f.now.time);
  if (!ratio) return problem("the reference does not know the energy ratio and states no value");
  const auto n = f.in.initial.size();
  if (!has_motion(f.now, n) || !has_motion(f.first, n))
    return problem("the trajectory has no positions and velocities");
  return single(kinetic(f.in, f.now) / kinetic(f.in, f.first) - *ratio);
}

FrameError bonded_objects(const FramePair& f) {
  const auto count = f.now.counts.find("objects");
  if (count == f.now.counts.end())
    return problem(
        "the run counts no objects: nothing in its scene melts, freezes or breaks, or its engine has no "
        "bonds");
  return against_truth(f, "bonded_objects", count->second);
}

FrameError recoveries(const FramePair& f) {
  const auto count = f.now.counts.find("recoveries");
  if (count == f.now.counts.end())
    return problem("the run counts no recoveries: its scene says on_failure = \"recover\" where it may");
  return single(count->second - f.in.reference.number("value").value_or(0.0));
}

FrameError left(const FramePair& f, const char* what) {
  const auto count = f.now.counts.find(what);
  if (count == f.now.counts.end())
    return problem("nothing can leave: the scene has on_escape = \"remove\" or an [[outflow]] where it may");
  return against_truth(f, what, count->second);
}

FrameError processes(const FramePair& f) {
  const auto count = f.now.counts.find("processes");
  if (count == f.now.counts.end()) return problem("the engine does not say over how many processes it ran");
  return against_truth(f, "processes", count->second);
}

}  // namespace

const std::vector<Quantity>& conserved_quantities() {
  static const std::vector<Quantity> list{
      {{"mass", "kg", "difference of the total mass (or the body's, as for all sums below)"}, mass_change},
      {{"momentum", "kg m/s", "length of the difference of the total momentum"}, momentum_change},
      {{"angular_momentum", "kg m2/s",
        "length of the difference of the angular momentum about the centre of mass"},
       [](const FramePair& f) { return vector_change(f, angular_momentum, "angular momentum"); }},
      {{"energy", "J", "difference of kinetic and potential energy, from the particles"}, energy_change},
      {{"energy_ratio", "1",
        "kinetic energy over that of the first frame, minus the reference's energy_ratio"},
       energy_ratio},
      {{"bonded_objects", "1",
        "solid objects that bonds hold together, as the engine counts them, minus the stated value; what "
        "only touches is two"},
       bonded_objects},
      {{"recoveries", "1", "how often a guard sent the run back to a good state, minus the stated value"},
       recoveries},
      {{"left", "1", "particles that have left the scene, minus the stated value"},
       [](const FramePair& f) { return left(f, "left"); }},
      {{"mass_left", "kg", "mass that has left the scene, minus the stated value"},
       [](const FramePair& f) { return left(f, "mass_left"); }},
      {{"processes", "1",
        "processes that the run was shared out to, as the engine counts them, minus the stated value"},
       processes},
      {{"ledger.TERM", "J",
        "difference of a ledger term, from the particles or as the engine keeps it; residual is the change "
        "of their sum"},
       ledger}};
  return list;
}

}  // namespace tripoint

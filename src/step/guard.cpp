// SPDX-License-Identifier: BSD-3-Clause
#include "step/guard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/machine.hpp"
#include "scene/ledger_entry.hpp"
#include "scene/meeting.hpp"

namespace tripoint {
namespace {

/// Share of the energy that the mass would have at one spacing a step, below which nothing is told apart from
/// round-off [1]. A choice, far above the round-off of sums over particles.
constexpr double round_off_share = 1e-10;
/// Share of the turned-over energy that the scheme may make or lose [1]: more is no error of integration any
/// more.
constexpr double most_made = 0.5;
/// Share of the first step that a step may shrink to [1]: a choice. Such a run would go on for ever.
constexpr double least_step_share = 1e-5;

/// Whether test(from, to) holds for all rows, shared among threads where there are enough: a team costs more
/// than a short column.
template <class Test>
bool holds_for_all(std::size_t rows, int threads, Test test) {
  if (threads == 1 || rows < worth_threads) return test(0, rows);
  const auto parts = static_cast<std::size_t>(threads);
  bool holds = true;
#pragma omp parallel for schedule(static) num_threads(threads) reduction(&& : holds)
  for (std::size_t part = 0; part < parts; ++part)
    holds = test(rows * part / parts, rows * (part + 1) / parts) && holds;
  return holds;
}

/// The sum of a column times zero is not finite when one of its values is not. So the loop needs no branch,
/// and the sum no order.
bool all_finite(std::span<const double> values, int threads) {
  return holds_for_all(values.size(), threads, [&](std::size_t from, std::size_t to) {
    double zero = 0.0;
#pragma omp simd reduction(+ : zero)
    for (std::size_t i = from; i < to; ++i) zero += 0.0 * values[i];
    return zero == 0.0;
  });
}

/// Looks for values at or below 0 in a column that has none.
void refuse_not_positive(const State& state, const Guarded& g) {
  const Particles& p = state.particles;
  const auto values = p[g.field].first(p.awake());
  const bool positive = holds_for_all(values.size(), state.threads, [&](std::size_t from, std::size_t to) {
    double least = 1.0;
#pragma omp simd reduction(min : least)
    for (std::size_t i = from; i < to; ++i) least = std::min(least, values[i]);
    return least > 0.0;
  });
  if (positive) return;
  for (std::size_t id = 0; id < p.size(); ++id)
    if (const std::size_t i = p.row(id); i < values.size() && !(values[i] > 0.0))
      fail(state, GuardName::temperature, i, g.name, to_string(g.written),
           fmt::format("is at {:.4g} {}", values[i], g.not_positive));
}

/// Whether forces move a particle: not a wall, not held, gripped or flowing in.
class Movable {
 public:
  explicit Movable(const State& state) : state_(state), body_(state.particles[field::body]) {
    if (state.particles.has(field::driven)) driven_ = state.particles[field::driven];
  }
  bool operator()(std::size_t row) const {
    if (!driven_.empty() && driven_[row] != 0) return false;
    return body_[row] < 0 || state_.bodies[field::body_motion][static_cast<std::size_t>(body_[row])] ==
                                 static_cast<int>(Motion::free);
  }

 private:
  const State& state_;
  std::span<const int> body_, driven_;
};

/// The row of the greatest kinetic energy: the particle that is named where no single particle is to blame.
std::size_t fastest(const State& state) {
  const auto v = velocities(state.particles);
  const auto m = state.particles[field::mass];
  double most = -1.0;
  std::size_t row = 0;
  for (std::size_t i = 0; i < m.size(); ++i)
    if (const double e = m[i] * dot(v.at(i), v.at(i)); e > most) {
      most = e;
      row = i;
    }
  return row;
}

double entry_of(const Ledger& ledger, std::string_view name) {
  const auto found = ledger.energy.find(std::string(name));
  return found == ledger.energy.end() ? 0.0 : found->second;
}

/// The largest energy that the scheme has made [J], lost where negative, and what made it. Effects declare
/// which of their entries mean energy from nowhere where they fall below 0 (EntryRole). The driver of a wall
/// pays for it in the entry `walls`. The printed pressure has no energy behind it: it makes some in every
/// column at rest, which is its known defect, and contacts store some.
struct Made {
  double energy = 0.0;
  std::string_view by;
  bool by_steps = true;  ///< finite steps, which a smaller one cures
};
Made made_by_scheme(const Ledger& ledger, const std::vector<GuardedEntry>& entries, bool still) {
  Made most{entry_of(ledger, ledger_entry::time_integration), "finite steps"};
  const auto look = [&](double energy, std::string_view by) {
    if (energy > std::abs(most.energy)) most = {energy, by, false};
  };
  double taken = 0.0;
  for (const GuardedEntry& e : entries)
    if (e.role == EntryRole::only_takes) taken += std::max(entry_of(ledger, e.entry), 0.0);
  for (const GuardedEntry& e : entries)
    if (still && e.role == EntryRole::unbacked) look(-entry_of(ledger, e.entry) - taken, e.made_by);
  for (const GuardedEntry& e : entries)
    if (e.role == EntryRole::only_takes) look(-entry_of(ledger, e.entry), e.made_by);
  return most;
}

/// Sizes of all entries but those apart, and the energy that the scheme made.
double turnover(const Ledger& ledger, const std::vector<GuardedEntry>& entries, double start_potential) {
  double sum = 0.0;
  for (const auto& [entry, energy] : ledger.energy) {
    if (entry == ledger_entry::time_integration) continue;
    const auto role = std::ranges::find(entries, entry, &GuardedEntry::entry);
    if (role != entries.end() && (role->role == EntryRole::apart || energy < 0.0)) continue;
    sum += std::abs(entry == ledger_entry::potential ? energy - start_potential : energy);
  }
  return sum;
}

}  // namespace

void check_finite(const State& state) {
  const Particles& p = state.particles;
  for (const Guarded& g : state.guarded) {
    const auto values = p[g.field].first(p.awake());
    if (all_finite(values, state.threads)) continue;
    for (std::size_t id = 0; id < p.size(); ++id)
      if (const std::size_t i = p.row(id); i < values.size() && !std::isfinite(values[i]))
        fail(state, GuardName::finite, i, g.name, to_string(g.written),
             fmt::format("has no finite {}", g.name));
  }
  for (const Guarded& g : state.guarded)
    if (!g.not_positive.empty()) refuse_not_positive(state, g);
}

Enclosure enclosure_of(const Scene& s, const InitialState& initial) {
  if (!s.min || !s.max) {
    constexpr Vec3 far{INFINITY, INFINITY, INFINITY};
    return {s.end_time > 0.0 ? escape_domain(s, initial) : Bounds{-far, far}, false};
  }
  const Vec3 around{s.spacing, s.spacing, s.spacing};
  return {{*s.min - around, *s.max + around}, true};
}

namespace {

/// Liquid that is about to be dropped, or spray above a domain that was made from the scene: it falls back.
bool may_be_outside(const State& state, const Enclosure& domain, std::size_t i, std::size_t axis,
                    bool above) {
  if (state.particles[field::body][i] >= 0) return false;
  const double g = state.scene.gravity[axis];
  return state.scene.removes_escaped || (!domain.given && (above ? g < 0.0 : g > 0.0));
}

std::string sides_of(const State& state, const Enclosure& domain, std::size_t i, std::size_t axis) {
  const Scene& s = state.scene;
  if (domain.given) return fmt::format("{:.6g} m .. {:.6g} m", (*s.min)[axis], (*s.max)[axis]);
  return fmt::format(
      "{:.6g} m .. {:.6g} m, which was made from the scene: give scene.min and "
      "scene.max where it may{}, or unguarded = [\"escape\"]",
      domain.box.min[axis], domain.box.max[axis],
      state.particles[field::body][i] < 0 ? ", with on_escape = \"remove\" where it may leave" : "");
}

}  // namespace

void check_escape(const State& state, const Enclosure& domain) {
  const Scene& s = state.scene;
  if (is_off(s, GuardName::escape) || (!domain.given && state.time > s.end_time)) return;
  const auto x = positions(state.particles);
  const std::array<std::span<const double>, 3> r{x.x, x.y, x.z};
  const Movable movable(state);
  for (std::size_t a = 0; a < 3; ++a) {
    if (s.periodic[a]) continue;
    const double low = domain.box.min[a], high = domain.box.max[a];
    for (std::size_t i = 0; i < state.particles.moving(); ++i) {
      if ((r[a][i] >= low && r[a][i] <= high) || !movable(i)) continue;
      if (may_be_outside(state, domain, i, a, r[a][i] > high)) continue;
      fail(state, GuardName::escape, i, "position", "drift",
           fmt::format("has left the domain: {} = {:.6g} m is outside {}", "xyz"[a], r[a][i],
                       sides_of(state, domain, i, a)));
    }
  }
}

void check_energy(const State& state, const Ledger& ledger, double start_potential, double dt,
                  GuardMemory& memory) {
  if (ledger.energy.count(ledger_entry::time_integration) == 0 || is_off(state.scene, GuardName::ledger))
    return;
  const Made made = made_by_scheme(ledger, state.guarded_entries, memory.still);
  memory.turned_over = std::max(memory.turned_over, turnover(ledger, state.guarded_entries, start_potential));
  const double grid_speed = state.scene.spacing / dt,
               least = round_off_share * ledger.mass * grid_speed * grid_speed;
  if (std::abs(made.energy) <= most_made * std::max(memory.turned_over, least)) return;
  const std::size_t i = fastest(state);
  fail(state, GuardName::ledger, i, "energy", "kick",
       fmt::format("moves fastest ({:.4g} m/s) where the scheme itself has {} {:.4g} J by {}, {:.2g} of all "
                   "the energy that the "
                   "scene has turned over: {}",
                   norm(state.particles.velocity(i)), made.energy > 0.0 ? "made" : "lost",
                   std::abs(made.energy), made.by, std::abs(made.energy) / memory.turned_over,
                   made.by_steps ? "a smaller time step"
                                 : "the corrected forms, a smaller time step, or a greater speed of sound"));
}

void check_step(const State& state, const TimeStepBound& bound, GuardMemory& memory) {
  if (memory.first_step == 0.0 && std::isfinite(bound.dt)) memory.first_step = bound.dt;
  if (bound.dt >= least_step_share * memory.first_step ||
      (is_off(state.scene, GuardName::time_step) && bound.dt > 0.0))
    return;
  const std::size_t i = fastest(state);
  fail(state, GuardName::time_step, i, "time_step", "bound",
       fmt::format("moves fastest ({:.4g} m/s) where the bound of {} has shrunk the time step to {:.3g} s, "
                   "from {:.3g} s at first",
                   norm(state.particles.velocity(i)), bound.name, bound.dt, memory.first_step));
}

void refuse_small_step(const State& state, double dt, double length, const std::string& name) {
  const std::size_t i = fastest(state);
  fail(state, GuardName::time_step, i, "time_step", "bound",
       fmt::format("moves fastest ({:.4g} m/s) where a time step of {:.3g} s, set by {}, would need {:.3g} "
                   "steps to the next output",
                   norm(state.particles.velocity(i)), dt, name, length / dt));
}

void refuse_step(const State& state, double dt, double bound, const std::string& name) {
  const std::size_t i = fastest(state);
  fail(state, GuardName::time_step, i, "time_step", "bound",
       fmt::format("moves fastest ({:.4g} m/s) where the scene's time_step, {:.4g} s, has come to lie above "
                   "the bound of {}, {:.4g} s: "
                   "make it smaller, or run all the same with [engines.tripoint] settings = {{ "
                   "force_time_step = true }}",
                   norm(state.particles.velocity(i)), dt, name, bound));
}

}  // namespace tripoint

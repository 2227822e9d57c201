// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <limits>

#include "liquids/carried_density.hpp"
#include "liquids/scene_numbers.hpp"
#include "state/state.hpp"

/// Solids that overlap at the start press against nothing at first, and are let out slowly (model 8.3).
namespace tripoint::liquid {

/// Time since the start [s]; -1 before the first forces, and none_let_out after them where nothing overlaps
inline constexpr StepNumber let_out_for{"solids_let_out_for", -1.0, true};
inline constexpr StepNumber core_let_out_for{"core_let_out_for", -1.0,
                                             true};  ///< the same of the core of pairs [s]
inline constexpr double none_let_out = std::numeric_limits<double>::max();

/// Whether a density is a sum over solids alone, by the corrected forms, and contact does not pull.
[[nodiscard]] inline bool lets_solids_out(const Scene& s) {
  const auto corrected = [&](const Term& t) { return s.mode_of(t) == Mode::corrected; };
  return corrected(term::density) && corrected(term::pressure) && corrected(term::state) && clamps(s) &&
         (carries_density(s) || !s.has_liquid());
}

/// Share of an overlap of the start that is left, after a time of letting out [s].
[[nodiscard]] inline double overlap_left(const State& state, const SceneNumbers& n, double time) {
  constexpr double slow = 50.0;     // supports that sound passes until 1/e is left [1]
  constexpr double at_last = 20.0;  // such times, after which none is left [1]
  const double all = slow * state.support() / n.sound_speed;
  if (time < 0.0) return 1.0;
  return time < at_last * all ? (1.0 + time / all) * std::exp(-time / all) : 0.0;
}

/// Share of the core of pairs that acts: little until pressure has parted what overlaps.
[[nodiscard]] inline double core_share(const State& state, const SceneNumbers& n) {
  if (!lets_solids_out(state.scene)) return 1.0;
  const double gone = 1.0 - overlap_left(state, n, state.step_numbers[core_let_out_for]);
  const double gone2 = gone * gone, gone4 = gone2 * gone2;
  return gone4 * gone4;
}

}  // namespace tripoint::liquid

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "pairs/pair_work.hpp"
#include "state/state.hpp"

namespace tripoint {

/// The fused pair passes, as the scene's modes choose them.
class Passes {
 public:
  /// @param lanes particles of a cluster, 0 = the fastest number here: measured only where a pass works on
  /// any pair
  /// @param sums_all whether clusters in which nothing meets are summed over too
  Passes(const Scene&, const std::vector<EffectPairWork>&, int lanes, bool sums_all = false);
  ~Passes();
  Passes(Passes&&) noexcept;
  Passes& operator=(Passes&&) noexcept;
  [[nodiscard]] bool needed() const;  ///< whether any pair is worked on at all
  [[nodiscard]] int lanes() const;    ///< particles of a cluster that the neighbours must have
  /// Sets the columns to which a pass adds to 0.
  void start_sums(PassName, State&, const Rows&) const;
  void run(PassName, State&) const;
  /// Whether a pass of density without the held terms finds all pairs too.
  [[nodiscard]] bool can_hold() const;
  /// Sums the values of fixed particles that no step reads (State::forms_fixed).
  void run_fixed(PassName, State&) const;
  /// How far around what something can reach fixed particles must be awake, for every bit to stay [m]; none:
  /// nothing may sleep.
  [[nodiscard]] std::optional<double> sleeps_beyond() const;
  /// Pairs of fixed particles have work too, as where they conduct heat
  [[nodiscard]] bool works_on_all() const;
  /// Cost of each particle in a step, by row, as lists and bonds are now; before there are any, a guess
  /// (ParticleCost).
  /// @param steps from new lists to new lists
  [[nodiscard]] std::vector<double> cost(const State&, double steps) const;
  [[nodiscard]] std::vector<double> cost_at_start(const State&) const;
  /// To be called when lists, excluded pairs, groups or the motion of bodies have changed: work of a pass
  /// is found anew.
  void drop_clusters();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tripoint

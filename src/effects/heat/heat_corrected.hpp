// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"
#include "effects/heat/held_surface.hpp"

namespace tripoint::heat {

/// Steps since B_i were formed.
inline constexpr StepNumber b_held_for{"heat_steps_held", 0.0};

/// (21) in the enthalpy form of model 8.6. Two-stage strong-stability-preserving Runge-Kutta [Shu & Osher
/// 1988, (2.16)]. It is a convex mix of Euler steps, so that a step within the bound makes no new extremes.
/// It is second order in time. With one Euler step at the bound the temporal error would be as large as the
/// spatial one, and of opposite sign.
class CorrectedHeat : public Effect {
 public:
  void load(State&, const InitialState&) override;
  void drift(State&, double dt) override;
  void decide_sums(State&) override;
  void start_sums(State&, PassName, const Rows&) override;
  void state(State&, const Rows&) override;
  bool correct(State&, double dt) override;
  void happen(State&, const Happening&) override;
  [[nodiscard]] TimeStepBound max_dt(const State&) const override;
  void add_to(const State&, Ledger&) const override;
  void adopt(State&) override;
  void lose(State&, std::span<const std::size_t> rows) override;
  void renumber(State& state) override { surfaces_.renumber(state); }
  [[nodiscard]] PairWork pair_work(const Scene&) const override;

 private:
  void set_material(State&, std::size_t row) const;

  HeldSurfaces surfaces_;
};

}  // namespace tripoint::heat

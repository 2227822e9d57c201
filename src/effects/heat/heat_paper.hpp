// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"

namespace tripoint::heat {

/// (21) as printed: temperature is the state, explicit Euler.
class PaperHeat : public Effect {
 public:
  void load(State&, const InitialState&) override;
  void drift(State&, double dt) override;
  void happen(State&, const Happening&) override;
  [[nodiscard]] TimeStepBound max_dt(const State&) const override;
  void add_to(const State&, Ledger&) const override;
  void lose(State&, std::span<const std::size_t> rows) override;
  void adopt(State&) override;
  [[nodiscard]] PairWork pair_work(const Scene&) const override;

 private:
  void set_material(State&, std::size_t row) const;
};

}  // namespace tripoint::heat

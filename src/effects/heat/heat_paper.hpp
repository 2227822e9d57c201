// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"

namespace tripoint::heat {

/// (21) as printed: temperature is the state, explicit Euler.
class PaperHeat : public Effect {
 public:
  void load(World&, const InitialState&) override;
  void drift(World&, double dt) override;
  void clear(World&, PassName) override;
  void happen(World&, const Happening&) override;
  [[nodiscard]] TimeStepBound max_dt(const World&) const override;
  void add_to(const World&, Ledger&) const override;
  void adopt(World&) override;
  [[nodiscard]] PairWork pair_work(const Scene&) const override;

 private:
  void set_material(World&, std::size_t row) const;
};

}  // namespace tripoint::heat

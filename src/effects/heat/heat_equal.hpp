// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/effect.hpp"

namespace tripoint::heat {

/// Heat of a scene where all has one temperature and nothing brings another (scene/temperatures.hpp): no
/// column, no pair, no bound of the step. Only its entry in the ledger is left.
class EqualHeat : public Effect {
 public:
  explicit EqualHeat(double temperature) : temperature_(temperature) {}
  void load(State&, const InitialState&) override;
  void lose(State&, std::span<const std::size_t> rows) override;
  void adopt(State&) override;
  void add_to(const State&, Ledger&) const override;

 private:
  double temperature_;  ///< [K]
};

}  // namespace tripoint::heat

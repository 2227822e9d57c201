// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "effects/effect.hpp"
#include "effects/no_slip/mirrored_velocity.hpp"
#include "liquids/changes.hpp"
#include "liquids/fields.hpp"
#include "liquids/scene_numbers.hpp"

/// Liquid sticks to walls: viscous pairs see the mirrored velocity of theirs (model 8.4).
namespace tripoint::no_slip {
namespace {

class NoSlip : public Effect {
 public:
  explicit NoSlip(const Scene& scene) : kernels_(liquid::pair_kernels(scene)) {}
  void state(State& state, const Rows& rows) override { velocity_.mirror(state, kernels_, rows); }
  void adopt(State& state) override {
    if (liquid::groups_changed(state)) velocity_.clear();
  }
  void happen(State&, const Happening&) override { velocity_.clear(); }
  void renumber(State&) override { velocity_.clear(); }

 private:
  PairKernels kernels_;
  MirroredVelocity velocity_;
};

}  // namespace

EffectSpec spec(const Scene&) {
  EffectSpec s{"no_slip",
               Mode::corrected,
               {field::wall_weight, field::wall_velocity},
               fields::joined(
                   {fields::position(),
                    fields::velocity(),
                    {field::group, field::stick, field::solid, field::viscosity, field::viscous_velocity}})};
  s.skips_sleeping = true;
  s.own_sums.state = columns_of_all(field::viscous_velocity);
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<NoSlip>(scene); }

}  // namespace tripoint::no_slip

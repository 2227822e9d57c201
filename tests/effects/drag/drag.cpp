// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "effects/drag/terms.hpp"
#include "effects/effect.hpp"

/// Linear drag: F = -c m v on every particle, c of its material [1/s]. A body that nothing else moves slows
/// down as exp(-c t). As printed v is that of half a step before, and the scheme of first order; corrected it
/// is that of the end of the step.
namespace tripoint::drag {
namespace {

constexpr VectorField<double> force{"drag_force", "N"};

class LinearDrag : public Effect {
 public:
  explicit LinearDrag(const Scene& scene) : as_printed_(scene.mode_of(term::drag) == Mode::paper) {
    for (const Material& m : scene.materials) coefficient_.push_back(value_of(m.values, "drag"));
  }
  void kick(State&, double dt) override { half_step_ = dt; }
  void bonds(State&, const Rows&) override;
  [[nodiscard]] TimeStepBound max_dt(const State&) const override;

 private:
  std::vector<double> coefficient_;  ///< of each material [1/s]
  bool as_printed_;
  double half_step_ = 0.0;  ///< length of the last kick, within a step [s]
};

/// The velocity at the end of the step is v/(1 + c dt/2) of that half a step before.
void LinearDrag::bonds(State& state, const Rows& rows) {
  const auto F = triple(state.particles, force);
  const auto v = velocities(std::as_const(state.particles));
  const auto m = state.particles[field::mass];
  const auto material = state.particles[field::material];
  const double later = as_printed_ ? 0.0 : half_step_;
  for (std::size_t i = rows.from; i < rows.to; ++i) {
    const double c = coefficient_[static_cast<std::size_t>(material[i])];
    F.set(i, (-c * m[i] / (1.0 + c * later)) * v.at(i));
  }
}

/// c dt <= 1: half of where a step would turn the velocity round.
TimeStepBound LinearDrag::max_dt(const State&) const {
  TimeStepBound bound;
  for (const double c : coefficient_)
    if (c > 0.0) tighten(bound, 1.0 / c, "drag");
  return bound;
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  Force drag{force, {"drag_work"}, EnergyAccount{"wall_drag_work"}};
  drag.entry = "drag";
  EffectSpec s{
      "drag", scene.mode_of(term::drag), {force}, {field::mass, field::material, field::velocity}, {drag}};
  s.guarded_entries = {{"drag", EntryRole::only_takes, "drag, which may only take energy"}};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<LinearDrag>(scene); }

}  // namespace tripoint::drag

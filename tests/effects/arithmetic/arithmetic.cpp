// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>

#include "effects/effect.hpp"
#include "liquids/acting_pairs.hpp"
#include "liquids/fields.hpp"
#include "liquids/scene_numbers.hpp"

/// A viscosity that the program does not have: as `morris`, with the arithmetic mean of two viscosities in
/// place of the harmonic.
namespace tripoint::arithmetic {
namespace {

class Arithmetic : public Effect {
 public:
  explicit Arithmetic(const Scene& scene) : kernels_(liquid::pair_kernels(scene)) {}
  void bonds(State&, const Rows&) override;
  [[nodiscard]] TimeStepBound max_dt(const State&) const override;

 private:
  /// Calls give(j, G) for the neighbours of a row, G_ij the coefficient of the force [kg/s].
  template <class Give>
  void each_pair(const State&, std::size_t i, Give give) const;

  PairKernels kernels_;
};

template <class Give>
void Arithmetic::each_pair(const State& state, std::size_t i, Give give) const {
  const Particles& p = state.particles;
  const auto V = p[field::volume], mu = p[field::viscosity], group = p[field::group];
  const auto x = positions(p);
  for (const Entry e : state.neighbours->of(i)) {
    const std::size_t j = e.row();
    if (j == i || e.own() || acts(group[i], group[j]) == 0.0) continue;
    const double r = norm((x.at(j) - x.at(i)) + state.neighbours->shift(e.image()));
    const double weight = -kernels_.wendland.derivative_over_r(r) * kernels_.per_gradient_moment;
    give(j, 0.5 * (mu[i] + mu[j]) * (V[i] * V[i] + V[j] * V[j]) * weight);
  }
}

/// F_i = sum_j G_ij (v_j - v_i) [N].
void Arithmetic::bonds(State& state, const Rows& rows) {
  Particles& p = state.particles;
  const auto v = triple(std::as_const(p), field::viscous_velocity);
  const auto F = triple(p, field::viscous_force);
  for (std::size_t i = rows.from; i < rows.to; ++i) {
    Vec3 sum;
    each_pair(state, i, [&](std::size_t j, double G) { sum += G * (v.at(j) - v.at(i)); });
    F.set(i, F.at(i) + sum);
  }
}

/// Half of the inverse of the greatest rate, as of the viscosities of the program (model 8.10).
TimeStepBound Arithmetic::max_dt(const State& state) const {
  TimeStepBound bound;
  const auto m = state.particles[field::mass];
  for (std::size_t i = 0; i < state.particles.moving(); ++i) {
    double rate = 0.0;
    each_pair(state, i, [&](std::size_t, double G) { rate += G / m[i]; });
    if (rate > 0.0) tighten(bound, 0.5 / rate, "viscosity");
  }
  return bound;
}

}  // namespace

EffectSpec spec(const Scene&) {
  EffectSpec s{"arithmetic",
               Mode::corrected,
               {},
               fields::joined({fields::position(),
                               {field::mass, field::volume, field::viscosity, field::group,
                                field::viscous_velocity, field::viscous_force}})};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Arithmetic>(scene); }

}  // namespace tripoint::arithmetic

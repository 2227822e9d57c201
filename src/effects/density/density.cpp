// SPDX-License-Identifier: BSD-3-Clause
#include "effects/density/density.hpp"

#include "sph/density_term.hpp"
#include "sph/kernels.hpp"

namespace tripoint::density {
namespace {

class DensityEffect : public Effect {
 public:
  /// Each particle's own share of (4), m_i W(0).
  void clear(World& world, PassName pass) override {
    if (pass != PassName::density) return;
    const double self = Poly6(world.support()).value(0.0);
    const auto rho = world.particles[field::density];
    const auto m = world.particles[field::mass];
    for (std::size_t i = 0; i < rho.size(); ++i) rho[i] = m[i] * self;
  }
  void state(World& world) override {
    if (!world.moved) return;
    const Particles& p = world.particles;
    const auto V = world.particles[field::volume];
    const auto rho = p[field::density], m = p[field::mass];
    for (std::size_t i = 0; i < V.size(); ++i) V[i] = m[i] / rho[i];
  }
  [[nodiscard]] PairWork pair_work(const Scene&) const override { return {{pair_term<DensityPaper>}}; }
};

}  // namespace

EffectSpec spec(const Scene&) {
  EffectSpec s{"density", Mode::paper, {field::density, field::volume}, {field::mass}};
  s.guards = {{field::density, "density", Written::density}};
  s.positive = {field::density};
  return s;
}

std::unique_ptr<Effect> make(const Scene&) { return std::make_unique<DensityEffect>(); }

}  // namespace tripoint::density

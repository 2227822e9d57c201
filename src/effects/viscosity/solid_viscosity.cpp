// SPDX-License-Identifier: BSD-3-Clause
#include "effects/viscosity/solid_viscosity.hpp"

#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::viscosity {

SolidViscosity::SolidViscosity(const Scene& scene) {
  const bool printed = scene.mode_of(term::viscosity) == Mode::paper;
  for (const Material& m : scene.materials) {
    const double own = printed ? value_of(m.values, "solid_viscosity") : 0.0;
    const bool stage = own > 0.0 && fusion_of(scene, m).soft_band && calls_for(scene, "phase");
    of_.push_back({own > 0.0 ? own : scene.contact_viscosity, m.viscosity, stage});
    follows_ = follows_ || stage;
  }
}

double SolidViscosity::operator()(const State& state, std::size_t row) const {
  const Particles& p = state.particles;
  const OfMaterial& m = of_[static_cast<std::size_t>(p[field::material][row])];
  return m.stage ? viscosity_between(m.solid, m.liquid, p[field::liquid_fraction][row]) : m.solid;
}

}  // namespace tripoint::viscosity

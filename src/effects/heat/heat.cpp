// SPDX-License-Identifier: BSD-3-Clause
#include "effects/heat/heat.hpp"

#include "effects/heat/heat_corrected.hpp"
#include "effects/heat/heat_equal.hpp"
#include "effects/heat/heat_paper.hpp"
#include "scene/temperatures.hpp"

namespace tripoint::heat {

EffectSpec spec(const Scene& scene) {
  if (equal_temperature(scene)) return {"heat", scene.mode_of(Term::heat), {}, {field::mass, field::material}};
  if (scene.mode_of(Term::heat) == Mode::paper) {
    return {"heat",
            Mode::paper,
            {field::temperature, field::temperature_rate, field::exchange, field::heat_capacity, field::diffusivity, field::held},
            {field::mass, field::density, field::volume, field::position_x, field::position_y, field::position_z}};
  }
  return {"heat",
          Mode::corrected,
          {field::temperature,       field::enthalpy,          field::heat_rate,
           field::heat_rate_before,  field::conductance,       field::heat_capacity,
           field::conductivity,      field::rest_volume,       field::held,
           field::moment_inverse_xx, field::moment_inverse_yy, field::moment_inverse_zz,
           field::moment_inverse_yz, field::moment_inverse_xz, field::moment_inverse_xy},
          {field::mass, field::position_x, field::position_y, field::position_z}};
}

std::unique_ptr<Effect> make(const Scene& scene) {
  if (const auto temperature = equal_temperature(scene)) return std::make_unique<EqualHeat>(*temperature);
  if (scene.mode_of(Term::heat) == Mode::paper) return std::make_unique<PaperHeat>();
  return std::make_unique<CorrectedHeat>();
}

std::vector<DefectEntry> defects() {
  return {{"heat.conductivity", "conductivity times 1 + size", "heat/cosine-mode"},
          {"heat.moment", "second-moment matrices left out", "heat/bar-3x3"},
          {"heat.inflow", "what flows in is size kelvin hotter", "heat/inflow"},
          {"heat.harmonic_mean", "arithmetic instead of harmonic mean of conductivities", "heat/two-conductivities"},
          {"heat.one_sided", "size of 0..1: conductivity and moment lean to the receiving particle, so that energy is not kept",
           "heat/step-insulated"},
          {"heat.held", "temperatures that should be held are let go", "heat/bar-3x3"},
          {"heat.first_order", "second stage of the time scheme left out: first order", "heat/temporal"},
          {"heat.paper.diffusivity", "diffusivity of (21) as printed times 1 + size", "heat/cosine-mode"},
          {"heat.paper.density", "rest density in the paper's diffusivity times 1 + size", "heat/cosine-mode"}};
}

}  // namespace tripoint::heat

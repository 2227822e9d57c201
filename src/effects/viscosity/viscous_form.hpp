// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "effects/viscosity/viscous_terms.hpp"
#include "scene/scene.hpp"
#include "scene/shared_terms.hpp"

namespace tripoint::viscosity {

/// A viscosity as the passes have it: its force, and the sums for the bound of the step.
struct ViscousForm {
  PairTerm force, spread;
  bool central;  ///< along the line of centres
};
template <class Viscosity>
inline constexpr ViscousForm viscous_form{pair_term<Viscosity>, pair_term<ViscousSpread<Viscosity>>,
                                          ViscousSpread<Viscosity>::central};

/// The viscosity of a scene.
[[nodiscard]] inline ViscousForm viscous_form_of(const Scene& scene, const PairKernels& kernels) {
  if (scene.mode_of(term::viscosity) == Mode::paper) return viscous_form<ViscosityPaper>;
  if (scene.viscosity_form == ViscosityForm::laplacian) return viscous_form<ViscosityLaplacian>;
  return kernels.shear.even() ? viscous_form<ViscosityCentral> : viscous_form<ViscosityCentralWeighted>;
}

}  // namespace tripoint::viscosity

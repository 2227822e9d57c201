// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/plane_shear.hpp"

namespace tripoint {

ReferenceEntry poiseuille_entry() {
  return {{"poiseuille", "analytic",
           "Batchelor, An Introduction to Fluid Dynamics, 1967, 4.3: parabola less its sine series in time",
           "liquid between two plates at rest, driven along them by a body force from rest",
           plane_shear_arguments()},
          [](const ReferenceInput& in) { return make_plane_shear(in, "poiseuille", false); }};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/plane_shear.hpp"

namespace tripoint {

ReferenceEntry couette_entry() {
  return {
      {"couette", "analytic",
       "Batchelor, An Introduction to Fluid Dynamics, 1967, 4.3: linear profile less its sine series in time",
       "liquid between two plates that moves from rest because the plates do", plane_shear_arguments()},
      [](const ReferenceInput& in) { return make_plane_shear(in, "couette", true); }};
}

}  // namespace tripoint

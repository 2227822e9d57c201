// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/scene.hpp"
#include "sph/kernels.hpp"
#include "sph/lattice.hpp"

/// Numbers of a scene whose liquids carry their density.
namespace tripoint::carried_liquid {

struct Numbers {
  double stiffness = 0.0, reference = 0.0;  ///< k [m2/s2], rho_ref [kg/m3]
  double sound_speed = 0.0;                 ///< greatest [m/s]
  double greatest_nu = 0.0;                 ///< [m2/s]
  LatticeMoments lattice;
};

[[nodiscard]] Numbers numbers_of(const Scene&);
[[nodiscard]] PairKernels kernels_of(const Scene&, const Numbers&);
/// Of the energy of an interface between liquids, the share that acts: 0 where all are as heavy [1].
[[nodiscard]] double interface_share(const Scene&);

}  // namespace tripoint::carried_liquid

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "liquids/equation_of_state.hpp"
#include "particles/catalogue.hpp"
#include "scene/scene.hpp"
#include "sph/kernels.hpp"

/// Numbers of the whole scene that the equation of state and the pair terms share (model 8.1-8.5).
namespace tripoint::liquid {

/// Share of h/(c + |v|) that a step of sound takes where the pressure is corrected [1].
inline constexpr double courant_corrected = 0.45;

struct SceneNumbers {
  double stiffness = 0.0;  ///< k, one a scene: the largest of its materials [m2/s2]
  /// Largest rest density of the liquids, of the solids where there is none [kg/m3]
  double reference_density = 0.0;
  double sound_speed = 0.0;  ///< [m/s]
  /// Rest density above which the numerical bulk viscosity of a liquid grows no more [kg/m3]
  double damped_density = 0.0;
  double bulk_viscosity = 0.0;   ///< zeta of the numerical bulk viscosity of liquids, 0 = none [1]
  double mean_pressure = 0.0;    ///< scene.mean_pressure, 0 where it changes nothing [1]
  double sound_damping = 0.0;    ///< scene.sound_damping, 0 where it changes nothing [1]
  double rest_volume = 0.0;      ///< of a cell of the lattice [m3]
  double lattice_density = 1.0;  ///< S0 of the kernel at the scene's h/dx
  /// Of a particle in the outermost layer of two bodies that overlap by one spacing, over its rest density
  double overlap_density = 2.0;
  double gradient_moment = 1.0;  ///< of the kernel at the scene's h/dx
  /// Energy of compression a p dV: lattice_density/gradient_moment, 1 as printed
  double pressure_work = 1.0;
  double core_stiffness = 0.0;  ///< kappa = 0.03 k rho_ref dx [N/m]
  double core_reach = 0.0;      ///< scene.core_reach [m]
  /// a wall particle is at the face of its wall where this share of its number density can be other than wall
  double least_exposure = 0.0;
  double wall_stiffness = 1.0;   ///< of a wall's equation of state over that of liquids (model 8.4)
  double solid_stiffness = 1.0;  ///< of that of other solids: 1 + scene.contact_stiffness (model 8.3)
  double contact_step = 0.0;     ///< scene.contact_step, 0 where the contact bound always holds [1]
  double courant = 0.0;          ///< share of h/(c + |v|) that a step of sound takes [1]
  double contact_speed = 0.0;    ///< greatest speed of sound where solids are stiffer [m/s]
  /// Pressure of the topmost layer of a liquid over its rest density [m2/s2], 0 = none (model 8.3)
  double surface_head = 0.0;
  double half_full = 0.5;  ///< density of that layer over the rest density, on the lattice
  /// The pressure of walls is that of a patch of their face: liquid alone touches them
  bool averages_walls = false;
};
/// @throws InputError when no material of the scene has a stiffness or a speed of sound
[[nodiscard]] SceneNumbers numbers_of(const Scene&);

/// Whether the transport velocity moves the liquid (model 8.3).
/// @throws InputError where the scene's choice cannot hold: free bodies, or pressure clamped at free surfaces
[[nodiscard]] bool uses_transport_velocity(const Scene&);
/// Whether scene.mean_pressure or scene.sound_damping acts.
[[nodiscard]] inline bool has_transport_means(const SceneNumbers& n) {
  return n.mean_pressure > 0.0 || n.sound_damping > 0.0;
}

/// The kernels of the scene with its core and its lattice moment.
[[nodiscard]] PairKernels pair_kernels(const Scene&);

/// @param group of the particle, field::group
[[nodiscard]] inline EquationOfState state_of(const SceneNumbers& n, double group, double rest_density,
                                              bool clamp) {
  const double share = group == liquid_group ? 1.0
                       : group == wall_group ? n.wall_stiffness
                                             : n.solid_stiffness;
  const double stiffness = share * n.stiffness;
  const double surface = group == liquid_group && clamp ? n.surface_head * rest_density : 0.0;
  return {stiffness, rest_density, n.reference_density, clamp, n.pressure_work, surface, n.half_full};
}

}  // namespace tripoint::liquid

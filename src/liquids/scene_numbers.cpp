// SPDX-License-Identifier: BSD-3-Clause
#include "liquids/scene_numbers.hpp"

#include <algorithm>
#include <array>

#include "core/errors.hpp"
#include "liquids/fixed_walls.hpp"
#include "liquids/pressing_gravity.hpp"
#include "scene/effect_rule.hpp"
#include "scene/geometry.hpp"
#include "scene/shared_terms.hpp"
#include "sph/lattice.hpp"

namespace tripoint::liquid {
namespace {

/// kappa/(k rho_ref dx) of the core of pairs [1] (model 8.3): a choice. Decision 7 gives the measured cost of
/// the core at this value, and at four times as much.
constexpr double core_stiffness_share = 0.03;

/// Greatest ratio of densities that the numerical bulk viscosity counts [1] (model 8.4). Without a limit a
/// step of sound is unstable from 1:10 on; with this one it is stable at any ratio, as measured by
/// tests/step/stability_bulk_test.cpp.
constexpr double most_damped_ratio = 4.0;

// Share of h/(c + |v|) that a step of sound takes [1]. With these both forms take 0.47 to 0.52 of the longest
// stable step, as measured (docs/guards.md).
constexpr double courant_printed = 0.7;
/// The background pressure of the transport velocity adds half to the stiffness: 0.45/sqrt(1.5) = 0.37,
/// rounded down.
constexpr double courant_transported = 0.35;

/// Largest rest density of the materials that liquids (or, without liquids, any bodies) are made of, those
/// that flow in too.
double reference_density(const Scene& scene) {
  const bool wet = scene.has_liquid();
  double most = 0.0;
  for (const Body& b : scene.bodies)
    if (!wet || b.phase == Phase::liquid) most = std::max(most, scene.material(b.material).density);
  for (const Inflow& f : scene.inflows) most = std::max(most, scene.material(f.material).density);
  return most;
}

/// Smallest rest density that the run can have: inflowing liquid may be lighter than every body, and sound is
/// fastest there.
double least_density(const Scene& scene) {
  double least = reference_density(scene);
  for (const Body& b : scene.bodies) least = std::min(least, scene.material(b.material).density);
  for (const Inflow& f : scene.inflows) least = std::min(least, scene.material(f.material).density);
  return least;
}

/// Weight of pairs in `central` viscosity: scene.isotropic_shear of it is that with which the lattice resists
/// all shears alike.
ShearWeight shear_weight(const Scene& scene) {
  const double share = acting_number(scene, "isotropic_shear");
  if (share == 0.0) return {};
  const ShearWeight isotropic = isotropic_shear(scene.support_ratio, scene.space());
  return {1.0 + share * (isotropic.constant - 1.0),
          share * isotropic.square / (scene.spacing * scene.spacing)};
}

}  // namespace

bool uses_transport_velocity(const Scene& scene) {
  if (!scene.transport_velocity || scene.mode_of(term::pressure) != Mode::corrected) return false;
  const bool free_bodies = std::ranges::any_of(
      scene.bodies, [](const Body& b) { return b.phase != Phase::liquid && b.motion == Motion::free; });
  if (free_bodies || scene.clamps())
    throw InputError(
        "the transport velocity is for liquid that fills its space, between walls at most: it needs "
        "model.clamp = \"paper\" and no free body");
  return true;
}

SceneNumbers numbers_of(const Scene& scene) {
  SceneNumbers n;
  for (const Material& m : scene.materials) n.stiffness = std::max(n.stiffness, m.stiffness.value_or(0.0));
  if (!(n.stiffness > 0.0))
    throw InputError(
        "bodies of this scene can touch or flow, and no material has a stiffness: give one a sound_speed of "
        "at least 10 times "
        "the fastest motion");
  n.reference_density = reference_density(scene);
  const double lightest = least_density(scene);
  n.damped_density = most_damped_ratio * lightest;
  n.bulk_viscosity = acting_number(scene, "bulk_viscosity");
  n.mean_pressure = acting_number(scene, "mean_pressure");
  n.sound_damping = acting_number(scene, "sound_damping");
  n.rest_volume = scene.cell();
  const bool paper = scene.mode_of(term::state) == Mode::paper;
  n.sound_speed = paper ? std::sqrt(n.stiffness) : sound_speed(state_of(n, liquid_group, lightest, false));
  const LatticeMoments moments = wendland_moments(scene.support_ratio, scene.space());
  n.lattice_density = moments.density;
  n.overlap_density = 1.0 + moments.layer / moments.density;
  n.gradient_moment = moments.gradient;
  n.half_full = 0.5 * (1.0 + moments.layer / moments.density);
  n.surface_head = acting_number(scene, "surface_weight") * norm(pressing_gravity(scene)) * scene.spacing;
  // Half of the part that a plane face lacks, (1 - S_layer/S0)/2
  n.least_exposure = 0.25 * (1.0 - moments.layer / moments.density);
  if (scene.mode_of(term::pressure) == Mode::corrected)
    n.pressure_work = n.lattice_density / n.gradient_moment;
  n.core_stiffness = core_stiffness_share * n.stiffness * n.reference_density * cell_depth(scene);
  n.core_reach = acting_number(scene, "core_reach") * scene.spacing;
  n.averages_walls = averages_walls(scene);
  // Half of a wall particle's neighbourhood is wall, which does not move: it reads half of the strain of the
  // liquid.
  if (n.averages_walls) n.wall_stiffness = 2.0;
  if (const double stiffer = acting_number(scene, "contact_stiffness"); stiffer > 0.0)
    n.wall_stiffness = n.solid_stiffness = 1.0 + stiffer;
  n.contact_step = acting_number(scene, "contact_step");
  n.contact_speed = std::sqrt(n.solid_stiffness) * n.sound_speed;
  const bool printed = scene.mode_of(term::pressure) == Mode::paper;
  n.courant = printed                          ? courant_printed
              : uses_transport_velocity(scene) ? courant_transported
                                               : courant_corrected;
  return n;
}

PairKernels pair_kernels(const Scene& scene) {
  const SceneNumbers n = numbers_of(scene);
  PairKernels kernels(scene.support_ratio * scene.spacing, scene.space());
  kernels.core = {n.core_stiffness, n.core_reach};
  kernels.per_gradient_moment = 1.0 / n.gradient_moment;
  kernels.shear = shear_weight(scene);
  return kernels;
}

}  // namespace tripoint::liquid

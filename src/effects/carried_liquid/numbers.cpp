// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "liquids/scene_numbers.hpp"

namespace tripoint::carried_liquid {
namespace {

/// Materials that are liquid, or can be.
std::vector<const Material*> liquids_of(const Scene& scene) {
  std::vector<const Material*> list;
  for (const Body& b : scene.bodies)
    if (const Material& m = scene.material(b.material); b.phase == Phase::liquid || m.t_melt)
      list.push_back(&m);
  for (const Inflow& f : scene.inflows) list.push_back(&scene.material(f.material));
  return list;
}

}  // namespace

Numbers numbers_of(const Scene& scene) {
  const liquid::SceneNumbers all = liquid::numbers_of(scene);
  Numbers n;
  n.stiffness = all.stiffness;
  n.reference = all.reference_density;
  double least = n.reference;
  for (const Material* m : liquids_of(scene)) {
    least = std::min(least, m->density);
    n.greatest_nu = std::max(n.greatest_nu, m->viscosity / m->density);
  }
  n.sound_speed = std::sqrt(n.stiffness * n.reference / least);
  n.lattice = wendland_moments(scene.support_ratio, scene.space());
  return n;
}

PairKernels kernels_of(const Scene& scene, const Numbers& n) {
  PairKernels kernels(scene.support_ratio * scene.spacing, scene.space());
  kernels.per_gradient_moment = 1.0 / n.lattice.gradient;
  const ShearWeight weight = isotropic_shear(scene.support_ratio, scene.space());
  kernels.shear = {weight.constant, weight.square / (scene.spacing * scene.spacing)};
  return kernels;
}

double interface_share(const Scene& scene) {
  const std::vector<const Material*> all = liquids_of(scene);
  const bool unlike =
      std::ranges::any_of(all, [&](const Material* m) { return m->density != all.front()->density; });
  return unlike ? 1.0 : 0.0;
}

}  // namespace tripoint::carried_liquid

// SPDX-License-Identifier: BSD-3-Clause
#include "effects/phase/softening.hpp"

#include <algorithm>
#include <array>

#include "solids/fusion.hpp"
#include "solids/solid_particles.hpp"

namespace tripoint::phase {
namespace {

/// Remaining share of the stiffness of a particle: all of it where its material does not soften.
class Shares {
 public:
  explicit Shares(const State& state)
      : material_(state.particles[field::material]), melted_(state.particles[field::liquid_fraction]) {
    for (const Material& m : state.scene.materials) softens_.push_back(solid::softens(state.scene, m));
  }
  double operator()(std::size_t row) const {
    return softens_[static_cast<std::size_t>(material_[row])] ? 1.0 - melted_[row] : 1.0;
  }

 private:
  std::span<const int> material_;
  std::span<const double> melted_;
  std::vector<bool> softens_;  ///< of each material
};

}  // namespace

bool any_softens(const Scene& scene) {
  return can_have_deformable_bodies(scene) &&
         std::ranges::any_of(scene.materials, [&](const Material& m) { return solid::softens(scene, m); });
}

void load_stiffness(State& state) {
  const Shares share_of(state);
  const auto share = state.particles[field::stiffness_share];
  for (std::size_t i = 0; i < share.size(); ++i) share[i] = share_of(i);
}

void follow_stiffness(State& state) {
  Particles& p = state.particles;
  const auto share = p[field::stiffness_share];
  const solid::ElasticForms forms(state.scene);
  const solid::ElasticParticles is_elastic(state);
  const Shares share_of(state);
  for (std::uint32_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (!state.owns(i)) continue;  // a copy's list is not whole
    const double now = share_of(i);
    if (now == share[i] || p[field::liquid_fraction][i] >= 1.0)
      continue;  // a particle that melts in this step gives all its
                 // energy
    const double before = is_elastic(i) ? solid::deformation_energy(state, forms, id).total() : 0.0;
    share[i] = now;
    if (!is_elastic(i)) continue;
    const double released = before - solid::deformation_energy(state, forms, id).total();
    state.accumulated[account::deformation_released] += released;
    give_heat(state, i, released);
  }
  state.refresh(std::array{&field::stiffness_share, &field::temperature, &field::liquid_fraction});
  if (p.has(field::enthalpy)) state.refresh(std::array{&field::enthalpy});
}

}  // namespace tripoint::phase

// SPDX-License-Identifier: BSD-3-Clause
#include "effects/phase/joining.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "solids/solid_particles.hpp"

namespace tripoint::phase {
namespace {

/// Determinant of F below which a particle's F gets no inverse [1]: a choice. A particle that is crushed or
/// turned inside out has no inverse worth having.
constexpr double least_determinant = 0.1;

void turn_plastic_strain(Particles& p, std::size_t row, const Matrix3& R) {
  if (!p.has(field::plastic_strain)) return;
  const Symmetric e = symmetric_part(R * full(solid::plastic_strain_of(p, row)) * transposed(R));
  solid::set_plastic_strain(p, row, e);
}

/// Turns the list of a deformable solid, and its plastic strain, into the present frame. No energy changes,
/// and F has an inverse also for chains and sheets. Printed, nothing is turned, and a bond with a turned
/// solid strains it. @return F^-1 of the list as it is left
Matrix3 turn_into_present_frame(State& state, std::uint32_t id) {
  if (state.scene.mode_of(term::phase) == Mode::paper) return identity3;
  // It may have lost bonds in this step; frequencies follow with all others
  solid::refresh_shapes(state, std::array{id}, true);
  const solid::Deformation before = solid::deformation_of(state, id);
  if (before.rank == 0) return identity3;
  const Matrix3 R = solid::rotation_of(before.F, before.P, before.rank);
  for (Bond& bond : state.bonds.edit(id)) {
    bond.x = R * bond.x;
    bond.gradient = R * bond.gradient;
  }
  turn_plastic_strain(state.particles, state.particles.row(id), R);
  solid::refresh_shapes(state, std::array{id}, true);
  const Matrix3 F = solid::deformation_of(state, id).F;
  return determinant(F) > least_determinant ? inverse(F) : identity3;
}

bool has_deformable(const State& state) { return state.particles.has(field::shape_rank.name); }

}  // namespace

void take_present_vectors(State& state, const ElasticityKernel& kernel, std::uint32_t id) {
  const std::size_t i = state.particles.row(id);
  for (Bond& bond : state.bonds.edit(id)) {
    Bond now = solid::bond_of(kernel, solid::separation(state, state.particles.row(bond.other), i));
    now.other = bond.other;
    now.twin = bond.twin;
    bond = now;
  }
}

void bond(State& state, const std::vector<Joint>& joints) {
  const ElasticityKernel kernel = solid::bond_kernel(state.scene);
  std::map<std::uint32_t, Matrix3> to_reference;  // of those that were solid before
  if (has_deformable(state)) {
    const solid::EnergyOwners owns(state);
    std::set<std::uint32_t> ids;
    for (const Joint& joint : joints)
      if (!joint.both) ids.insert(joint.j);
    for (const std::uint32_t id : ids) {
      if (owns(state.particles.row(id)))
        to_reference[id] = turn_into_present_frame(state, id);
      else
        take_present_vectors(state, kernel, id);
    }
  }
  for (const Joint& joint : joints) {
    const auto at = to_reference.find(joint.j);
    const Vec3 back = at == to_reference.end() ? -joint.r : at->second * -joint.r;
    connect(state.bonds, joint.i, joint.j, solid::bond_of(kernel, joint.r), solid::bond_of(kernel, back));
  }
}

void make_excluded_pairs(State& state, const std::vector<std::uint32_t>& frozen) {
  Particles& p = state.particles;
  if (!p.has(field::own_density.name) && !(has_deformable(state) && p.has(field::force))) return;
  const solid::ElasticParticles is_elastic(state);
  const auto body = p[field::body];
  const double reach = std::max(state.support(), bond_reach(state.scene) * state.scene.spacing);
  for (const std::uint32_t id : frozen) {
    const std::size_t i = p.row(id);
    std::set<int> object{body[i]};
    for (const Bond& bond : std::as_const(state.bonds).of(id)) object.insert(body[p.row(bond.other)]);
    std::vector<std::uint32_t> paired;
    for (const Entry e : state.neighbours->of(i)) {
      const std::size_t j = e.row();
      if (j == i || body[j] < 0 || !object.contains(body[j]) || !(is_elastic(i) || is_elastic(j))) continue;
      const double r = norm(solid::separation(state, i, j));
      if (r >= reach) continue;
      const auto other = static_cast<std::uint32_t>(p[field::id][j]);
      make_own(state.own, id, other, solid::own_weight(state.scene, r));
      paired.push_back(other);
    }
    state.change.relisted.insert(state.change.relisted.end(), paired.begin(), paired.end());
  }
}

}  // namespace tripoint::phase

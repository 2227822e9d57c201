// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <initializer_list>
#include <vector>

#include "particles/catalogue.hpp"

/// Fields that are read together, for the declaration of an effect: components of one quantity, and the fields that a shared
/// function reads.
namespace tripoint::fields {

using List = std::vector<FieldInfo>;

[[nodiscard]] inline List joined(std::initializer_list<List> groups) {
  List all;
  for (const List& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

[[nodiscard]] inline List position() { return {field::position_x, field::position_y, field::position_z}; }
[[nodiscard]] inline List velocity() { return {field::velocity_x, field::velocity_y, field::velocity_z}; }
/// World::unwrapped(), beside the position; a scene without a periodic direction has none.
[[nodiscard]] inline List image() { return {field::image_x, field::image_y, field::image_z}; }
[[nodiscard]] inline List shift() { return {field::shift_x, field::shift_y, field::shift_z}; }
[[nodiscard]] inline List strain() {
  return {field::strain_xx, field::strain_yy, field::strain_zz, field::strain_yz, field::strain_xz, field::strain_xy};
}
[[nodiscard]] inline List plastic_strain() {
  return {field::plastic_strain_xx, field::plastic_strain_yy, field::plastic_strain_zz,
          field::plastic_strain_yz, field::plastic_strain_xz, field::plastic_strain_xy};
}
[[nodiscard]] inline List shape_inverse() {
  return {field::shape_inverse_xx, field::shape_inverse_yy, field::shape_inverse_zz,
          field::shape_inverse_yz, field::shape_inverse_xz, field::shape_inverse_xy};
}

/// solid::deformation_of() and solid::deformation_energy() of owners of strain energy, beside the position.
[[nodiscard]] inline List deformation() {
  return joined({shape_inverse(), {field::shape_rank, field::solid_volume, field::solid_material, field::solid_stiffness}});
}
/// The same where a scene has them.
[[nodiscard]] inline List deformation_if_there() { return joined({plastic_strain(), {field::stiffness_share}}); }
/// solid::refresh_shapes(), beside deformation(), mass, body and material.
[[nodiscard]] inline List shapes() { return {field::regular_bonds}; }
[[nodiscard]] inline List shapes_if_there() { return {field::bond_frequency}; }
/// regroup(): which particles are one body.
[[nodiscard]] inline List grouping() { return {field::id, field::body, field::phase, field::source, field::material}; }

}  // namespace tripoint::fields

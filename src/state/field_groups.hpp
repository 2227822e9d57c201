// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <initializer_list>
#include <vector>

#include "particles/catalogue.hpp"

namespace tripoint {

/// An item of a list of fields: a vector or a symmetric matrix stands for its columns.
struct FieldGroup {
  std::vector<FieldInfo> columns;

  FieldGroup(const FieldInfo& one) : columns{one} {}
  FieldGroup(const std::vector<FieldInfo>& list) : columns(list) {}
  template <class T>
  FieldGroup(const Field<T>& one) : columns{one} {}
  template <class T>
  FieldGroup(const VectorField<T>& v) : columns{v.x, v.y, v.z} {}
  FieldGroup(const SymmetricField& m) : columns{m.xx, m.yy, m.zz, m.yz, m.xz, m.xy} {}
  FieldGroup(const MatrixField& m) : columns{m.xx, m.xy, m.xz, m.yx, m.yy, m.yz, m.zx, m.zy, m.zz} {}
};
class FieldList : public std::vector<FieldInfo> {
 public:
  FieldList() = default;
  FieldList(const std::vector<FieldInfo>& list) : vector(list) {}
  FieldList(std::initializer_list<FieldGroup> groups) {
    for (const FieldGroup& group : groups) insert(end(), group.columns.begin(), group.columns.end());
  }
};

}  // namespace tripoint

/// Fields that are read together, for the declaration of an effect: components of one quantity, and the
/// fields that a shared function reads.
namespace tripoint::fields {

using List = FieldList;

[[nodiscard]] inline List joined(std::initializer_list<List> groups) {
  List all;
  for (const List& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

[[nodiscard]] inline List position() { return {field::position}; }
[[nodiscard]] inline List velocity() { return {field::velocity}; }
/// State::unwrapped(), beside the position; a scene without a periodic direction has none.
[[nodiscard]] inline List image() { return {field::image}; }
[[nodiscard]] inline List shift() { return {field::shift}; }
[[nodiscard]] inline List strain() { return {field::strain}; }
[[nodiscard]] inline List plastic_strain() { return {field::plastic_strain}; }
[[nodiscard]] inline List shape_inverse() { return {field::shape_inverse}; }

/// solid::deformation_of() and solid::deformation_energy() of owners of strain energy, beside the position.
[[nodiscard]] inline List deformation() {
  return joined({shape_inverse(),
                 {field::shape_rank, field::solid_volume, field::solid_material, field::solid_stiffness}});
}
/// The same where a scene has them.
[[nodiscard]] inline List deformation_if_there() {
  return joined({plastic_strain(), {field::stiffness_share}});
}
/// solid::refresh_shapes(), beside deformation(), mass, body and material.
[[nodiscard]] inline List shapes() { return {field::regular_bonds}; }
[[nodiscard]] inline List shapes_if_there() { return {field::bond_frequency}; }
/// regroup(): which particles are one body.
[[nodiscard]] inline List grouping() {
  return {field::id, field::body, field::phase, field::source, field::material};
}

}  // namespace tripoint::fields

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

namespace tripoint {

struct Scene;

struct PlannedField {
  std::string name, unit, per;  ///< per: particle, bond or body
  std::string owner;            ///< effect
  std::size_t bytes = 0;        ///< for each particle, bond or body
};
struct PlannedEffect {
  std::string name, why;
  std::string mode;  ///< corrected, paper, or the terms that differ
};
/// Plan of a scene, what it simulates and stores: the union of what its effects own.
struct Plan {
  std::vector<PlannedEffect> effects;
  std::vector<PlannedEffect> idle;  ///< what the scene does without, and why it can never act
  std::vector<PlannedField> fields;
  std::size_t bytes_per_particle = 0;
};
/// @throws InputError naming effect and field when a field is read and owned by none, or owned by two
[[nodiscard]] Plan plan(const Scene&);

}  // namespace tripoint

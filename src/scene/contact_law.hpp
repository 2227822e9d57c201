// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string_view>

#include "scene/scene.hpp"

namespace tripoint {

/// Whether a law has friction, or a loss in hits, which contact without a law has not.
[[nodiscard]] inline bool takes_energy(const ContactLaw& law) {
  return law.friction.value_or(0.0) > 0.0 || law.restitution.value_or(0.0) < 1.0;
}

/// The law of a pair of materials, in either order; null where no [[contact]] names it.
[[nodiscard]] const ContactLaw* contact_law_of(const Scene&, std::string_view material,
                                               std::string_view other);

/// What all pairs of solids that can meet have in common: two bodies that do not move by forces never count
/// as a pair.
struct CommonContact {
  std::optional<double> friction, restitution;  ///< empty = no pair states it
  /// Some pair has another friction or restitution than another pair
  bool differs = false;
};
[[nodiscard]] CommonContact common_contact(const Scene&);

}  // namespace tripoint

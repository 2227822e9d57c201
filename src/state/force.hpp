// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "core/field.hpp"
#include "state/energy_account.hpp"

/// Description of a force by the effect that makes it. Motion, rigid bodies and the ledger do the rest.
namespace tripoint {

/// The energy whose gradient a force is. The difference that finite steps leave between it and the work of
/// the force is the entry `time_integration`.
struct StoredEnergy {
  std::vector<std::string_view> entries;    ///< of the ledger, which the effect tells in add_to()
  EnergyAccount at_start;                   ///< their sum at time 0
  std::optional<EnergyAccount> released{};  ///< energy that events let go of
  std::string_view released_to{};  ///< entry that has the energy they let go; "" where others tell it
};

/// Particles that feel a force. all: rigid bodies too, by the sum over their members; particles: only what
/// moves by the forces on its own particles.
enum class Feels { all, particles };

struct Force {
  std::reference_wrapper<const VectorField<double>> field;  ///< that the effect owns [N]
  EnergyAccount work;                                       ///< done on what moves by forces
  /// Done on bodies that the scene moves, which pay for it; none: it stands with the other
  std::optional<EnergyAccount> work_on_driven{};
  std::optional<StoredEnergy> stored{};
  std::string_view entry{};  ///< of the ledger, that takes the work of a force which no energy stores
  Feels feels = Feels::all;
  /// Its moment about each particle, which rigid bodies feel beside that of the force on its centre [J]
  std::optional<std::reference_wrapper<const VectorField<double>>> couple{};
};

/// Where the work on bodies that the scene moves is accumulated.
[[nodiscard]] inline const EnergyAccount& work_on_driven(const Force& f) {
  return f.work_on_driven ? *f.work_on_driven : f.work;
}

/// Most forces that a scene may have: their sums are kept side by side in arrays of this length.
inline constexpr std::size_t most_forces = 6;

}  // namespace tripoint

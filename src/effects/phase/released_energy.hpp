// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "state/state.hpp"

namespace tripoint::phase {

/// Energy that the events of one step set free, and the particles that get it as heat (model 8.9). For each
/// particle the energy in its bonds, before less after, is divided equally among the events that touched it.
/// The cost of the joining of a rigid body is divided equally among the events of that body. So the result
/// does not depend on any order.
class ReleasedEnergy {
 public:
  using Energy = std::function<double(std::uint32_t id)>;  ///< of deformation, as the lists are [J]

  explicit ReleasedEnergy(Energy energy) : energy_(std::move(energy)) {}
  /// To be called ahead of a change to the lists of a particle: remembers its energy the first time.
  void touch(std::uint32_t id);
  /// The same, by the melting or freezing of `event`.
  void touch(std::uint32_t id, std::uint32_t event);
  /// Gives every difference to the heat of the events, and accumulates it. To be called when all effects have
  /// adopted the change.
  void settle(State&) const;

 private:
  struct Entry {
    double before = 0.0;                ///< [J]
    std::vector<std::uint32_t> events;  ///< ids, each once
  };
  void settle_deformation(State&) const;
  void settle_joining(State&) const;

  Energy energy_;
  std::map<std::uint32_t, Entry> entries_;
};

}  // namespace tripoint::phase

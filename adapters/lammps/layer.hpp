// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <string>
#include <vector>

#include "files/job.hpp"
#include "files/trajectory.hpp"

namespace tripoint::lammps {

/// One layer of a scene that is the same all along a periodic z: it stands for all layers, in plane strain.
struct Layer {
  InitialState state;            ///< of the lowest layer
  std::vector<std::size_t> row;  ///< of every particle of the scene in it
  std::size_t count = 1;         ///< layers
};

/// Why the scene cannot be run in one layer, by the job alone; empty = it can.
[[nodiscard]] std::string why_no_layer(const Job&);
/// @throws EngineError where the particles are no stack of equal layers
[[nodiscard]] Layer lowest_layer(const Job&, const InitialState&);
/// The whole scene from its layer: every column moves as its particle does.
[[nodiscard]] Snapshot all_layers(const Layer&, const InitialState& whole, const Snapshot& layer);

}  // namespace tripoint::lammps

// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <memory>
#include <string>

#include "adapters/lammps/model.hpp"

namespace tripoint::lammps {

/// Why pair sph/taitwater cannot run this job honestly; empty = it can.
[[nodiscard]] std::string why_no_sph_liquid(const Job&);
/// One liquid between fixed walls by pair sph/taitwater, or sph/taitwater/morris where it is viscous. The
/// kernel is Lucy's, and the density follows by continuity from the rest density. Tait's equation of state
/// has gamma = 7 and the scene's speed of sound.
/// @throws EngineError in LAMMPS's words
[[nodiscard]] std::unique_ptr<Model> make_sph_liquid(const Job&, const InitialState&);

}  // namespace tripoint::lammps

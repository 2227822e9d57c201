// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <memory>
#include <string>

#include "adapters/lammps/model.hpp"

namespace tripoint::lammps {

/// Why RHEO cannot run this job honestly; empty = it can.
[[nodiscard]] std::string why_no_rheo(const Job&);
/// Matter that melts and freezes by LAMMPS's RHEO: liquids by pair rheo (quintic spline, shifted particles), solids as networks
/// of bonds (bpm/spring) that end where a particle melts and begin where it freezes beside solid ones; heat by fix rheo/thermal.
/// @throws EngineError in LAMMPS's words
[[nodiscard]] std::unique_ptr<Model> make_rheo(const Job&, const InitialState&);

}  // namespace tripoint::lammps

// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <memory>
#include <string>

#include "adapters/lammps/model.hpp"

namespace tripoint::lammps {

/// Why RHEO cannot run this job honestly; empty = it can.
[[nodiscard]] std::string why_no_rheo(const Job&);
/// Matter that melts and freezes by LAMMPS's RHEO. Liquids use pair rheo (quintic spline, shifted particles),
/// and heat uses fix rheo/thermal. Solids are networks of bonds (bpm/spring). Bonds end where a particle
/// melts and begin where it freezes beside solid ones.
/// @throws EngineError in LAMMPS's words
[[nodiscard]] std::unique_ptr<Model> make_rheo(const Job&, const InitialState&);

}  // namespace tripoint::lammps

// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <memory>
#include <string>

#include "adapters/lammps/model.hpp"

namespace tripoint::lammps {

/// Why independent walkers cannot run this job honestly; empty = they can.
[[nodiscard]] std::string why_no_walkers(const Job&);
/// Heat as the number density of independent walkers in cells of one spacing, with one standard error beside
/// it.
/// @param brownian fix brownian, exact at every step; else fix langevin, see walkers.cpp
[[nodiscard]] std::unique_ptr<Model> make_walkers(const Job&, const InitialState&, bool brownian);

}  // namespace tripoint::lammps

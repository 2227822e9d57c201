// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <memory>
#include <string>

#include "adapters/lammps/model.hpp"

namespace tripoint::lammps {

/// Why `fix rigid` cannot run this job honestly; empty = it can.
[[nodiscard]] std::string why_no_rigid(const Job&);
/// Rigid bodies in free flight by `fix rigid`: velocity Verlet, rotation by Richardson's method, second
/// order.
/// @throws EngineError in LAMMPS's words, or when bodies come within a spacing: there is no contact here
[[nodiscard]] std::unique_ptr<Model> make_rigid_flight(const Job&, const InitialState&);

}  // namespace tripoint::lammps

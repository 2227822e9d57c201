// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <memory>
#include <string>

#include "adapters/lammps/model.hpp"

namespace tripoint::lammps {

/// Why MACHDYN's smd/tlsph cannot run this job honestly; empty = it can.
[[nodiscard]] std::string why_no_tlsph(const Job&);
/// One elastic object, with the held and driven ends that are joined to it, by pair smd/tlsph. It is total
/// Lagrangian SPH with corrected gradients, linear elasticity in the unrotated frame, and hourglass
/// stiffness 10.
/// @throws EngineError in LAMMPS's words
[[nodiscard]] std::unique_ptr<Model> make_tlsph(const Job&, const InitialState&);

}  // namespace tripoint::lammps

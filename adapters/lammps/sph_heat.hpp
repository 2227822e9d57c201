// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <memory>
#include <string>

#include "adapters/lammps/model.hpp"

namespace tripoint::lammps {

/// Why pair sph/heatconduction cannot run this job honestly; empty = it can.
[[nodiscard]] std::string why_no_sph_heat(const Job&);
/// Heat between the job's own particles by pair sph/heatconduction: Lucy kernel, uncorrected sums, explicit
/// steps.
[[nodiscard]] std::unique_ptr<Model> make_sph_heat(const Job&, const InitialState&);

}  // namespace tripoint::lammps

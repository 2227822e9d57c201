// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/references/functions.hpp"
#include "validation/references/number_table.hpp"

/// What a case states of how a quantity is measured: where a probe sits, which box, axis or phase is meant. The references in
/// which a case states its own truth (stated, expression, table) take these beside it.
namespace tripoint {

[[nodiscard]] std::vector<ReferenceArgument> measuring_arguments();

/// Numbers: axis, phase (3 = any solid), other (row in the job's bodies), gauge, outside, follows, stated_frequency [Hz], low.x
/// ... high.z and point.x ... point.z [m]. @throws InputError naming the function and the argument that is wrong
[[nodiscard]] Numbers measuring_numbers(const ReferenceInput&, const std::string& function);

/// The place of the case's probe, if it states one [m].
[[nodiscard]] std::optional<Vec3> stated_point(const Reference&);

}  // namespace tripoint

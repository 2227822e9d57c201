// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/references/functions.hpp"
#include "validation/references/number_table.hpp"

/// Statements of a case about how a quantity is measured: where a probe sits, which box, axis or phase is
/// meant. The references in which a case states its own truth (stated, expression, table) take these beside
/// it.
namespace tripoint {

[[nodiscard]] std::vector<ReferenceArgument> measuring_arguments();

/// The case's statement of the place and the object of the measurement. @throws InputError naming the
/// function and the argument that is wrong
[[nodiscard]] Measuring stated_measuring(const ReferenceInput&, const std::string& function);
/// Numbers: gauge [1], stated_frequency [Hz], stated_amplitude, diffusivity [m2/s]. @throws InputError
/// likewise
[[nodiscard]] Numbers stated_numbers(const ReferenceInput&, const std::string& function);

}  // namespace tripoint

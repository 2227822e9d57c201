// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "validation/case/case.hpp"
#include "validation/results/results.hpp"

/// `tripoint converge --metric`: what a ladder says of one number whose truth nobody knows.
namespace tripoint {

/// Leaves the case with this metric alone: its own of that name, or a new one of that quantity, which is
/// compared with 0. @throws InputError where it is neither
void ask_for(Case&, const std::string& metric);
/// Prints values, observed order, extrapolated value and grid convergence index, and writes
/// OUT/convergence.md.
void tell_convergence(const CaseResult&, const Case&, const std::string& out);

}  // namespace tripoint

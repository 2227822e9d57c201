// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include "particles/neighbours.hpp"
#include "particles/particles.hpp"
#include "sph/pass.hpp"

namespace tripoint {

/// Adds each term's sum to its columns; what they hold before is the caller's.
/// @param function made for clusters as wide as those of the neighbours   @throws MissingField that a term names and nobody owns
void run_pass(const PassFunction& function, Particles&, Neighbours&, const PairKernels&, int threads);
/// For these rows only. @param rows each once, ascending
void run_pass(const PassFunction& function, Particles&, Neighbours&, const PairKernels&, int threads, const std::vector<std::uint32_t>& rows);

/// For these clusters only; what a finding pass found of the others stays. @param clusters each once, ascending
void run_pass_over(const PassFunction& function, Particles&, Neighbours&, const PairKernels&, int threads, const std::vector<std::uint32_t>& clusters);

}  // namespace tripoint

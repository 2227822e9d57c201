// SPDX-License-Identifier: BSD-3-Clause
#include "effects/pair_passes.hpp"

#include <string>

#include "core/errors.hpp"
#include "core/machine.hpp"

namespace tripoint {

template <>
PairPasses pair_passes_for<Any>();
template <>
PairPasses pair_passes_for<Avx2>();
template <>
PairPasses pair_passes_for<Avx512>();

PairPasses pair_passes(int lanes) {
  if (lanes == 1) return pair_passes_for<Any>();
  if (lanes == 4 && machine_has_avx2()) return pair_passes_for<Avx2>();
  if (lanes == 8 && machine_has_avx512()) return pair_passes_for<Avx512>();
  throw InputError(std::to_string(lanes) + " lanes: there are 1, 4 (where the machine has AVX2) and 8 (AVX-512)");
}

int best_lanes() { return machine_has_avx2() ? 4 : 1; }

}  // namespace tripoint

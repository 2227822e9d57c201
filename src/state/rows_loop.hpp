// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "core/machine.hpp"

namespace tripoint {

/// body(i) for i = 0..count-1, shared among threads where there are enough. The thread library is not called
/// for a team of one. It would take memory at every call, a sixth of the instructions of a small scene's
/// step.
template <class Body>
void for_rows(std::size_t count, int threads, Body body) {
  if (threads == 1 || count <= worth_threads) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

/// What the machine that runs this can do.
namespace tripoint {

/// Particles from which a short loop over them is worth a team of threads.
inline constexpr std::size_t worth_threads = 4096;

[[nodiscard]] inline bool machine_has_avx2() noexcept { return __builtin_cpu_supports("avx2"); }
[[nodiscard]] inline bool machine_has_avx512() noexcept {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

/// Abilities of the machine that runs this program.
namespace tripoint {

/// Particles from which a short loop over them is worth a team of threads.
inline constexpr std::size_t worth_threads = 4096;

[[nodiscard]] inline bool machine_has_avx2() noexcept { return __builtin_cpu_supports("avx2"); }
[[nodiscard]] inline bool machine_has_avx512() noexcept {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq");
}

/// Particles that the widest vectors of this machine hold: 1, 4 or 8.
[[nodiscard]] inline int widest_lanes() noexcept {
  return !machine_has_avx2() ? 1 : machine_has_avx512() ? 8 : 4;
}

}  // namespace tripoint

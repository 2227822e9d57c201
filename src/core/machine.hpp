// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// What the machine that runs this can do.
namespace tripoint {

[[nodiscard]] inline bool machine_has_avx2() noexcept { return __builtin_cpu_supports("avx2"); }
[[nodiscard]] inline bool machine_has_avx512() noexcept { return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq"); }

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

namespace tripoint {

/// Uniform in [-1, 1) from a counter: the same number for the same (seed, particle, axis) on every machine
/// (splitmix64).
[[nodiscard]] constexpr double counter_noise(std::uint64_t seed, std::uint64_t particle, std::uint64_t axis) {
  std::uint64_t z = seed * 0x9e3779b97f4a7c15ULL + (3 * particle + axis + 1) * 0xbf58476d1ce4e5b9ULL;
  for (int round = 0; round < 2; ++round) {
    z += 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    z ^= z >> 31;
  }
  return static_cast<double>(z >> 11) * 0x1.0p-52 - 1.0;
}

}  // namespace tripoint

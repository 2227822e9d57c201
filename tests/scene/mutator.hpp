// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

/// Spoils case files: the same mutants for the same seed on every machine.
namespace tripoint::test {

struct Mutant {
  std::string text;
  std::string what;  ///< what was done, for people
};

/// @param sources texts of sound case files   @param count half of them spoil the grammar, half the values
[[nodiscard]] std::vector<Mutant> mutants(const std::vector<std::string>& sources, std::size_t count,
                                          std::uint64_t seed);

/// Texts that are known to break TOML libraries: `[,]`, `v=[1,}`, deep nesting, a 400 kB dotted key ...
[[nodiscard]] std::vector<Mutant> parser_breakers();

}  // namespace tripoint::test

// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "full_case.hpp"
#include "mutator.hpp"
#include "real_cases.hpp"

/// write-mutants FOLDER COUNT SEED: the mutated case files of the reader's test as files, for tests of the
/// whole program. Beside mutant-N.toml lies its sound source as source-N.toml; breaker-N.toml are texts that
/// every reader must refuse.
int main(int argc, char** argv) {
  using namespace tripoint::test;
  if (argc != 4) {
    std::fputs("usage: write-mutants FOLDER COUNT SEED\n", stderr);
    return 2;
  }
  const std::string folder = argv[1];
  const auto write = [&](const char* kind, std::size_t n, const std::string& text) {
    std::ofstream(folder + "/" + kind + "-" + std::to_string(n) + ".toml", std::ios::binary) << text;
  };
  const std::vector<std::string> sources{full_case, cosine_case, torque_free_case, board_case};
  const auto all = mutants(sources, std::strtoul(argv[2], nullptr, 10), std::strtoull(argv[3], nullptr, 10));
  for (std::size_t n = 0; n < all.size(); ++n) {
    write("mutant", n, all[n].text);
    write("source", n, sources[n % sources.size()]);
    std::printf("%s\n", all[n].what.c_str());
  }
  const auto breakers = parser_breakers();
  for (std::size_t n = 0; n < breakers.size(); ++n) write("breaker", n, breakers[n].text);
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
// The targets without a fuzzer, in every build: one call for each file of the folder. A crash is a crash.
//   replay-NAME FOLDER [MUTANTS FIRST]   then so many mutants of these files by chance, from seed FIRST on:
//   without clang, and blind, but of any build
#include <algorithm>
#include <iterator>
#include <random>
#include <vector>

#include "fuzz/input.hpp"

namespace fs = std::filesystem;
using Input = std::vector<std::uint8_t>;

namespace {

std::vector<Input> inputs_in(const char* folder, bool say) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Input> inputs;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    if (say) std::fprintf(stderr, "%s\n", file.c_str());  // the last one named is the one that did it
    LLVMFuzzerTestOneInput(inputs.back().data(), inputs.back().size());
  }
  return inputs;
}

/// One of the inputs with one to eight changes: a byte, a bit, a piece cut out, doubled, or taken from
/// another input.
Input mutant(const std::vector<Input>& inputs, unsigned seed) {
  std::mt19937 chance(seed);
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(chance()) % std::max<std::size_t>(n, 1);
  };
  Input made = inputs[below(inputs.size())];
  for (std::size_t changes = 1 + below(8); changes > 0 && !made.empty(); --changes) {
    const auto at = static_cast<std::ptrdiff_t>(below(made.size()));
    const auto length = static_cast<std::ptrdiff_t>(
        1 + below(std::min<std::size_t>(made.size() - static_cast<std::size_t>(at), 32)));
    const Input piece(made.begin() + at,
                      made.begin() + std::min(at + length, static_cast<std::ptrdiff_t>(made.size())));
    const Input& other = inputs[below(inputs.size())];
    switch (below(5)) {
      case 0:
        made[static_cast<std::size_t>(at)] = static_cast<std::uint8_t>(chance());
        break;
      case 1:
        made[static_cast<std::size_t>(at)] ^= static_cast<std::uint8_t>(1u << below(8));
        break;
      case 2:
        made.erase(made.begin() + at, made.begin() + at + static_cast<std::ptrdiff_t>(piece.size()));
        break;
      case 3:
        made.insert(made.begin() + at, piece.begin(), piece.end());
        break;
      default:
        made.insert(made.begin() + at, other.begin() + static_cast<std::ptrdiff_t>(below(other.size())),
                    other.end());
        break;
    }
    if (made.size() > 65536) made.resize(65536);
  }
  return made;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return 2;
  const unsigned mutants = argc > 2 ? static_cast<unsigned>(std::atol(argv[2])) : 0,
                 first = argc > 3 ? static_cast<unsigned>(std::atol(argv[3])) : 1;
  const auto inputs = inputs_in(argv[1], mutants == 0);
  if (inputs.empty()) return 1;  // a corpus that is not there proves nothing
  for (unsigned seed = first; seed < first + mutants; ++seed) {
    const Input made = mutant(inputs, seed);
    if (seed % 1000 == 0) std::fprintf(stderr, "seed %u\n", seed);
    LLVMFuzzerTestOneInput(made.data(), made.size());
  }
  std::printf("%zu inputs, %u mutants\n", inputs.size(), mutants);
  return 0;
}

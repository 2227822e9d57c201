// SPDX-License-Identifier: BSD-3-Clause
/// Prints one hash a case and mode, of the whole state after some steps: of all columns, bonds, energy
/// accounts and the order of rows. Values go by their names: which effect declares them, and in which order,
/// changes no hash. Two builds, two processors and two numbers of lanes must print the same text.
///   state-hashes [--steps N] [--lanes N] [--threads N] [--traps] CASE.toml...
/// --traps: what is not a number, infinite or divided by zero ends the program by SIGFPE.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cfenv>
#include <cstdlib>
#include <string_view>

#include "sampling/sample.hpp"
#include "state_after.hpp"
#include "step/settle.hpp"
#include "validation/case/read_case.hpp"

using namespace tripoint;

namespace {

/// FNV-1a, 64 bits.
class Hash {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  }
  template <class T>
  void add_bits(T number) {
    const auto bits = std::bit_cast<std::array<char, sizeof(T)>>(number);
    add({bits.data(), bits.size()});
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

/// Values that stand in the order of their declaration are taken apart, each to the name that the layout has
/// for it.
Checkpoint by_names(Checkpoint kept) {
  std::vector<std::string> names[2], fields;
  for (const std::string& line : kept.text.at("step/layout")) {
    if (line.starts_with("effect ")) continue;
    if (line.starts_with("account "))
      names[0].push_back(line);
    else if (line.starts_with("step number "))
      names[1].push_back(line);
    else
      fields.push_back(line);
  }
  const auto take_apart = [&](const char* key, const std::vector<std::string>& of) {
    const std::vector<double> values = kept.real.extract(key).mapped();
    for (std::size_t n = 0; n < of.size(); ++n) kept.real[of[n]] = {values.at(n)};
  };
  take_apart("step/booked", names[0]);
  take_apart("step/numbers", names[1]);
  std::ranges::sort(fields);
  kept.text["step/layout"] = fields;
  return kept;
}

std::uint64_t hash_of(const Outcome& state) {
  Hash hash;
  const auto add = [&](const auto& arrays) {
    for (const auto& [name, values] : arrays) {
      hash.add(name);
      for (const auto& value : values) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::string>)
          hash.add(value);
        else
          hash.add_bits(value);
      }
    }
  };
  const Checkpoint kept = state.failure.empty() ? by_names(state.kept) : state.kept;
  add(kept.real);
  add(kept.whole);
  add(kept.text);
  hash.add(state.failure);
  hash.add_bits(state.pairs);
  return hash.value();
}

}  // namespace

int main(int argc, char** argv) {
  tripoint::set_settler(tripoint::settled);
  long steps = 40;
  Way way{.threads = 1, .lanes = 0};
  bool traps = false;
  try {
    for (int i = 1; i < argc; ++i) {
      const std::string_view word = argv[i];
      const bool has_value = i + 1 < argc;
      if (word == "--traps") {
        traps = true;
      } else if (word == "--steps" && has_value) {
        steps = std::max(1L, std::atol(argv[++i]));
      } else if (word == "--lanes" && has_value) {
        way.lanes = std::atoi(argv[++i]);
      } else if (word == "--threads" && has_value) {
        way.threads = std::atoi(argv[++i]);
      } else {
        const CaseReading reading = read_case(argv[i]);
        for (const Mode mode : reading.value.modes) {
          RunChoice choice;
          choice.mode = mode;
          const Scene scene = scene_for(reading.value, choice);
          const InitialState initial = sample(scene);
          if (traps) feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
          const Outcome state = state_after(scene, initial, way, steps);
          if (traps) fedisableexcept(FE_ALL_EXCEPT);
          fmt::print("{} {} {} steps {:016x}\n", reading.value.id, to_string(mode), state.steps,
                     hash_of(state));
        }
      }
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "state-hashes: {}\n", e.what());
    return 2;
  }
  return 0;
}

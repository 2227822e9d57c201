// SPDX-License-Identifier: BSD-3-Clause
/// Prints one hash a case and mode, of the whole state after some steps: of all columns, bonds, bookings and
/// the order of rows. Two builds, two processors and two numbers of lanes must print the same text.
///   state-hashes [--steps N] [--lanes N] [--threads N] [--traps] CASE.toml...
/// --traps: what is not a number, infinite or divided by zero ends the program by SIGFPE.
#include <fmt/format.h>

#include <bit>
#include <cfenv>
#include <cstdlib>
#include <string_view>

#include "scene/sample.hpp"
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
  add(state.kept.real);
  add(state.kept.whole);
  add(state.kept.text);
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

// SPDX-License-Identifier: BSD-3-Clause
/// Whether cases have the same bits on any number of threads and at every vector width: a few steps of each,
/// all columns, bonds, bookings and the order of rows compared with those of one thread that works a particle
/// at a time, and on every pair.
///   same-bits [--steps MOST] [--budget PARTICLE-STEPS] CASE.toml...
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "core/machine.hpp"
#include "sampling/sample.hpp"
#include "state_after.hpp"
#include "step/settle.hpp"
#include "validation/case/read_case.hpp"

using namespace tripoint;

namespace {

/// Every number of threads that the project promises, and every width that this machine has, each at least
/// once.
std::vector<Way> ways() {
  std::vector<Way> list{{2, 1}, {7, 1}};
  if (machine_has_avx2()) {
    list.push_back({1, 4});
    list.push_back({3, 4});
  }
  if (machine_has_avx512()) {
    list.push_back({1, 8});
    list.push_back({7, 8});
  }
  list.push_back({.threads = 2, .lanes = 0, .changes = true});
  return list;
}

bool same(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y);
  });
}

/// Name of the first array in which two states differ; "" where none does.
std::string difference(const Checkpoint& a, const Checkpoint& b) {
  if (a.real.size() != b.real.size() || a.whole.size() != b.whole.size()) return "the set of arrays";
  for (const auto& [name, values] : a.real)
    if (const auto at = b.real.find(name); at == b.real.end() || !same(values, at->second)) return name;
  for (const auto& [name, values] : a.whole)
    if (const auto at = b.whole.find(name); at == b.whole.end() || values != at->second) return name;
  return a.text == b.text ? "" : "text";
}

/// @return whether all ways agree
bool agrees(const std::string& file, Mode mode, long most, double budget) {
  const CaseReading reading = read_case(file);
  RunChoice choice;
  choice.mode = mode;
  const Scene scene = scene_for(reading.value, choice);
  const InitialState initial = sample(scene);
  const auto afford =
      static_cast<long>(budget / static_cast<double>(std::max<std::size_t>(1, initial.size())));
  const long steps = std::clamp(afford, 2L, most);
  Outcome oracle;
  try {
    oracle = state_after(scene, initial, {.threads = 1, .lanes = 1, .sums_all = true}, steps);
  } catch (const InputError& e) {  // a scene that the solver does not take
    fmt::print("{} {}: left out, {}\n", reading.value.id, to_string(mode), e.what());
    return true;
  }
  for (const Way& way : ways()) {
    const Outcome other = state_after(scene, initial, way, steps);
    std::string what = oracle.failure == other.failure ? difference(oracle.kept, other.kept) : "how it fails";
    if (what.empty() && oracle.pairs != other.pairs) what = "the number of pairs";
    if (what.empty()) continue;
    fmt::print("{} {}: {} threads, {} lanes differ from 1 thread, 1 lane in {} after {} steps\n",
               reading.value.id, to_string(mode), way.threads, way.lanes, what, steps);
    return false;
  }
  fmt::print("{} {}: {} particles, {} steps, {:.0f} pairs{}\n", reading.value.id, to_string(mode),
             initial.size(), oracle.steps, oracle.pairs, oracle.failure.empty() ? "" : ", fails alike");
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  tripoint::set_settler(tripoint::settled);
  long most = 10;
  double budget = 2e4;
  bool all = true;
  int states = 0;
  try {
    for (int i = 1; i < argc; ++i) {
      if (std::string_view(argv[i]) == "--steps" && i + 1 < argc) {
        most = std::max(1L, std::atol(argv[++i]));
        continue;
      }
      if (std::string_view(argv[i]) == "--budget" && i + 1 < argc) {
        budget = std::atof(argv[++i]);
        continue;
      }
      for (const Mode mode : read_case(argv[i]).value.modes) {
        all = agrees(argv[i], mode, most, budget) && all;
        ++states;
      }
    }
  } catch (const std::exception& e) {
    fmt::print(stderr, "same-bits: {}\n", e.what());
    return 2;
  }
  fmt::print("{} states, {} ways each\n", states, ways().size() + 1);
  return all && states > 0 ? 0 : 1;
}

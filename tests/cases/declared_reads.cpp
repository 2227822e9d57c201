// SPDX-License-Identifier: BSD-3-Clause
/// Whether the effects of cases ask for no column and tell no entry of the ledger that they have not
/// declared: each case in all its modes, until its end or until a sum of particles and steps. The solver is
/// that of the test build, which refuses other columns.
///   declared-reads [--work PARTICLE_STEPS] CASE.toml...
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "sampling/sample.hpp"
#include "scene/effect_rule.hpp"
#include "step/settle.hpp"
#include "step/simulation.hpp"
#include "validation/case/read_case.hpp"

using namespace tripoint;

namespace {

/// @throws std::runtime_error where an entry stands in no rule of an effect
void check_entries(const Ledger& ledger) {
  const std::vector<LedgerEntry> declared = ledger_entries();
  for (const auto& [entry, joule] : ledger.energy)
    if (std::ranges::find(declared, entry, &LedgerEntry::name) == declared.end())
      throw std::runtime_error("the ledger has an entry \"" + entry + "\", which no effect declares");
}

/// Steps that were made. @throws UndeclaredField
long run(const Case& read, Mode mode, double work) {
  RunChoice choice;
  choice.mode = mode;
  const Scene scene = scene_for(read, choice);
  const InitialState initial = sample(scene);
  long steps = static_cast<long>(work / static_cast<double>(std::max<std::size_t>(1, initial.size()))) + 1,
       made = 0;
  try {
    Simulation s(scene, initial, {.force_time_step = true});
    s.advance_to(scene.end_time, [&] { return ++made < steps; });
    check_entries(s.ledger());
  } catch (const Diverged&) {    // a case that is meant to
  } catch (const InputError&) {  // a scene that the solver does not take
  }
  return made;
}

}  // namespace

int main(int argc, char** argv) {
  tripoint::set_settler(tripoint::settled);
  double work = 3e5;
  int runs = 0, wrong = 0;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--work" && i + 1 < argc) {
      work = std::atof(argv[++i]);
      continue;
    }
    try {
      const Case read = read_case(argv[i]).value;
      for (const Mode mode : read.modes) {
        fmt::print("{} {}: {} steps\n", read.id, to_string(mode), run(read, mode, work));
        ++runs;
      }
    } catch (const std::exception& e) {
      fmt::print("{}: {}\n", argv[i], e.what());
      ++wrong;
    }
  }
  fmt::print("{} runs, {} wrong\n", runs, wrong);
  return wrong == 0 && runs > 0 ? 0 : 1;
}

// SPDX-License-Identifier: BSD-3-Clause
/// Runs a few steps of a case, for callgrind to count: the instructions of counted_steps() and nothing else.
///   count-steps CASE.toml corrected|paper WARM STEPS [a.b=VALUE]...
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "assembly/plan.hpp"
#include "sampling/sample.hpp"
#include "step/settle.hpp"
#include "step/simulation.hpp"
#include "validation/case/read_case.hpp"

using namespace tripoint;

namespace {
void run_steps(Simulation& simulation, long steps) {
  simulation.advance_to(simulation.state().scene.end_time * 1e3, [&] { return --steps > 0; });
}
}  // namespace

extern "C" [[gnu::noipa]] void counted_steps(Simulation& simulation, long steps) {
  run_steps(simulation, steps);
}

int main(int argc, char** argv) {
  tripoint::set_settler(tripoint::settled);
  if (argc < 5) {
    std::fputs("count-steps CASE.toml corrected|paper WARM STEPS [a.b=VALUE]...\n", stderr);
    return 2;
  }
  try {
    const CaseReading reading = read_case(argv[1], std::vector<std::string>(argv + 5, argv + argc));
    RunChoice choice;
    choice.mode = mode_from(argv[2]);
    const Scene scene = scene_for(reading.value, choice);
    Simulation simulation(scene, sample(scene));
    run_steps(simulation, std::atol(argv[3]));
    counted_steps(simulation, std::atol(argv[4]));
    std::printf("%zu particles, %s, %zu bytes\n", simulation.state().particles.size(), __VERSION__,
                plan(scene).bytes_per_particle);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "count-steps: %s\n", e.what());
    return 1;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "assembly/plan.hpp"
#include "program/cli/case_summary.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "sampling/sample.hpp"
#include "validation/campaign/case_names.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/idle_keys.hpp"
#include "validation/case/preflight.hpp"
#include "validation/case/read_case.hpp"
#include "validation/case/shape_match.hpp"
#include "validation/references/experiment.hpp"
#include "validation/run/trial.hpp"

namespace tripoint {
namespace {

constexpr const char* check_description =
    "Checks a case before anything runs: every key, unit and name. It finds bodies that overlap, stand\n"
    "too near, are too coarse or have a wrong mass. It finds time steps above a bound, and events and\n"
    "keys that can change nothing. It names metrics, references and engines that would be refused, and a\n"
    "case that no gate judges.\n"
    "Exit: 2 with an error, 0 with none or with warnings.\n"
    "  tripoint check my.toml\n"
    "  tripoint check my.toml --set scene.spacing=0.01";

int check(const std::string& file, const std::vector<std::string>& set) {
  const CaseReading reading = read_case(file, set);
  check_data_files(reading.value);
  const Scene scene = scene_for(reading.value, {});
  Scene laid = scene;
  laid.settle = false;  // that would run the solver for minutes
  static_cast<void>(plan_of(reading));
  const InitialState state = sample(laid);
  auto findings = preflight(reading.value, scene, state);
  for (auto& f : idle_keys(reading, scene, state)) findings.push_back(std::move(f));
  for (auto& f : trial(reading.value)) findings.push_back(std::move(f));
  for (auto& f : unjudged(reading.value)) findings.push_back(std::move(f));
  long errors = 0;
  for (const auto& f : library_values(reading)) say("note: " + with_place(f));
  for (const auto& f : old_keys(reading)) say("note: " + with_place(f));
  for (const auto& f : mesh_notes(scene, state)) say("note: " + with_place(f));
  for (const auto& f : moment_notes(scene, state)) say("note: " + with_place(f));
  for (const auto& f : start_notes(scene, state)) say("note: " + with_place(f));
  for (const auto& f : data_after_the_end(reading.value)) say("note: " + with_place(f));
  for (const auto& f : foreseen(scene)) say("note: " + with_place(f));
  if (scene.settle)
    say("note: nothing is run here: liquids are not let down into equilibrium (scene.settle), and the "
        "particles are those before "
        "it");
  if (const auto seconds = cpu_seconds(scene, state))
    say(fmt::format(
        "note: a run of the particle solver takes about {:.2g} CPU seconds (within a factor of three){}",
        *seconds, *seconds > 600.0 ? "; `tripoint explain` says what bounds its steps" : ""));
  for (const auto& f : findings) {
    errors += f.error ? 1 : 0;
    say((f.error ? "error: " : "warning: ") + with_place(f));
  }
  const auto counted = [](long n, const char* one, const char* more) {
    return fmt::format("{} {}", n, n == 1 ? one : more);
  };
  print_line(fmt::format("{}: {} particles in {}, {}, {}", file, state.size(),
                         counted(static_cast<long>(scene.bodies.size()), "body", "bodies"),
                         counted(errors, "error", "errors"),
                         counted(static_cast<long>(findings.size()) - errors, "warning", "warnings")));
  return errors > 0 ? 2 : 0;
}

}  // namespace

void add_check(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("check", check_description);
  auto file = std::make_shared<std::string>();
  auto set = std::make_shared<std::vector<std::string>>();
  command->add_option("CASE", *file, "path of a case file, or the id of a case that is shipped")->required();
  command
      ->add_option("--set", *set,
                   "replace a key: scene.spacing=0.01, body.NAME.velocity=[1,0,0]; may be repeated")
      ->take_all()
      ->allow_extra_args(false);
  command->callback(
      [=, &exit_code] { exit_code = guarded([&] { return check(shown_path(case_file(*file)), *set); }); });
}

}  // namespace tripoint

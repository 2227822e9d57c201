// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "core/limits.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/gate_judge.hpp"
#include "program/cli/options.hpp"
#include "sampling/sample.hpp"
#include "step/settle.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/verdict.hpp"

namespace {

constexpr const char* description =
    "tripoint: one scene in our SPH solver, in Bullet, in LAMMPS and in exact solutions, compared and\n"
    "judged.\n\n"
    "First steps:\n"
    "  tripoint list                         the cases and the claim of each\n"
    "  tripoint explain rigid/ballistic      the meaning of a case, and the reason of each default\n"
    "  tripoint validate rigid/ballistic     run it on every engine, judge it, write report/index.html\n"
    "  tripoint new my-case.toml             start a case of your own\n\n";

constexpr const char* footer =
    "tripoint COMMAND --help says more, with examples.\n"
    "Exit codes: 0 pass, 1 an accuracy, order or invariant gate fails, 2 bad input, 3 inconclusive, 4 a "
    "required engine, "
    "reference\n"
    "or metric is missing or not comparable, 5 the gate's self-test fails, 6 cost regression, 7 diverged, "
    "130 Ctrl-C.";

/// Lists commands by the first sentence of their descriptions: the rest is in each one's own help.
class FirstSentences : public CLI::Formatter {
 public:
  std::string make_subcommand(const CLI::App* command) const override {
    std::ostringstream out;
    CLI::detail::format_help(out, command->get_name(), tripoint::first_sentence(command->get_description()),
                             14);
    return out.str();
  }
};

/// A command that lists its own exit codes does not list those of all commands too.
void keep_one_list_of_exit_codes(CLI::App& app) {
  for (auto* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_description().find("\nExit") != std::string::npos) command->footer("");
    keep_one_list_of_exit_codes(*command);
  }
}

/// Ranges of the library let nan pass.
void expect_finite_numbers(CLI::App& app) {
  const auto finite = [](const std::string& word) {
    char* end = nullptr;
    const double value = std::strtod(word.c_str(), &end);
    return *end == '\0' && !std::isfinite(value) ? word + " is no finite number" : std::string();
  };
  for (auto* option : app.get_options())
    if (option->get_type_name().starts_with("FLOAT")) option->check(finite, "");
  for (auto* command : app.get_subcommands([](const CLI::App*) { return true; }))
    expect_finite_numbers(*command);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace tripoint;
  hold_standard_streams();
  expect_file_limit();
  if (const auto why = stack_trouble(argv); !why.empty()) {
    say("tripoint: " + why);
    return exit_bad_input;
  }
  remember_command_line(argc, argv);
  set_settler(settled);
  stop_settling_when(interrupted);
  CLI::App app{description, "tripoint"};
  app.footer(footer);
  app.formatter(std::make_shared<FirstSentences>());
  app.set_version_flag("--version", TRIPOINT_VERSION);
  app.require_subcommand(1);
  int exit_code = exit_pass;
  for (const auto add :
       {add_run,    add_validate, add_merge,    add_suite,     add_status, add_compare, add_report,
        add_render, add_view,     add_converge, add_recommend, add_plan,   add_predict, add_ablate,
        add_gate,   add_summary,  add_check,    add_explain,   add_list,   add_new,     add_import,
        add_schema, add_engines,  add_engine,   add_releases,  add_bench,  add_export})
    add(app, exit_code);
  keep_one_list_of_exit_codes(app);
  expect_finite_numbers(app);
  if (const auto wrong = mistyped_word(app, argc, argv); !wrong.empty()) {
    say("tripoint: " + wrong);
    return exit_bad_input;
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    // CLI11's own codes, 106 and others, mean nothing here
    return app.exit(e) == 0 ? exit_pass : exit_bad_input;
  }
  return output_arrived() || exit_code != exit_pass ? exit_code : exit_bad_input;
}

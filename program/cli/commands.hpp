// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

/// One function a command: adds its subcommand to the program, and sets the exit code when it was called
/// (contracts: exit codes).
namespace tripoint {

void add_run(CLI::App& app, int& exit_code);
void add_validate(CLI::App& app, int& exit_code);
void add_merge(CLI::App& app, int& exit_code);
void add_suite(CLI::App& app, int& exit_code);
void add_status(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
void add_report(CLI::App& app, int& exit_code);
void add_converge(CLI::App& app, int& exit_code);
void add_recommend(CLI::App& app, int& exit_code);
void add_plan(CLI::App& app, int& exit_code);
void add_predict(CLI::App& app, int& exit_code);
void add_ablate(CLI::App& app, int& exit_code);
void add_gate(CLI::App& app, int& exit_code);
/// @return the subcommand, so that `gate` sees whether it was called
CLI::App* add_gate_adopt(CLI::App& gate, int& exit_code);
void add_check(CLI::App& app, int& exit_code);
void add_explain(CLI::App& app, int& exit_code);
void add_list(CLI::App& app, int& exit_code);
void add_new(CLI::App& app, int& exit_code);
void add_import(CLI::App& app, int& exit_code);
void add_schema(CLI::App& app, int& exit_code);
void add_engines(CLI::App& app, int& exit_code);
void add_engine(CLI::App& app, int& exit_code);
void add_releases(CLI::App& app, int& exit_code);
void add_bench(CLI::App& app, int& exit_code);
void add_export(CLI::App& app, int& exit_code);
void add_render(CLI::App& app, int& exit_code);
void add_view(CLI::App& app, int& exit_code);

}  // namespace tripoint

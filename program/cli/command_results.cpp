// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "validation/baseline/history.hpp"
#include "validation/campaign/merge.hpp"
#include "validation/judge/judge.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace {

constexpr const char* merge_description =
    "Joins the results of shards into one report with the verdict that the whole suite would have had.\n"
    "  tripoint validate --shard 1/2 --out a     tripoint validate --shard 2/2 --out b\n"
    "  tripoint merge a b --out report\n"
    "A missing or doubled shard is refused (exit 2).";

constexpr const char* report_description =
    "Draws the report anew from a results.json: index.html, junit.xml and summary.md beside it. Runs and judges nothing anew\n"
    "but the verdicts, which are always recomputed from the measured values.\n"
    "  tripoint report report/results.json\n"
    "  tripoint report report/results.json --pdf      also report.pdf, the report to sign (needs Debian's weasyprint)\n"
    "Exit: 0 drawn, whatever the verdict; 4 where the page or the PDF could not be made.";

/// @return why not all of it could be drawn; empty when it is there
std::string finish(const Results& results, const std::string& out, bool pdf = false) {
  auto missing = write_report(results, out, pdf);
  if (!missing.empty()) say("tripoint: " + missing);
  print(last_line(results, out) + "\n");
  return missing;
}

int merge(const std::vector<std::string>& folders, const std::string& out, bool sandbox) {
  if (sandbox) sandbox_third_parties(out);
  auto results = merge_shards(folders);
  const auto lock = hold_folder(out);
  copy_runs_of_shards(folders, out);
  results.history = "history.jsonl";
  append_history((std::filesystem::path(out) / results.history).string(), history_lines(results));
  for (const auto& c : results.cases) print(case_line(c) + "\n");
  static_cast<void>(finish(results, out));
  return results.exit_code;
}

int report(const std::string& path_or_folder, bool pdf, bool sandbox) {
  const auto path = results_file(path_or_folder);
  auto results = read_results(path);
  judge(results);
  const auto folder = std::filesystem::path(path).parent_path();
  if (sandbox) sandbox_third_parties(folder.string());
  return finish(results, folder.empty() ? "." : folder.string(), pdf).empty() ? exit_pass : exit_missing;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("merge", merge_description);
  auto folders = std::make_shared<std::vector<std::string>>();
  auto out = std::make_shared<std::string>();
  command->add_option("DIR", *folders, "folders of the shards")->required();
  command->add_option("--out", *out, "folder of the joined report")->required();
  auto sandbox = std::make_shared<bool>(false);
  add_sandbox_flag(*command, *sandbox);
  command->callback([=, &exit_code] { exit_code = guarded([&] { return merge(*folders, *out, *sandbox); }); });
}

void add_report(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("report", report_description);
  auto path = std::make_shared<std::string>();
  command->add_option("RESULTS", *path, "a results.json, or the folder of one")->required();
  auto pdf = std::make_shared<bool>(false);
  command->add_flag("--pdf", *pdf, "also write report.pdf");
  auto sandbox = std::make_shared<bool>(false);
  add_sandbox_flag(*command, *sandbox);
  command->callback([=, &exit_code] { exit_code = guarded([&] { return report(*path, *pdf, *sandbox); }); });
}

}  // namespace tripoint

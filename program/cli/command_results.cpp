// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/merge.hpp"
#include "program/cli/options.hpp"
#include "validation/baseline/history.hpp"
#include "validation/campaign/merge.hpp"
#include "validation/judge/judge.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace {

constexpr const char* merge_description =
    "Joins the parts of a suite into one report with the verdict that the whole suite would have had.\n"
    "  tripoint validate --shard 1/2 --out a     tripoint validate --shard 2/2 --out b\n"
    "  tripoint merge a b --out report           a missing or doubled shard is refused (exit 2)\n"
    "  tripoint suite make DIR                   tripoint suite work DIR\n"
    "  tripoint merge DIR                        DIR/results.json, DIR/index.html; jobs without a "
    "result are named (exit 2)\n"
    "  tripoint merge DIR --out report           into another folder, with a copy of the runs";

constexpr const char* report_description =
    "Draws the report anew from a results.json: index.html, junit.xml and summary.md beside it. Runs anew\n"
    "nothing but the verdicts, which are always computed from the measured values.\n"
    "  tripoint report report/results.json\n"
    "  tripoint report report/results.json --pdf      also report.pdf, the report to sign (needs "
    "Debian's weasyprint)\n"
    "Exit: 0 drawn, whatever the verdict; 4 where the page or the PDF could not be made.";

int merge_reports(const MergeOptions& o) {
  if (o.out.empty()) throw InputError("merge: name the folder of the joined report: --out DIR");
  if (o.sandbox) sandbox_third_parties(o.out);
  auto results = merge_shards(o.folders);
  const auto lock = hold_folder(o.out);
  copy_runs_of_shards(o.folders, o.out);
  results.history = "history.jsonl";
  append_history((std::filesystem::path(o.out) / results.history).string(), history_lines(results));
  if (!o.json)
    for (const auto& c : results.cases) print(case_line(c) + "\n");
  if (!o.page)
    write_results(results, o.out);
  else if (const auto missing = write_report(results, o.out); !missing.empty())
    say("tripoint: " + missing);
  print(o.json ? results_text(results) : last_line(results, o.out) + "\n");
  return results.exit_code;
}

int merge(const MergeOptions& o) {
  const bool is_suite =
      o.folders.size() == 1 && std::filesystem::exists(std::filesystem::path(o.folders[0]) / "suite.json");
  return is_suite ? merge_suite(o.folders[0], o) : merge_reports(o);
}

/// @return why not all of it could be drawn; empty when it is there
std::string finish(const Results& results, const std::string& out, bool pdf = false) {
  auto missing = write_report(results, out, pdf);
  if (!missing.empty()) say("tripoint: " + missing);
  print(last_line(results, out) + "\n");
  return missing;
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

void add_merge_to(CLI::App& group, int& exit_code, const std::string& earlier) {
  auto* command = group.add_subcommand("merge", merge_description);
  if (!earlier.empty()) command->group("");
  auto o = std::make_shared<MergeOptions>();
  command->add_option("DIR", o->folders, "folders of the shards, or the folder of a suite")->required();
  command->add_option("--out", o->out, "folder of the joined report (default for a suite: its own)");
  command->add_flag_callback(
      "--no-report", [o] { o->page = false; },
      "draw no page: results.json, junit.xml and summary.md are written all the same");
  command->add_flag("--json", o->json, "print results.json, and nothing else, on stdout");
  add_sandbox_flag(*command, o->sandbox);
  command->callback([=, &exit_code] {
    if (!earlier.empty()) note_earlier(earlier, "tripoint merge");
    exit_code = guarded([&] { return merge(*o); });
  });
}

void add_merge(CLI::App& app, int& exit_code) { add_merge_to(app, exit_code, ""); }

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

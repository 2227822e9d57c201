// SPDX-License-Identifier: BSD-3-Clause
#include "validation/publish/report_files.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include "core/durable_file.hpp"
#include "tables/library.hpp"
#include "validation/baseline/history.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/rows.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/process.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr double report_limit = 900.0;  // [s]

}  // namespace

std::string python_program() {
  const char* named = std::getenv("TRIPOINT_PYTHON");
  return named && *named ? named : "/usr/bin/python3";
}

namespace {

std::string make_page(const fs::path& results, const std::string& history, bool pdf) {
  const fs::path program = fs::path(share_folder()) / "reports" / "report.py";
  if (!fs::exists(program)) return "the report program " + program.string() + " is missing";
  ProcessSpec spec;
  spec.argv = {python_program(), program.string(), results.string()};
  if (pdf) spec.argv.push_back("--pdf");
  spec.wall_limit = report_limit;
  spec.outlives_interrupt = true;
  spec.log = (results.parent_path() / "report.log").string();
  const auto end = run_process(sandboxed_report(spec, results.parent_path().string(), history));
  if (end.how == ProcessEnd::How::exited && end.code == 0 && fs::exists(results.parent_path() / "index.html"))
    return {};
  return fmt::format("the report program {}: {}", describe(end), end.log_tail);
}

/// Removes old pages, so that none stands for new results.
void remove_pages(const fs::path& out) {
  std::error_code none;
  for (const char* page : {"index.html", "signable.html", "report.pdf"}) fs::remove(out / page, none);
  if (fs::is_symlink(out / "case", none)) return;  // the link's target is not ours
  for (const auto& page : fs::directory_iterator(out / "case", none))
    if (page.path().extension() == ".html") fs::remove(page.path(), none);
}

}  // namespace

void write_results(const Results& results, const std::string& folder) {
  fs::create_directories(folder);
  const fs::path out = fs::absolute(folder);
  write_durably((out / "results.json").string(), results_text(results));
  write_durably((out / "junit.xml").string(), junit_text(results));
  write_durably((out / "summary.md").string(), summary_text(results));
  remove_pages(out);
}

std::string write_report(const Results& results, const std::string& folder, bool pdf) {
  write_results(results, folder);
  const fs::path file = fs::absolute(folder) / "results.json";
  return make_page(file, history_file(results, file.string()), pdf);
}

void set_aside_report(const std::string& folder) {
  const fs::path out(folder);
  std::error_code none;
  if (fs::exists(out / "results.json", none)) fs::rename(out / "results.json", out / "results.previous.json");
  const fs::path previous = out / "previous";
  fs::remove_all(previous, none);
  fs::create_directory(previous, none);
  for (const char* made : {"junit.xml", "summary.md", "scorecard.json", "scorecard.md", "scorecard.html",
                           "index.html", "signable.html", "report.pdf", "case"})
    if (!fs::is_symlink(out / made, none)) fs::rename(out / made, previous / made, none);
  fs::remove(previous, none);  // where there was nothing to set aside
  remove_pages(out);
}

namespace {

/// The first cases that are not green, once more at the end: a long suite has scrolled them away.
std::string again(const Results& results) {
  constexpr int most = 10;
  std::string text;
  int count = 0;
  for (const auto& c : results.cases)
    if (c.exit_code != exit_pass && ++count <= most) text += case_line(c) + "\n";
  if (count > most) text += fmt::format("and {} more cases that are not green: summary.md\n", count - most);
  return text.empty() ? text : "not green:\n" + text;
}

}  // namespace

std::string notes_text(const Results& results) {
  std::string text;
  if (results.cases.size() > 1) text += again(results);
  for (const auto& p : results.problems) text += "problem: " + one_line(p) + "\n";
  std::map<std::string, int> missing, unjudged;
  for (const auto& c : results.cases) {
    std::set<std::string> absent;  // each once a case, however many presets it has
    for (const auto& e : c.engines) {
      if (e.status == Status::missing && absent.insert(e.name).second) ++missing[e.name];
      if (is_unjudged(e)) ++unjudged[label_of(e.name, e.preset)];
    }
  }
  const auto list = [&](const char* what, const std::map<std::string, int>& rows) {
    std::string names;
    for (const auto& [name, count] : rows)
      names +=
          fmt::format("{}{} in {} case{}", names.empty() ? "" : ", ", name, count, count == 1 ? "" : "s");
    if (!names.empty()) text += fmt::format("{}: {}\n", what, one_line(names));
  };
  list("missing", missing);
  list("not judged", unjudged);
  return text;
}

std::string last_line(const Results& results, const std::string& folder) {
  return fmt::format("verdict {} exit {}  {}", results.verdict, results.exit_code,
                     one_line((fs::path(folder) /
                               (fs::exists(fs::path(folder) / "index.html") ? "index.html" : "results.json"))
                                  .string()));
}

}  // namespace tripoint

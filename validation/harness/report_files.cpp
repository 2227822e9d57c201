// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/report_files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "core/durable_file.hpp"
#include "scene/read_case.hpp"
#include "validation/harness/process.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr double report_limit = 900.0;  // [s]

std::string make_page(const fs::path& results, bool pdf) {
  const fs::path program = fs::path(share_folder()) / "reports" / "report.py";
  if (!fs::exists(program)) return "the report program " + program.string() + " is missing";
  ProcessSpec spec;
  spec.argv = {"/usr/bin/python3", program.string(), results.string()};
  if (pdf) spec.argv.push_back("--pdf");
  spec.wall_limit = report_limit;
  spec.log = (results.parent_path() / "report.log").string();
  const auto end = run_process(spec);
  if (end.how == ProcessEnd::How::exited && end.code == 0 && fs::exists(results.parent_path() / "index.html")) return {};
  return fmt::format("the report program {}: {}", describe(end), end.log_tail);
}

}  // namespace

std::string write_report(const Results& results, const std::string& folder, bool pdf) {
  fs::create_directories(folder);
  const fs::path out = fs::absolute(folder);
  write_durably((out / "results.json").string(), results_text(results));
  write_durably((out / "junit.xml").string(), junit_text(results));
  write_durably((out / "summary.md").string(), summary_text(results));
  fs::remove(out / "index.html");  // an old page must not stand for new results
  return make_page(out / "results.json", pdf);
}

std::string last_line(const Results& results, const std::string& folder) {
  return fmt::format("verdict {} exit {}  {}", results.verdict, results.exit_code, (fs::path(folder) / "index.html").string());
}

}  // namespace tripoint

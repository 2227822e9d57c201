// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <CLI/CLI.hpp>
#include <cstring>
#include <filesystem>
#include <memory>

#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "scene/library.hpp"
#include "validation/harness/report_files.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

constexpr const char* description =
    "Writes one page that shows the particles of a run in three dimensions, in any browser and without a network.\n"
    "  tripoint view runs/paper/fig-14-coated/tripoint              view.html in the run's folder: turn it, play it, colour it\n"
    "  tripoint view paper/fig-14-coated --out look.html            the run that `tripoint run` left in runs/, into a file of "
    "your own\n"
    "  tripoint view report/runs/rigid/ballistic/tripoint/corrected report/runs/rigid/ballistic/bullet/base --out beside.html\n"
    "                                                               several runs, with one camera and one time\n"
    "In the page: a slider of time, colour by phase, temperature, speed, pressure, body or material, walls on and off; every key "
    "is named there.\n"
    "Gravity points down. A run that is too large for the page loses frames first, then particles, and the page says so "
    "(--limit).\n"
    "docs/surface.md says more. For a picture of the surface: tripoint render. For other programs: tripoint export.\n"
    "Exit: 0 written, 2 bad input, 4 a dataset, a library or room on the disk is missing, 130 Ctrl-C.";

struct ViewOptions {
  std::vector<std::string> runs;
  std::string out;
  double limit = 10.0;  // [MB]
};

/// Becomes the program of the reports, which also takes Ctrl-C then. @throws EngineError where there is no such program
int hand_over(const ViewOptions& o) {
  const fs::path program = fs::path(share_folder()) / "reports" / "view.py";
  if (!fs::exists(program)) throw EngineError("the program of the page, " + program.string() + ", is missing");
  std::vector<std::string> words{python_program(), "-B", program.string(), fmt::format("--limit={}", o.limit)};
  if (!o.out.empty()) words.push_back("--out=" + o.out);
  words.emplace_back("--");
  words.insert(words.end(), o.runs.begin(), o.runs.end());
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(words.front().c_str(), pointers.data());
  throw EngineError(fmt::format("{} cannot be started: {}", words.front(), std::strerror(errno)));
}

}  // namespace

void add_view(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("view", description);
  auto o = std::make_shared<ViewOptions>();
  command
      ->add_option("RUN", o->runs, "folders of runs, their trajectory.h5, or ids of cases that have a run in runs/; at most six")
      ->required();
  command->add_option("--out", o->out, "the page (default: view.html in the folder of the first run)")->type_name("FILE");
  command->add_option("--limit", o->limit, "greatest size of the page in MB")
      ->capture_default_str()
      ->type_name("MB")
      ->check(CLI::Range(1.0, 500.0));
  command->callback([o, &exit_code] { exit_code = guarded([&] { return hand_over(*o); }); });
}

}  // namespace tripoint

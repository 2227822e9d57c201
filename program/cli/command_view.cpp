// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"

namespace tripoint {
namespace {

constexpr const char* view_description =
    "Writes one page that shows the particles of a run in three dimensions, in any browser and without a\n"
    "network.\n"
    "  tripoint view runs/paper/fig-14-coated/tripoint              view.html in the run's folder: "
    "turn it, play it, colour it\n"
    "  tripoint view paper/fig-14-coated --out look.html            the run that `tripoint run` "
    "left in runs/, into a file of your own\n"
    "  tripoint view report/runs/rigid/ballistic/tripoint/corrected "
    "report/runs/rigid/ballistic/bullet/base --out beside.html\n"
    "                                                               several runs, with one camera "
    "and one time\n"
    "The page has a slider of time, colours by phase, temperature, speed, pressure, body or material, and\n"
    "walls on and off. It names its keys. Gravity points down. A run that is too large for the page loses\n"
    "frames first, then particles, and the page says so (--limit). docs/surface.md says more. For a\n"
    "picture of the surface: tripoint render. For other programs: tripoint export.\n"
    "Exit: 0 written, 2 bad input, 4 a dataset, a library or disk space is missing, 130 Ctrl-C.";

struct ViewOptions {
  std::vector<std::string> runs;
  std::string out;
  double limit = 10.0;  // [MB]
};

[[noreturn]] void write_page(const ViewOptions& o) {
  std::vector<std::string> options{fmt::format("--limit={}", o.limit)};
  if (!o.out.empty()) options.push_back("--out=" + o.out);
  hand_over("view.py", options, o.runs);
}

}  // namespace

void add_view(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("view", view_description);
  auto o = std::make_shared<ViewOptions>();
  command
      ->add_option(
          "RUN", o->runs,
          "folders of runs, their trajectory.h5, or ids of cases that have a run in runs/; at most six")
      ->required();
  command->add_option("--out", o->out, "the page (default: view.html in the folder of the first run)")
      ->type_name("FILE");
  command->add_option("--limit", o->limit, "greatest size of the page in MB")
      ->capture_default_str()
      ->type_name("MB")
      ->check(CLI::Range(1.0, 500.0));
  command->callback([o, &exit_code] { exit_code = guarded([&]() -> int { write_page(*o); }); });
}

}  // namespace tripoint

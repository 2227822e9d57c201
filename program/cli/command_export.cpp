// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <memory>

#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/options.hpp"

namespace tripoint {
namespace {

constexpr const char* export_description =
    "Writes a run for other programs, or the numbers of a report for a paper. docs/trajectory.md says\n"
    "which program reads which file.\n"
    "  tripoint export runs/rigid/ballistic/tripoint --to vtp                     frames.pvd for "
    "ParaView and PyVista\n"
    "  tripoint export runs/rigid/ballistic/tripoint --to xyz,lammps --out files  OVITO, ASE; only "
    "of particles that are alive\n"
    "  tripoint export runs/rigid/ballistic/tripoint --to csv --frames 0:100:10   poses of bodies, "
    "energies\n"
    "  tripoint export report/results.json --to csv,latex,pdf                     tables and "
    "figures at print size\n"
    "Of a run: vtp, xdmf, h5md, lammps, xyz, ply, obj, csv, paraview. Of a results.json: csv, latex, pdf.\n"
    "Numbers are copied: SI, every digit.\n"
    "Exit: 0 written, 2 bad input, 4 a dataset, a library or disk space is missing, 130 Ctrl-C.";

struct ExportOptions {
  std::string what, out, frames = "all";
  std::vector<std::string> to;
  bool json = false;
};

[[noreturn]] void write_files(const ExportOptions& o) {
  std::vector<std::string> options{"--frames=" + o.frames};
  for (const auto& format : o.to) options.push_back("--to=" + format);
  if (!o.out.empty()) options.push_back("--out=" + o.out);
  if (o.json) options.emplace_back("--json");
  hand_over("export.py", options, {o.what});
}

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("export", export_description);
  auto o = std::make_shared<ExportOptions>();
  command->add_option("RUN|RESULTS", o->what, "folder of a run, or a results.json")->required();
  command->add_option("--to", o->to, "formats, with commas between them; may be repeated")
      ->type_name("FORMAT")
      ->take_all()
      ->allow_extra_args(false);
  for (const char* format : {"csv", "latex", "pdf", "vtp", "xyz", "lammps", "ply", "obj"})
    add_earlier_flag(*command, std::string("--") + format, std::string("--to ") + format,
                     [o, format] { o->to.emplace_back(format); });
  command->add_option("--out", o->out,
                      "folder of the files (default: `export` in the folder of the run or report)");
  command->add_option("--frames", o->frames, "all, last, a number, or FROM:TO:STEP")->capture_default_str();
  command->add_flag("--json", o->json, "print one JSON document with the names of the files");
  command->callback([o, &exit_code] { exit_code = guarded([&]() -> int { write_files(*o); }); });
}

}  // namespace tripoint

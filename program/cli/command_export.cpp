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
    "Writes a run for other programs, or the numbers of a report for a paper. docs/trajectory.md says which program reads which "
    "file.\n"
    "  tripoint export runs/rigid/ballistic/tripoint --to vtp                     frames.pvd for ParaView and PyVista\n"
    "  tripoint export runs/rigid/ballistic/tripoint --to xyz,lammps --out files  OVITO, ASE; only of particles that are alive\n"
    "  tripoint export runs/rigid/ballistic/tripoint --to csv --frames 0:100:10   poses of bodies, energies\n"
    "  tripoint export report/results.json --csv --latex --pdf                    tables and figures at print size\n"
    "Of a run: vtp, xdmf, h5md, lammps, xyz, ply, obj, csv, paraview. Of a results.json: csv, latex, pdf. Numbers are copied: "
    "SI, every digit.\n"
    "Exit: 0 written, 2 bad input, 4 a dataset, a library or room on the disk is missing, 130 Ctrl-C.";

struct ExportOptions {
  std::string what, out, frames = "all";
  std::vector<std::string> to;
  bool json = false;
};

/// Becomes the program of the reports, which also takes Ctrl-C then. @throws EngineError where there is no such program
int hand_over(const ExportOptions& o) {
  const fs::path program = fs::path(share_folder()) / "reports" / "export.py";
  if (!fs::exists(program)) throw EngineError("the export program " + program.string() + " is missing");
  std::vector<std::string> words{python_program(), "-B", program.string(), "--frames=" + o.frames};
  for (const auto& format : o.to) words.push_back("--to=" + format);
  if (!o.out.empty()) words.push_back("--out=" + o.out);
  if (o.json) words.emplace_back("--json");
  words.insert(words.end(), {"--", o.what});
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(words.front().c_str(), pointers.data());
  throw EngineError(fmt::format("{} cannot be started: {}", words.front(), std::strerror(errno)));
}

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("export", description);
  auto o = std::make_shared<ExportOptions>();
  command->add_option("RUN|RESULTS", o->what, "folder of a run, or a results.json")->required();
  command->add_option("--to", o->to, "formats, with commas between them; may be repeated")
      ->type_name("FORMAT")
      ->take_all()
      ->allow_extra_args(false);
  for (const char* format : {"csv", "latex", "pdf", "vtp", "xyz", "lammps", "ply", "obj"})
    command->add_flag_callback(
        std::string("--") + format, [o, format] { o->to.emplace_back(format); }, std::string("the same as --to ") + format);
  command->add_option("--out", o->out, "folder of the files (default: `export` in the folder of the run or report)");
  command->add_option("--frames", o->frames, "all, last, a number, or FROM:TO:STEP")->capture_default_str();
  command->add_flag("--json", o->json, "print one JSON document with the names of the files");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return hand_over(*o); }); });
}

}  // namespace tripoint

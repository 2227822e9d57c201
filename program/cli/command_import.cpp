// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <CLI/CLI.hpp>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <sstream>

#include "core/errors.hpp"
#include "files/foreign_file.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "tables/library.hpp"
#include "tables/nearest.hpp"
#include "tables/other_formats.hpp"
#include "validation/references/measured_table.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* import_description =
    "Makes a case file of a model in MJCF or URDF, or reference data of a measured table.\n"
    "Of a model it takes bodies, shapes, masses, places, velocities, joints, gravity and friction.\n"
    "MuJoCo's own parser reads it (tripoint engine install mujoco). It prints all that is left out, in a\n"
    "comment of the file too. Meshes are written beside it.\n"
    "A table may have tabs, semicolons, decimal commas, a title, units in its header, or no header.\n"
    "  tripoint import scene.xml                      writes scene.toml; a file that exists stays\n"
    "  tripoint import arm.urdf --joints lock         bodies that joints connect are one\n"
    "  tripoint import front.csv --source 'report 12' --uncertainty front='2 %'   writes front.ref.csv\n"
    "  tripoint import points.csv --columns time,front --unit time=s --unit front=mm ...\n"
    "Exit: 0 written, 2 the file is refused, 4 MuJoCo is not installed.";

struct ImportChoices {
  std::string file, out;
  std::string end, spacing, key, base, joints;  ///< of models, in the importer's words
  TableWords table;
};

/// Hands over to the importer, which takes this process's place. @return only when it could not be started
int import_model(const ImportChoices& choices) {
  std::error_code error;
  const std::string script = (fs::path(share_folder()) / "vendors" / "import_scene.py").string();
  const std::string program = fs::read_symlink("/proc/self/exe", error).string();
  std::vector<std::string> words{"/usr/bin/python3", "-B", script, choices.file, "--program", program};
  const std::pair<const char*, const std::string*> options[] = {
      {"--out", &choices.out}, {"--end", &choices.end},   {"--spacing", &choices.spacing},
      {"--key", &choices.key}, {"--base", &choices.base}, {"--joints", &choices.joints}};
  for (const auto& [option, value] : options)
    if (!value->empty()) words.insert(words.end(), {option, *value});
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv(argv.front(), argv.data());
  throw EngineError(fmt::format("{} {}: {}", argv.front(), script, std::strerror(errno)));
}

int import_table(const ImportChoices& choices, const std::string& text) {
  const std::string out =
      choices.out.empty() ? fs::path(choices.file).replace_extension(".ref.csv").string() : choices.out;
  write_new_file(out, reference_table(choices.file, text, choices.table), "choose another by --out");
  print_line(fmt::format("wrote {}", out));
  say(fmt::format("next: reference = {{ kind = \"experiment\", function = \"table\", file = \"{}\" }}",
                  fs::path(out).filename().string()));
  return 0;
}

/// NAME=VALUE, repeated.
std::map<std::string, std::string> named(const std::vector<std::string>& words, const char* option) {
  std::map<std::string, std::string> values;
  for (const auto& word : words) {
    const auto at = word.find('=');
    if (at == std::string::npos || at == 0)
      throw InputError(fmt::format("{} {}: write COLUMN=VALUE", option, printable(word)));
    values[word.substr(0, at)] = word.substr(at + 1);
  }
  return values;
}

int import(const ImportChoices& choices) {
  constexpr std::uintmax_t most = 64U << 20U;  // [bytes]
  const std::string text = text_of_regular_file(choices.file, most), format = other_format(text);
  const bool model = format.find("MJCF") != format.npos || format.find("URDF") != format.npos;
  if (model) return import_model(choices);
  if (!format.empty())
    throw InputError(
        {choices.file, 0, 0},
        fmt::format("this is {}: models in MJCF and URDF and tables of numbers are read", format));
  return import_table(choices, text);
}

}  // namespace

void add_import(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("import", import_description);
  auto choices = std::make_shared<ImportChoices>();
  auto units = std::make_shared<std::vector<std::string>>(),
       uncertainties = std::make_shared<std::vector<std::string>>();
  command->add_option("FILE", choices->file, "model in MJCF or URDF, or table of measured values")
      ->required();
  command->add_option("--out", choices->out, "path of the file that is written");
  command->add_option("--end", choices->end, "model: end time [s], default 1")->check(CLI::PositiveNumber);
  command
      ->add_option("--spacing", choices->spacing,
                   "model: particle spacing [m], default a quarter of the thinnest body")
      ->check(CLI::PositiveNumber);
  command->add_option("--key", choices->key,
                      "model: keyframe of the start, default the first; none: the model's own start");
  command->add_option("--base", choices->base, "model: the base link of a URDF is free (default) or fixed")
      ->check(CLI::IsMember({"free", "fixed"}));
  command
      ->add_option(
          "--joints", choices->joints,
          "model: keep (default), free leaves joints out, lock makes one body of those that they connect")
      ->check(CLI::IsMember({"keep", "free", "lock"}));
  command->add_option("--columns", choices->table.columns, "table: names of its columns, as time,front")
      ->delimiter(',');
  command->add_option("--source", choices->table.source, "table: where it comes from");
  command->add_option("--unit", *units, "table: unit of a column, as front=mm; may be repeated");
  command->add_option("--uncertainty", *uncertainties,
                      "table: standard uncertainty of a column, as front='2 %' or, in its unit, front=0.5");
  command->callback([=, &exit_code] {
    exit_code = guarded([&] {
      choices->table.units = named(*units, "--unit");
      choices->table.uncertainties = named(*uncertainties, "--uncertainty");
      return import(*choices);
    });
  });
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "tables/nearest.hpp"
#include "validation/case/schema.hpp"

namespace tripoint {
namespace {

constexpr const char* new_description =
    "Writes a new case file that runs as it is: one steel block in free flight, judged against the exact\n"
    "solution. Change it from there; a file that exists is never overwritten.\n"
    "  tripoint new my-case        writes my-case.toml\n"
    "  tripoint new my-case --from tank    writes a scene of that kind: tank dam float melt pour "
    "ramp stack drop beam heat\n"
    "  tripoint run my-case.toml";

int create(const std::string& name, const std::string& from) {
  namespace fs = std::filesystem;
  fs::path path = name;
  if (path.extension() != ".toml") path += ".toml";
  const auto stem = path.stem().string();
  if (stem.empty() ||
      stem.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-.") !=
          std::string::npos)
    throw InputError(
        fmt::format("`{}` is no name for a case: use letters, digits, or any of _ - .", printable(stem)));
  std::error_code error;
  const auto folder = fs::absolute(path, error).parent_path();
  if (!fs::is_directory(folder, error))
    throw InputError({path.string(), 0, 0}, "its folder does not exist: make it first");
  const auto text = from.empty() ? new_case_text("my/" + stem) : new_case_text("my/" + stem, from);
  write_new_file(path.string(), text, "choose another name");
  print_line(fmt::format("wrote {}", path.string()));
  say(fmt::format("next: tripoint explain {0}; tripoint run {0}", path.string()));
  return 0;
}

}  // namespace

void add_new(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("new", new_description);
  auto name = std::make_shared<std::string>();
  command->add_option("NAME", *name, "name or path of the new case file")->required();
  auto from = std::make_shared<std::string>();
  command->add_option("--from", *from, "kind of scene: tank dam float melt pour ramp stack drop beam heat");
  command->callback([=, &exit_code] { exit_code = guarded([&] { return create(*name, *from); }); });
}

}  // namespace tripoint

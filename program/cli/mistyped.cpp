// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <filesystem>

#include "program/cli/common.hpp"
#include "tables/nearest.hpp"

namespace tripoint {
namespace {

/// The subcommand of this name, or nullptr.
const CLI::App* below(const CLI::App& app, const std::string& name) {
  for (const auto* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    if (sub->get_name() == name) return sub;
  return nullptr;
}

std::vector<std::string> verbs_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(sub->get_name());
  return names;
}

/// Long options of a command, without their dashes.
std::vector<std::string> options_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const auto* option : app.get_options())
    for (const auto& name : option->get_lnames()) names.push_back(name);
  return names;
}

/// The first word that looks like an option, is none, and is near one.
std::string mistyped_option(const CLI::App& command, int argc, char** argv) {
  const auto known = options_of(command);
  for (int i = 2; i < argc && std::string_view(argv[i]) != "--"; ++i) {
    const std::string word = argv[i];
    if (!word.starts_with("--") || word.find(' ') < word.find('=')) continue;
    const std::string option = word.substr(2, word.find('=') - 2);
    if (std::find(known.begin(), known.end(), option) != known.end()) continue;
    const auto near = nearest(option, known);
    if (!near.empty())
      return fmt::format("{} has no option --{} (did you mean `--{}`?)", command.get_name(),
                         printable(option), near);
  }
  return "";
}

}  // namespace

std::string mistyped_word(const CLI::App& app, int argc, char** argv) {
  if (argc < 2) return "name a command:\n\n" + app.help();
  const std::string verb = argv[1];
  if (verb.starts_with("-")) return "";
  const auto* command = below(app, verb);
  if (!command) {
    const auto near = nearest(verb, verbs_of(app));
    return fmt::format("no command is named {} ({})", printable(verb),
                       near.empty() ? "tripoint --help lists them" : "did you mean `" + near + "`?");
  }
  const std::string second = argc > 2 ? argv[2] : "";
  if (const auto* sub = below(*command, second)) return mistyped_option(*sub, argc, argv);
  const bool is_word =
      !second.empty() && second.find_first_of("-./") == std::string::npos && !std::filesystem::exists(second);
  const auto near = is_word ? nearest(second, verbs_of(*command)) : "";
  if (!near.empty())
    return fmt::format("{}: no command is named {} (did you mean `{} {}`?)", verb, printable(second), verb,
                       near);
  return mistyped_option(*command, argc, argv);
}

}  // namespace tripoint

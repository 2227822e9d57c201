// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <CLI/CLI.hpp>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/options.hpp"
#include "tables/library.hpp"
#include "validation/run/discover.hpp"
#include "validation/run/engine_check.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* engines_description =
    "Lists the engines: every engine-* beside the program (libexec/tripoint) and in the folders of\n"
    "TRIPOINT_ENGINE_PATH. Each has its version, library and capabilities, or the reason why it cannot\n"
    "start.\n"
    "  tripoint engines            a table\n"
    "  tripoint engines --json     one JSON document";

constexpr const char* engine_description =
    "Makes, checks and installs engines. An engine is any executable that answers --info, --check JOB and\n"
    "--run JOB (docs/engines.md).\n"
    "  tripoint engine new my-engine --lang python\n"
    "  tripoint engine check ./my-engine/engine-my-engine\n"
    "  tripoint engine install mujoco";

constexpr const char* install_description =
    "Fetches a pinned release of an engine, checks its SHA-256, and unpacks it into an environment of its\n"
    "own. The environment is in .venv-engines of the checkout, or in the folder TRIPOINT_ENGINES. Size\n"
    "and licence are said first. Earlier downloads are used again.\n"
    "  tripoint engine install mujoco              the release that the project's cases know, after "
    "a question\n"
    "  tripoint engine install mujoco@3.3.7 --yes  another release; the name mujoco means it from "
    "now on\n"
    "Exit: 0 installed, 2 unknown name or version, or nobody agreed, 4 it could not be fetched or does\n"
    "not start.";

std::string short_list(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

int list(bool json) {
  const auto engines = discover_engines();
  if (json) {
    print(engines_json(engines) + "\n");
    return 0;
  }
  for (const auto& e : engines) {
    print_line(fmt::format("{:14} {}", e.name, e.available ? e.version : "missing: " + e.reason));
    if (!e.available) continue;
    print_line("               can: " + short_list(e.capabilities));
    print_line("               presets: " + short_list(e.presets));
    if (!e.library_path.empty())
      print_line(fmt::format("               library: {} ({})", e.library_path, e.library_hash));
  }
  return 0;
}

std::string filled(std::string text, const std::string& name) {
  for (auto at = text.find("@NAME@"); at != std::string::npos; at = text.find("@NAME@", at + name.size()))
    text.replace(at, 6, name);
  return text;
}

void check_name(const std::string& name) {
  const bool good = !name.empty() &&
                    name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-") == std::string::npos &&
                    name.front() != '-';
  if (!good)
    throw InputError("engine new " + name +
                     ": a name is of small letters, digits and dashes, for example my-engine");
}

/// Copies the template of a language: file by file, with the name filled into contents and file names.
int make_new(const std::string& name, const std::string& language) {
  check_name(name);
  const fs::path from = fs::path(share_folder()) / "templates" / language;
  if (!fs::is_directory(from)) throw InputError(from.string() + ": there is no template for " + language);
  if (fs::exists(name)) throw InputError(name + ": exists already");
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    if (!entry.is_regular_file()) continue;
    const fs::path to = fs::path(name) / filled(fs::relative(entry.path(), from).string(), name);
    fs::create_directories(to.parent_path());
    std::ifstream in(entry.path());
    std::ostringstream text;
    text << in.rdbuf();
    std::ofstream(to) << filled(text.str(), name);
    fs::permissions(to, entry.status().permissions());
    print(to.string() + "\n");
  }
  if (language == "cpp")
    say(fmt::format(
        "next: cmake -S {0} -B {0}/build && cmake --build {0}/build && tripoint engine check {0}/engine-{0}",
        name));
  else
    say(fmt::format("next: tripoint engine check {0}/engine-{0}", name));
  return 0;
}

/// Hands over to the installer, which asks on the terminal: it takes this process's place. @return only when
/// it could not be started
int install(const std::string& words, bool yes) {
  const std::string program = (fs::path(share_folder()) / "vendors" / "install.py").string();
  std::vector<const char*> argv{"/usr/bin/python3", "-B", program.c_str(), words.c_str()};
  if (yes) argv.push_back("--yes");
  argv.push_back(nullptr);
  ::execv(argv.front(), const_cast<char* const*>(argv.data()));
  throw EngineError(fmt::format("{} {}: {}", argv.front(), program, std::strerror(errno)));
}

/// A path, or the name of an engine that `tripoint engines` lists.
std::string executable_of(const std::string& word) {
  if (word.find('/') != std::string::npos || std::filesystem::exists(word)) return word;
  const auto found = discover_engines_named({word});
  const EngineEntry* engine = find_engine(found, word);
  if (!engine)
    throw InputError(word + ": is neither a file nor an engine that is known here: tripoint engines");
  if (!engine->available) throw InputError(word + ": " + engine->reason);
  return engine->executable;
}

int check(const std::string& word, bool sandbox) {
  if (sandbox) sandbox_third_parties("");
  bool good = true;
  for (const auto& c : check_engine(executable_of(word))) {
    print_line(
        fmt::format("{}  {}{}", c.passed ? "ok   " : "FAILS", c.what, c.found.empty() ? "" : ": " + c.found));
    good = good && c.passed;
  }
  return good ? 0 : 1;
}

/// `tripoint engine list`, which many type for `tripoint engines`.
void add_list_to(CLI::App& engine, int& exit_code) {
  auto* command = engine.add_subcommand("list", engines_description)->group("");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print one JSON document");
  command->callback([=, &exit_code] {
    note_earlier("tripoint engine list", "tripoint engines");
    exit_code = guarded([&] { return list(*json); });
  });
}

}  // namespace

void add_engines(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("engines", engines_description);
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "print one JSON document");
  command->callback([=, &exit_code] { exit_code = guarded([&] { return list(*json); }); });
}

void add_engine(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("engine", engine_description);
  list_when_alone(*command, exit_code);
  auto name = std::make_shared<std::string>(), language = std::make_shared<std::string>("python"),
       path = std::make_shared<std::string>();
  auto* made = command->add_subcommand(
      "new",
      "Copies a working engine to start from into the folder NAME.\n  tripoint engine new my-engine "
      "--lang python\nIt flies single bodies through the ballistic case as it stands.");
  made->add_option("NAME", *name, "small letters, digits and dashes")->required();
  made->add_option("--lang", *language, "language of the template")
      ->check(CLI::IsMember({"python", "cpp"}))
      ->capture_default_str();
  made->callback([=, &exit_code] { exit_code = guarded([&] { return make_new(*name, *language); }); });
  auto* checked =
      command->add_subcommand("check",
                              "Tests an engine against the contract: answers, jobs good and broken, results, "
                              "times, ids, repeatability.\n  tripoint "
                              "engine check bullet\n  tripoint engine check my-engine/engine-my-engine\nExit "
                              "0 when every check holds, 1 otherwise.");
  checked->add_option("PATH|NAME", *path, "the engine's executable, or the name of one that is known")
      ->required();
  auto sandbox = std::make_shared<bool>(false);
  add_sandbox_flag(*checked, *sandbox);
  checked->callback([=, &exit_code] { exit_code = guarded([&] { return check(*path, *sandbox); }); });
  add_list_to(*command, exit_code);
  auto yes = std::make_shared<bool>(false);
  auto* installed = command->add_subcommand("install", install_description);
  installed->add_option("NAME[@VERSION]", *name, "an engine that `tripoint engines` lists as not installed")
      ->required();
  installed->add_flag("--yes", *yes, "agree to size and licence; needed where there is no terminal");
  installed->callback([=, &exit_code] { exit_code = guarded([&] { return install(*name, *yes); }); });
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <sstream>

#include "core/durable_file.hpp"
#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/one_case.hpp"
#include "tables/library.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/read_case.hpp"
#include "validation/publish/releases.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/process.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* releases_description =
    "Runs a case on several releases of an engine, each in its own environment. It prints error and\n"
    "observed order by release, which says whether you can upgrade.\n"
    "  tripoint releases mujoco --versions 2.3.7,3.3.7,3.7.0,3.10.0,3.17.0,4.0.0 rigid/torque-free\n"
    "  tripoint releases my-engine --versions ./old/engine-mine,./new/engine-mine rigid/ballistic\n"
    "A version is one that `tripoint engine install NAME@VERSION` knows, or the path of an executable;\n"
    "oldest first. Without --versions all pinned ones are taken. A missing one is installed, after --yes.\n"
    "OUT holds releases.json, releases.md and index.html.\n"
    "Exit: 0 the last release is not worse than the\n"
    "first beyond the margin, 1 it is, 2 bad input, 4 a release cannot be installed or run.";

constexpr double install_limit = 3600.0;  // [s]
constexpr double page_limit = 120.0;      // [s]

struct ReleasesOptions {
  std::string engine, what, versions, presets, out = "releases";
  std::vector<double> levels;
  double margin = 1.5;
  int jobs = 1;
  bool yes = false;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

/// The installer's answer. @throws InputError, EngineError with its message
std::vector<std::string> ask_installer(const std::vector<std::string>& words) {
  ProcessSpec spec;
  spec.argv = {"/usr/bin/python3", "-B", (fs::path(share_folder()) / "vendors" / "install.py").string()};
  spec.argv.insert(spec.argv.end(), words.begin(), words.end());
  spec.wall_limit = install_limit;
  const auto end = run_process(spec);
  if (end.how == ProcessEnd::How::exited && end.code == 0) return lines_of(end.output);
  if (end.how == ProcessEnd::How::exited && end.code == 2) throw InputError(end.log_tail);
  throw EngineError(end.log_tail.empty() ? "the installer " + describe(end) : end.log_tail);
}

std::vector<std::string> versions_of(const ReleasesOptions& o) {
  auto versions = o.versions.empty() ? ask_installer({o.engine, "--versions"}) : split(o.versions);
  if (versions.size() < 2) throw InputError("releases: name two versions or more, oldest first");
  return versions;
}

EngineEntry release_of(const ReleasesOptions& o, const std::string& version) {
  std::string path = version;
  if (version.find('/') == std::string::npos) {
    std::vector<std::string> words{o.engine + "@" + version, "--keep"};
    if (o.yes) words.push_back("--yes");
    path = ask_installer(words).front();
  }
  if (!fs::exists(path)) throw InputError(path + ": is no version and no executable");
  auto engine = ask_engine(fs::absolute(path).string());
  if (!engine.available) throw EngineError(path + ": " + engine.reason);
  return engine;
}

Release run_release(const ReleasesOptions& o, const Case& value, const EngineEntry& engine) {
  SuiteOptions options;
  options.selection.engines = {engine.name};
  options.out = (fs::path(o.out) / (engine.name + "-" + engine.version)).string();
  options.jobs = o.jobs;
  options.say = [](const std::string& line) { say(line); };
  const auto results =
      run_suite({case_for_releases(value, engine, split(o.presets), o.levels)}, {engine}, options);
  if (results.cases.empty()) throw EngineError("stopped");
  return {engine, results.cases.front()};
}

void write_page(const fs::path& out) {
  ProcessSpec spec;
  spec.argv = {"/usr/bin/python3", (fs::path(share_folder()) / "reports" / "releases.py").string(),
               (out / "releases.json").string()};
  spec.wall_limit = page_limit;
  const auto end = run_process(spec);
  if (end.how != ProcessEnd::How::exited || end.code != 0) say("tripoint: no page: " + end.log_tail);
}

int releases(const ReleasesOptions& o) {
  const auto value = one_case(o.what);
  catch_interrupts();
  const auto lock = hold_folder(o.out);
  ReleaseTable table{value.id, value.title, command_line(), o.margin, {}};
  for (const auto& version : versions_of(o))
    table.releases.push_back(run_release(o, value, release_of(o, version)));
  write_durably((fs::path(o.out) / "releases.json").string(), releases_text(table));
  write_durably((fs::path(o.out) / "releases.md").string(), releases_markdown(table));
  write_page(o.out);
  print(releases_markdown(table));
  for (const auto& r : table.releases)
    for (const auto& e : r.result.engines)
      if (e.status != Status::ok)
        say(fmt::format("{} {} ({}) {}: {}", e.name, r.engine.version, e.preset, e.status, e.reason));
  return is_worse(table) ? exit_fail : exit_pass;
}

}  // namespace

void add_releases(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("releases", releases_description);
  auto o = std::make_shared<ReleasesOptions>();
  command->add_option("ENGINE", o->engine, "name of the engine")->required();
  command->add_option("CASE", o->what, "a case file or id")->required();
  command->add_option("--versions", o->versions, "A,B,C: versions or paths of executables, oldest first");
  command->add_option("--presets", o->presets, "A,B (default: those of the case, else all of the engine)");
  command
      ->add_option("--levels", o->levels,
                   "time steps a,b,c, coarse to fine [s] (default: the case's study of the engine, else 2, "
                   "1, 1/2, 1/4 of its own step)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--margin", o->margin, "an error may differ by this factor before it counts as changed")
      ->check(CLI::Range(1.0, 1e6))
      ->capture_default_str();
  command->add_option("--out", o->out, "folder of the table and the runs")->capture_default_str();
  command->add_option("--jobs", o->jobs, "engine processes at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--yes", o->yes, "install what is not installed");
  command->callback([o, &exit_code] { exit_code = guarded([&] { return releases(*o); }); });
}

}  // namespace tripoint

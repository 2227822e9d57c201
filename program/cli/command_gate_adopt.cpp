// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

#include "core/durable_file.hpp"
#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "validation/baseline/baseline.hpp"
#include "validation/campaign/suite.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/case/read_case.hpp"
#include "validation/judge/apply_gate.hpp"
#include "validation/publish/adopt.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/process.hpp"
#include "validation/run/sandbox.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* adopt_description =
    "Measures an engine of your own on the acceptance cases, twice, and with other seeds where a run has\n"
    "random numbers. For each case it writes a case file with gates into your repository. Later drift is\n"
    "red, to the worse or to the better. Baselines are accepted beside them. Cases that the engine\n"
    "refuses are left out. Named and not adopted are failures of a limit of any engine, engines that are\n"
    "wrongly declared deterministic, and noise above the value. The option --despite adopts these. A case\n"
    "with a metric that has no finite value is never adopted.\n"
    "  tripoint gate adopt --engine ./my-engine --out cases\n"
    "  tripoint gate adopt --engine my-engine --margin 1.2 --out cases rigid/ballistic\n"
    "Exit: 0 the written gates hold on a run of their own, 1 a case fails acceptance, 2 a file is there\n"
    "already, 3 noise hides a value, 4 a metric has no value or the engine runs none of the cases.\n"
    "Adoptable cases are written in any case.";

struct GateAdoptOptions {
  std::string engine, out = "cases";
  std::vector<std::string> what;
  AdoptOptions adopt;
  bool overwrite = false, sandbox = false, despite_given = false;
};

std::string today() {
  const std::time_t t = std::time(nullptr);
  char text[16];
  std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&t));
  return text;
}

/// The first lines of a case, which say what it shows.
std::string first_comment(const std::string& file) {
  std::istringstream in(text_of_file(file));
  std::string comment;
  for (std::string line; std::getline(in, line) && line.starts_with("#");) comment += line + "\n";
  return comment;
}

fs::path file_of(const GateAdoptOptions& o, const std::string& id) {
  return fs::path(o.out) / (id + ".toml");
}

std::vector<Case> cases_of(const GateAdoptOptions& o) {
  CaseFilter filter;
  filter.what = o.what;
  if (o.what.empty()) filter.profile = "acceptance";
  auto cases = select_cases(filter);
  for (const auto& c : cases)
    if (!o.overwrite && fs::exists(file_of(o, c.id)))
      throw InputError(
          fmt::format("{}: is there already; --overwrite writes it anew, and `tripoint gate accept` keeps "
                      "new figures of old gates",
                      file_of(o, c.id).string()));
  return cases;
}

EngineEntry engine_of(const GateAdoptOptions& o, std::vector<EngineEntry>& engines) {
  if (o.sandbox) sandbox_third_parties(o.adopt.work, o.adopt.jobs);
  const auto words = sort_engine_words(files_as_paths({o.engine}));
  engines = discover_engines(words.paths);
  const std::string name = words.paths.empty() ? o.engine : ask_engine(words.paths.front()).name;
  const auto* found = find_engine(engines, name);
  if (!found) throw EngineError(no_such_engine(name, engines));
  if (!found->available) throw EngineError(fmt::format("{}: {}", found->name, found->reason));
  return *found;
}

/// Files that this call wrote, with what was there before: unless they are kept, that comes back.
class WrittenFiles {
 public:
  WrittenFiles() = default;
  WrittenFiles(const WrittenFiles&) = delete;
  WrittenFiles& operator=(const WrittenFiles&) = delete;
  ~WrittenFiles() { take_back(); }
  void keep() { files_.clear(); }
  void write(const fs::path& file, const std::string& text) {
    std::optional<std::string> before;
    if (fs::exists(file)) before = text_of_file(file.string());
    fs::create_directories(file.parent_path());
    write_durably(file.string(), text);
    files_.emplace_back(file, before);
  }
 private:
  void take_back() noexcept try {
    for (const auto& [file, before] : files_) {
      if (before) {
        write_durably(file.string(), *before);
        continue;
      }
      std::error_code none;
      fs::remove(file, none);
      for (auto folder = file.parent_path(); fs::is_empty(folder, none) && !none;
           folder = folder.parent_path())
        fs::remove(folder, none);
    }
  } catch (const std::exception& e) {
    say(std::string("tripoint: what was there before is not written back: ") + e.what());
  }

  std::vector<std::pair<fs::path, std::optional<std::string>>> files_;
};

/// Meshes and data of the source go beside the written case, as it names them. @throws InputError for one
/// that lies elsewhere
void copy_files(const TomlNode& document, const std::string& source, const fs::path& file,
                WrittenFiles& written) {
  for (const auto& name : files_named_in(document)) {
    const auto path = fs::path(name).lexically_normal();
    if (path.is_absolute() || path.begin()->string() == "..")
      throw InputError({source, 0, 0}, "names the file " + printable(name) +
                                           ", which does not lie beside the case: it is not adopted");
    written.write(file.parent_path() / path, text_of_file((fs::path(source).parent_path() / path).string()));
  }
}

void say_findings(const AdoptedCase& c, bool refused) {
  for (const auto& f : c.all_findings()) {
    const std::string line =
        fmt::format("{}: {}: {}", c.id, refused ? "NOT ADOPTED" : "adopted despite this", f.text);
    print_line(line);
    if (refused) say("tripoint: " + line);
  }
}

void print_gates(const AdoptedCase& c) {
  for (const auto& row : c.rows)
    for (const auto& g : row.gates)
      print_line(fmt::format("  {:28} {:34} {}",
                             g.metric + (is_default_preset(row.preset) ? "" : " (" + row.preset + ")"),
                             describe(g), g.reason));
}

/// Writes the case files of what is adopted. @return their paths
std::vector<std::string> write_cases(const GateAdoptOptions& o, const std::vector<AdoptedCase>& measured,
                                     const EngineEntry& engine, WrittenFiles& written, std::set<int>& codes) {
  std::vector<std::string> files;
  for (const auto& c : measured) {
    const auto refused = c.refused_by(o.adopt.despite);
    codes.insert(refused.begin(), refused.end());
    say_findings(c, !refused.empty());
    if (!c.judged() || !refused.empty()) continue;
    const auto file = file_of(o, c.id);
    const auto document = read_case_document(c.source);
    copy_files(document, c.source, file, written);
    written.write(file, adopted_text(document, first_comment(c.source), c, engine, o.adopt.despite));
    files.push_back(file.string());
    print_line(fmt::format("wrote {}", file.string()));
    print_gates(c);
  }
  return files;
}

std::string reason_of(const GateAdoptOptions& o, const EngineEntry& engine) {
  auto reason = fmt::format("adopted from {} {} by tripoint gate adopt --margin {:g}", engine.name,
                            engine.version, o.adopt.margin);
  if (!o.adopt.despite.empty()) reason += ", despite what fails: " + o.adopt.despite;
  return one_line(reason);
}

/// The written gates judge a run of their own before anything is accepted.
int accept_written(const GateAdoptOptions& o, const std::vector<std::string>& files,
                   const std::vector<EngineEntry>& engines, const EngineEntry& engine,
                   WrittenFiles& written) {
  CaseFilter filter;
  filter.what = files;
  SuiteOptions suite;
  suite.selection.engines = suite.selection.asked = {engine.name};
  suite.jobs = o.adopt.jobs;
  suite.out = (fs::path(o.adopt.work) / "written").string();
  auto results = run_suite(select_cases(filter), engines, suite);
  results.date = today();
  results.what = files;
  results.command = command_line();
  write_results(results, suite.out);
  for (const auto& c : results.cases) print(case_line(c) + "\n");
  if (results.exit_code != exit_pass) {
    say("tripoint: the gates that were just written do not hold on a second look; they are taken back, and "
        "no baseline was accepted: is the engine deterministic, and is there room in --margin?");
    return results.exit_code;
  }
  fs::create_directories(baseline_folder(files.front()));
  print(accept(results, {}, {results.date, results.tool.commit, reason_of(o, engine)}));
  written.keep();
  return exit_pass;
}

void say_what_comes_next(const GateAdoptOptions& o, const std::vector<std::string>& files,
                         std::size_t cases) {
  say(fmt::format(
      "{} of {} cases adopted. Commit {} and {}. From then on:\n  tripoint validate {} --engines {}\n  "
      "tripoint gate report",
      files.size(), cases, o.out, baseline_folder(files.front()), o.out, o.engine));
}

int adopt(GateAdoptOptions o) {
  if (o.despite_given && o.adopt.despite.find_first_not_of(" \t\n") == std::string::npos)
    throw InputError("gate adopt: --despite says who decided to adopt what fails, and why");
  catch_interrupts();
  std::vector<EngineEntry> engines;
  const auto engine = engine_of(o, engines);
  const auto cases = cases_of(o);
  o.adopt.date = today();
  const auto measured = measure_to_adopt(cases, engine, o.adopt, say);
  std::set<int> codes;
  WrittenFiles written;
  const auto files = write_cases(o, measured, engine, written, codes);
  if (files.empty() && codes.empty())
    throw EngineError(
        fmt::format("{} ran none of {} cases: there is nothing to gate", engine.name, cases.size()));
  if (files.empty()) return first_of(codes);
  const int second_look = accept_written(o, files, engines, engine, written);
  codes.insert(second_look);
  if (second_look == exit_pass) say_what_comes_next(o, files, cases.size());
  return first_of(codes);
}

}  // namespace

CLI::App* add_gate_adopt(CLI::App& gate, int& exit_code) {
  auto* command = gate.add_subcommand("adopt", adopt_description);
  auto o = std::make_shared<GateAdoptOptions>();
  command->add_option("CASE", o->what, "case files, folders or ids; none = the profile acceptance")
      ->type_name("CASE|DIR");
  command->add_option("--engine", o->engine, "the engine: the path of an executable, or a name")->required();
  add_sandbox_flag(*command, o->sandbox);
  command
      ->add_option("--margin", o->adopt.margin,
                   "factor by which an error may grow or shrink before that is red")
      ->check(CLI::Range(1.0, 100.0))
      ->capture_default_str();
  command->add_option("--out", o->out, "folder of the written cases; baselines go beside it")
      ->capture_default_str();
  command->add_option("--seeds", o->adopt.seeds, "other seeds, for runs with random numbers")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option("--jobs", o->adopt.jobs, "engine processes at a time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--work", o->adopt.work, "folder of the runs")->capture_default_str();
  command->add_flag("--overwrite", o->overwrite, "write files that are there anew");
  auto* despite = command->add_option("--despite", o->adopt.despite,
                                      "adopt failing figures too, with this reason written into the case");
  command->callback([o, despite, &exit_code] {
    o->despite_given = despite->count() > 0;
    exit_code = guarded([&] { return adopt(*o); });
  });
  return command;
}

}  // namespace tripoint

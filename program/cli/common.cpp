// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/common.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <sstream>

#include "assembly/plan.hpp"
#include "core/errors.hpp"
#include "core/limits.hpp"
#include "step/settle.hpp"
#include "tables/library.hpp"
#include "tables/nearest.hpp"
#include "validation/case/read_case.hpp"
#include "validation/publish/report_files.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {
namespace {
std::string& remembered() {
  static std::string line;
  return line;
}

constexpr const char *green = "32", *red = "31", *yellow = "33";

/// Verdicts as they begin a line of the result.
constexpr std::array<std::pair<std::string_view, const char*>, 11> colours{{{"PASS", green},
                                                                            {"FAIL", red},
                                                                            {"FAILS", red},
                                                                            {"BAD INPUT", red},
                                                                            {"INCONCLUSIVE", yellow},
                                                                            {"MISSING", red},
                                                                            {"SELF-TEST FAILED", red},
                                                                            {"COST REGRESSION", yellow},
                                                                            {"DIVERGED", red},
                                                                            {"INTERRUPTED", yellow},
                                                                            {"ok", green}}};

bool wants_colour() {
  const char *no = std::getenv("NO_COLOR"), *term = std::getenv("TERM");
  return ::isatty(1) == 1 && !(no && *no) && term && std::string_view(term) != "dumb";
}

/// The verdict that begins the line, or follows the word "verdict", in its colour.
std::string painted(const std::string& line) {
  const std::size_t from = line.starts_with("verdict ") ? 8 : 0;
  for (const auto& [word, colour] : colours) {
    const bool whole = line.compare(from, word.size(), word) == 0 &&
                       (line.size() == from + word.size() || line[from + word.size()] == ' ');
    if (whole)
      return fmt::format("{}\033[1;{}m{}\033[0m{}", line.substr(0, from), colour, word,
                         line.substr(from + word.size()));
  }
  return line;
}

std::string all_painted(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const auto end = std::min(text.find('\n', at), text.size());
    out += painted(text.substr(at, end - at));
    if (end < text.size()) out += '\n';
    at = end + 1;
  }
  return out;
}
}  // namespace

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const InputError& e) {
    say(std::string("tripoint: ") + e.what());
    return exit_bad_input;
  } catch (const SettlingStopped& e) {
    say(std::string("tripoint: ") + e.what());
    return exit_interrupted;
  } catch (const Diverged& e) {
    say(std::string("tripoint: diverged: ") + e.what());
    return exit_diverged;
  } catch (const std::filesystem::filesystem_error& e) {
    say(fmt::format("tripoint: {}: {}", e.path1().string(), e.code().message()));
    return exit_missing;
  } catch (const std::exception& e) {
    say("tripoint: " + with_limit(e.what()));
    return exit_missing;
  }
}

void say(const std::string& line) {
  std::string text;
  for (const auto& part : split(line, '\n')) text += (text.empty() ? "" : "  ") + one_line(part) + "\n";
  text = without_commands(text.empty() ? "\n" : text);
  std::fwrite(text.data(), 1, text.size(), stderr);
}

namespace {

int output_error = 0;  ///< of the first write to standard output that failed
bool output_was_closed = false;

void write_out(const std::string& text) {
  errno = 0;
  const bool written = std::fwrite(text.data(), 1, text.size(), stdout) == text.size();
  if ((std::fflush(stdout) != 0 || !written) && output_error == 0) output_error = errno;
}

}  // namespace

void print_commands(const std::string& text) { write_out(text); }

void print(const std::string& plain) {
  static const bool coloured = wants_colour();
  write_out(without_commands(coloured ? all_painted(plain) : plain));
}

void hold_standard_streams() {
  constexpr std::array<const char*, 3> instead{"/dev/null", "/dev/full", "/dev/null"};
  output_was_closed = ::fcntl(STDOUT_FILENO, F_GETFD) == -1;
  for (int stream = 0; stream < 3; ++stream)
    if (::fcntl(stream, F_GETFD) == -1 && ::open(instead[static_cast<std::size_t>(stream)], O_RDWR) != stream)
      std::abort();
}

bool output_arrived() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return true;
  const int error = output_error != 0 ? output_error : errno;
  say("tripoint: what it printed could not be written: " +
      (output_was_closed ? "standard output is closed" : with_limit(std::strerror(error))));
  return false;
}

void print_line(const std::string& line) { print(one_line(line) + "\n"); }

void write_new_file(const std::string& path, const std::string& text, const char* otherwise) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (file < 0)
    throw InputError({path, 0, 0}, errno == EEXIST
                                       ? fmt::format("exists already, and is left as it is: {}", otherwise)
                                       : fmt::format("cannot be written: {}", std::strerror(errno)));
  const bool whole = ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (::close(file) != 0 || !whole)
    throw InputError({path, 0, 0}, "could not be written whole: is the disk full?");
}

std::vector<std::string> split(const std::string& list, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(list);
  for (std::string part; std::getline(stream, part, separator);)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

EngineWords sort_engine_words(const std::vector<std::string>& words) {
  EngineWords sorted;
  for (const auto& word : words)
    (word.find('/') != std::string::npos ? sorted.paths : sorted.names).push_back(word);
  return sorted;
}

std::vector<std::string> files_as_paths(std::vector<std::string> words) {
  for (auto& word : words)
    if (word.find('/') == std::string::npos && std::filesystem::is_regular_file(word)) word = "./" + word;
  return words;
}

std::string no_such_engine(const std::string& name, const std::vector<EngineEntry>& engines) {
  std::vector<std::string> names;
  for (const auto& e : engines) names.push_back(e.name);
  const auto near = nearest(name, names);
  return fmt::format("no engine is named {} ({})", printable(name),
                     near.empty() ? "tripoint engines lists them" : "did you mean `" + near + "`?");
}

std::string own_folder(const std::string& command, const std::string& case_id) {
  return "report-" + command + (case_id.empty() ? "" : "/" + case_id);
}

std::string results_file(const std::string& path) {
  if (!std::filesystem::exists(path))
    throw InputError(
        path + ": there is no such file or folder" +
        (std::filesystem::path(path).is_absolute() ? "" : " in " + std::filesystem::current_path().string()) +
        ": name a results.json, or the folder of a report");
  return std::filesystem::is_directory(path) ? (std::filesystem::path(path) / "results.json").string() : path;
}

void add_sandbox_flag(CLI::App& command, bool& wanted) {
  command.add_flag("--sandbox", wanted,
                   "run third-party engines by bubblewrap: no network, none of your files, writing in the "
                   "run's own folder alone. Pages are drawn in it too");
}

void make_folder(const std::string& out) {
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (!error && !std::filesystem::is_directory(out)) error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw InputError(fmt::format("--out {}: the folder cannot be made: {}. Name another with --out",
                                 printable(out, 200), error.message()));
  if (::access(out.c_str(), W_OK | X_OK) != 0)
    throw InputError(fmt::format("--out {}: the folder cannot be written to. Name another with --out",
                                 printable(out, 200)));
}

FolderLock hold_folder(const std::string& out) {
  make_folder(out);
  return FolderLock(out);
}

void remember_command_line(int argc, char** argv) {
  remembered() = "tripoint";
  for (int i = 1; i < argc; ++i) remembered() += std::string(" ") + argv[i];
}

const std::string& command_line() { return remembered(); }

Shard read_shard(const std::string& text) {
  Shard shard{0, 0};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%d/%d%c", &shard.i, &shard.n, &rest) != 2 || shard.i < 1 || shard.n < 1 ||
      shard.i > shard.n)
    throw InputError("--shard " + text + ": write i/n with 1 <= i <= n, for example 2/4");
  return shard;
}

std::string date_now() {
  const std::time_t t = std::time(nullptr);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&t));
  return text.data();
}

std::vector<EngineEntry> discover_selected(const Selection& selection,
                                           const std::vector<std::string>& paths) {
  if (selection.engines.empty()) return discover_engines(paths);
  auto names = selection.engines;
  names.insert(names.end(), selection.extra.begin(), selection.extra.end());
  return discover_engines_wanted(names, paths);
}

Plan plan_of(const CaseReading& reading) {
  try {
    return plan(scene_for(reading.value, {}));
  } catch (const InputError& e) {
    if (!e.place().file.empty()) throw;
    throw InputError({reading.value.file, 0, 0}, e.what());
  }
}

void hand_over(const std::string& program, const std::vector<std::string>& options,
               const std::vector<std::string>& operands) {
  const std::filesystem::path file = std::filesystem::path(share_folder()) / "reports" / program;
  if (!std::filesystem::exists(file)) throw EngineError("the program " + file.string() + " is missing");
  std::vector<std::string> words{python_program(), "-B", file.string()};
  words.insert(words.end(), options.begin(), options.end());
  words.emplace_back("--");
  words.insert(words.end(), operands.begin(), operands.end());
  std::vector<char*> pointers;
  for (auto& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  ::execv(words.front().c_str(), pointers.data());
  throw EngineError(fmt::format("{} cannot be started: {}", words.front(), std::strerror(errno)));
}

}  // namespace tripoint

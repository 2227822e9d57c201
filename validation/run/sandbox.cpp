// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/sandbox.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "core/confined_copy.hpp"
#include "core/errors.hpp"
#include "tables/library.hpp"
#include "validation/run/discover.hpp"
#include "validation/run/earlier_run.hpp"
#include "validation/run/sandbox_sums.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

void add(Words& words, const Words& more) { words.insert(words.end(), more.begin(), more.end()); }

constexpr const char* bubblewrap = "/usr/bin/bwrap";
constexpr const char* limiter = "/usr/bin/prlimit";
constexpr auto in_memory = "1073741824";          ///< bytes of a folder that lives in memory
constexpr int most_processes = 512;               ///< of one engine
constexpr double share_of_free_memory = 0.75;     ///< of what is free when it begins
constexpr double most_bytes = 16.0 * (1u << 30);  ///< of the files of one run
std::atomic<bool> wanted{false};
fs::path report;  ///< that no engine sees
int at_once = 1;  ///< sandboxes

/// Who runs what a sandbox holds.
enum class As {
  caller,  ///< the user who called us, in a user namespace of its own
  /// a user of the system who owns nothing: as root an engine could write whatever root may write without its
  /// rights
  nobody
};

As engines_run_as() { return ::geteuid() == 0 ? As::nobody : As::caller; }

/// Namespaces of its own for all that Linux has; no right of root; ends with us. Only the system's programs
/// and libraries are there, and settings of the kernel to read.
std::vector<std::string> bare(As as) {
  std::vector<std::string> words{bubblewrap,          "--unshare-ipc",
                                 "--unshare-pid",     "--unshare-net",
                                 "--unshare-uts",     "--unshare-cgroup-try",
                                 "--die-with-parent", "--new-session",
                                 "--cap-drop",        "ALL"};
  if (as == As::caller)
    words.emplace_back("--unshare-user");
  else
    words.insert(words.end(), {"--cap-add", "CAP_SETUID", "--cap-add", "CAP_SETGID"});
  words.insert(words.end(), {"--clearenv", "--ro-bind", "/usr",      "/usr",      "--dev",     "/dev",
                             "--perms",    "1777",      "--size",    in_memory,   "--tmpfs",   "/dev/shm",
                             "--proc",     "/proc",     "--ro-bind", "/proc/sys", "/proc/sys", "--perms",
                             "1777",       "--size",    in_memory,   "--tmpfs",   "/tmp"});
  for (const char* link : {"bin", "lib", "lib64", "sbin"})
    words.insert(words.end(), {"--symlink", fmt::format("usr/{}", link), fmt::format("/{}", link)});
  for (const char* file : {"/etc/alternatives", "/etc/ld.so.cache", "/etc/localtime"})
    words.insert(words.end(), {"--ro-bind-try", file, file});
  return words;
}

fs::path place_of(const std::string& path) { return fs::weakly_canonical(fs::absolute(path)); }

/// Whether a file or folder lies in a folder, or is that folder.
bool is_within(const fs::path& path, const fs::path& folder) {
  const fs::path relative = path.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

/// Binds a file or folder at its own place. Folders above it are made first, so that nobody may enter them.
void show(Words& words, const char* how, const std::string& path) {
  const fs::path place = fs::absolute(path).lexically_normal();
  fs::path above;
  for (const fs::path& part : place.parent_path()) {
    above /= part;
    if (above != above.root_path()) add(words, {"--dir", above.string()});
  }
  add(words, {how, place.string(), place.string()});
}

/// @throws EngineError where engines run as nobody, who may not read this one
void expect_readable(const fs::path& folder, const fs::path& program) {
  if (engines_run_as() == As::caller) return;
  constexpr auto read = fs::perms::others_read, enter = fs::perms::others_exec;
  for (const auto& [path, needed] : {std::pair(folder, enter), std::pair(program, read | enter)})
    if ((fs::status(path).permissions() & needed) != needed)
      throw EngineError(fmt::format(
          "--sandbox: called by root, engines run as user {}, who may not read {}: chmod -R o+rX {}",
          sandbox_user, path.string(), folder.string()));
}

/// The engine's folder as it may be read: an empty folder hides the report and the data of git.
std::vector<std::string> bind_engine(const fs::path& folder) {
  const char* home = std::getenv("HOME");
  if (home && *home == '/' && home[1] != '\0' && is_within(place_of(home), folder))
    throw EngineError(fmt::format(
        "--sandbox: the engine's folder {} holds your home: put the engine into a folder of its own",
        folder.string()));
  const fs::path real = place_of(folder.string());
  if (!report.empty() && is_within(real, report))
    throw EngineError(fmt::format(
        "--sandbox: the engine's folder {} lies in the report's, {}: put it elsewhere, or choose another "
        "--out",
        folder.string(), report.string()));
  Words words;
  show(words, "--ro-bind", folder.string());
  const auto hide = [&](const fs::path& what) {
    std::error_code none;
    if (is_within(what, real) && fs::is_directory(what, none))
      words.insert(words.end(), {"--tmpfs", (folder / what.lexically_relative(real)).string()});
  };
  if (!report.empty()) hide(report);
  hide(real / ".git");
  return words;
}

/// This much, or our own limit where that is less: nobody can raise a limit inside.
rlim_t at_most(__rlimit_resource what, rlim_t much) {
  rlimit ours{};
  return ::getrlimit(what, &ours) == 0 ? std::min(much, ours.rlim_max) : much;
}

rlim_t memory_of_the_machine() {
  return static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// What gives up root's name. Nothing for another user.
std::vector<std::string> become(As as) {
  if (as == As::caller) return {};
  const std::string id = std::to_string(sandbox_user);
  return {"/usr/bin/setpriv",
          "--reuid=" + id,
          "--regid=" + id,
          "--clear-groups",
          "--no-new-privs",
          "--inh-caps=-all",
          "--"};
}

/// Limits of the engine. They are set inside the sandbox before the engine begins, so that it cannot escape
/// them.
std::vector<std::string> limits(double wall_limit) {
  const rlim_t memory = memory_of_the_machine();
  const double cpu = std::min(wall_limit * std::max(1u, std::thread::hardware_concurrency()) + 10.0, 1e9);
  return {limiter, "--core=0", fmt::format("--data={}", at_most(RLIMIT_DATA, memory)),
          fmt::format("--as={}", at_most(RLIMIT_AS, 4 * memory)),  // some reserve much more than they use
          fmt::format("--fsize={}", at_most(RLIMIT_FSIZE, static_cast<rlim_t>(most_bytes))),
          // The user's other processes count, too
          fmt::format("--nproc={}", at_most(RLIMIT_NPROC, 2 * most_processes)),
          fmt::format("--cpu={}", at_most(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(cpu)))), "--"};
}

}  // namespace

bool belongs_to_us(const std::string& executable) {
  std::error_code none;
  const fs::path own = fs::weakly_canonical(fs::path(program_folder()).parent_path() / "libexec", none);
  const fs::path relative = fs::weakly_canonical(executable, none).lexically_relative(own);
  return !none && !relative.empty() && *relative.begin() != "..";
}

void sandbox_third_parties(const std::string& out, int jobs) {
  at_once = std::max(jobs, 1);
  report = out.empty() ? fs::path() : place_of(out);
  ProcessSpec trial;
  trial.argv = bare(engines_run_as());
  add(trial.argv, {"--"});
  add(trial.argv, become(engines_run_as()));
  add(trial.argv, limits(10.0));
  trial.argv.push_back("/bin/true");
  trial.wall_limit = 10.0;
  const ProcessEnd end = run_process(trial);
  if (end.how == ProcessEnd::How::not_started)
    throw EngineError(
        "--sandbox needs bubblewrap: apt-get install bubblewrap; without --sandbox engines run as you do");
  if (end.how != ProcessEnd::How::exited || end.code != 0)
    throw EngineError(
        fmt::format("--sandbox: this machine lets bubblewrap make no namespaces ({}): {}; without --sandbox "
                    "engines run as you do",
                    end.log_tail,
                    engines_run_as() == As::nobody ? "run tripoint as a user who is not root"
                                                   : "allow unprivileged user namespaces"));
  CopyBounds reader{"what engines leave", 10.0};
  reader.folder = "/";
  reader.must_be_confined = true;
  if (read_in_confined_copy([] { return std::string(); }, reader).how != CopyEnd::How::read)
    throw EngineError(
        "--sandbox: this system cannot confine the reader of what engines leave: that takes seccomp and "
        "Landlock (Linux 5.13); "
        "without --sandbox engines run as you do");
  wanted = true;
}

bool third_parties_are_sandboxed() noexcept { return wanted; }

namespace {

/// The child in bubblewrap, where it sees the bound folders and no more.
ProcessSpec behind_walls(ProcessSpec spec, const Words& bound, As as) {
  Words words = bare(as);
  add(words, bound);
  add(words,
      {"--chdir", spec.folder.empty() ? "/tmp" : fs::absolute(spec.folder).lexically_normal().string()});
  add(words, {"--setenv", "PATH", "/usr/local/bin:/usr/bin:/bin", "--setenv", "HOME", "/tmp", "--setenv",
              "LANG", "C.UTF-8"});
  for (const auto& [name, value] : spec.environment) add(words, {"--setenv", name, value});
  words.emplace_back("--");
  add(words, become(as));
  add(words, limits(spec.wall_limit));
  add(words, spec.argv);
  spec.argv = std::move(words);
  spec.in_sandbox = true;
  if (as == As::nobody) spec.lent = spec.folder;
  spec.most = {share_of_free_memory * free_memory() / at_once, most_processes, most_bytes, most_files,
               at_once};
  return spec;
}

/// Folders of the checkout or the installation, with the targets of links in the folder of shared data.
void show_shared(Words& words) {
  show(words, "--ro-bind", share_folder());
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(share_folder(), none))
    if (entry.is_symlink(none)) show(words, "--ro-bind", fs::weakly_canonical(entry.path()).string());
}

/// The folder above bin, or the program alone where that folder holds the user's home.
void show_prefix(Words& words, const fs::path& program) {
  const fs::path prefix = program.parent_path().parent_path();
  if (is_within(program, "/usr") || prefix == prefix.root_path()) return;
  const char* home = std::getenv("HOME");
  const bool holds_home = home && *home == '/' && is_within(place_of(home), place_of(prefix.string()));
  show(words, "--ro-bind", holds_home ? program.string() : prefix.string());
}

/// An environment of Python, or one that is not the system's, with all that its links lead to.
void show_python(Words& words, fs::path python) {
  constexpr int most_links = 8;
  std::error_code none;
  show_prefix(words, place_of(python.string()));
  for (int n = 0; n < most_links; ++n) {
    show_prefix(words, python);
    if (!fs::is_symlink(python, none)) return;
    python = (python.parent_path() / fs::read_symlink(python, none)).lexically_normal();
  }
}

/// Whether an entry is made by the program that draws the pages: a page, or its figures.
bool is_drawn(const fs::path& entry) {
  const fs::path name = entry.filename();
  return name.extension() == ".html" || name == "case" || name == "figures" || name == "report.pdf" ||
         name == "report.log";
}

/// The report's folder, in which nothing but pages and figures may change.
void show_report(Words& words, const fs::path& out) {
  show(words, "--bind", out.string());
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(out, none))
    if (!is_drawn(entry.path()))
      show(words, "--ro-bind-try",
           entry.is_symlink(none) ? fs::weakly_canonical(entry.path()).string() : entry.path().string());
}

}  // namespace

ProcessSpec sandboxed(ProcessSpec spec, const std::vector<std::string>& readable) {
  if (!wanted || belongs_to_us(spec.argv.front())) return spec;
  const fs::path folder = fs::absolute(fs::path(spec.argv.front()).parent_path()).lexically_normal();
  expect_readable(folder, spec.argv.front());
  Words bound = bind_engine(folder);
  for (const std::string& path : readable) {
    show(bound, "--ro-bind", path);
    if (engines_run_as() == As::nobody) fs::permissions(path, fs::perms::others_read, fs::perm_options::add);
  }
  if (!spec.folder.empty()) show(bound, "--bind", spec.folder);
  if (const auto earlier = fs::path(spec.folder) / earlier_run_folder;
      !spec.folder.empty() && fs::is_directory(earlier))
    add(bound, {"--tmpfs", fs::absolute(earlier).lexically_normal().string()});
  return behind_walls(std::move(spec), bound, engines_run_as());
}

ProcessSpec sandboxed_report(ProcessSpec spec, const std::string& out, const std::string& history) {
  if (!wanted) return spec;
  spec.argv.front() = fs::absolute(spec.argv.front()).lexically_normal().string();
  Words bound;
  show_shared(bound);
  show_python(bound, spec.argv.front());
  for (const char* fonts : {"/etc/fonts", "/etc/matplotlibrc"}) add(bound, {"--ro-bind-try", fonts, fonts});
  show_report(bound, out);
  if (!history.empty()) show(bound, "--ro-bind-try", history);
  spec.folder = out;
  spec = behind_walls(std::move(spec), bound, As::caller);
  spec.most.bytes = 0.0;  // the folder holds all runs
  return spec;
}

}  // namespace tripoint

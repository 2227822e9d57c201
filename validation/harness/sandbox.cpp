// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/sandbox.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "core/errors.hpp"
#include "validation/harness/discover.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

constexpr const char* bubblewrap = "/usr/bin/bwrap";
constexpr const char* limiter = "/usr/bin/prlimit";
constexpr auto in_memory = "1073741824";  ///< bytes of a folder that lives in memory
constexpr rlim_t most_processes = 512;    ///< of one engine; nobody counts those of root
std::atomic<bool> wanted{false};
fs::path report;  ///< that no engine sees

/// Namespaces of its own for all that Linux has; no right of root; ends with us. Only the system's programs and libraries are
/// there.
std::vector<std::string> bare() {
  std::vector<std::string> words{bubblewrap,
                                 "--unshare-all",
                                 "--unshare-user",
                                 "--die-with-parent",
                                 "--new-session",
                                 "--cap-drop",
                                 "ALL",
                                 "--clearenv",
                                 "--ro-bind",
                                 "/usr",
                                 "/usr",
                                 "--dev",
                                 "/dev",
                                 "--size",
                                 in_memory,
                                 "--tmpfs",
                                 "/dev/shm",
                                 "--proc",
                                 "/proc",
                                 "--size",
                                 in_memory,
                                 "--tmpfs",
                                 "/tmp"};
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

/// The engine's folder as it may be read: an empty one stands where the report is, and where git keeps what it knows.
std::vector<std::string> bind_engine(const fs::path& folder) {
  const char* home = std::getenv("HOME");
  if (home && *home == '/' && home[1] != '\0' && is_within(place_of(home), folder))
    throw EngineError(fmt::format("--sandbox: the engine's folder {} holds your home: put the engine into a folder of its own",
                                  folder.string()));
  const fs::path real = place_of(folder.string());
  if (!report.empty() && is_within(real, report))
    throw EngineError(
        fmt::format("--sandbox: the engine's folder {} lies in the report's, {}: put it elsewhere, or choose another "
                    "--out",
                    folder.string(), report.string()));
  std::vector<std::string> words{"--ro-bind", folder.string(), folder.string()};
  const auto hide = [&](const fs::path& what) {
    std::error_code none;
    if (is_within(what, real) && fs::is_directory(what, none))
      words.insert(words.end(), {"--tmpfs", (folder / what.lexically_relative(real)).string()});
  };
  if (!report.empty()) hide(report);
  hide(real / ".git");
  return words;
}

/// This much, or less where we may have no more ourselves: nobody can raise a limit inside.
rlim_t at_most(__rlimit_resource what, rlim_t much) {
  rlimit ours{};
  return ::getrlimit(what, &ours) == 0 ? std::min(much, ours.rlim_max) : much;
}

/// What the engine may use. Set before it begins, inside: nobody can be faster.
std::vector<std::string> limits(double wall_limit) {
  const auto memory = static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
  const double cpu = std::min(wall_limit * std::max(1u, std::thread::hardware_concurrency()) + 10.0, 1e9);
  return {limiter,
          "--core=0",
          fmt::format("--data={}", at_most(RLIMIT_DATA, memory)),
          fmt::format("--as={}", at_most(RLIMIT_AS, 4 * memory)),  // some reserve much more than they use
          fmt::format("--fsize={}", at_most(RLIMIT_FSIZE, rlim_t{16} << 30)),
          fmt::format("--nproc={}", at_most(RLIMIT_NPROC, most_processes)),
          fmt::format("--cpu={}", at_most(RLIMIT_CPU, static_cast<rlim_t>(std::ceil(cpu)))),
          "--"};
}

}  // namespace

bool belongs_to_us(const std::string& executable) {
  std::error_code none;
  const fs::path own = fs::weakly_canonical(fs::path(program_folder()).parent_path() / "libexec", none);
  const fs::path relative = fs::weakly_canonical(executable, none).lexically_relative(own);
  return !none && !relative.empty() && *relative.begin() != "..";
}

void sandbox_strangers(const std::string& out) {
  report = out.empty() ? fs::path() : place_of(out);
  ProcessSpec trial;
  trial.argv = bare();
  const auto limited = limits(10.0);
  trial.argv.insert(trial.argv.end(), limited.begin(), limited.end());
  trial.argv.push_back("/bin/true");
  trial.wall_limit = 10.0;
  const ProcessEnd end = run_process(trial);
  if (end.how == ProcessEnd::How::not_started)
    throw EngineError("--sandbox needs bubblewrap: apt-get install bubblewrap; without --sandbox engines run as you do");
  if (end.how != ProcessEnd::How::exited || end.code != 0)
    throw EngineError(
        fmt::format("--sandbox: this machine lets bubblewrap make no namespaces ({}): allow unprivileged user namespaces; "
                    "without --sandbox engines run as you do",
                    end.log_tail));
  wanted = true;
}

ProcessSpec sandboxed(ProcessSpec spec, const std::vector<std::string>& readable) {
  if (!wanted || belongs_to_us(spec.argv.front())) return spec;
  std::vector<std::string> words = bare();
  const auto add = [&](const std::vector<std::string>& more) { words.insert(words.end(), more.begin(), more.end()); };
  const auto bind = [&](const char* how, const std::string& path) {
    const std::string place = fs::absolute(path).lexically_normal().string();
    add({how, place, place});
  };
  add(bind_engine(fs::absolute(fs::path(spec.argv.front()).parent_path()).lexically_normal()));
  for (const std::string& path : readable) bind("--ro-bind", path);
  if (!spec.folder.empty()) bind("--bind", spec.folder);
  words.insert(words.end(), {"--chdir", spec.folder.empty() ? "/tmp" : fs::absolute(spec.folder).lexically_normal().string()});
  words.insert(words.end(),
               {"--setenv", "PATH", "/usr/local/bin:/usr/bin:/bin", "--setenv", "HOME", "/tmp", "--setenv", "LANG", "C.UTF-8"});
  for (const auto& [name, value] : spec.environment) words.insert(words.end(), {"--setenv", name, value});
  add({"--"});
  add(limits(spec.wall_limit));
  add(spec.argv);
  spec.argv = std::move(words);
  spec.in_sandbox = true;
  return spec;
}

}  // namespace tripoint

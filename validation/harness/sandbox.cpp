// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/sandbox.hpp"

#include <fmt/format.h>

#include <atomic>
#include <filesystem>

#include "core/errors.hpp"
#include "validation/harness/discover.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

constexpr const char* bubblewrap = "/usr/bin/bwrap";
std::atomic<bool> wanted{false};

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
                                 "--proc",
                                 "/proc",
                                 "--tmpfs",
                                 "/tmp"};
  for (const char* link : {"bin", "lib", "lib64", "sbin"})
    words.insert(words.end(), {"--symlink", fmt::format("usr/{}", link), fmt::format("/{}", link)});
  for (const char* file : {"/etc/alternatives", "/etc/ld.so.cache", "/etc/localtime"})
    words.insert(words.end(), {"--ro-bind-try", file, file});
  return words;
}

}  // namespace

bool belongs_to_us(const std::string& executable) {
  std::error_code none;
  const fs::path own = fs::weakly_canonical(fs::path(program_folder()).parent_path() / "libexec", none);
  const fs::path relative = fs::weakly_canonical(executable, none).lexically_relative(own);
  return !none && !relative.empty() && *relative.begin() != "..";
}

void sandbox_strangers() {
  ProcessSpec trial;
  trial.argv = bare();
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
  const auto bind = [&](const char* how, const std::string& path) {
    const std::string place = fs::absolute(path).lexically_normal().string();
    words.insert(words.end(), {how, place, place});
  };
  bind("--ro-bind", fs::path(spec.argv.front()).parent_path().string());
  for (const std::string& path : readable) bind("--ro-bind", path);
  if (!spec.folder.empty()) bind("--bind", spec.folder);
  words.insert(words.end(), {"--chdir", spec.folder.empty() ? "/tmp" : fs::absolute(spec.folder).lexically_normal().string()});
  words.insert(words.end(),
               {"--setenv", "PATH", "/usr/local/bin:/usr/bin:/bin", "--setenv", "HOME", "/tmp", "--setenv", "LANG", "C.UTF-8"});
  for (const auto& [name, value] : spec.environment) words.insert(words.end(), {"--setenv", name, value});
  words.push_back("--");
  words.insert(words.end(), spec.argv.begin(), spec.argv.end());
  spec.argv = std::move(words);
  return spec;
}

}  // namespace tripoint

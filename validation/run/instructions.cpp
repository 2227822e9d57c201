// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/instructions.hpp"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace tripoint {
namespace {

/// Full path of a program of PATH; empty when there is none.
std::string on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const auto file = std::filesystem::path(folder) / name;
    if (!folder.empty() && ::access(file.c_str(), X_OK) == 0) return file.string();
  }
  return {};
}

}  // namespace

InstructionCounter::InstructionCounter() {
  perf_event_attr what{};
  what.size = sizeof what;
  what.type = PERF_TYPE_HARDWARE;
  what.config = PERF_COUNT_HW_INSTRUCTIONS;
  what.disabled = 1;
  what.inherit = 1;
  what.enable_on_exec = 1;  // of the children, from their exec on, with all that they start
  what.exclude_kernel = 1;
  what.exclude_hv = 1;
  fd_ = static_cast<int>(::syscall(SYS_perf_event_open, &what, 0, -1, -1, PERF_FLAG_FD_CLOEXEC));
}

InstructionCounter::~InstructionCounter() {
  if (fd_ >= 0) ::close(fd_);
}

double InstructionCounter::read() const {
  std::uint64_t count = 0;
  if (fd_ < 0 || ::read(fd_, &count, sizeof count) != static_cast<ssize_t>(sizeof count)) return 0.0;
  return static_cast<double>(count);
}

std::optional<double> collected_instructions(const std::string& log) {
  static constexpr std::string_view word = "Collected : ";
  double sum = 0.0;
  for (auto at = log.find(word); at != std::string::npos; at = log.find(word, at + 1))
    sum += std::strtod(log.c_str() + at + word.size(), nullptr);
  if (!(sum > 0.0)) return {};
  return sum;
}

std::optional<double> callgrind_instructions(const ProcessSpec& run) {
  ProcessSpec spec = run;
  const auto valgrind = on_path("valgrind");
  if (valgrind.empty()) return {};
  spec.argv.insert(spec.argv.begin(),
                   {valgrind, "--tool=callgrind", "--trace-children=yes", "--callgrind-out-file=/dev/null"});
  spec.progress = {};
  spec.status = {};
  const auto end = run_process(spec);
  if (end.how != ProcessEnd::How::exited || end.code != 0) return {};
  return collected_instructions(end.log_tail);
}

}  // namespace tripoint

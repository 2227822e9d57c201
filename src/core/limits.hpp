// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>

/// Limits that the caller's shell may have set (ulimit), and that would otherwise end us by a signal without
/// a word.
namespace tripoint {

/// A file above the limit of its size is an error of the write from now on, as a full disk is.
inline void expect_file_limit() noexcept { ::signal(SIGXFSZ, SIG_IGN); }

/// The words of an error, with what to do where a file passed the limit of its size.
[[nodiscard]] inline std::string with_limit(std::string words) {
  if (words.find(std::strerror(EFBIG)) == std::string::npos) return words;
  rlimit file{};
  constexpr rlim_t kilo = 1024;
  const bool known = ::getrlimit(RLIMIT_FSIZE, &file) == 0 && file.rlim_cur != RLIM_INFINITY;
  return words + " (a file may have " +
         (known ? std::to_string(file.rlim_cur / kilo) + " kB" : "no such size") +
         " here: raise that, as by ulimit -f unlimited)";
}

/// Begins this program anew with a greater stack, where the limit is too small for it, and may be raised.
/// @return what to do where it may not; empty where the stack is great enough
[[nodiscard]] inline std::string stack_trouble(char** argv) {
  constexpr rlim_t kilo = 1024, least = 1024 * kilo, usual = 8192 * kilo;
  rlimit stack{};
  if (::getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= least) return {};
  const auto had = std::to_string(stack.rlim_cur / kilo);
  stack.rlim_cur = std::min(stack.rlim_max, usual);
  if (stack.rlim_cur >= least && ::setrlimit(RLIMIT_STACK, &stack) == 0) ::execv("/proc/self/exe", argv);
  return "the stack is limited to " + had + " kB, and " + std::to_string(least / kilo) +
         " kB are needed: raise the limit, as by ulimit -s 8192, and call again";
}

}  // namespace tripoint

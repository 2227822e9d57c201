// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <unistd.h>

#include <stdexcept>
#include <vector>

#include "core/errors.hpp"
#include "validation/run/third_party_reader.hpp"

namespace tripoint {
namespace {

/// What is thrown here where this is tried; empty = nothing.
std::string words_of(const std::function<void()>& deed, double limit = 20.0) {
  try {
    try_of_third_party(deed, {"a file"}, limit);
    return {};
  } catch (const EngineError& e) {
    return e.what();
  }
}

TEST(ThirdPartyReader, WhatEndsWellOrWithAnExceptionIsLeftToUs) {
  int done = 0;
  EXPECT_EQ(words_of([&] { ++done; }), "");
  EXPECT_EQ(words_of([] { throw std::runtime_error("refused"); }), "");
  EXPECT_EQ(done, 0);  // it was a copy that did it
}

TEST(ThirdPartyReader, WhatKillsTheCopyIsAnErrorOfTheFile) {
  EXPECT_NE(words_of([] { ::raise(SIGSEGV); }).find("a file kills the library that reads it (signal 11"),
            std::string::npos);
}

TEST(ThirdPartyReader, WhatHangsIsStoppedAtTheLimit) {
  EXPECT_EQ(words_of(
                [] {
                  for (;;) ::pause();
                },
                0.2),
            "a file could not be read within 0.2 s");
}

TEST(ThirdPartyReader, NothingIsReadWithoutADescriptorToSpare) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &before), 0);
  const int next = ::dup(0);
  ASSERT_GE(next, 0);
  ::close(next);
  const rlimit none_to_spare{static_cast<rlim_t>(next), before.rlim_max};
  ::setrlimit(RLIMIT_NOFILE, &none_to_spare);
  const auto told = words_of([] {});
  ::setrlimit(RLIMIT_NOFILE, &before);
  EXPECT_EQ(told,
            "a file was not read: no file is to spare for what a copy of us reads: Too many open files");
}

TEST(ThirdPartyReader, WhatTakesMoreThanTheMachineHasIsRefused) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "address space is not bounded under the sanitizer";
#endif
  const auto much = [] {
    std::vector<char> all(std::size_t{1} << 46);
    const char* volatile const first = all.data();  // volatile: clang leaves out memory that nobody can see
    if (first[5] != 0) ::raise(SIGSEGV);
  };
  EXPECT_EQ(words_of(much), "a file takes more memory than this machine has");
}

}  // namespace
}  // namespace tripoint

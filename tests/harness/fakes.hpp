// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "validation/campaign/suite.hpp"
#include "validation/case/read_case.hpp"
#include "validation/run/discover.hpp"

namespace tripoint {

/// A folder of its own for one test, gone after it.
class TestFolder {
 public:
  TestFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tripoint-test-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TestFolder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  TestFolder(const TestFolder&) = delete;
  TestFolder& operator=(const TestFolder&) = delete;
  [[nodiscard]] std::string operator/(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

inline void write_text(const std::string& path, const std::string& text) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  std::ofstream(path) << text;
}

/// An executable that runs tests/harness/fake/engine.py with this fault.
inline std::string fake_engine(const TestFolder& folder, const std::string& wrong,
                               const std::string& name = "fake") {
  const auto path = folder / ("engine-" + name);
  write_text(path, "#!/bin/sh\nFAKE='" + wrong + "' FAKE_NAME='" + name +
                       "' exec /usr/bin/python3 " TRIPOINT_FAKE_ENGINE " \"$@\"\n");
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return path;
}

/// One body in free flight, judged against the parabola at round-off: fake/flight.toml, and more.
inline std::string flight_case(const std::string& more = "") {
  std::ifstream file(std::filesystem::path(TRIPOINT_FAKE_ENGINE).replace_filename("flight.toml"));
  return std::string{std::istreambuf_iterator<char>(file), {}} + more;
}

inline Case read_flight_case(const TestFolder& folder, const std::string& more = "") {
  const auto path = folder / "cases/test/flight.toml";
  write_text(path, flight_case(more));
  return read_case(path).value;
}

/// The flight, run on one fake engine alone.
inline CaseResult fly(const TestFolder& folder, const std::string& wrong, const std::string& more = "",
                      double wall_limit = 60.0) {
  const auto value = read_flight_case(folder, more);
  SuiteOptions options;
  options.out = folder / "out";
  options.selection.engines = {"fake"};
  options.wall_limit = wall_limit;
  return run_suite({value}, {ask_engine(fake_engine(folder, wrong))}, options).cases.at(0);
}

}  // namespace tripoint

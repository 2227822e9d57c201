// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "validation/references/experiment.hpp"

/// Data files of measured values, written for a test.
namespace tripoint::test {

/// A file that is gone with the test.
class DataFile {
 public:
  explicit DataFile(const std::string& text) {
    path_ = std::filesystem::temp_directory_path() /
            ("measured_" + std::to_string(::getpid()) + "_" + std::to_string(count()++) + ".ref.csv");
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~DataFile() { std::filesystem::remove(path_); }
  DataFile(const DataFile&) = delete;
  DataFile& operator=(const DataFile&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  static int& count() {
    static int n = 0;
    return n;
  }
  std::filesystem::path path_;
};

/// The text with its own hash as first line.
inline std::string sealed(const std::string& text) {
  return "# hash: " + experiment_hash(text) + "\n" + text;
}

inline ReferenceChoice experiment(const DataFile& file, const std::string& axis = "x") {
  ReferenceChoice choice;
  choice.kind = ReferenceKind::experiment;
  choice.file = file.path();
  choice.args["axis"] = axis;
  return choice;
}

}  // namespace tripoint::test

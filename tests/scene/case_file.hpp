// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "validation/case/read_case.hpp"

/// Case files for the tests of the scene, in a folder of their own that goes with the object.
namespace tripoint::test {

class Folder {
 public:
  Folder() {
    // Users have such folders
    std::string path = (std::filesystem::temp_directory_path() / "tripoint a b \u00fc XXXXXX").string();
    path_ = mkdtemp(path.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    const auto file = path_ / name;
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

inline CaseReading read_text(const std::string& text, const std::vector<std::string>& set = {}) {
  const Folder folder;
  return read_case(folder.write("case.toml", text), set);
}

/// The refusal of a text, or "" when it is accepted.
inline std::string refusal(const std::string& text, const std::vector<std::string>& set = {}) {
  try {
    static_cast<void>(read_text(text, set));
    return "";
  } catch (const InputError& e) {
    const std::string what = e.what();
    const auto file = what.find("case.toml");
    return file == std::string::npos ? what : what.substr(file);
  }
}

inline const Decision* decision(const CaseReading& r, const std::string& key) {
  for (const auto& d : r.decisions)
    if (d.key == key) return &d;
  return nullptr;
}

/// Six lines: all else by default.
inline const std::string six_lines = R"([scene]
end_time = 1.0
[[body]]
name = "block"
material = "steel"
shape = {kind = "box", min = [0, 0, 0], max = [0.4, 0.4, 0.4]}
)";

/// Every value that a case was given or got, a line each.
inline std::string decisions_of(const CaseReading& r) {
  std::string text;
  for (const auto& d : r.decisions) text += d.key + " = " + d.value + (d.given ? " given\n" : "\n");
  return text;
}

/// The reading of this text fails, and says each of these parts.
inline void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
  const auto what = refusal(text);
  EXPECT_NE(what, "") << text;
  for (const auto& part : parts) EXPECT_NE(what.find(part), std::string::npos) << part << "\n in: " << what;
}

}  // namespace tripoint::test

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "case_file.hpp"
#include "validation/case/case_document.hpp"

/// Every case of this repository: what `explain --resolved` prints is a case file, and the same case.
namespace tripoint::test {
namespace {

namespace fs = std::filesystem;

std::string decisions_and_id(const CaseReading& r) {
  std::string text;
  // The resolved text says it
  for (const auto& d : r.decisions)
    if (d.key != "case.id") text += d.key + " = " + d.value + (d.given ? " given\n" : "\n");
  return text + r.value.id;
}

bool is_case(const fs::path& file) {
  return file.extension() == ".toml" && file.filename().string().find(".ref.") == std::string::npos &&
         file.parent_path().filename() != "materials";
}

TEST(ResolvedCases, AreTheSameCasesAndExtendNothing) {
  const Folder folder;
  const fs::path copy = fs::path(folder.path()) / "cases";
  fs::copy(fs::path(TRIPOINT_SOURCE_DIR) / "cases", copy, fs::copy_options::recursive);
  std::map<std::string, std::string> before, texts;
  std::size_t extend = 0;
  for (const auto& entry : fs::recursive_directory_iterator(copy)) {
    if (!is_case(entry.path())) continue;
    const auto file = entry.path().string();
    const auto reading = read_case(file);
    before[file] = decisions_and_id(reading);
    texts[file] = resolved_case(reading);
    extend += read_toml(file).find("extends") != nullptr;
  }
  EXPECT_GT(before.size(), 200U);
  EXPECT_GT(extend, 50U);
  for (const auto& [file, text] : texts) std::ofstream(file, std::ios::binary) << text;
  for (const auto& [file, was] : before) {
    EXPECT_FALSE(has_short_forms(read_toml(file))) << file;
    EXPECT_EQ(decisions_and_id(read_case(file)), was) << file;
  }
}

}  // namespace
}  // namespace tripoint::test

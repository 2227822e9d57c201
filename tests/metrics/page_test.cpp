// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// docs/add-a-metric.md shows code of the tree: each of its blocks of C++ stands in one of these files, as it
/// is.
TEST(MetricPage, ShowsCodeAsItStands) {
  const std::filesystem::path root = TRIPOINT_SOURCE_DIR;
  const std::string page = text_of(root / "docs/add-a-metric.md");
  const std::string code = text_of(root / "validation/metrics/contact_quantities.cpp") +
                           text_of(root / "validation/metrics/motion_quantities.cpp") +
                           text_of(root / "tests/metrics/contact_test.cpp") +
                           text_of(root / "tests/metrics/known_runs_test.cpp");
  const std::string fence = "```cpp\n";
  int blocks = 0;
  for (auto at = page.find(fence); at != std::string::npos; at = page.find(fence, at)) {
    at += fence.size();
    const std::string block = page.substr(at, page.find("```", at) - at);
    EXPECT_NE(code.find(block), std::string::npos) << block;
    ++blocks;
  }
  EXPECT_EQ(blocks, 5);
}

}  // namespace

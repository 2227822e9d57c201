// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace tripoint::architecture {

/// The folder of the sources.
[[nodiscard]] inline const std::filesystem::path& root() {
  static const std::filesystem::path path = TRIPOINT_SOURCE_DIR;
  return path;
}
/// A whole file; empty where there is none.
[[nodiscard]] inline std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace tripoint::architecture

// SPDX-License-Identifier: BSD-3-Clause
#include "files/foreign_file.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <fstream>

#include "core/errors.hpp"

namespace tripoint {
namespace fs = std::filesystem;

void expect_regular_file(const std::string& path, std::uintmax_t most) {
  std::error_code error;
  const auto status = fs::status(path, error);
  if (!fs::exists(status)) throw InputError(path + ": cannot be read");
  if (!fs::is_regular_file(status)) throw InputError(path + ": is no regular file; refused");
  const auto size = fs::file_size(path, error);
  if (error) throw InputError(path + ": cannot be read");
  if (size > most)
    throw InputError(
        fmt::format("{}: has {} bytes, more than the {} that it can need; refused", path, size, most));
}

bool is_no_own_file(const std::string& path) {
  std::error_code error;
  const auto status = fs::symlink_status(path, error);
  if (!fs::exists(status)) return false;
  return !fs::is_regular_file(status) || fs::hard_link_count(path, error) > 1;
}

std::string text_of_regular_file(const std::string& path, std::uintmax_t most) {
  expect_regular_file(path, most);
  std::ifstream in(path, std::ios::binary);
  std::string text;
  std::array<char, 1 << 16> part;
  while (in.read(part.data(), part.size()) || in.gcount() > 0)
    text.append(part.data(), static_cast<std::size_t>(in.gcount()));
  if (!in.is_open() || in.bad()) throw InputError(path + ": cannot be read");
  return text;
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/plain_tree.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "core/errors.hpp"
#include "tables/nearest.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr std::array<std::pair<fs::file_type, const char*>, 5> strange{
    {{fs::file_type::symlink, "a link"},
     {fs::file_type::fifo, "a pipe"},
     {fs::file_type::socket, "a socket"},
     {fs::file_type::block, "a device"},
     {fs::file_type::character, "a device"}}};

/// @param status of the thing itself, not of what a link leads to
void expect_plain(const fs::path& path, fs::file_status status) {
  for (const auto& [type, word] : strange)
    if (status.type() == type)
      throw InputError(fmt::format(
          "{}: is {}, and nothing is taken but files and folders. Remove it, or make the runs again",
          printable(path.string(), 400), word));
}

}  // namespace

void expect_plain_tree(const fs::path& root) {
  const auto status = fs::symlink_status(root);
  expect_plain(root, status);
  if (!fs::is_directory(status)) return;
  for (const auto& entry : fs::recursive_directory_iterator(root))
    expect_plain(entry.path(), entry.symlink_status());
}

void copy_plain_tree(const fs::path& from, const fs::path& to) {
  expect_plain_tree(from);
  using Options = fs::copy_options;
  fs::copy(from, to, Options::recursive | Options::overwrite_existing | Options::copy_symlinks);
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>

namespace tripoint {

/// Allows a file that an engine left to be read only where it is a regular file of at most `most` bytes. A
/// pipe would never end, and a device is endless.
/// @throws InputError naming the kind of file that it is
void expect_regular_file(const std::string& path, std::uintmax_t most);
/// Whether this name is there but is no file of its own. It is then a link to elsewhere, a pipe, a device, a
/// folder, or a second name of another file. Nothing is opened.
[[nodiscard]] bool is_no_own_file(const std::string& path);
/// Its whole text. @throws InputError as above
[[nodiscard]] std::string text_of_regular_file(const std::string& path, std::uintmax_t most);

}  // namespace tripoint

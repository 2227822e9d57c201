// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/errors.hpp"

/// A TOML document as plain data. The rest of this room reads it, so that the parser stays behind one file.
namespace tripoint {

struct TomlNode {
  enum class Kind { boolean, integer, real, text, date, array, table };
  Kind kind = Kind::table;
  bool flag = false;
  std::int64_t integer = 0;
  double real = 0.0;
  std::string text;                                       ///< of a string; of a date as written
  std::vector<TomlNode> items;                            ///< array
  std::vector<std::pair<std::string, TomlNode>> members;  ///< table, in the order of the file
  SourcePlace place;                                      ///< of the value
  SourcePlace key_place;                                  ///< of its key, where it has one

  // Defaulted below: clang asks what a pair of a node can do, and a node must be whole by then.
  TomlNode() noexcept;
  TomlNode(const TomlNode&);
  TomlNode(TomlNode&&) noexcept;
  TomlNode& operator=(const TomlNode&);
  TomlNode& operator=(TomlNode&&) noexcept;
  ~TomlNode();

  [[nodiscard]] const TomlNode* find(std::string_view key) const;
  [[nodiscard]] TomlNode* find(std::string_view key);
};
inline TomlNode::TomlNode() noexcept = default;
inline TomlNode::TomlNode(const TomlNode&) = default;
inline TomlNode::TomlNode(TomlNode&&) noexcept = default;
inline TomlNode& TomlNode::operator=(const TomlNode&) = default;
inline TomlNode& TomlNode::operator=(TomlNode&&) noexcept = default;
inline TomlNode::~TomlNode() = default;

/// "a table", "an array", "a number" ...
[[nodiscard]] std::string_view kind_name(TomlNode::Kind);

/// The value as TOML text on one line, numbers with all their digits.
[[nodiscard]] std::string to_toml(const TomlNode&);

/// A copy of this process reads the text first, so that no text can end us.
/// @param limit wall clock of the copy [s]; then it is killed
/// @throws InputError (file, line, column) when the text breaks a bound of check_text, is no TOML, or kills
/// or holds up the copy
/// @throws std::system_error when there is no process to spare for the copy
[[nodiscard]] TomlNode parse_toml(const std::string& text, const std::string& file, double limit = 30.0);

/// One copy of this process tries many files before they are read, where each would have a copy of its own (1
/// ms). Says nothing of what is wrong in them; where the copy does not survive them all, each has its own as
/// before.
/// @throws std::system_error as parse_toml
void try_toml_files(const std::vector<std::string>& files, double limit = 30.0);

/// @throws InputError also when the file is not there, no regular file, empty or above the bound
[[nodiscard]] TomlNode read_toml(const std::string& file);

/// Bounds on third-party text before a parser sees it: size, line length, control bytes, length of dotted
/// keys. Also nesting by brackets and dots together, and a comma where a value belongs. @throws InputError
/// with line and column
void check_size(std::size_t bytes, const std::string& file);
void check_text(std::string_view text, const std::string& file);

}  // namespace tripoint

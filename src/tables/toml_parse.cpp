// SPDX-License-Identifier: BSD-3-Clause
// toml++ header-only, in this file alone. Its asserts become exceptions, so that no text can abort the
// program.
#include <stdexcept>
namespace tripoint {
[[noreturn]] inline void toml_assertion_failed() { throw std::logic_error("the parser lost its way here"); }
}  // namespace tripoint
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 1
#define TOML_ASSERT(expr) ((expr) ? static_cast<void>(0) : ::tripoint::toml_assertion_failed())
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <toml++/toml.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <fstream>
#include <mutex>
#include <new>
#include <system_error>
#include <unordered_set>
#include <vector>

#include "core/confined_copy.hpp"
#include "tables/nearest.hpp"
#include "tables/other_formats.hpp"
#include "tables/toml_node.hpp"

namespace tripoint {
namespace {

SourcePlace place_of(const toml::source_region& region, const std::string& file) {
  return {file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

bool before(const SourcePlace& a, const SourcePlace& b) {
  return a.line != b.line ? a.line < b.line : a.column < b.column;
}

TomlNode convert(const toml::node& from, const std::string& file);

TomlNode convert_table(const toml::table& table, const std::string& file) {
  TomlNode to;
  for (const auto& [key, value] : table) {
    TomlNode member = convert(value, file);
    member.key_place = place_of(key.source(), file);
    to.members.emplace_back(std::string(key.str()), std::move(member));
  }
  std::stable_sort(to.members.begin(), to.members.end(), [](const auto& a, const auto& b) {
    return before(a.second.key_place, b.second.key_place);
  });
  return to;
}

TomlNode convert(const toml::node& from, const std::string& file) {
  TomlNode to;
  switch (from.type()) {
    case toml::node_type::table:
      to = convert_table(*from.as_table(), file);
      break;
    case toml::node_type::array:
      to.kind = TomlNode::Kind::array;
      for (const auto& item : *from.as_array()) to.items.push_back(convert(item, file));
      break;
    case toml::node_type::string:
      to.kind = TomlNode::Kind::text;
      to.text = from.as_string()->get();
      break;
    case toml::node_type::integer:
      to.kind = TomlNode::Kind::integer;
      to.integer = from.as_integer()->get();
      break;
    case toml::node_type::floating_point:
      to.kind = TomlNode::Kind::real;
      to.real = from.as_floating_point()->get();
      break;
    case toml::node_type::boolean:
      to.kind = TomlNode::Kind::boolean;
      to.flag = from.as_boolean()->get();
      break;
    default:
      to.kind = TomlNode::Kind::date;
      break;
  }
  to.place = place_of(from.source(), file);
  return to;
}

TomlNode document_of(const std::string& text, const std::string& file) {
  TomlNode root = convert_table(toml::parse(text), file);
  const auto lines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
  root.place = {file, lines + 1, 0};  // a missing key is reported at the file's end
  return root;
}

/// Texts that a child survived, up to a bound: a case is read more than once, and many share a library.
class Survived {
 public:
  [[nodiscard]] bool has(const std::string& text) const {
    const std::lock_guard lock(one_);
    return texts_.count(text) > 0;
  }
  void add(const std::string& text) {
    constexpr std::size_t most_bytes = std::size_t{16} << 20;
    const std::lock_guard lock(one_);
    if (bytes_ + text.size() > most_bytes || !texts_.insert(text).second) return;
    bytes_ += text.size();
  }

 private:
  mutable std::mutex one_;
  std::unordered_set<std::string> texts_;
  std::size_t bytes_ = 0;
};

Survived& survived() {
  static Survived texts;
  return texts;
}

constexpr rlim_t room_of_child = rlim_t{2} << 30;  // [bytes]

/// Whether a child process makes a document of the text, and frees it, without dying. That is a pure function
/// of the text: where the child survives, the parent survives. (Upstream has an open report of unreachable
/// points that are reached.)
/// @throws std::system_error where there is no process to spare: no fault of the text, which is not read then
/// @throws InputError where the child takes longer than the limit
bool child_survives(const std::string& text, const std::string& file, double limit) {
  if (survived().has(text)) return true;
  const CopyBounds bounds{file, limit, room_of_child};
  const auto read = [&] {
    static_cast<void>(document_of(text, file));
    return std::string();
  };
  switch (read_in_confined_copy(read, bounds).how) {
    case CopyEnd::How::late:
      throw InputError({file, 0, 0},
                       fmt::format("could not be read within {:g} s: simplify its brackets and keys", limit));
    case CopyEnd::How::read:
    case CopyEnd::How::refused:  // it is worded where it counts
      survived().add(text);
      return true;
    default:
      return false;
  }
}

}  // namespace

const TomlNode* TomlNode::find(std::string_view key) const {
  for (const auto& [name, value] : members)
    if (name == key) return &value;
  return nullptr;
}
TomlNode* TomlNode::find(std::string_view key) {
  return const_cast<TomlNode*>(std::as_const(*this).find(key));
}

std::string_view kind_name(TomlNode::Kind kind) {
  static constexpr std::array<std::string_view, 7> names{"true or false", "an integer", "a number", "a text",
                                                         "a date",        "an array",   "a table"};
  return names[static_cast<std::size_t>(kind)];
}

namespace {

/// A basic string of TOML: quotes, backslashes and control characters escaped.
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      out += {'\\', c};
    else if (const auto code = static_cast<unsigned char>(c); code < 0x20 || code == 0x7f)
      out += fmt::format("\\u{:04x}", code);
    else
      out += c;
  }
  return out + '"';
}

}  // namespace

std::string to_toml(const TomlNode& n) {
  std::string out;
  switch (n.kind) {
    case TomlNode::Kind::boolean:
      return n.flag ? "true" : "false";
    case TomlNode::Kind::integer:
      return std::to_string(n.integer);
    case TomlNode::Kind::real:
      return fmt::format("{}", n.real);
    case TomlNode::Kind::text:
      return in_quotes(n.text);
    case TomlNode::Kind::date:
      return "a date";
    case TomlNode::Kind::array:
      for (const auto& item : n.items) out += (out.empty() ? "" : ", ") + to_toml(item);
      return "[" + out + "]";
    case TomlNode::Kind::table:
      for (const auto& [key, value] : n.members)
        out += (out.empty() ? "" : ", ") + key + " = " + to_toml(value);
      return "{" + out + "}";
  }
  return out;
}

namespace {

/// Whether toml++ ends in one of its asserts, which names no place.
bool loses_parser(const std::string& text, const std::string& file, double limit) {
  if (!child_survives(text, file, limit)) return true;
  try {
    static_cast<void>(toml::parse(text));
  } catch (const toml::parse_error&) {
    return false;
  } catch (const std::exception&) {
    return true;
  }
  return false;
}

/// First line with which the text up to its end loses the parser, by bisection: 20 parses of a million lines.
int line_that_loses_parser(const std::string& text, const std::string& file, double limit) {
  std::vector<std::size_t> ends;
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at + 1))
    ends.push_back(at + 1);
  const auto first = std::ranges::partition_point(
      ends, [&](std::size_t end) { return !loses_parser(text.substr(0, end), file, limit); });
  return static_cast<int>(first - ends.begin()) + 1;
}

}  // namespace

TomlNode parse_toml(const std::string& text, const std::string& file, double limit) {
  check_text(text, file);
  if (!child_survives(text, file, limit))
    throw InputError({file, 0, 0},
                     "the TOML parser could not read this text and stopped: simplify its brackets and keys");
  try {
    return document_of(text, file);
  } catch (const toml::parse_error& error) {
    if (const auto format = other_format(text); !format.empty())
      throw InputError(
          {file, 0, 0},
          fmt::format(
              "this is {}, and a case is TOML: {}", format,
              format.find("MJCF") != format.npos || format.find("URDF") != format.npos
                  ? fmt::format("`tripoint import {}` makes one of it", file)
                  : "`tripoint new NAME` writes one, whose bodies, shapes and materials take what this "
                    "file says (docs/case-file.md)"));
    throw InputError(place_of(error.source(), file),
                     fmt::format("no valid TOML: {}; write key = value, texts in quotes, [a, b] for lists",
                                 printable(error.description(), 300)));
  } catch (const std::exception& error) {
    throw InputError(
        {file, line_that_loses_parser(text, file, limit), 0},
        fmt::format("no valid TOML: {}; write key = value, texts in quotes, [a, b] for lists", error.what()));
  }
}

namespace {

/// @throws InputError where it is no file that a reader of TOML takes
std::string text_of_file(const std::string& file) {
  struct stat info {};
  if (stat(file.c_str(), &info) != 0)
    throw InputError({file, 0, 0}, fmt::format("cannot be read: {}", std::strerror(errno)));
  if (!S_ISREG(info.st_mode))
    throw InputError({file, 0, 0}, "is no regular file: give the path of a case file (*.toml)");
  if (info.st_size == 0)
    throw InputError({file, 0, 0}, "the file is empty: `tripoint new NAME` writes a case to start from");
  check_size(static_cast<std::size_t>(info.st_size), file);
  std::ifstream in(file, std::ios::binary);
  std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (!in) throw InputError({file, 0, 0}, "cannot be read");
  return text;
}

/// Those texts of the files that a parser may see.
std::vector<std::string> fit_texts(const std::vector<std::string>& files) {
  std::vector<std::string> texts;
  for (const auto& file : files) {
    try {
      std::string text = text_of_file(file);
      check_text(text, file);
      texts.push_back(std::move(text));
    } catch (const InputError&) {
      continue;  // it is worded where the file is read
    }
  }
  return texts;
}

}  // namespace

void try_toml_files(const std::vector<std::string>& files, double limit) {
  const auto texts = fit_texts(files);
  const auto read = [&] {
    for (const auto& text : texts) {
      try {
        static_cast<void>(document_of(text, ""));
      } catch (const std::exception&) {
        continue;
      }
    }
    return std::string();
  };
  if (read_in_confined_copy(read, {"case files", limit, room_of_child}).how != CopyEnd::How::read) return;
  for (const auto& text : texts) survived().add(text);
}

TomlNode read_toml(const std::string& file) { return parse_toml(text_of_file(file), file); }

}  // namespace tripoint

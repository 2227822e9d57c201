// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "validation/case/case_document.hpp"

/// A document as TOML that reads back as the same document.
namespace tripoint {
namespace {

using Kind = TomlNode::Kind;

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      out += fmt::format("\\{}", c);
    else if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (byte < 32 || byte == 127)
      out += fmt::format("\\u{:04X}", byte);
    else
      out += c;
  }
  return out + "\"";
}

std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? key : quoted(key);
}

/// With all its digits, and never as an integer.
std::string real_text(double value) {
  const std::string digits = fmt::format("{}", value);
  return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
}

std::string value_text(const TomlNode& n) {
  std::string out;
  switch (n.kind) {
    case Kind::text:
      return quoted(n.text);
    case Kind::real:
      return real_text(n.real);
    case Kind::array:
      for (const auto& item : n.items) out += (out.empty() ? "" : ", ") + value_text(item);
      return "[" + out + "]";
    case Kind::table:
      for (const auto& [key, value] : n.members)
        out += (out.empty() ? "" : ", ") + key_text(key) + " = " + value_text(value);
      return out.empty() ? "{}" : "{ " + out + " }";
    default:
      return to_toml(n);
  }
}

/// An array of arrays or tables has a line for each: a line is of bounded length.
std::string line_text(const std::string& key, const TomlNode& value) {
  const bool rows = value.kind == Kind::array && !value.items.empty() &&
                    (value.items.front().kind == Kind::table || value.items.front().kind == Kind::array);
  if (!rows) return fmt::format("{} = {}\n", key_text(key), value_text(value));
  std::string out = key_text(key) + " = [\n";
  for (const auto& item : value.items) out += "  " + value_text(item) + ",\n";
  return out + "]\n";
}

std::string table_text(const std::string& header, const TomlNode& table) {
  std::string out = "\n" + header + "\n";
  for (const auto& [key, value] : table.members) out += line_text(key, value);
  return out;
}

bool is_list_of_tables(const TomlNode& n) {
  return n.kind == Kind::array && !n.items.empty() &&
         std::all_of(n.items.begin(), n.items.end(),
                     [](const auto& item) { return item.kind == Kind::table; });
}

}  // namespace

std::string document_text(const TomlNode& document) {
  std::string head, tables;
  for (const auto& [key, value] : document.members) {
    if (key == "engines" && value.kind == Kind::table) {
      for (const auto& [name, engine] : value.members)
        tables += table_text(fmt::format("[engines.{}]", key_text(name)), engine);
    } else if (value.kind == Kind::table) {
      tables += table_text(fmt::format("[{}]", key_text(key)), value);
    } else if (is_list_of_tables(value)) {
      for (const auto& item : value.items) tables += table_text(fmt::format("[[{}]]", key_text(key)), item);
    } else {
      head += line_text(key, value);
    }
  }
  return head + tables;
}

}  // namespace tripoint

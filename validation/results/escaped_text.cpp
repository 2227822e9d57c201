// SPDX-License-Identifier: BSD-3-Clause
#include "validation/results/escaped_text.hpp"

#include <fmt/format.h>

#include <cstdint>

namespace tripoint {
namespace {

struct Letter {
  std::uint32_t code = 0;
  std::size_t bytes = 1;
  bool valid = false;
};

/// The letter that begins at `at`, by the rules of UTF-8: shortest form, no surrogates, at most U+10FFFF.
Letter letter_at(std::string_view text, std::size_t at) {
  const auto byte = [&](std::size_t k) {
    return static_cast<std::uint32_t>(static_cast<unsigned char>(text[k]));
  };
  const auto first = byte(at);
  if (first < 0x80) return {first, 1, true};
  const std::size_t bytes = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || at + bytes > text.size()) return {};
  std::uint32_t code = first & (0x7FU >> bytes);
  for (std::size_t k = 1; k < bytes; ++k) {
    if ((byte(at + k) & 0xC0U) != 0x80U) return {};
    code = (code << 6U) | (byte(at + k) & 0x3FU);
  }
  constexpr std::uint32_t least[5] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[bytes] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return {};
  return {code, bytes, true};
}

bool breaks_a_line(std::uint32_t c) {
  return (c >= 0x09 && c <= 0x0D) || c == 0x85 || c == 0x2028 || c == 0x2029;
}

/// Control characters, and marks that turn the direction of writing or are not seen.
bool is_hidden(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7F && c <= 0x9F) || (c >= 0x200B && c <= 0x200F) ||
         (c >= 0x202A && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF || c == 0xFFFE ||
         c == 0xFFFF;
}

bool is_word(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Markdown text for a character of one line. Entities, since a backslash does not keep a bar out of a table
/// everywhere.
std::string markdown_letter(std::string_view line, std::size_t k) {
  const char c = line[k], before = k > 0 ? line[k - 1] : ' ', after = k + 1 < line.size() ? line[k + 1] : ' ';
  switch (c) {
    case '&':
      return "&amp;";
    case '<':
      return "&lt;";
    case '>':
      return k == 0 ? "&gt;" : ">";  // a quotation; an arrow elsewhere
    case '|':
    case '`':
    case '*':
    case '~':
    case '[':
    case ']':
    case '\\':
    case '$':
      return fmt::format("&#{};", static_cast<int>(c));
    case '_':
      return is_word(before) && is_word(after) ? "_" : "&#95;";  // inside a word it emphasises nothing
    case '@':
    case '#':
      // No mention, no reference: a space of no width
      return is_word(after) ? std::string(1, c) + "&#8203;" : std::string(1, c);
    case ':':
      return after == '/' ? "&#58;" : ":";  // no link
    case '.':
      return k >= 3 && (line.substr(k - 3, 3) == "www" || line.substr(k - 3, 3) == "WWW") ? "&#46;" : ".";
    default:
      return std::string(1, c);
  }
}

}  // namespace

std::string one_line(std::string_view text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const auto letter = letter_at(text, at);
    if (!letter.valid)
      out += '?';
    else if (breaks_a_line(letter.code))
      out += ' ';
    else if (is_hidden(letter.code))
      out += '?';
    else
      out += text.substr(at, letter.bytes);
    at += letter.bytes;
  }
  return out;
}

std::string markdown(std::string_view text) {
  const auto line = one_line(text);
  std::string out;
  for (std::size_t k = 0; k < line.size(); ++k) out += markdown_letter(line, k);
  return out;
}

std::string xml(std::string_view text) {
  std::string out;
  for (const char c : one_line(text)) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string url_path(std::string_view text) {
  std::string out;
  for (const char c : text)
    out += is_word(c) || c == '-' || c == '.' || c == '_' || c == '~' || c == '/'
               ? std::string(1, c)
               : fmt::format("%{:02X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
  return out;
}

std::string command_text(std::string_view text, bool property) {
  std::string out, line;
  const auto end_line = [&] {
    for (const char c : one_line(line)) switch (c) {
        case '%':
          out += "%25";
          break;
        case ':':
          out += property ? "%3A" : ":";
          break;
        case ',':
          out += property ? "%2C" : ",";
          break;
        default:
          out += c;
      }
    line.clear();
  };
  for (const char c : text) {
    if (c != '\r' && c != '\n')
      line += c;
    else {
      end_line();
      out += c == '\r' ? "%0D" : "%0A";
    }
  }
  end_line();
  for (auto at = out.find("##["); at != std::string::npos; at = out.find("##[", at))
    out.insert(at + 1, 1, ' ');
  return out;
}

std::string without_commands(const std::string& lines) {
  std::string out;
  bool at_start = true;  // of a line, or behind its leading spaces: a runner trims them
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const char c = lines[k];
    out += c;
    if (at_start && c == ':' && lines.compare(k, 2, "::") == 0)
      out += ' ';
    else if (c == '#' && lines.compare(k, 3, "##[") == 0)
      out += ' ';
    at_start = c == '\n' || c == '\r' || (at_start && (c == ' ' || c == '\t'));
  }
  return out;
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "architecture/rules.hpp"

#include <array>
#include <cctype>

#include <fmt/format.h>

namespace tripoint::architecture {

std::string Offence::message() const { return fmt::format("{}:{}: {}\n    {}", path, line, why, text); }

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const auto end = text.find('\n');
    lines.push_back(text.substr(0, end));
    if (end == std::string_view::npos) break;
    text.remove_prefix(end + 1);
  }
  return lines;
}

std::vector<Offence> missing_licence(const Source& source) {
  const bool with_lammps = source.path.starts_with("adapters/lammps/") || source.path.starts_with("adapters/ranks/");
  const std::string_view licence = with_lammps ? "GPL-2.0-only" : "BSD-3-Clause";
  const std::string wanted = fmt::format("SPDX-License-Identifier: {}", licence);
  const auto lines = lines_of(source.text);
  for (std::size_t n = 0; n < lines.size() && n < 3; ++n) {
    if (lines[n].ends_with(wanted)) return {};
  }
  return {{source.path, 1, std::string(lines.empty() ? "" : lines.front()), fmt::format("no line '{}' at the top", wanted)}};
}

std::vector<Offence> too_long(const Source& source) {
  constexpr std::size_t most = 500;
  const auto lines = lines_of(source.text);
  if (lines.size() <= most) return {};
  return {{source.path, most + 1, std::string(lines[most]),
           fmt::format("{} lines, {} at most: split by subject", lines.size(), most)}};
}

namespace {

/// True where `line` holds `root` at the start of a path: nothing of a path before it, a name after it.
bool has_path_under(std::string_view line, std::string_view root) {
  const auto in_path = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '}' || c == '-' || c == '/';
  };
  for (auto at = line.find(root); at != std::string_view::npos; at = line.find(root, at + 1)) {
    const auto after = at + root.size();
    const bool starts = at == 0 || !in_path(line[at - 1]);
    if (starts && after < line.size() && std::isalnum(static_cast<unsigned char>(line[after])) != 0) return true;
  }
  return false;
}

}  // namespace

std::vector<Offence> machine_paths(const Source& source) {
  constexpr std::array<std::string_view, 6> roots{"/home/", "/root/", "/work/", "/mnt/", "/Users/", "/opt/"};
  std::vector<Offence> found;
  std::size_t number = 0;
  for (const auto line : lines_of(source.text)) {
    ++number;
    for (const auto root : roots) {
      if (has_path_under(line, root)) found.push_back({source.path, number, std::string(line), "a path of one machine"});
    }
  }
  return found;
}

}  // namespace tripoint::architecture

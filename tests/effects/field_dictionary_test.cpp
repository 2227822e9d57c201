// SPDX-License-Identifier: BSD-3-Clause
// The field dictionary of docs/model.md against the catalogue and against what the effects of all cases own.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assembly/all_effects.hpp"
#include "assembly/plan.hpp"
#include "validation/case/read_case.hpp"

namespace tripoint {
namespace {

namespace fs = std::filesystem;

/// What the dictionary says of a field, or of the components of one.
struct Entry {
  std::string components, per, unit, owners;
  bool operator==(const Entry&) const = default;
};
using Dictionary = std::map<std::string, Entry>;

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// "position.x" is the component x of "position".
std::pair<std::string, std::string> split(const std::string& name) {
  static const std::regex component("(.*)\\.(x|y|z|xx|yy|zz|yz|xz|xy|yx|zx|zy)");
  std::smatch found;
  return std::regex_match(name, found, component) ? std::pair{found[1].str(), found[2].str()}
                                                  : std::pair{name, std::string("1")};
}

std::string joined(const std::set<std::string>& words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : ", ") + word;
  return line;
}

/// Owners of every field, by name, in all cases and their modes.
std::map<std::string, std::set<std::string>> owners() {
  std::map<std::string, std::set<std::string>> found;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(TRIPOINT_SOURCE_DIR) / "cases")) {
    if (entry.path().extension() != ".toml" || entry.path().parent_path().filename() == "materials") continue;
    const Case value = read_case(entry.path().string()).value;
    for (const Mode mode : value.modes)
      for (const PlannedField& field : plan(scene_for(value, {.mode = mode,
                                                             .spacing = {},
                                                             .time_step = {},
                                                             .support_ratio = {},
                                                             .jitter = {},
                                                             .seed = {}}))
                                           .fields)
        found[field.name].insert(field.owner);
  }
  return found;
}

/// The text of every file that declares fields: those that several rooms know, those of liquids, and all
/// files of an effect. Names of scratch memory, which is no column, are left out.
std::string declarations() {
  static const std::regex scratch("no column of a scene\n[^;]*;");
  const fs::path src = fs::path(TRIPOINT_SOURCE_DIR) / "src";
  std::string text = text_of(src / "particles/catalogue.hpp");
  for (const char* room : {"liquids", "effects"})
    for (const auto& file : fs::recursive_directory_iterator(src / room))
      if (file.path().extension() == ".hpp" || file.path().extension() == ".cpp")
        text += text_of(file.path());
  return std::regex_replace(text, scratch, "");
}

/// Endings of the columns of a field of this kind.
std::vector<std::string> endings(const std::string& kind) {
  if (kind == "Vector") return {".x", ".y", ".z"};
  if (kind == "Symmetric") return {".xx", ".yy", ".zz", ".yz", ".xz", ".xy"};
  if (kind == "Matrix") return {".xx", ".xy", ".xz", ".yx", ".yy", ".yz", ".zx", ".zy", ".zz"};
  return {""};
}

/// The fields that they declare.
Dictionary catalogue() {
  static const std::regex declaration("\\b(Vector|Symmetric|Matrix|)Field(?:<(\\w+)>)? ([^;]*);"),
      one("\\w+\\{\"([^\"]+)\", \"([^\"]+)\"(,\\s+Per::(\\w+))?\\}");
  const std::string text = declarations();
  const auto owned_by = owners();
  Dictionary all;
  for (std::sregex_iterator line(text.begin(), text.end(), declaration), end; line != end; ++line) {
    const std::string kind = (*line)[1], type = (*line)[2], list = (*line)[3];
    for (std::sregex_iterator field(list.begin(), list.end(), one); field != end; ++field)
      for (const std::string& ending : endings(kind)) {
        const std::string name = (*field)[1].str() + ending;
        const auto [group, component] = split(name);
        const auto owner = owned_by.find(name);
        const Entry entry{component == "1" && (type == "Vec3" || type == "Quaternion") ? type : component,
                          (*field)[4].matched ? (*field)[4].str() : "particle", (*field)[2],
                          owner == owned_by.end() ? "nobody" : joined(owner->second)};
        const auto [at, first] = all.try_emplace(group, entry);
        if (first) continue;
        EXPECT_EQ(at->second.unit, entry.unit) << name;
        EXPECT_EQ(at->second.owners, entry.owners) << name;
        at->second.components += "," + component;
      }
  }
  return all;
}

std::string without_ticks(std::string cell) {
  std::erase(cell, '`');
  const auto first = cell.find_first_not_of(' ');
  return first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(' ') - first + 1);
}

/// Rows of the table of chapter 13: field with components and carrier, symbol, unit, owner, meaning. Neither
/// is said of a scalar of a particle.
Dictionary dictionary() {
  const std::string text = text_of(fs::path(TRIPOINT_SOURCE_DIR) / "docs/model.md");
  const auto from = text.find("<a id=\"13-fields\">"), to = text.find("<a id=\"14-readings\">");
  if (from == std::string::npos || to == std::string::npos) return {};
  std::istringstream lines(text.substr(from, to - from));
  Dictionary all;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| `")) continue;
    std::vector<std::string> cells;
    std::istringstream row(line.substr(1));
    for (std::string cell; std::getline(row, cell, '|');) cells.push_back(without_ticks(cell));
    EXPECT_EQ(cells.size(), 5U) << line;
    if (cells.size() != 5) continue;
    EXPECT_FALSE(cells[1].empty() || cells[4].empty()) << "no symbol or no meaning: " << line;
    std::istringstream words(cells[0]);
    std::string name, components = "1", carrier = "particle";
    words >> name;
    for (std::string word; words >> word;)
      (word.starts_with('(') ? carrier : components) =
          word.starts_with('(') ? word.substr(1, word.size() - 2) : word;
    EXPECT_TRUE(all.try_emplace(name, Entry{components, carrier, cells[2], cells[3]}).second)
        << "twice: " << name;
  }
  return all;
}

TEST(FieldDictionary, SaysOfEveryFieldWhatTheCatalogueAndTheEffectsSay) {
  const Dictionary page = dictionary(), code = catalogue();
  ASSERT_GT(code.size(), 50U);
  for (const auto& [name, entry] : code) {
    const auto row = page.find(name);
    const std::string right = "| `" + name + "` " + entry.components + " (" + entry.per + ") | SYMBOL | " +
                              entry.unit + " | " + entry.owners + " | MEANING |";
    EXPECT_TRUE(row != page.end() && row->second == entry)
        << "docs/model.md, chapter 13, should have the row\n"
        << right
        << "\nSYMBOL and MEANING stand in the fields.toml beside the declaration; make pages writes the row";
    EXPECT_NE(entry.owners, "nobody") << "no effect of any case owns " << name << ": delete it";
  }
  for (const auto& [name, entry] : page)
    EXPECT_TRUE(code.contains(name)) << "docs/model.md, chapter 13, has the row " << name
                                     << ", which is no field: make pages";
}

}  // namespace
}  // namespace tripoint

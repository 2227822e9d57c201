// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <sstream>

#include "core/errors.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/harness/adopt.hpp"

namespace tripoint {
namespace {

/// A table of a case file: its comment, its header line and its keys, as they are written.
struct Block {
  std::string header;  ///< "[scene]", "[[gate]]"; empty before the first table
  std::vector<std::string> lines;
};

bool is_header(const std::string& line) {
  static const std::regex header(R"(^\[\[?[A-Za-z][A-Za-z0-9_.\- "]*\]\]?\s*(#.*)?$)");
  return std::regex_match(line, header);
}

/// A comment right above a header belongs to the table below it.
std::vector<Block> blocks_of(const std::string& text) {
  std::vector<Block> blocks(1);
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (is_header(line)) {
      Block next;
      next.header = line.substr(0, line.rfind(']') + 1);
      auto& before = blocks.back().lines;
      while (!before.empty() && before.back().starts_with("#") && !(blocks.size() == 1 && before.size() == 1)) {
        next.lines.insert(next.lines.begin(), before.back());
        before.pop_back();
      }
      next.lines.push_back(line);
      blocks.push_back(next);
    } else {
      blocks.back().lines.push_back(line);
    }
  }
  for (auto& b : blocks)
    while (!b.lines.empty() && b.lines.back().empty()) b.lines.pop_back();
  return blocks;
}

/// Value of a key of a table as it is written; empty where the table has no such key.
std::string written(const Block& b, const std::string& key) {
  const std::regex line("^" + key + R"(\s*=\s*(.*?)\s*(#.*)?$)");
  for (const auto& text : b.lines)
    if (std::smatch found; std::regex_match(text, found, line)) return found[1];
  return {};
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) (c == '"' || c == '\\') ? (out += '\\', out += c) : out += c;
  return out + "\"";
}

bool is_dropped(const Block& b) {
  for (const char* word : {"[engines", "[[gate", "[[defect", "[[harmless"})
    if (b.header.starts_with(word)) return true;
  return b.header == "[[study]]" &&
         (!written(b, "engine").empty() || (!written(b, "mode").empty() && written(b, "mode") != "\"not paper\""));
}

/// [case] without the words that are of this suite: profiles, tags, modes, and what its own engines prove.
std::string case_text(const Block& b, const std::string& id, const EngineEntry& engine) {
  static constexpr std::array<const char*, 6> own{"id", "profiles", "tags", "modes", "claims", "expect"};
  std::string text;
  for (const auto& line : b.lines) {
    const bool left_out = std::any_of(own.begin(), own.end(), [&](const char* key) {
      return std::regex_match(line, std::regex("^" + std::string(key) + R"(\s*=.*)"));
    });
    if (!left_out) text += line + "\n";
    if (line == b.header) text += fmt::format("id = {}\n", quoted(id));
  }
  return text + fmt::format("claims = {}\nprofiles = [\"commit\"]\n",
                            quoted(fmt::format("{} {} is as accurate as when it was adopted", engine.name, engine.version)));
}

std::string study_text(const Block& b) {
  std::string text;
  for (const auto& line : b.lines)
    if (!line.starts_with("mode") && !line.starts_with("expect")) text += line + "\n";
  return text;
}

std::string engine_text(const AdoptedCase& c, const EngineEntry& engine) {
  std::vector<std::string> presets;
  for (const auto& row : c.rows)
    if (!row.gates.empty() && !is_default_preset(row.preset)) presets.push_back(quoted(row.preset));
  std::string text = fmt::format("[engines.{}]\nrequired = true\n", quoted(engine.name));
  if (!presets.empty()) text += fmt::format("preset = [{}]\n", fmt::join(presets, ", "));
  return is_own_solver(engine.name)
             ? text
             : text + "\n[engines.tripoint]\nrequired = false # it may run beside, and no gate here judges it\n";
}

std::string gate_text(const Gate& g) {
  std::string text = fmt::format("[[gate]]\nmetric = {}\nengine = {}\n", quoted(g.metric), quoted(g.engine));
  if (!g.preset.empty()) text += fmt::format("preset = {}\n", quoted(g.preset));
  if (g.level) text += fmt::format("level = {:.17g}\n", *g.level);
  if (g.limit) text += fmt::format("limit = {:.4g}\n", *g.limit);
  if (g.band) text += fmt::format("band = [{:.6g}, {:.6g}]\n", (*g.band)[0], (*g.band)[1]);
  return text + fmt::format("reason = {}\ndate = {}\n", quoted(g.reason), quoted(g.date));
}

bool is_lost(const AdoptedCase& c, const std::string& metric) {
  return std::all_of(c.rows.begin(), c.rows.end(), [&](const auto& r) {
    return std::none_of(r.gates.begin(), r.gates.end(), [&](const Gate& g) { return quoted(g.metric) == metric; });
  });
}

}  // namespace

std::string adopted_text(const std::string& source_text, const AdoptedCase& adopted, const EngineEntry& engine) {
  std::string text;
  for (const auto& b : blocks_of(source_text)) {
    if (is_dropped(b) || (b.header == "[[metric]]" && is_lost(adopted, written(b, "name")))) continue;
    if (!written(b, "file").empty() || (b.header == "[case]" && !written(b, "expect").empty()))
      throw InputError({adopted.source, 0, 0},
                       "leans on a file beside it, or declares a defect or a divergence: such a case is not adopted");
    if (b.header == "[case]")
      text += case_text(b, adopted.id, engine);
    else if (b.header == "[[study]]")
      text += study_text(b);
    else
      for (const auto& line : b.lines) text += line + "\n";
    text += "\n";
    if (b.header.empty())
      text += fmt::format(
          "# Adopted: `tripoint gate adopt` measured {} {} on this scene. The gates turn red where it drifts, to the worse or to "
          "the better.\n\n",
          engine.name, engine.version);
  }
  text += engine_text(adopted, engine);
  for (const auto& row : adopted.rows)
    for (const auto& gate : row.gates) text += "\n" + gate_text(gate);
  return text;
}

}  // namespace tripoint

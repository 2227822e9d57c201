// SPDX-License-Identifier: BSD-3-Clause
#include "validation/results/case_hash.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "files/job.hpp"
#include "scene/model.hpp"
#include "scene/scene_keys.hpp"
#include "scene/shared_terms.hpp"
#include "tables/table_reader.hpp"
#include "validation/case/read_case.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

// Size of the greatest mesh; no other file may be as large
constexpr std::uintmax_t most_read = std::uintmax_t{256} << 20;

/// Content of a file. For a file that every reader refuses for its size it is the size: a third-party case
/// may name one that fits in no memory.
std::string text_of(const fs::path& file) {
  std::error_code none;
  const std::uintmax_t size = fs::file_size(file, none);
  if (!none && size > most_read) return "more than is read: " + std::to_string(size);
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The number of a form, as an old key of [scene] said it; empty for a number that is the default.
std::string line_of_number(const Key& row, double number) {
  const std::string begin = "scene." + std::string(row.name) + "=";
  if (row.type == ValueType::word)
    return begin + "\"" + split_words(row.words).at(static_cast<std::size_t>(number)) + "\"\n";
  if (row.type == ValueType::flag) return number != 0.0 ? begin + "true\n" : "";
  return number == kept_number({}, row) ? "" : begin + show(number) + "\n";
}

/// A word of [model] as old files said it, so that a case that is only worded anew keeps its hash. Empty
/// where they had no other way.
std::vector<std::string> old_lines_of(const Decision& d) {
  for (const ModelTerm& t : model_terms()) {
    if (d.key != "model." + std::string(t.name)) continue;
    const ModelForm* form = form_of_word(t, std::string_view(d.value).substr(1, d.value.size() - 2));
    if (t.term == term::clamp)
      return {form == &t.forms.back() ? "scene.clamp=false\n" : "scene.clamp=true\n"};
    if (t.term && form == &t.forms.back())
      return {"scene.modes." + std::string(t.term->name) + "=" + d.value + "\n"};
    std::vector<std::string> lines;
    for (const auto& [key, number] : form->values)
      if (std::string line = line_of_number(key_row("scene", key), number); !line.empty())
        lines.push_back(line);
    return lines;
  }
  return {};
}

/// One key with its value, and with the contents of the file that it names.
std::string line_of(const Decision& d, const fs::path& folder) {
  std::string line = d.key + "=" + d.value + "\n";
  if (d.key.ends_with(".file") && d.value.size() > 2)
    line += text_hash(text_of(folder / d.value.substr(1, d.value.size() - 2))) + "\n";
  return line;
}

bool is_of_the_scene(const std::string& key) {
  static constexpr std::array<std::string_view, 11> rooms{"scene.",    "spring.", "joint.", "model.",
                                                          "material.", "body.",   "event.", "inflow.",
                                                          "outflow.",  "study.",  "input."};
  if (key == "case.modes" || key == "case.expect") return true;
  // Part of the judgement, not of the question
  if (key.starts_with("engines.")) return !key.ends_with(".required") && !key.ends_with(".refuses");
  return !key.ends_with(".source") &&
         std::any_of(rooms.begin(), rooms.end(), [&](auto room) { return key.starts_with(room); });
}

std::string hash_of(std::vector<std::string> lines) {
  std::sort(lines.begin(), lines.end());
  std::string all;
  for (const auto& line : lines) all += line;
  return text_hash(all);
}

}  // namespace

std::optional<CaseHashes> case_hashes(const std::string& file) {
  CaseReading reading;
  try {
    reading = read_case(file);
  } catch (const std::exception&) {
    return {};
  }
  const fs::path folder = fs::path(file).parent_path();
  const auto hash = [&](const auto& wanted) {
    std::vector<std::string> lines;
    for (const auto& d : reading.decisions)
      if ((d.given || d.reason.starts_with("library, ")) && wanted(d.key)) {
        auto old = old_lines_of(d);
        if (old.empty()) old.push_back(line_of(d, folder));
        lines.insert(lines.end(), old.begin(), old.end());
      }
    return hash_of(std::move(lines));
  };
  CaseHashes hashes;
  hashes.scene = hash(is_of_the_scene);
  hashes.reference =
      hash([](const std::string& key) { return key.starts_with("reference.") && !key.ends_with(".source"); });
  for (const auto& m : reading.value.metrics)
    hashes.metrics[m.name] = hash([&](const std::string& key) {
      return key.starts_with("metric." + m.name + ".") && !key.ends_with(".source");
    });
  for (const auto& e : reading.value.engines) hashes.required[e.name] = e.required;
  hashes.profiles = reading.value.profiles;
  return hashes;
}

}  // namespace tripoint

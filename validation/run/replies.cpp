// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/replies.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/foreign_json.hpp"

namespace tripoint {
using Reply = nlohmann::json;
namespace {

constexpr std::size_t most_letters = 4096;  // of a text that an engine says

Reply parsed(const std::string& printed) {
  return unfit_json(printed).empty() ? Reply::parse(printed, nullptr, false) : Reply();
}

std::string text(const Reply& from, const char* key) {
  const auto at = from.find(key);
  if (at == from.end() || at->is_null()) return {};
  return (at->is_string() ? at->get<std::string>() : at->dump()).substr(0, most_letters);
}

std::vector<std::string> words(const Reply& from, const char* key) {
  std::vector<std::string> list;
  if (const auto at = from.find(key); at != from.end() && at->is_array())
    for (const auto& word : *at)
      if (word.is_string()) list.push_back(word.get<std::string>().substr(0, most_letters));
  return list;
}

void read_info(const Reply& info, EngineEntry& entry) {
  entry.name = text(info, "name");
  entry.version = text(info, "version");
  entry.build = text(info, "build");
  if (const auto library = info.find("library"); library != info.end() && library->is_object()) {
    entry.library_path = text(*library, "path");
    entry.library_hash = text(*library, "hash");
  }
  entry.capabilities = words(info, "capabilities");
  if (const auto presets = words(info, "presets"); !presets.empty()) entry.presets = presets;
  if (const auto settings = info.find("settings"); settings != info.end() && settings->is_object())
    for (const auto& [key, value] : settings->items()) entry.settings[key] = text(*settings, key.c_str());
  if (const auto said = info.find("preset_words"); said != info.end() && said->is_object())
    for (const auto& [preset, value] : said->items())
      entry.settings["preset " + preset] = text(*said, preset.c_str());
  if (const auto d = info.find("deterministic"); d != info.end() && d->is_boolean())
    entry.deterministic = d->get<bool>();
  if (const auto defects = info.find("defects"); defects != info.end() && defects->is_array())
    for (const auto& d : *defects)
      entry.defects.push_back({text(d, "name"), text(d, "what"), text(d, "case")});
  if (const auto a = info.find("available"); a != info.end() && a->is_boolean() && !a->get<bool>()) {
    entry.available = false;
    entry.reason =
        text(info, "reason").empty() ? "says of itself that it is not available" : text(info, "reason");
  }
}

/// A name is a word of the report and a folder of its own. It must not lead elsewhere, or look like the name
/// of another engine.
bool is_plain(const std::string& name) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_' || c == '.';
  };
  return !name.empty() && name.size() <= 64 && name.front() != '.' &&
         std::all_of(name.begin(), name.end(), good);
}

}  // namespace

EngineEntry unavailable(EngineEntry entry, const std::string& reason) {
  entry.available = false;
  entry.reason = reason;
  return entry;
}

EngineEntry with_info(EngineEntry entry, const std::string& printed) {
  const std::string name_before = entry.name;
  const Reply info = parsed(printed);
  if (!info.is_object() || text(info, "contract") != "1" || text(info, "name").empty())
    return unavailable(entry, "--info did not print one JSON object of contract 1 with a name");
  read_info(info, entry);
  if (!is_plain(entry.name)) {
    entry.name = name_before;
    return unavailable(entry, "its name is not 1 to 64 letters, digits, '-', '_' or '.'");
  }
  if (entry.name == "all")
    return unavailable(entry,
                       "calls itself all, which is the word for all engines: give it a name of its own");
  for (const auto& preset : entry.presets)
    if (!is_plain(preset))
      return unavailable(
          entry, "one of its presets has a name that is not 1 to 64 letters, digits, '-', '_' or '.'");
  return entry;
}

Refusal refusal_for(const std::string& reason) {
  return reason.empty() ? Refusal{"it gives no reason", false} : Refusal{reason, true};
}

std::optional<Refusal> refusal_in(const std::string& printed) {
  const Reply answer = parsed(printed);
  if (!answer.is_object() || !answer.contains("can") || !answer["can"].is_boolean())
    return refusal_for("--check did not print {can, reason}");
  if (answer["can"].get<bool>()) return {};
  const auto reason = answer.find("reason");
  return refusal_for(reason != answer.end() && reason->is_string()
                         ? reason->get<std::string>().substr(0, most_letters)
                         : "");
}

}  // namespace tripoint

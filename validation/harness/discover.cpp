// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/discover.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <future>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "core/errors.hpp"
#include "core/nesting.hpp"
#include "validation/harness/process.hpp"
#include "validation/harness/sandbox.hpp"

namespace tripoint {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
namespace {

constexpr double info_limit = 10.0;  // [s], by the contract

std::string text(const Json& from, const char* key) {
  const auto at = from.find(key);
  if (at == from.end() || at->is_null()) return {};
  return at->is_string() ? at->get<std::string>() : at->dump();
}

std::vector<std::string> words(const Json& from, const char* key) {
  std::vector<std::string> list;
  if (const auto at = from.find(key); at != from.end() && at->is_array())
    for (const auto& word : *at)
      if (word.is_string()) list.push_back(word.get<std::string>());
  return list;
}

std::string name_of_file(const std::string& executable) {
  const std::string file = fs::path(executable).filename().string();
  return file.rfind("engine-", 0) == 0 ? file.substr(7) : file;
}

EngineEntry unavailable(EngineEntry entry, const std::string& reason) {
  entry.available = false;
  entry.reason = reason;
  return entry;
}

void read_info(const Json& info, EngineEntry& entry) {
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
    for (const auto& [preset, value] : said->items()) entry.settings["preset " + preset] = text(*said, preset.c_str());
  if (const auto d = info.find("deterministic"); d != info.end() && d->is_boolean()) entry.deterministic = d->get<bool>();
  if (const auto defects = info.find("defects"); defects != info.end() && defects->is_array())
    for (const auto& d : *defects) entry.defects.push_back({text(d, "name"), text(d, "what"), text(d, "case")});
  if (const auto a = info.find("available"); a != info.end() && a->is_boolean() && !a->get<bool>()) {
    entry.available = false;
    entry.reason = text(info, "reason").empty() ? "says of itself that it is not available" : text(info, "reason");
  }
}

bool is_program(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none) && ::access(path.c_str(), X_OK) == 0;
}

/// A name is a word of the report and a folder of its own: nothing that leads elsewhere, or looks like the name of another engine.
bool is_plain(const std::string& name) {
  const auto good = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' || c == '.'; };
  return !name.empty() && name.size() <= 64 && name.front() != '.' && std::all_of(name.begin(), name.end(), good);
}

/// Also one that is no program: an engine that was put there and cannot be started is a row that says so.
std::vector<std::string> engines_in(const fs::path& folder) {
  std::vector<std::string> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const auto name = entry.path().filename().string();
    const bool part_of_one = entry.path().has_extension() && !is_program(entry.path());  // engine-mine.cpp beside engine-mine
    if (name.rfind("engine-", 0) == 0 && entry.is_regular_file(none) && !part_of_one) found.push_back(fs::absolute(entry.path()).string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

struct Candidate {
  std::string path;
  bool joins = false;
};

/// Each executable once, also where a folder is listed twice or an engine is both on the path and asked for.
std::vector<Candidate> candidates(const std::vector<std::string>& extra) {
  std::vector<Candidate> list;
  std::set<std::string> seen;
  const auto add = [&](const std::string& path, bool joins) {
    if (seen.insert(fs::weakly_canonical(path).string()).second) list.push_back({fs::absolute(path).lexically_normal().string(), joins});
  };
  for (const auto& path : engines_in(fs::path(program_folder()) / "../libexec/tripoint")) add(path, false);
  for (const auto& path : extra) {
    if (!is_program(path)) throw EngineError(path + ": was asked for as an engine and is no executable file (an engine is a program, see docs/engines.md)");
    add(path, true);
  }
  const char* folders = std::getenv("TRIPOINT_ENGINE_PATH");
  std::istringstream path(folders ? folders : "");
  for (std::string folder; std::getline(path, folder, ':');)
    if (!folder.empty()) {
      const auto found = engines_in(folder);
      if (found.empty()) throw EngineError("TRIPOINT_ENGINE_PATH: " + folder + " holds no engine-NAME: put the engine there, or take the folder off");
      for (const auto& engine : found) add(engine, true);
    }
  return list;
}

/// Asks all at once. @throws EngineError for two of one name
std::vector<EngineEntry> ask_all(const std::vector<Candidate>& list) {
  std::vector<std::future<EngineEntry>> asked;
  for (const auto& c : list) asked.push_back(std::async(std::launch::async, ask_engine, c.path));
  std::vector<EngineEntry> engines;
  for (std::size_t k = 0; k < asked.size(); ++k) {
    auto entry = asked[k].get();
    entry.joins = list[k].joins;
    if (const auto* other = find_engine(engines, entry.name))  // neither may stand in the rows of the other without a word
      throw EngineError(fmt::format("{}: calls itself {}, which is the name of {}: give it a name of its own, or take one of the two away", entry.executable, entry.name, other->executable));
    engines.push_back(std::move(entry));
  }
  std::sort(engines.begin(), engines.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return engines;
}

}  // namespace

std::string program_folder() {
  std::error_code none;
  return fs::read_symlink("/proc/self/exe", none).parent_path().string();
}

EngineEntry ask_engine(const std::string& executable) {
  EngineEntry entry;
  entry.executable = executable;
  entry.name = name_of_file(executable);
  if (!is_program(executable)) return unavailable(entry, executable + " is not executable (chmod +x)");
  ProcessSpec spec;
  spec.argv = {executable, "--info"};
  spec.wall_limit = info_limit;
  const auto end = run_process(sandboxed(spec));
  if (end.how != ProcessEnd::How::exited || end.code != 0) return unavailable(entry, "--info " + describe(end));
  const auto info = nests_too_deep(end.output) ? Json() : Json::parse(end.output, nullptr, false);
  if (!info.is_object() || text(info, "contract") != "1" || text(info, "name").empty())
    return unavailable(entry, "--info did not print one JSON object of contract 1 with a name");
  read_info(info, entry);
  for (const auto& preset : entry.presets)
    if (!is_plain(preset)) return unavailable(entry, "one of its presets has a name that is not 1 to 64 letters, digits, '-', '_' or '.'");
  if (is_plain(entry.name)) return entry;
  entry.name = name_of_file(executable);
  return unavailable(entry, "its name is not 1 to 64 letters, digits, '-', '_' or '.'");
}

std::vector<EngineEntry> discover_engines(const std::vector<std::string>& extra) { return ask_all(candidates(extra)); }

std::vector<EngineEntry> discover_engines_named(const std::vector<std::string>& names) {
  auto list = candidates({});
  std::erase_if(list, [&](const Candidate& c) { return std::find(names.begin(), names.end(), name_of_file(c.path)) == names.end(); });
  return ask_all(list);
}

const EngineEntry* find_engine(const std::vector<EngineEntry>& engines, const std::string& name) {
  const auto at = std::find_if(engines.begin(), engines.end(), [&](const auto& e) { return e.name == name; });
  return at == engines.end() ? nullptr : &*at;
}

std::string engines_json(const std::vector<EngineEntry>& engines) {
  Json list = Json::array();
  for (const auto& e : engines)
    list.push_back({{"name", e.name}, {"version", e.version}, {"build", e.build}, {"library", {{"path", e.library_path}, {"hash", e.library_hash}}},
                    {"capabilities", e.capabilities}, {"presets", e.presets}, {"settings", e.settings}, {"deterministic", e.deterministic},
                    {"executable", e.executable}, {"available", e.available}, {"reason", e.reason}});
  return Json{{"engines", list}}.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tripoint

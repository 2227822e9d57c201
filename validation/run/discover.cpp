// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/discover.hpp"

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
#include "validation/run/process.hpp"
#include "validation/run/replies.hpp"
#include "validation/run/sandbox.hpp"
#include "validation/run/third_party_reader.hpp"

namespace tripoint {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
namespace {

constexpr double info_limit = 10.0;  // [s], by the contract

std::string name_of_file(const std::string& executable) {
  const std::string file = fs::path(executable).filename().string();
  return file.rfind("engine-", 0) == 0 ? file.substr(7) : file;
}

bool is_program(const fs::path& path) {
  std::error_code none;
  return fs::is_regular_file(path, none) && ::access(path.c_str(), X_OK) == 0;
}

/// Also one that is no program: an engine that was put there and cannot be started is a row that says so.
std::vector<std::string> engines_in(const fs::path& folder) {
  std::vector<std::string> found;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) {
    const auto name = entry.path().filename().string();
    // engine-mine.cpp beside engine-mine
    const bool part_of_one = entry.path().has_extension() && !is_program(entry.path());
    if (name.rfind("engine-", 0) == 0 && entry.is_regular_file(none) && !part_of_one)
      found.push_back(fs::absolute(entry.path()).string());
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
    if (seen.insert(fs::weakly_canonical(path).string()).second)
      list.push_back({fs::absolute(path).lexically_normal().string(), joins});
  };
  for (const auto& path : engines_in(fs::path(program_folder()) / "../libexec/tripoint")) add(path, false);
  for (const auto& path : extra) {
    if (!is_program(path))
      throw EngineError(path +
                        ": was asked for as an engine and is no executable file (an engine is a program, see "
                        "docs/engines.md)");
    add(path, true);
  }
  const char* folders = std::getenv("TRIPOINT_ENGINE_PATH");
  std::istringstream path(folders ? folders : "");
  for (std::string folder; std::getline(path, folder, ':');)
    if (!folder.empty()) {
      const auto found = engines_in(folder);
      if (found.empty())
        throw EngineError("TRIPOINT_ENGINE_PATH: " + folder +
                          " holds no engine-NAME: put the engine there, or take the folder off");
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
    // Neither may stand in the rows of the other without a word
    if (const auto* other = find_engine(engines, entry.name))
      throw EngineError(
          fmt::format("{}: calls itself {}, which is the name of {}: give it a name of its own, or take one "
                      "of the two away",
                      entry.executable, entry.name, other->executable));
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
  if (end.how != ProcessEnd::How::exited || end.code != 0)
    return unavailable(entry, "--info " + describe(end) + last_words(end.log_tail));
  try {
    if (!belongs_to_us(executable))
      try_of_third_party([&] { static_cast<void>(with_info(entry, end.output)); }, {"what --info printed"},
                         info_limit);
    return with_info(entry, end.output);
  } catch (const std::exception& e) {
    return unavailable(entry, e.what() + last_words(end.log_tail));
  }
}

std::vector<EngineEntry> discover_engines(const std::vector<std::string>& extra) {
  return ask_all(candidates(extra));
}

std::vector<EngineEntry> discover_engines_wanted(const std::vector<std::string>& names,
                                                 const std::vector<std::string>& extra) {
  auto list = candidates(extra);
  // What a third-party engine calls itself only the engine knows
  std::erase_if(list, [&](const Candidate& c) {
    return !c.joins && std::find(names.begin(), names.end(), name_of_file(c.path)) == names.end();
  });
  return ask_all(list);
}

std::vector<EngineEntry> discover_engines_named(const std::vector<std::string>& names) {
  auto list = candidates({});
  std::erase_if(list, [&](const Candidate& c) {
    return std::find(names.begin(), names.end(), name_of_file(c.path)) == names.end();
  });
  return ask_all(list);
}

const EngineEntry* find_engine(const std::vector<EngineEntry>& engines, const std::string& name) {
  const auto at = std::find_if(engines.begin(), engines.end(), [&](const auto& e) { return e.name == name; });
  return at == engines.end() ? nullptr : &*at;
}

std::string engines_json(const std::vector<EngineEntry>& engines) {
  Json list = Json::array();
  for (const auto& e : engines)
    list.push_back({{"name", e.name},
                    {"version", e.version},
                    {"build", e.build},
                    {"library", {{"path", e.library_path}, {"hash", e.library_hash}}},
                    {"capabilities", e.capabilities},
                    {"presets", e.presets},
                    {"settings", e.settings},
                    {"deterministic", e.deterministic},
                    {"executable", e.executable},
                    {"available", e.available},
                    {"reason", e.reason}});
  return Json{{"engines", list}}.dump(2, ' ', false, Json::error_handler_t::replace);
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <vector>

#include "core/defect.hpp"
#include "validation/case/engine_names.hpp"

namespace tripoint {

/// An engine executable as its `--info` describes it.
struct EngineEntry {
  std::string name, version, build;
  std::string library_path, library_hash;
  std::vector<std::string> capabilities, presets{default_preset};
  std::map<std::string, std::string> settings;
  std::vector<DefectEntry> defects;  ///< of the test build only
  bool deterministic = true;
  bool available = true;
  bool joins = false;      ///< found in a folder of TRIPOINT_ENGINE_PATH: it runs every case that it can
  std::string reason;      ///< why it is not available
  std::string executable;  ///< absolute path
};

/// Asks one executable; a program that does not answer by the contract within 10 s is an entry that is not
/// available.
[[nodiscard]] EngineEntry ask_engine(const std::string& executable);

/// Every engine-* in ../libexec/tripoint beside this program and in the folders of TRIPOINT_ENGINE_PATH, by
/// name; each is asked once.
/// @param extra executables that join (--engine PATH)
/// @throws EngineError when an extra path is no executable file, and when two executables call themselves by
/// one name
[[nodiscard]] std::vector<EngineEntry> discover_engines(const std::vector<std::string>& extra = {});

/// As discover_engines, but of the engines beside this program those of these names alone are started.
[[nodiscard]] std::vector<EngineEntry> discover_engines_wanted(const std::vector<std::string>& names,
                                                               const std::vector<std::string>& extra);

/// Engines of these names that stand beside this program or in TRIPOINT_ENGINE_PATH; no other is started.
[[nodiscard]] std::vector<EngineEntry> discover_engines_named(const std::vector<std::string>& names);

/// nullptr when there is none of that name.
[[nodiscard]] const EngineEntry* find_engine(const std::vector<EngineEntry>&, const std::string& name);

/// The document of `tripoint engines --json`.
[[nodiscard]] std::string engines_json(const std::vector<EngineEntry>&);

/// Folder of the executable that runs now.
[[nodiscard]] std::string program_folder();

}  // namespace tripoint

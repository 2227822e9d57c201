// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "validation/run/discover.hpp"
#include "validation/run/plan_runs.hpp"

/// Options that commands share, and spellings of earlier versions: they work, and are not in --help.
namespace CLI {
class App;
}

namespace tripoint {

/// The option --engines: `A,B` is these alone, `all,A` those of each case and A. --engine A is the earlier
/// spelling of the second.
struct EngineList {
  std::string list;
  std::vector<std::string> joining;
  [[nodiscard]] std::vector<std::string> words() const;
};
void add_engines_option(CLI::App& command, EngineList& choice);

/// Finds the engines of --engines and fills the selection; says which of those asked for are not there.
/// @throws EngineError when a path is no executable file
[[nodiscard]] std::vector<EngineEntry> engines_asked_for(const std::vector<std::string>& words, Selection&);

/// One line on stderr: the earlier spelling still works, and what is written now.
void note_earlier(const std::string& spelling, const std::string& now);

/// A flag of an earlier version: it works, says on stderr what is written now, and --help does not list it.
void add_earlier_flag(CLI::App& command, const std::string& flag, const std::string& now,
                      const std::function<void()>& set);

/// Of a command's description: the rest is in its own help.
[[nodiscard]] std::string first_sentence(std::string description);

/// A line for each command of a group: its name and the first sentence of its description.
[[nodiscard]] std::string commands_of(const CLI::App& group);

/// A command of other commands: called alone it lists them and ends with 2.
void list_when_alone(CLI::App& group, int& exit_code);

}  // namespace tripoint

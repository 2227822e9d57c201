// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "validation/run/discover.hpp"
#include "validation/run/folder_lock.hpp"
#include "validation/run/plan_runs.hpp"

/// Parts that the commands share: how errors become exit codes, and how lists and progress look.
namespace CLI {
class App;
}

namespace tripoint {

struct CaseReading;
struct Plan;

/// Calls the command and turns its exceptions into messages on stderr and the exit codes of the contract.
[[nodiscard]] int guarded(const std::function<int()>& command);

/// Plan of the quantities that a case simulates and stores. @throws InputError naming its file, also where
/// the scene as a whole asks for what cannot be
[[nodiscard]] Plan plan_of(const CaseReading&);

/// One line on stderr; further lines of it are indented, and none of them is a workflow command.
void say(const std::string& line);

/// One piece of the result, on stdout, at once. On a terminal its verdicts have colours, unless NO_COLOR is
/// set. No line of it is a workflow command, whatever name or reason it holds; names in it must have gone
/// through one_line().
void print(const std::string& text);

/// One line of the result, whatever names and reasons it holds.
void print_line(const std::string& line);

/// Workflow commands for a runner, as annotations_text() makes them.
void print_commands(const std::string& text);

/// Writes a file that is not there yet, in one act: no other can slip in. @param otherwise what to do where
/// one is there, as "choose another name" @throws InputError naming the path
void write_new_file(const std::string& path, const std::string& text, const char* otherwise);

/// "A,B" -> {"A", "B"}.
[[nodiscard]] std::vector<std::string> split(const std::string& list, char separator = ',');

/// The word of --engines for those of each case.
inline constexpr const char* all_engines = "all";

/// Names are those of engines, words with a slash are paths.
struct EngineWords {
  std::vector<std::string> names, paths;
};
[[nodiscard]] EngineWords sort_engine_words(const std::vector<std::string>& words);
/// Words with "./" before those that are files of this folder.
[[nodiscard]] std::vector<std::string> files_as_paths(std::vector<std::string> words);

/// The engines that a selection can need; `paths` join.
[[nodiscard]] std::vector<EngineEntry> discover_selected(const Selection&,
                                                         const std::vector<std::string>& paths);

/// "no engine is named x (did you mean `y`?)"
[[nodiscard]] std::string no_such_engine(const std::string& name, const std::vector<EngineEntry>& engines);

/// Folder that a command writes to where no --out is given: one for each command and case, so that none
/// overwrites another's report.
[[nodiscard]] std::string own_folder(const std::string& command, const std::string& case_id);

/// A results.json, or that of the folder of a report. @throws InputError where neither is there
[[nodiscard]] std::string results_file(const std::string& path);

/// The switch --sandbox. Where it is wanted, sandbox_third_parties() is called before the first engine is
/// asked.
void add_sandbox_flag(CLI::App& command, bool& wanted);

/// Makes the folder of --out before anything runs. @throws InputError that says why it cannot be made or
/// written to
void make_folder(const std::string& out);

/// The same, and no other call has it while the result lives: for commands that make runs or reports in it.
/// @throws InputError also where another call has it
[[nodiscard]] FolderLock hold_folder(const std::string& out);

/// Message about a command or option that does not exist, with the nearest one; empty where none is mistyped.
[[nodiscard]] std::string mistyped_word(const CLI::App& app, int argc, char** argv);

/// Opens the standard streams that the caller has closed. Otherwise the next opened file would take their
/// place, and our words would go into it.
void hold_standard_streams();
/// Whether all that was printed has arrived; says so where it has not (a full disk, a closed pipe).
[[nodiscard]] bool output_arrived();

struct Shard {
  int i, n;  ///< the i-th of n, from 1
};
/// "i/n". @throws InputError
[[nodiscard]] Shard read_shard(const std::string& text);

/// Now, in UTC: "2026-01-31T12:00:00Z".
[[nodiscard]] std::string date_now();

/// The command line as it was typed, for the report.
void remember_command_line(int argc, char** argv);
[[nodiscard]] const std::string& command_line();

/// Becomes a program of the reports, which also takes Ctrl-C then.
/// @param program  its file in the folder of the reports, for example "view.py"
/// @param options  its options, each with its value: --out=FILE
/// @param operands its operands, each a word of its own even where it begins with a hyphen
/// @return never
/// @throws EngineError where there is no such program, or no Python that starts it
[[noreturn]] void hand_over(const std::string& program, const std::vector<std::string>& options,
                            const std::vector<std::string>& operands);

}  // namespace tripoint

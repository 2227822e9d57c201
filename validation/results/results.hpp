// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/not_a_number.hpp"
#include "files/status.hpp"
#include "validation/case/choices.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/metrics/ladder_limit.hpp"
#include "validation/metrics/metric_value.hpp"
#include "validation/metrics/order.hpp"
#include "validation/results/case_hash.hpp"
#include "validation/results/verdict.hpp"

/// Content of results.json (contracts: results.json, format 1), as plain data. Verdicts in it are always
/// recomputed: judge.hpp.
namespace tripoint {

struct Cost {
  double cpu_s = 0.0, wall_s = 0.0, setup_cpu_s = 0.0;  ///< [s]
  double peak_bytes = 0.0;
  double pairs = 0.0, steps = 0.0, iterations = 0.0;  ///< counted by the engine
  /// Time of the scene that the steps took it through [s]
  double simulated_s = 0.0;
  /// At the end: with inflowing particles, without lost ones
  double particles = 0.0;
  /// In user space, of the whole process; 0 = not counted
  double instructions = 0.0;
  /// CPU seconds of the timed runs (--timing), one a round [s]; empty = it was run once
  std::vector<double> repeats;
  /// Of the instructions: counter (the processor's own), callgrind (a second run)
  std::string counted_by;
};

struct Knobs {
  double spacing = 0.0;    ///< [m]
  double time_step = 0.0;  ///< as the engine itself says [s]; 0 = it has none
  double support_ratio = 0.0;
  std::optional<double> walkers, iterations;
  JudgedMode mode = JudgedMode::none;
  int threads = 1;
  std::uint64_t seed = 1;
  double jitter = 0.0;  ///< [spacings]
};

/// One run of one engine.
struct RunRow {
  Knobs knobs;
  std::map<StudyAxes, double> levels;  ///< of a study -> the level that this run is
  bool base = false;                   ///< the case's own resolution
  std::string group;                   ///< runs of one group differ by seed only; empty = alone
  std::string input;                   ///< "key=VALUE" where the run is one end of an uncertain input
  Status status = Status::ok;
  std::string reason;      ///< of a status that is not ok, and the message of a run that is ok
  bool comparable = true;  ///< false: the engine read back another scene than it was given
  std::map<std::string, MetricValue> metrics;
  Cost cost;
  std::string state_hash, time_step_bound;
  std::string folder;  ///< of job, trajectory and log, relative to results.json
};

struct OrderRow {
  std::string metric;
  StudyAxes axes;
  JudgedMode mode = JudgedMode::none;
  Order order;
  LadderLimit limit;
  double formal = 0.0;
  std::vector<double> step, error, uncertainty;  ///< points that were fitted
  /// Standard uncertainty of each level by the grid convergence index, which knows no truth; empty = no
  /// formal order is declared
  std::vector<double> numerical;
};

/// Whether what was measured is right, beside the verdict of the gate, which says whether it is as expected:
/// physics.hpp.
enum class Physics { right, known_defect, wrong, unknown };
constexpr WordTable<4> word_table(Physics) {
  return {"physics", {"right", "known defect", "wrong", "not known"}};
}

/// One gate applied to one engine's run (or seeds of a run, pooled), or to a fitted order.
struct GateRow {
  std::string metric;
  JudgedMode mode = JudgedMode::none;
  std::optional<double> level;
  double value = 0.0;               ///< NaN where there is none
  double uncertainty = 0.0;         ///< standard
  Uncertainty budget;               ///< its parts
  std::optional<double> low, high;  ///< an order's 95 % interval
  Verdict verdict = Verdict::missing;
  std::string why;                            ///< one sentence for a verdict that is not pass
  std::optional<FitClass> expect, fit_class;  ///< as a study declares it, and as fitted
  Gate gate;                                  ///< limit, band, reason, file and line
  /// An acceptance limit that holds, though a defect is declared that excuses from it
  bool excused = false;
  double used = not_a_number;  ///< share of its limit: share_of_limit()
  Physics physics = Physics::unknown;
  std::string defect;  ///< NAME of the defect that its gate declares; empty = none
};

/// One row of the matrix: an engine with a preset.
struct EngineRow {
  std::string name, version, preset = default_preset;
  /// Of the engine's own library, as it reported; empty = it reported none
  std::string library_path, library_hash;
  /// Of a third-party engine: its program, and the hash of it when it ran
  std::string executable, executable_hash;
  bool deterministic = false;  ///< as the engine says
  bool required = false;
  std::string refuses;  ///< words of the refusal that the case declares; empty = it declares none
  Status status = Status::ok;
  std::string reason;
  std::vector<RunRow> runs;
  std::vector<OrderRow> order;
  std::vector<GateRow> gates;
  Physics physics = Physics::unknown;  ///< the worst of its rows
  std::vector<std::string> defects;    ///< names of the known defects among them
};

struct EquivalenceRow {
  std::string a, b, metric;
  double difference = 0.0, uncertainty = 0.0;
  std::optional<double> margin;         ///< the limit that the case sets for this metric
  double error_a = 0.0, error_b = 0.0;  ///< to truth
  Equivalence verdict = Equivalence::no_margin;
};

/// CPU seconds of two engines (presets, modes) at the case's own resolution.
struct TimingPair {
  std::string a, b;
  double ratio = 0.0;     ///< of the medians, a over b
  bool resolved = false;  ///< it is outside the noise floor
};

struct CaseResult {
  std::string id, title, requirement, claims, file;
  CaseKind kind = CaseKind::verification;
  Expect expect = Expect::pass;
  CaseVerdict verdict = CaseVerdict::missing;
  Physics physics = Physics::unknown;  ///< the worst of its engines
  int exit_code = 0;
  std::vector<std::string> tags;  ///< as declared
  ReferenceChoice reference;
  std::vector<MetricChoice> metrics;  ///< as declared
  std::vector<Study> studies;         ///< as declared
  std::vector<Gate> gates;            ///< as declared: the judge starts from these
  /// Engines that the case was adopted for: none may be left out by --engines
  std::vector<std::string> adopted;
  std::vector<EngineRow> engines;
  std::vector<EquivalenceRow> equivalence;
  std::map<std::string, double> ledger;
  std::vector<std::string> problems;  ///< why the verdict is not pass, beyond the gates' own rows
  /// --timing; 0 = runs were made once, and nothing says how far their times may be off
  int timing_rounds = 0;
  double timing_floor = not_a_number;  ///< factor >= 1 by which an engine differed from itself
  std::string repeat;
  std::optional<CaseHashes> hashes;  ///< of the case that was run; older results do not say
};

struct Tool {
  std::string version, commit, compiler, flags, cpu;
  int cores = 0;
};

struct Results {
  int format = 1;
  Tool tool;
  std::string command, profile, date;
  CaseVerdict verdict = CaseVerdict::missing;
  std::uint64_t seed = 1;
  int exit_code = 0;
  std::string history;               ///< file of JSON lines, relative to results.json; empty = none is kept
  std::string shard;                 ///< "i/n", empty = whole
  bool interrupted = false;          ///< Ctrl-C ended it before every planned case was complete
  std::vector<std::string> planned;  ///< ids of every case that this run had to do
  /// Files, folders and ids that were asked for; empty = the cases beside the program
  std::vector<std::string> what;
  std::string tag;  ///< --tag; empty = any
  /// These are all cases of `what`, `tag` and `profile`: not with -k or --last-failed, and older results do
  /// not say
  bool filter_known = false;
  bool seed_given = false;                ///< --seed replaced the cases' own
  std::vector<std::string> only_engines;  ///< --engines; empty = all
  /// Engines that the command line named, by --engines: none of them passes unjudged
  std::vector<std::string> asked;
  std::vector<std::string> problems;
  std::vector<CaseResult> cases;
};

[[nodiscard]] std::string results_text(const Results&);
/// @throws InputError naming the file and the field that is missing or of the wrong kind
[[nodiscard]] Results read_results(const std::string& path);
/// One run as results.json holds it, and back again. @throws InputError naming the place and the fault
[[nodiscard]] std::string run_row_text(const RunRow&);
[[nodiscard]] RunRow read_run_row(const std::string& text, const std::string& place);
/// This build, this machine.
[[nodiscard]] Tool this_tool();

}  // namespace tripoint

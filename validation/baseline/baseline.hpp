// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/judge/remarks.hpp"
#include "validation/results/case_hash.hpp"

/// The last accepted figures of a case: `baselines/<subject>/<case>.toml` beside the folder `cases`.
/// `tripoint gate accept` writes it, nothing else does.
namespace tripoint {

/// One gate as it was accepted: its metric, its limits, and the value measured then.
struct AcceptedGate {
  std::string metric, engine, preset, allows;  ///< allows: "limit 0.01", as the gate describes itself
  JudgedMode mode = JudgedMode::none;
  std::optional<double> level;
  double room = 0.0;                           ///< how much it lets pass, one number: allowance_of()
  double value = 0.0, uncertainty = 0.0;       ///< in the row that uses most of it
  std::optional<FitClass> fit_class;           ///< of an order
  double first_room = 0.0, first_value = 0.0;  ///< of the first baseline: against creep
  /// Sum of ln(new/old) of every loosening since then; tightening takes nothing off
  double loosened = 0.0;
  /// Each edge as it was accepted; baselines of older versions have only `allows`
  std::optional<double> limit, at_least, drift;
  std::optional<std::array<double, 2>> band;
  /// Hash of the metric: CaseHashes::metrics; empty = it was accepted by an older version
  std::string measures;
};

/// Counts of one run. Seconds are never among them: they belong to the machine.
struct AcceptedCost {
  std::string run;  ///< engine and folder
  double pairs = 0.0, steps = 0.0, instructions = 0.0;
  /// How and where the instructions were counted: they are compared only with the same
  std::string counted_on;
};

/// The engine whose figures were accepted. Its program is known where it is a third party's.
struct AcceptedEngine {
  std::string name, version, executable;  ///< executable: hash of its program
};

struct Acceptance {
  std::string date, commit, reason;
};

/// What happens to accepted rows that the results lack. Neither: the acceptance is refused.
struct Lacking {
  bool keep = false;  ///< rows of engines that did not run stay, where scene and reference are as they were
  bool drop = false;  ///< what does not stay is removed
};

struct Baseline {
  std::string id, case_hash;  ///< of the case file's text
  std::uint64_t seed = 1;
  std::vector<Acceptance> accepted;  ///< oldest first
  std::vector<AcceptedGate> gates;
  std::vector<AcceptedCost> cost;
  std::vector<AcceptedEngine> engines;  ///< that the gates judge; older versions kept none
  std::string scene, reference;         ///< CaseHashes; empty = accepted by an older version
  std::vector<std::string> profiles;    ///< that the case belonged to
  std::vector<std::string> required;    ///< engines that it required
  /// The file is as `gate accept` wrote it; false = it was edited by hand
  bool sealed = true;
  /// Gates that were accepted once and that an acceptance has let go since
  int removed = 0;
};

/// Where the baseline of a case file lies: below the folder `baselines` beside the nearest folder `cases`
/// above it; else in `baselines` beside the file.
/// @param root a folder that stands for `baselines`: another copy of it, such as that of the branch that a
/// change is to go into
[[nodiscard]] std::string baseline_file(const std::string& case_file, const std::string& root = {});
/// The folder `baselines` that a case file belongs to.
[[nodiscard]] std::string baseline_folder(const std::string& case_file);
/// Whether the suite that a case belongs to keeps baselines at all: the folder is there.
[[nodiscard]] bool keeps_baselines(const std::string& case_file);
/// The folder of cases that a case file belongs to: `cases` beside `baselines`, or the folder that it lies
/// in.
[[nodiscard]] std::string folder_of_cases(const std::string& case_file);

/// The bytes of a file; none where it cannot be read.
[[nodiscard]] std::string text_of_file(const std::string& file);

/// @throws InputError with the place of the fault
[[nodiscard]] Baseline read_baseline(const std::string& file);
[[nodiscard]] std::string baseline_text(const Baseline&);

/// The allowance of a gate: its limit; half the width of a band; 1/at_least (of an order, and of anything
/// else).
[[nodiscard]] double allowance_of(const Gate&);

/// Which edge of `now` lets pass what `old` did not: both ends of a band count, and an edge that is gone.
/// Empty = none.
[[nodiscard]] std::string looser_edge(const AcceptedGate& now, const AcceptedGate& old);

/// A band of an error that has moved toward zero and become no wider: an engine that errs less, not a limit
/// that allows more.
[[nodiscard]] bool is_nearer_truth(const AcceptedGate& now, const AcceptedGate& old);

/// The baseline that these results would be, after the one that was accepted before.
[[nodiscard]] Baseline accepted_from(const CaseResult&, const Tool&, std::uint64_t seed,
                                     const Baseline* before, const Acceptance&);

/// Results against their baselines. An edge looser than the accepted one, a lost gate, or one whose engine
/// was there and refused or ended early: error, exit 4. So is another metric, scene, reference, or an engine
/// that is required no more. A value that has moved by more than the `drift` that its gate states and its
/// uncertainty: error, exit 1. More than 1 % more pairs or steps at the accepted seed: error, exit 6. The
/// same holds for instructions counted in the same way on the same machine. Warning: where no drift is
/// stated, a value worse than the accepted or the first one by more than a tenth. Another class of
/// convergence or another case file is a warning too. Cases of a suite that keeps baselines and that have
/// none yet: one warning that names them; with `required` an error of each, exit 4.
[[nodiscard]] std::vector<Remark> baseline_remarks(const Results&, bool required = false,
                                                   const std::string& root = {});

/// What a change may not do to the suite itself, judged by baselines of another place (`root`, as of the
/// branch that it is to go into): a case or a folder that is a link, a baseline that is gone here and not
/// there, a case that has a baseline and is not in the results. Error, exit 4. Links are named without a root
/// too.
[[nodiscard]] std::vector<Remark> suite_remarks(const Results&, bool required, const std::string& root = {});

/// The engines themselves: a program that is not the one that made the results (error, exit 4), a version
/// lower than the accepted one, and a flag `deterministic` that the accepted values of the same program belie
/// (warnings).
[[nodiscard]] std::vector<Remark> engine_remarks(const Results&, const std::string& root = {});

/// Baselines whose case is gone, or has left a profile that it was accepted in: error, exit 4. All suites of
/// the results are searched.
[[nodiscard]] std::vector<Remark> lost_case_remarks(const Results&, const std::string& root = {});

/// Accepted gates that are not judged here, by engine: one that is missing on this machine, or that was left
/// out by name.
[[nodiscard]] std::map<std::string, int> accepted_but_absent(const Results&, const std::string& root = {});

/// Accepts the cases with these ids (empty: all). @return what changed, old and new, and the sum of all
/// loosenings since the first baseline
/// @throws InputError for an id that the results do not hold, where a case is not green, and where they lack
/// accepted rows
[[nodiscard]] std::string accept(const Results&, const std::vector<std::string>& ids, const Acceptance&,
                                 const Lacking& = {});

/// Removes the baselines of cases that are no more. @return text that names the removed ones
/// @throws InputError for an id that has no baseline, and for one whose case is still there
[[nodiscard]] std::string accept_removal(const std::vector<std::string>& ids, const Acceptance&);

}  // namespace tripoint

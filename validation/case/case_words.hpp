// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "tables/words.hpp"

/// The words of a case file for the choices of the judge.
namespace tripoint {

/// Truth that a case is judged against: an exact solution, an experiment, another engine.
enum class CaseKind { verification, validation, comparison };
constexpr WordTable<3> word_table(CaseKind) {
  return {"kind of case", {"verification", "validation", "comparison"}};
}

/// Result that must be measured for a case to pass. Paper diverges: the printed form does, the corrected one
/// does not.
enum class Expect { pass, diverges, paper_diverges, defect };
constexpr WordTable<4> word_table(Expect) {
  return {"expectation", {"pass", "diverges", "paper-diverges", "defect"}};
}

/// How the error of a study falls with refinement.
enum class FitClass {
  asymptotic,
  preasymptotic,
  plateau,
  roundoff,
  oscillating,
  diverging,
  noise_limited,
  too_few
};
constexpr WordTable<8> word_table(FitClass) {
  return {"class of convergence",
          {"asymptotic", "preasymptotic", "plateau", "roundoff", "oscillating", "diverging", "noise-limited",
           "too-few"}};
}

/// Quantity that a study refines.
enum class Axis { spacing, time_step, support_ratio, walkers, iterations };
constexpr WordTable<5> word_table(Axis) {
  return {"axis of a study", {"spacing", "time_step", "support_ratio", "walkers", "iterations"}};
}

/// How a metric makes one number of errors in space and time; metric_norms() describes each.
enum class Norm {
  L1,
  L2,
  L2raw,
  Linf,
  chi,
  max,
  rms,
  L2mean,
  mean,
  stationary,
  final,
  drift,
  frequency,
  swing,
  slope
};
constexpr WordTable<15> word_table(Norm) {
  return {"norm of a metric",
          {"L1", "L2", "L2raw", "Linf", "chi", "max", "rms", "L2mean", "mean", "stationary", "final", "drift",
           "frequency", "swing", "slope"}};
}
/// Whether a norm is of one frame (then `at` chooses it), or over time (then `window` does).
[[nodiscard]] constexpr bool is_spatial(Norm norm) {
  return norm == Norm::L1 || norm == Norm::L2 || norm == Norm::L2raw || norm == Norm::Linf ||
         norm == Norm::chi;
}

/// Whether a norm looks at how a single number swings: it then does not matter what is subtracted from it.
[[nodiscard]] constexpr bool swings(Norm norm) { return norm == Norm::frequency || norm == Norm::swing; }

/// For a run: the form of the model that our solver made it in; none for a foreign engine. For a gate or a
/// study: the runs that it judges. none = all; not paper = every engine's but ours in the printed form. In
/// the order of the words.
enum class JudgedMode { none, corrected, not_paper, paper };
constexpr WordTable<4> word_table(JudgedMode) { return {"mode", {"", "corrected", "not paper", "paper"}}; }
/// Whether a run of one mode is among the wanted ones.
[[nodiscard]] constexpr bool fits(JudgedMode wanted, JudgedMode run) {
  return wanted == JudgedMode::none ||
         (wanted == JudgedMode::not_paper ? run != JudgedMode::paper : run == wanted);
}
/// " paper": as a part of a sentence; nothing where there is none.
[[nodiscard]] inline std::string after_blank(JudgedMode mode) {
  return mode == JudgedMode::none ? std::string() : " " + std::string(to_string(mode));
}

}  // namespace tripoint

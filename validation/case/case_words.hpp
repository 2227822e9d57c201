// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/words.hpp"

/// The words that a case file has for what the judge tells apart.
namespace tripoint {

/// Against what a case is judged: an exact solution, an experiment, another engine.
enum class CaseKind { verification, validation, comparison };
constexpr WordTable<3> word_table(CaseKind) { return {"kind of case", {"verification", "validation", "comparison"}}; }

/// What must be measured for a case to pass. Paper diverges: the printed form does, the corrected one does not.
enum class Expect { pass, diverges, paper_diverges, defect };
constexpr WordTable<4> word_table(Expect) { return {"expectation", {"pass", "diverges", "paper-diverges", "defect"}}; }

/// How the error of a study falls with refinement.
enum class FitClass { asymptotic, preasymptotic, plateau, roundoff, oscillating, diverging, noise_limited, too_few };
constexpr WordTable<8> word_table(FitClass) {
  return {"class of convergence",
          {"asymptotic", "preasymptotic", "plateau", "roundoff", "oscillating", "diverging", "noise-limited", "too-few"}};
}

}  // namespace tripoint

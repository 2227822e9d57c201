// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "tables/settings.hpp"
#include "tables/words.hpp"

namespace tripoint {

/// Where a truth comes from.
enum class ReferenceKind { analytic, discrete_exact, mms, self, engine, experiment, invariant, bound };
constexpr WordTable<8> word_table(ReferenceKind) {
  return {"kind of reference",
          {"analytic", "discrete_exact", "mms", "self", "engine", "experiment", "invariant", "bound"}};
}

/// The truth that a case names. The judge reads it, and of the engines `exact` alone.
struct ReferenceChoice {
  ReferenceKind kind = ReferenceKind::analytic;
  std::string function;
  std::string file;
  std::string source;  ///< book, paper or derivation, printed in the report
  Settings args;
  double uncertainty = 0.0;  ///< standard uncertainty of the reference, in the metric's unit
};

}  // namespace tripoint

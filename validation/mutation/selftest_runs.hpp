// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "validation/mutation/selftest.hpp"

/// Work of the self-test for one case and one defect.
namespace tripoint {

struct Defect;

/// The engine whose test build a defect is put into. It is the solver in one process, unless each gate that
/// must turn red judges the solver over ranks alone.
[[nodiscard]] std::string engine_of_defect(const Case&, const Defect&);

/// Makes the runs that the gates of this engine on these metrics need, with a defect ("name=size"; empty =
/// none). They go into `folder` below the self-test's own.
/// @throws EngineError when interrupted
[[nodiscard]] CaseResult run_with_defect(const Case&, const EngineEntry&,
                                         const std::vector<std::string>& metrics, const std::string& defect,
                                         const std::string& folder, const SelftestOptions&);

/// Verdicts of one metric of our engine in one mode.
struct Seen {
  bool any = false, all_green = true, red = false;
  std::string words;  ///< "pressure 0.012 pass, pressure 0.3 fail"; empty when nothing was judged
};
[[nodiscard]] Seen look(const CaseResult&, const std::string& metric, JudgedMode mode);

/// Modes in which a gate judges this metric.
[[nodiscard]] std::vector<JudgedMode> judged_modes(const CaseResult&, const std::string& metric);
/// The mode that must see a defect: the printed form where the defect is of one (`X.paper.Y`), else the
/// corrected form wherever it is judged. The red row of one form does not stand for the other.
[[nodiscard]] JudgedMode decisive_mode(const CaseResult&, const std::string& metric,
                                       const std::string& defect);

}  // namespace tripoint

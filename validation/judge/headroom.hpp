// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <vector>

#include "validation/judge/remarks.hpp"

/// A limit far above the error that it judges guards nothing: a defect can hide in that headroom.
namespace tripoint {

inline constexpr double headroom_warns = 3.0, headroom_fails = 10.0;

/// Change of a metric that physically neutral changes may cause (docs/harness.md: invariance tests). A limit
/// that is not above it is one of round-off. Its values change with compiler and thread count, and the used
/// share of it says nothing.
inline constexpr double roundoff_limit = 1e-10;

/// Allowance of a gate over the part that one judged row uses: 1 over share_of_limit() of |value| + 2 u. A
/// band that states a figure is measured by its width: the larger of value over low and high over value. A
/// count changes by whole numbers: half a count is the least it is compared with. Empty where nothing is to
/// be asked: an order (its interval is judged), a limit of round-off, no value.
[[nodiscard]] std::optional<double> headroom_of(const CaseResult&, const GateRow&);

/// One remark for each declared gate whose headroom is above 3 in every row that it judges. It is a warning,
/// and above 10 an error unless the gate is dated.
[[nodiscard]] std::vector<Remark> headroom_remarks(const Results&);

}  // namespace tripoint

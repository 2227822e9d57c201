// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "validation/baseline/changes.hpp"
#include "validation/baseline/gate_verdict.hpp"
#include "validation/results/results.hpp"

/// Results as shown to people and other programs: the text of a comment, a badge, data for a dashboard. Every
/// foreign string in it is escaped.
namespace tripoint {

/// First line of a comment, not seen by readers. The comment that holds it is written anew at the next push,
/// so that there is only one.
inline constexpr const char* comment_mark = "<!-- tripoint: accuracy -->";

struct CommentOptions {
  std::string head, base;  ///< names for people, such as branches; empty = none
  std::string links;       ///< URL that a case file's path is appended to; empty = no links
  std::string note;        ///< one sentence on how the verdict was formed; empty = by the gate
  std::size_t most = 10;   ///< metrics in the table
  bool informational = false;
};

/// Verdict and the most changed metrics as Markdown. It shows base beside head, in units of the limit, with
/// the noise; new or lost values; values that are not green. Without a comparison the metrics that use most
/// of their limits. @param against may be null
[[nodiscard]] std::string comment_markdown(const Results&, const GateVerdict&, const Comparison* against,
                                           const CommentOptions&);

/// The same as plain text.
[[nodiscard]] std::string comment_text(const Results&, const GateVerdict&, const Comparison* against,
                                       const CommentOptions&);

/// A list of {name, unit, value, range, extra}, an entry for each judged metric, as benchmark actions read
/// it.
/// @param in_limits values in units of the limit, the less the better, so that such an action knows a
/// regression; else in the metric's own unit
[[nodiscard]] std::string dashboard_json(const Results&, bool in_limits);

/// "accuracy | 12/12 gates", green where the verdict is PASS. @param json as an endpoint's answer
/// {schemaVersion, label, message, color}; else as SVG
[[nodiscard]] std::string badge_text(const Results&, const GateVerdict&, bool json);

/// SARIF 2.1.0: a result for each remark, at the line of its limit.
[[nodiscard]] std::string sarif_text(const GateVerdict&);

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "validation/case/case_words.hpp"

/// Axes that studies refine.
namespace tripoint {

/// The words of all axes, as an option of a command takes one.
[[nodiscard]] std::vector<std::string> axis_words();

/// Whether a greater level is a finer one.
[[nodiscard]] constexpr bool refines_upward(Axis axis) {
  return axis == Axis::support_ratio || axis == Axis::walkers || axis == Axis::iterations;
}

/// The number that falls with refinement. @param level in the axis's own unit, > 0
[[nodiscard]] constexpr double step_of(Axis axis, double level) {
  return refines_upward(axis) ? 1.0 / level : level;
}

/// Axis of the levels of a study, and the numbers refined together with it: "spacing+support_ratio" is a
/// ladder of its own.
struct StudyAxes {
  Axis axis = Axis::spacing;
  bool support_ratio = false, time_step = false;  ///< refined together with the axis
  [[nodiscard]] bool alone() const { return !support_ratio && !time_step; }
  friend bool operator==(const StudyAxes&, const StudyAxes&) = default;
};
[[nodiscard]] std::string to_string(const StudyAxes&);
/// Inverse of to_string. @throws InputError naming the word
[[nodiscard]] StudyAxes study_axes_from(std::string_view text);
/// In the order of their words, as results.json has them.
[[nodiscard]] inline bool operator<(const StudyAxes& a, const StudyAxes& b) {
  return to_string(a) < to_string(b);
}

}  // namespace tripoint

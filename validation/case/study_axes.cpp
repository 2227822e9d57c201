// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/study_axes.hpp"

namespace tripoint {

std::vector<std::string> axis_words() {
  constexpr auto words = word_table(Axis{}).words;
  return {words.begin(), words.end()};
}

std::string to_string(const StudyAxes& axes) {
  std::string text{to_string(axes.axis)};
  if (axes.support_ratio) text += "+support_ratio";
  if (axes.time_step) text += "+time_step";
  return text;
}

StudyAxes study_axes_from(std::string_view text) {
  for (const Axis axis : all_of<Axis>())
    for (const bool support_ratio : {false, true})
      for (const bool time_step : {false, true})
        if (const StudyAxes axes{axis, support_ratio, time_step}; to_string(axes) == text) return axes;
  return {from_word<Axis>(text)};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

/// Days on which limits were accepted. A date silences a rule, so it must be a day that has been.
namespace tripoint {

/// "2026-11-29": four, two and two digits that name a day of the calendar.
[[nodiscard]] bool is_date(const std::string& text);

/// Later than tomorrow by this machine's clock: no time zone is as far ahead. @pre is_date(text)
[[nodiscard]] bool is_in_the_future(const std::string& text);

}  // namespace tripoint

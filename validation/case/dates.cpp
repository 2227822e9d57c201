// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/dates.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>

namespace tripoint {
namespace {

namespace chrono = std::chrono;

bool has_the_form(const std::string& text) {
  static constexpr std::string_view form = "dddd-dd-dd";
  return text.size() == form.size() && std::equal(form.begin(), form.end(), text.begin(), [](char f, char c) {
           return f == 'd' ? std::isdigit(static_cast<unsigned char>(c)) != 0 : f == c;
         });
}

chrono::year_month_day day_of(const std::string& text) {
  return {chrono::year(std::stoi(text.substr(0, 4))),
          chrono::month(static_cast<unsigned>(std::stoi(text.substr(5, 2)))),
          chrono::day(static_cast<unsigned>(std::stoi(text.substr(8, 2))))};
}

}  // namespace

bool is_date(const std::string& text) { return has_the_form(text) && day_of(text).ok(); }

bool is_in_the_future(const std::string& text) {
  const auto now = chrono::floor<chrono::days>(chrono::system_clock::now());
  return chrono::sys_days(day_of(text)) > now + chrono::days(1);
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
// Formulas and quantities of a case file.
#include <cmath>
#include <stdexcept>

#include "core/errors.hpp"
#include "fuzz/input.hpp"
#include "tables/expression.hpp"
#include "tables/units.hpp"

using namespace tripoint;

namespace {

void read_expression(const std::string& text) {
  try {
    const Expression expression(text, Expression::Time::known);
    const double once = expression({1.5, -2.0, 0.0}, 0.25), again = expression({1.5, -2.0, 0.0}, 0.25);
    fuzz::expect(once == again || (std::isnan(once) && std::isnan(again)), "a formula has one value");
  } catch (const InputError&) {
  }
}

void read_quantity(const std::string& text, const char* expected) {
  try {
    fuzz::expect(!std::isnan(parse_quantity(text, expected)), "a quantity that is read is a number");
  } catch (const std::invalid_argument&) {
  } catch (const InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text = fuzz::text_of(data, size);
  read_expression(text);
  for (const char* expected : {"", "m", "kg/m3", "K", "J/(kg K)"}) read_quantity(text, expected);
  return 0;
}

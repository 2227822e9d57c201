// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <string>
#include <string_view>

namespace tripoint {

/// Exponents of metre, kilogram, second and kelvin; angles are numbers (rad = 1).
using Dimension = std::array<int, 4>;

/// A unit as a factor to SI, kept as a fraction so that "35 mm" is the double nearest to 0.035.
struct Unit {
  double numerator = 1.0, denominator = 1.0;
  double offset = 0.0;  ///< added after the factor: degC only
  Dimension dimension{};
};

/// Reads "kg/m3", "m s^-2", "W/m/K", "J/(kg K)", "rad/s", "degC". An empty text is the number 1.
/// @throws std::invalid_argument naming the unknown word
[[nodiscard]] Unit parse_unit(std::string_view text);

/// "m/s2" of a dimension; "1" for a plain number.
[[nodiscard]] std::string to_string(const Dimension&);

/// Reads "3 mm" as a value in SI of the expected dimension.
/// @param expected SI unit of the key, as "kg/m3"; "" for a plain number
/// @throws std::invalid_argument saying what was wrong and which unit is expected
[[nodiscard]] double parse_quantity(std::string_view text, std::string_view expected);

/// The units that are known by name, for the reference page.
[[nodiscard]] std::string known_units();

}  // namespace tripoint

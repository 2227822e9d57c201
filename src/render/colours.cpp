// SPDX-License-Identifier: BSD-3-Clause
#include "render/colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tripoint {
namespace {

/// The curve of sRGB.
double linear(double stored) {
  return stored <= 0.04045 ? stored / 12.92 : std::pow((stored + 0.055) / 1.055, 2.4);
}
double stored(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

}  // namespace

Colour colour_of(std::uint8_t red, std::uint8_t green, std::uint8_t blue) noexcept {
  return {linear(red / 255.0), linear(green / 255.0), linear(blue / 255.0)};
}

std::uint8_t screen_byte(double light) noexcept {
  return static_cast<std::uint8_t>(
      std::lround(255.0 * std::clamp(stored(std::clamp(light, 0.0, 1.0)), 0.0, 1.0)));
}

Colour temperature_colour(double share) noexcept {
  static const std::array<Colour, 6> stops{colour_of(24, 30, 92),   colour_of(98, 32, 128),
                                           colour_of(176, 42, 92),  colour_of(226, 88, 44),
                                           colour_of(250, 166, 50), colour_of(255, 240, 176)};
  const double at = std::clamp(share, 0.0, 1.0) * (stops.size() - 1);
  const auto k = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  const double part = at - static_cast<double>(k);
  return (1.0 - part) * stops[k] + part * stops[k + 1];
}

Colour phase_colour(int phase, bool other_liquid) noexcept {
  static const std::array<Colour, 4> colours{colour_of(42, 111, 184), colour_of(58, 157, 93),
                                             colour_of(217, 130, 43), colour_of(140, 196, 238)};
  if (phase == 0) return colours[other_liquid ? 3 : 0];
  return colours[phase == 1 ? 1 : 2];
}

Colour body_colour(int body) noexcept {
  static const std::array<Colour, 7> colours{
      colour_of(61, 159, 216), colour_of(232, 128, 58), colour_of(43, 181, 140), colour_of(204, 121, 167),
      colour_of(230, 159, 0),  colour_of(86, 180, 233), colour_of(140, 149, 159)};
  if (body < 0) return phase_colour(0, false);
  return colours[static_cast<std::size_t>(body) % colours.size()];
}

Colour wall_colour() noexcept { return colour_of(178, 178, 174); }

}  // namespace tripoint

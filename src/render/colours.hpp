// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "core/vec3.hpp"

namespace tripoint {

/// Light that a surface gives back, red, green, blue, each 0 to 1 and linear (not as screens store it).
using Colour = Vec3;

/// Colour from the three bytes that screens store.
[[nodiscard]] Colour colour_of(std::uint8_t red, std::uint8_t green, std::uint8_t blue) noexcept;
/// One byte of a screen. @param light linear, 0 to 1; values beyond are cut off
[[nodiscard]] std::uint8_t screen_byte(double light) noexcept;

/// From dark blue (cold) by red and orange to pale yellow (hot), ever lighter, as in the paper's figures.
/// @param share 0 to 1
[[nodiscard]] Colour temperature_colour(double share) noexcept;
/// Liquid blue, elastic green, rigid orange; a liquid of another material than the first is light blue.
[[nodiscard]] Colour phase_colour(int phase, bool other_liquid) noexcept;
/// Seven colours in turn that colour blindness tells apart; a liquid (-1) is blue.
[[nodiscard]] Colour body_colour(int body) noexcept;
/// Grounds and tanks.
[[nodiscard]] Colour wall_colour() noexcept;

}  // namespace tripoint

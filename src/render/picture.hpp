// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace tripoint {

/// Pixels of 8 bits red, green, blue, by rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;
  Picture() = default;
  Picture(int w, int h)
      : width(w),
        height(h),
        rgb(std::size_t{3} * static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}
  [[nodiscard]] std::uint8_t* at(int x, int y) {
    return &rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x))];
  }
  [[nodiscard]] const std::uint8_t* at(int x, int y) const {
    return &rgb[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                     static_cast<std::size_t>(x))];
  }
};

/// @throws EngineError when it cannot be written
void write_png(const std::string& path, const Picture&);

/// Each pixel the mean of those that it replaces. @param width no more than the picture's
[[nodiscard]] Picture shrunk(const Picture&, int width);

/// Pictures of one size in rows, with white lines between them. @param columns at least 1
[[nodiscard]] Picture contact_sheet(std::span<const Picture>, int columns);

}  // namespace tripoint

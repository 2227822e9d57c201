// SPDX-License-Identifier: BSD-3-Clause
#include "render/picture.hpp"

#include <png.h>

#include <algorithm>
#include <cassert>

#include "core/errors.hpp"

namespace tripoint {

void write_png(const std::string& path, const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  if (png_image_write_to_file(&image, path.c_str(), 0, picture.rgb.data(), 0, nullptr) == 0)
    throw EngineError(path + ": cannot be written: " + image.message);
}

Picture shrunk(const Picture& from, int width) {
  assert(width >= 1 && width <= from.width);
  Picture to(width, std::max(1, from.height * width / from.width));
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x) {
      const int left = x * from.width / to.width, right = (x + 1) * from.width / to.width;
      const int top = y * from.height / to.height, bottom = (y + 1) * from.height / to.height;
      const int count = (right - left) * (bottom - top);
      for (int c = 0; c < 3; ++c) {
        int sum = 0;
        for (int j = top; j < bottom; ++j)
          for (int i = left; i < right; ++i) sum += from.at(i, j)[c];
        to.at(x, y)[c] = static_cast<std::uint8_t>((sum + count / 2) / count);
      }
    }
  return to;
}

Picture contact_sheet(std::span<const Picture> pictures, int columns) {
  constexpr int gap = 4;  // pixels
  if (pictures.empty()) return {};
  const int count = static_cast<int>(pictures.size()), across = std::min(columns, count),
            down = (count + across - 1) / across;
  const int w = pictures.front().width, h = pictures.front().height;
  Picture sheet(across * (w + gap) - gap, down * (h + gap) - gap);
  std::ranges::fill(sheet.rgb, std::uint8_t{255});
  for (int n = 0; n < count; ++n)
    for (int y = 0; y < h; ++y)
      std::copy_n(pictures[static_cast<std::size_t>(n)].at(0, y), 3 * w,
                  sheet.at(n % across * (w + gap), n / across * (h + gap) + y));
  return sheet;
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>

#include "render/camera.hpp"
#include "render/colours.hpp"

namespace tripoint {

/// Where a ray meets something first.
struct Hit {
  double distance = 0.0;  ///< along the ray [m]
  Vec3 normal;            ///< unit vector, outwards
  Colour colour;
};

/// One thread's way of asking a target: may keep its last result. Its answers do not depend on earlier
/// questions.
class Gaze {
 public:
  virtual ~Gaze() = default;
  /// @param span distances to look between [m]
  [[nodiscard]] virtual std::optional<Hit> first(const Ray&, const Span& span) = 0;
  /// Whether anything stands in a ray's way.
  [[nodiscard]] virtual bool blocks(const Ray&, const Span& span) = 0;
};

/// Something that a picture shows.
class Target {
 public:
  virtual ~Target() = default;
  [[nodiscard]] virtual std::unique_ptr<Gaze> gaze() const = 0;
  [[nodiscard]] virtual Box bounds() const = 0;  ///< all of it lies inside [m]
};

}  // namespace tripoint

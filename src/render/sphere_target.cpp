// SPDX-License-Identifier: BSD-3-Clause
#include "render/sphere_target.hpp"

#include <algorithm>
#include <cmath>

namespace tripoint {
namespace {

class SphereGaze : public Gaze {
 public:
  SphereGaze(const PointCells& cells, double radius, std::span<const Colour> colours)
      : cells_(&cells), cache_(cells, radius), radius_(radius), colours_(colours) {}

  /// Goes from cell to cell. A cell's list holds every ball that reaches into it, so that a ball met within
  /// the cell is the first.
  std::optional<Hit> first(const Ray& ray, const Span& span) override {
    const Span box = inside(ray, grown(cells_->box(), radius_));
    const double nudge = 1e-6 * radius_;
    for (double t = std::max(span.from, box.from), end = std::min(span.to, box.to); t < end;) {
      const Vec3 r = ray.at(t + nudge);
      const double leaves = std::max(inside(ray, cells_->box_of(cells_->cell_of(r))).to, t) + nudge;
      if (const auto hit = nearest(ray, cache_.around(r), span); hit && hit->distance <= leaves) return hit;
      t = leaves;
    }
    return {};
  }
  bool blocks(const Ray& ray, const Span& span) override { return first(ray, span).has_value(); }

 private:
  std::optional<Hit> nearest(const Ray& ray, const NearPoints& balls, const Span& span) const {
    std::optional<Hit> found;
    for (std::size_t k = 0; k < balls.row.size(); ++k) {
      const Vec3 centre{balls.x[k], balls.y[k], balls.z[k]}, to = centre - ray.from;
      const double along = dot(to, ray.along);
      const Vec3 aside = to - along * ray.along;
      const double room = radius_ * radius_ - dot(aside, aside);
      if (room <= 0.0) continue;
      const double t = along - std::sqrt(room);
      if (t < span.from || t > span.to || (found && t >= found->distance)) continue;
      found = Hit{t, (ray.at(t) - centre) / radius_, colours_[balls.row[k]]};
    }
    return found;
  }

  const PointCells* cells_;
  NearCache cache_;
  double radius_;
  std::span<const Colour> colours_;
};

}  // namespace

std::unique_ptr<Gaze> SphereTarget::gaze() const {
  return std::make_unique<SphereGaze>(cells_, radius_, colours_);
}

}  // namespace tripoint

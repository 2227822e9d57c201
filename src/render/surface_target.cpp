// SPDX-License-Identifier: BSD-3-Clause
#include "render/surface_target.hpp"

#include <algorithm>
#include <cmath>

namespace tripoint {
namespace {

constexpr double shortest = 0.03, longest = 0.25, share = 0.7;  // of a step: over ir, over ir, of phi
constexpr double tolerance = 1e-5;                              // over ir

/// Root between an outer place (phi > 0) and an inner one, by the Illinois form of false position.
double closed_in(SurfaceProbe& probe, const Ray& ray, double outer, double inner, double phi_outer,
                 double phi_inner, double ir) {
  int kept = 0;
  for (int step = 0; step < 40 && inner - outer > tolerance * ir; ++step) {
    const double t = std::clamp(outer + (inner - outer) * phi_outer / (phi_outer - phi_inner),
                                outer + 0.02 * (inner - outer), inner - 0.02 * (inner - outer));
    const double phi = probe.phi(ray.at(t));
    if (std::abs(phi) < tolerance * ir) return t;
    if (phi > 0.0) {
      outer = t;
      phi_outer = phi;
      if (kept == 1) phi_inner *= 0.5;
      kept = 1;
    } else {
      inner = t;
      phi_inner = phi;
      if (kept == -1) phi_outer *= 0.5;
      kept = -1;
    }
  }
  return 0.5 * (outer + inner);
}

class SurfaceGaze : public Gaze {
 public:
  SurfaceGaze(const ImplicitSurface& surface, std::span<const Colour> colours)
      : surface_(&surface), colours_(colours), probe_(surface) {}

  std::optional<Hit> first(const Ray& ray, const Span& span) override {
    const auto t = first_crossing(*surface_, probe_, ray, span);
    if (!t) return {};
    const Vec3 place = ray.at(*t), g = probe_.gradient(place);
    Hit hit{*t, norm(g) > 0.0 ? g / norm(g) : -ray.along, {}};
    double weights = 0.0;
    probe_.weigh(place, [&](std::uint32_t row, double w) {
      hit.colour += w * colours_[row];
      weights += w;
    });
    if (weights > 0.0) hit.colour *= 1.0 / weights;
    return hit;
  }
  bool blocks(const Ray& ray, const Span& span) override {
    return first_crossing(*surface_, probe_, ray, span).has_value();
  }

 private:
  const ImplicitSurface* surface_;
  std::span<const Colour> colours_;
  SurfaceProbe probe_;
};

}  // namespace

std::unique_ptr<Gaze> SurfaceTarget::gaze() const {
  return std::make_unique<SurfaceGaze>(surface_, colours_);
}

std::optional<double> first_crossing(const ImplicitSurface& surface, SurfaceProbe& probe, const Ray& ray,
                                     const Span& span) {
  const double ir = surface.options().influence_radius;
  const Span box = inside(ray, surface.bounds());
  const double end = std::min(span.to, box.to);
  double t = std::max(span.from, box.from), before = t, phi_before = 0.0;
  bool outside = false;  // whether `before` is known to lie outside
  while (t < end) {
    const Vec3 r = ray.at(t);
    double step = shortest * ir, phi = ir;
    if (const auto empty = surface.empty_box(r)) {
      step = std::max(inside(ray, *empty).to - t, 0.0) + 1e-6 * ir;
    } else if (const SurfaceValue v = probe.value(r); !v.near) {
      const auto nearest = probe.nearest(r);
      const double far =
          nearest ? *nearest - ir
                  : inside(ray, surface.cells().box_of(surface.cells().cell_of(r))).to - t + 1e-6 * ir;
      step = std::max(step, far);
    } else {
      phi = v.phi;
      if (phi <= 0.0 && outside) return closed_in(probe, ray, before, t, phi_before, phi, ir);
      step = std::clamp(share * std::abs(phi), shortest * ir, longest * ir);
    }
    outside = phi > 0.0;
    before = t;
    phi_before = phi;
    t += step;
  }
  return {};
}

}  // namespace tripoint

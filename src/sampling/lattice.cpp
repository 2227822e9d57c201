// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tripoint {
namespace {

/// A corner counts as on the lattice within this part of a spacing: round-off of the numbers in the file.
constexpr double on_lattice = 1e-6;

constexpr double max_cells = 1e8;

/// Spacings from the lattice's origin. Beyond it round-off is more than on_lattice, and further out an index
/// no whole number of 64 bits.
constexpr double farthest = 1e9;

struct Span {
  double origin = 0.0, first = 0.0, count = 0.0;  ///< first and count are whole numbers
};

/// Cells of a lattice through `origin` whose centres lie between low and high.
Span cells_between(double origin, double low, double high, double dx) {
  const double first = std::ceil((low - origin) / dx - 0.5 - on_lattice),
               last = std::floor((high - origin) / dx - 0.5 + on_lattice);
  return {origin, first, std::max(0.0, last - first + 1.0)};
}

Span along(const Scene& s, const Body& b, const Bounds& box, std::size_t a) {
  const double dx = s.spacing, low = box.min[a], high = box.max[a];
  if (a == 1 && s.is_planar()) return {-0.5 * dx, 0.0, 1.0};
  if (s.periodic[a]) {
    const double cells = ((*s.max)[a] - (*s.min)[a]) / dx;
    if (std::abs(cells - std::round(cells)) > on_lattice * std::max(1.0, cells))
      throw InputError(
          b.place,
          fmt::format(
              "the domain is {} spacings long in the periodic direction {}: choose a spacing that divides it",
              cells, "xyz"[a]));
    return cells_between((*s.min)[a], std::max(low, (*s.min)[a]), std::min(high, (*s.max)[a]), dx);
  }
  if (const auto centre = symmetry_centre(b.shape)) {
    const double n = std::max(1.0, std::round((high - low) / dx));
    return cells_between((*centre)[a] - 0.5 * n * dx, low, high, dx);
  }
  const double k = std::round(low / dx);
  const bool shared = std::abs(low / dx - k) <= on_lattice * std::max(1.0, std::abs(k) * 1e-6);
  return cells_between(shared ? 0.0 : low, low, high, dx);
}

/// A mesh says no unit: one in millimetres is a thousand times too large.
std::string scale_of_mesh(const Shape& shape, const Bounds& box) {
  const Vec3 size = box.extent();
  return shape.kind != Shape::Kind::mesh ? ""
                                         : fmt::format(
                                               ", or give the mesh a shape.scale where it is not in metres: "
                                               "now it is {:.4g} x {:.4g} x {:.4g} m",
                                               size.x, size.y, size.z);
}

}  // namespace

Lattice lattice_of(const Scene& s, const Body& b) {
  Bounds box = bounds(b.shape);
  Lattice lattice;
  lattice.spacing = s.spacing;
  double cells = 1.0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (s.min && s.max) {  // a half space fills the domain
      if (!std::isfinite(box.min[a])) box.min[a] = (*s.min)[a];
      if (!std::isfinite(box.max[a])) box.max[a] = (*s.max)[a];
    }
    if (!std::isfinite(box.min[a]) || !std::isfinite(box.max[a]))
      throw InputError(
          b.place,
          fmt::format(
              "body \"{}\" has no end along {}: cut it by a difference, or give scene.min and scene.max",
              b.name, "xyz"[a]));
    if (!(a == 1 && s.is_planar())) cells *= std::max(0.0, (box.max[a] - box.min[a]) / s.spacing + 2.0);
    if (!(cells <= max_cells))
      throw InputError(
          b.place,
          fmt::format("body \"{}\" spans more than {:.0e} cells of spacing {} m: coarsen scene.spacing{}",
                      b.name, max_cells, s.spacing, scale_of_mesh(b.shape, box)));
    const Span span = along(s, b, box, a);
    if (!(std::abs(span.first) <= farthest))
      throw InputError(
          b.place,
          fmt::format("body \"{}\" lies {:.2g} spacings from {} = {} m, where a number cannot tell one "
                      "particle's place from the next: move it nearer",
                      b.name, std::abs(span.first), "xyz"[a], span.origin));
    lattice.origin[a] = span.origin;
    lattice.first[a] = static_cast<long>(span.first);
    lattice.count[a] = static_cast<long>(span.count);
  }
  return lattice;
}

namespace {

/// A turned body takes its lattice along: it holds the same particles at every angle.
std::vector<Vec3> fill_turned(const Scene& s, const Body& b) {
  Body upright = b;
  upright.shape = not_turned(b.shape);
  auto centres = fill(s, upright);
  std::ranges::transform(centres, centres.begin(), turning(b.shape));
  return centres;
}

}  // namespace

std::vector<Vec3> fill(const Scene& s, const Body& b) {
  if (is_turned(b.shape)) return fill_turned(s, b);
  const Lattice lattice = lattice_of(s, b);
  const auto inside = inside_of(b.shape, s.spacing);
  std::vector<Vec3> centres;
  for (long k = 0; k < lattice.count[2]; ++k)
    for (long j = 0; j < lattice.count[1]; ++j)
      for (long i = 0; i < lattice.count[0]; ++i)
        if (const Vec3 r = lattice.centre(i, j, k); inside(r)) centres.push_back(r);
  if (centres.empty())
    throw InputError(
        b.place,
        fmt::format("body \"{}\" holds no particle at spacing {} m: refine scene.spacing or enlarge the body",
                    b.name, s.spacing));
  return centres;
}

Vec3 wrapped(const Scene& s, Vec3 r) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (!s.periodic[a]) continue;
    const double low = (*s.min)[a], high = (*s.max)[a];
    if (r[a] < low) r[a] += high - low;
    if (r[a] >= high) r[a] -= high - low;
  }
  return r;
}

}  // namespace tripoint

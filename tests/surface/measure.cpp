// SPDX-License-Identifier: BSD-3-Clause
// The figures of docs/surface.md: surface-measure [ball|torus|slab|times]; the plot of (25) in
// docs/gallery.md: surface-measure factor
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>

#include "surface/shapes.hpp"
#include "surface/surface_mesh.hpp"

namespace {

using namespace tripoint;

double cpu() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void ladder(const shapes::ExactBody& body, const std::vector<double>& counts, bool detector) {
  std::printf(
      "%s, %s\n| spacings | volume | order | area | order | Hausdorff / spacing | order of Hausdorff "
      "|\n|---|---|---|---|---|---|---|\n",
      body.name.c_str(), detector ? "f of (25)" : "f = 1");
  shapes::SurfaceErrors before;
  double spacing_before = 0.0;
  for (const double n : counts) {
    const double dx = body.size / n;
    const auto e = shapes::errors_at(body, dx, detector);
    const auto order = [&](double a, double b) {
      return spacing_before > 0.0 ? std::log(a / b) / std::log(spacing_before / dx) : std::nan("");
    };
    std::printf("| %g | %.2g %% | %.2f | %.2g %% | %.2f | %.2f | %.2f |\n", n, 100 * e.volume,
                order(before.volume, e.volume), 100 * e.area, order(before.area, e.area), e.hausdorff / dx,
                order(before.hausdorff, e.hausdorff));
    before = e;
    spacing_before = dx;
  }
}

/// CPU seconds of a mesh of a cube of particles.
void times(int across) {
  std::vector<Vec3> places;
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < across; ++j)
      for (int k = 0; k < across; ++k)
        places.push_back({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
  const double start = cpu();
  const ImplicitSurface surface(places, SurfaceOptions::for_spacing(1.0));
  const double built = cpu();
  const Mesh mesh = surface_mesh(surface, 0.5, 2);
  std::printf("%zu particles: cells %.2f CPU s, mesh %.2f CPU s, %zu triangles\n", places.size(),
              built - start, cpu() - built, mesh.triangles.size());
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "all";
  for (const bool detector : {true, false}) {
    if (what == "ball" || what == "all") ladder(shapes::ball(1.0), {5, 10, 20, 40}, detector);
    if (what == "torus" || what == "all") ladder(shapes::torus(2.0, 1.0), {4, 8, 16}, detector);
    if (what == "slab" || what == "all") ladder(shapes::slab(4.0, 1.0), {4, 8, 16}, detector);
  }
  if (what == "factor")
    for (int n = 0; n <= 240; ++n) std::printf("%g %.6f\n", 0.01 * n, detector_factor(0.01 * n));
  if (what == "times" || what == "all") {
    times(20);
    times(34);
    times(60);
  }
}

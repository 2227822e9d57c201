// SPDX-License-Identifier: BSD-3-Clause
// Where rays meet surfaces and balls, and what a picture of them is made of.
#include "render/draw.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "render/sphere_target.hpp"
#include "render/surface_target.hpp"
#include "surface/shapes.hpp"

namespace tripoint {
namespace {

constexpr double dx = 0.01;
constexpr double far = 1e3;
const Colour red{0.8, 0.1, 0.1};

std::vector<Vec3> ball_at(const Vec3& centre, double radius) {
  std::vector<Vec3> places;
  for (const Vec3& r : shapes::lattice(shapes::ball(radius), dx, {0.5, 0.5, 0.5}))
    places.push_back(r + centre);
  return places;
}

/// Rays from five radii off towards places at a share of the radius.
std::vector<Ray> rays_towards(const Vec3& centre, double radius, double share, int n) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  std::vector<Ray> rays;
  const auto unit = [&] {
    const Vec3 v{normal(random), normal(random), normal(random)};
    return v / norm(v);
  };
  for (int k = 0; k < n; ++k) {
    const Vec3 from = centre + 5.0 * radius * unit(), to = centre + share * radius * unit();
    rays.push_back({from, (to - from) / norm(to - from)});
  }
  return rays;
}

/// The first place along a ray where phi is not positive, in steps too short to miss anything that the test
/// asks about.
std::optional<double> by_small_steps(const ImplicitSurface& surface, const Ray& ray, double to) {
  SurfaceProbe probe(surface);
  for (double t = 0.0; t < to; t += 0.002 * dx)
    if (surface.bounds().holds(ray.at(t)) && probe.phi(ray.at(t)) <= 0.0) return t;
  return {};
}

TEST(Crossing, IsTheFirstAlongTheRay) {
  auto places = ball_at({0, 0, 0}, 4 * dx);
  for (const Vec3& r : ball_at({0, 0, 10 * dx}, 3 * dx)) places.push_back(r);
  places.push_back({7 * dx, 0, 5 * dx});  // a drop
  const ImplicitSurface surface(places, SurfaceOptions::for_spacing(dx));
  SurfaceProbe probe(surface);
  int met = 0, unlike = 0;
  for (const Ray& ray : rays_towards({0, 0, 5 * dx}, 9 * dx, 0.4, 60)) {
    const auto quick = first_crossing(surface, probe, ray, {0.0, far}),
               slow = by_small_steps(surface, ray, 90 * dx);
    if (quick.has_value() != slow.has_value()) ++unlike;  // a ray that grazes
    if (!quick || !slow) continue;
    ++met;
    if (std::abs(*quick - *slow) > 0.01 * dx) ++unlike;
    EXPECT_LT(std::abs(probe.phi(ray.at(*quick))), 1e-3 * dx);
  }
  EXPECT_GT(met, 20);
  EXPECT_LE(unlike, 1);
}

TEST(Crossing, KeepsWithinItsSpan) {
  const ImplicitSurface surface(ball_at({0, 0, 0}, 4 * dx), SurfaceOptions::for_spacing(dx));
  SurfaceProbe probe(surface);
  const Ray ray{{0, 0, 1}, {0, 0, -1}};
  const auto t = first_crossing(surface, probe, ray, {0.0, far});
  ASSERT_TRUE(t);
  EXPECT_NEAR(*t, 1.0 - 4 * dx, 0.5 * dx);
  EXPECT_FALSE(first_crossing(surface, probe, ray, {0.0, *t - 0.2 * dx}));
  EXPECT_FALSE(first_crossing(surface, probe, ray, {1.0, far})) << "from inside it only leaves";
  EXPECT_FALSE(first_crossing(surface, probe, {{0, 0, 1}, {0, 0, 1}}, {0.0, far}));
}

TEST(Balls, AreMetWhereABallIs) {
  const auto places = ball_at({0, 0, 0}, 6 * dx);
  const SphereTarget target(places, 0.5 * dx, std::vector<Colour>(places.size(), red));
  const auto gaze = target.gaze();
  int met = 0;
  for (const Ray& ray : rays_towards({0, 0, 0}, 6 * dx, 1.0, 400)) {
    double least = far;
    for (const Vec3& c : places) {
      const Vec3 to = c - ray.from;
      const double along = dot(to, ray.along), room = 0.25 * dx * dx - (dot(to, to) - along * along);
      if (room > 0.0) least = std::min(least, along - std::sqrt(room));
    }
    const auto hit = gaze->first(ray, {0.0, far});
    EXPECT_EQ(hit.has_value(), least < far);
    if (!hit) continue;
    ++met;
    EXPECT_NEAR(hit->distance, least, 1e-9);
    EXPECT_NEAR(norm(hit->normal), 1.0, 1e-9);
  }
  EXPECT_GT(met, 150);
}

Display display_of(std::vector<Vec3> places, bool balls) {
  Display display;
  std::vector<Colour> colours(places.size(), red);
  if (balls)
    display.targets.push_back(std::make_unique<SphereTarget>(places, 0.5 * dx, colours));
  else
    display.targets.push_back(
        std::make_unique<SurfaceTarget>(places, SurfaceOptions::for_spacing(dx), colours));
  display.ground = 0.0;
  display.size = 20 * dx;
  return display;
}

TEST(Picture, HasTheSameBitsForAnyNumberOfThreads) {
  const auto places = ball_at({0, 0, 6 * dx}, 5 * dx);
  for (const bool balls : {false, true}) {
    const Display display = display_of(places, balls);
    const Camera camera(places, dx, CameraAxes(display.up, {}), 1.5);
    const Picture one = draw(display, camera, 90, 60, 1);
    for (const int threads : {2, 5}) EXPECT_EQ(one.rgb, draw(display, camera, 90, 60, threads).rgb);
  }
}

TEST(Picture, ShowsTheBodyItsShadowAndTheGround) {
  const auto places = ball_at({0, 0, 8 * dx}, 5 * dx);
  const Display display = display_of(places, false);
  std::vector<Vec3> shown{{0, 0, 0}};
  shown.insert(shown.end(), places.begin(), places.end());
  const Picture p =
      draw(display, Camera(shown, 2.0 * dx, CameraAxes(display.up, {0.0, 25.0}), 1.0), 120, 120, 2);
  int body = 0, shadow = 0, lit = 0;
  for (int y = 0; y < p.height; ++y)
    for (int x = 0; x < p.width; ++x) {
      const auto* c = p.at(x, y);
      const bool grey = std::abs(c[0] - c[2]) < 12;
      body += c[0] > 2 * c[2] && c[0] > 60;
      shadow += grey && c[1] < 150;
      lit += grey && c[1] > 180;
    }
  EXPECT_NEAR(body, 3.14 / 4 * std::pow(120 * 10.0 / 16.0, 2),
              1200);  // ten of the some sixteen spacings that the picture is high
  EXPECT_GT(shadow, 200);
  EXPECT_GT(lit, 3000);
}

TEST(Camera, HasAllPlacesInThePictureAndSomeAtItsEdges) {
  const Vec3 low{-1, -2, 0}, high{3, 1, 4};
  std::vector<Vec3> corners;
  for (unsigned c = 0; c < 8; ++c)
    corners.push_back({c & 1U ? high.x : low.x, c & 2U ? high.y : low.y, c & 4U ? high.z : low.z});
  for (const Vec3& up : {Vec3{0, 0, 1}, Vec3{0, 1, 0}, Vec3{-1, 0, 0}})
    for (const double azimuth : {-120.0, 0.0, 30.0, 90.0}) {
      const CameraAxes axes(up, {azimuth, 20.0});
      const Camera camera(corners, 0.0, axes, 4.0 / 3.0);
      EXPECT_NEAR(dot(axes.right, up), 0.0, 1e-12);
      EXPECT_GT(dot(axes.upward, up), 0.9);
      const double widest =
          dot(camera.ray(1, 0).along, axes.right) / dot(camera.ray(1, 0).along, axes.forward);
      const double highest =
          dot(camera.ray(0, 1).along, axes.upward) / dot(camera.ray(0, 1).along, axes.forward);
      double across = 0.0, upwards_ = 0.0;
      for (const Vec3& r : corners) {
        const Vec3 d = r - camera.eye();
        across = std::max(across, std::abs(dot(d, axes.right)) / dot(d, axes.forward) / widest);
        upwards_ = std::max(upwards_, std::abs(dot(d, axes.upward)) / dot(d, axes.forward) / highest);
      }
      EXPECT_LE(std::max(across, upwards_), 1.0);
      EXPECT_GT(std::max(across, upwards_), 0.9);
    }
}

TEST(Sheet, ShrinksAndSetsPicturesSideBySide) {
  Picture a(40, 20), b(40, 20);
  std::ranges::fill(a.rgb, std::uint8_t{200});
  const Picture small = shrunk(a, 10);
  EXPECT_EQ(small.width, 10);
  EXPECT_EQ(small.height, 5);
  EXPECT_EQ(small.at(3, 3)[0], 200);
  const Picture sheet = contact_sheet(std::vector<Picture>{a, b, a}, 2);
  EXPECT_EQ(sheet.width, 84);
  EXPECT_EQ(sheet.height, 44);
  EXPECT_EQ(sheet.at(5, 30)[0], 200);   // the third begins the second row
  EXPECT_EQ(sheet.at(60, 30)[0], 255);  // and nothing stands beside it
  EXPECT_EQ(sheet.at(60, 5)[0], 0);
}

TEST(Colours, OfTemperatureBecomeLighter) {
  const auto light = [](const Colour& c) { return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z; };
  for (double share = 0.0; share < 0.99; share += 0.02)
    EXPECT_LT(light(temperature_colour(share)), light(temperature_colour(share + 0.02))) << share;
  EXPECT_EQ(screen_byte(colour_of(17, 99, 200).y), 99);
}

}  // namespace
}  // namespace tripoint

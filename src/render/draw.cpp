// SPDX-License-Identifier: BSD-3-Clause
#include "render/draw.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tripoint {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double ambient = 0.38, sun = 0.72, shine = 0.10, sharpness = 40.0;
constexpr double fade_from = 1.5, fade_to = 6.0;  // of the ground, in sizes of what is shown
constexpr double differs = 0.06;                  // light of two neighbours
constexpr int tile = 16;                          // pixels
constexpr int finer = 3;                          // rays a pixel along each axis, where neighbours differ

const Colour ground_colour{0.62, 0.62, 0.60}, sky_low{0.90, 0.92, 0.94}, sky_high{0.70, 0.78, 0.88};

/// Light and number of the object that a ray meets first: 0 the sky, 1 the ground, from 2 the targets.
struct Seen {
  Colour light;
  std::size_t what = 0;
};

/// One thread's view of the display.
class Tracer {
 public:
  Tracer(const Display& display, const Camera& camera)
      : display_(&display),
        sun_(unit_vector(0.9 * display.up - 0.45 * camera.axes().right + 0.55 * camera.towards())),
        nudge_(1e-3 * display.size),
        middle_(box_middle(display)) {
    for (const auto& t : display.targets) {
      gazes_.push_back(t->gaze());
      boxes_.push_back(t->bounds());
    }
  }

  Seen seen(const Ray& ray) {
    std::optional<Hit> hit;
    std::size_t what = 0;
    for (std::size_t n = 0; n < gazes_.size(); ++n) {
      const Span in = inside(ray, boxes_[n]);
      const Span span{std::max(in.from, 0.0), std::min(in.to, hit ? hit->distance : infinite)};
      if (span.empty()) continue;
      if (const auto found = gazes_[n]->first(ray, span)) {
        hit = found;
        what = n + 2;
      }
    }
    if (const auto t = ground_distance(ray); t && !(hit && hit->distance < *t))
      return {on_ground(ray, *t), 1};
    if (!hit) return {sky(ray), 0};
    return {lit(ray, *hit), what};
  }

 private:
  static Vec3 box_middle(const Display& display) {
    Vec3 sum;
    for (const auto& t : display.targets) sum += 0.5 * (t->bounds().low + t->bounds().high);
    return display.targets.empty() ? sum : sum / static_cast<double>(display.targets.size());
  }
  [[nodiscard]] Colour sky(const Ray& ray) const {
    const double height = std::clamp(dot(ray.along, display_->up) + 0.3, 0.0, 1.0);
    return (1.0 - height) * sky_low + height * sky_high;
  }
  [[nodiscard]] std::optional<double> ground_distance(const Ray& ray) const {
    const double falls = -dot(ray.along, display_->up);
    if (!display_->ground || falls <= 1e-9) return {};
    const double t = (dot(ray.from, display_->up) - *display_->ground) / falls;
    return t > 0.0 ? std::optional(t) : std::nullopt;
  }
  [[nodiscard]] bool in_shadow(const Vec3& place, const Vec3& normal) {
    const Ray ray{place + nudge_ * normal, sun_};
    for (std::size_t n = 0; n < gazes_.size(); ++n) {
      const Span in = inside(ray, boxes_[n]);
      const Span span{std::max(in.from, 0.0), in.to};
      if (!span.empty() && gazes_[n]->blocks(ray, span)) return true;
    }
    return false;
  }
  [[nodiscard]] Colour on_ground(const Ray& ray, double t) {
    const Vec3 place = ray.at(t), off = place - middle_;
    const double away = norm(off - dot(off, display_->up) * display_->up) / display_->size;
    const double part = std::clamp((away - fade_from) / (fade_to - fade_from), 0.0, 1.0),
                 fade = part * part * (3.0 - 2.0 * part);
    if (fade >= 1.0) return sky(ray);
    const double light = ambient + (in_shadow(place, display_->up) ? 0.0 : sun * dot(display_->up, sun_));
    return (1.0 - fade) * (light * ground_colour) + fade * sky(ray);
  }
  [[nodiscard]] Colour lit(const Ray& ray, const Hit& hit) {
    const Vec3 normal = dot(hit.normal, ray.along) < 0.0 ? hit.normal : -hit.normal;
    const double facing = dot(normal, sun_);
    const double soft = ambient * (0.75 + 0.25 * dot(normal, display_->up));
    if (facing <= 0.0 || in_shadow(ray.at(hit.distance), normal)) return soft * hit.colour;
    const double glint =
        shine * std::pow(std::max(dot(unit_vector(sun_ - ray.along), normal), 0.0), sharpness);
    return (soft + sun * facing) * hit.colour + Colour{glint, glint, glint};
  }

  const Display* display_;
  Vec3 sun_;
  double nudge_;
  Vec3 middle_;
  std::vector<std::unique_ptr<Gaze>> gazes_;
  std::vector<Box> boxes_;
};

struct Frame {
  int width, height;
  std::vector<Seen> seen;
  [[nodiscard]] const Seen& at(int x, int y) const {
    return seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
  }
};

Ray ray_of(const Camera& camera, const Frame& f, double x, double y) {
  return camera.ray(2.0 * x / f.width - 1.0, 1.0 - 2.0 * y / f.height);
}

bool unlike(const Seen& a, const Seen& b) {
  return a.what != b.what || std::abs(a.light.x - b.light.x) > differs ||
         std::abs(a.light.y - b.light.y) > differs || std::abs(a.light.z - b.light.z) > differs;
}

bool differs_from_neighbours(const Frame& f, int x, int y) {
  const Seen& here = f.at(x, y);
  return (x > 0 && unlike(here, f.at(x - 1, y))) || (x + 1 < f.width && unlike(here, f.at(x + 1, y))) ||
         (y > 0 && unlike(here, f.at(x, y - 1))) || (y + 1 < f.height && unlike(here, f.at(x, y + 1)));
}

Colour finer_light(Tracer& tracer, const Camera& camera, const Frame& f, int x, int y) {
  Colour sum;
  for (int i = 0; i < finer; ++i)
    for (int j = 0; j < finer; ++j) {
      const bool middle = i == finer / 2 && j == finer / 2;
      sum += middle ? f.at(x, y).light
                    : tracer.seen(ray_of(camera, f, x + (i + 0.5) / finer, y + (j + 0.5) / finer)).light;
    }
  return sum / static_cast<double>(finer * finer);
}

/// Calls work(x, y) for each pixel of a tile.
template <class Work>
void each_pixel(const Frame& f, int number, Work&& work) {
  const int across = (f.width + tile - 1) / tile;
  const int left = number % across * tile, top = number / across * tile;
  for (int y = top; y < std::min(top + tile, f.height); ++y)
    for (int x = left; x < std::min(left + tile, f.width); ++x) work(x, y);
}

}  // namespace

Picture draw(const Display& display, const Camera& camera, int width, int height, int threads) {
  Frame f{width, height,
          std::vector<Seen>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height))};
  Picture picture(width, height);
  const int tiles = ((width + tile - 1) / tile) * ((height + tile - 1) / tile);
#pragma omp parallel num_threads(threads)
  {
    Tracer tracer(display, camera);
#pragma omp for schedule(dynamic)
    for (int n = 0; n < tiles; ++n)
      each_pixel(f, n, [&](int x, int y) {
        f.seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] =
            tracer.seen(ray_of(camera, f, x + 0.5, y + 0.5));
      });
#pragma omp for schedule(dynamic)
    for (int n = 0; n < tiles; ++n)
      each_pixel(f, n, [&](int x, int y) {
        const Colour light =
            differs_from_neighbours(f, x, y) ? finer_light(tracer, camera, f, x, y) : f.at(x, y).light;
        std::uint8_t* pixel = picture.at(x, y);
        for (std::size_t c = 0; c < 3; ++c) pixel[c] = screen_byte(light[c]);
      });
  }
  return picture;
}

}  // namespace tripoint

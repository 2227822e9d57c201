// SPDX-License-Identifier: BSD-3-Clause
#include "validation/campaign/invariance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "core/errors.hpp"
#include "validation/campaign/invariance_frames.hpp"

namespace tripoint {
namespace {

constexpr SignedAxes mirror_x{{0, 1, 2}, {-1.0, 1.0, 1.0}, -1.0};
// x to y, y to z, z to x: a third of a turn about (1, 1, 1)
constexpr SignedAxes next_axis{{2, 0, 1}, {1.0, 1.0, 1.0}, 1.0};
constexpr Units other_units{1024.0, 16.0, 4096.0};

// --- who refuses what

std::string always(const Scene&) { return {}; }

/// Places and motions that the scene gives besides its particles would have to change with them.
std::string has_places(const Scene& s) {
  if (!s.inflows.empty()) return "the scene has an inflow";
  if (!s.sources.empty()) return "the scene has a source of heat";
  for (const auto& b : s.bodies)
    if (!b.keyframes.empty()) return "body `" + b.name + "` moves by keyframes";
  for (const auto& e : s.events)
    if (e.region || !e.keyframes.empty()) return "an event names a region or keyframes";
  return {};
}

/// A boost is a symmetry of scenes in which nothing is held from outside.
std::string is_not_closed(const Scene& s) {
  for (const auto& b : s.bodies)
    if (b.motion != Motion::free) return "body `" + b.name + "` is held or driven from outside";
  if (s.periodic[0] || s.periodic[1] || s.periodic[2])
    return "the scene is periodic: places could not be taken back";
  if (!s.time_step) return "the time step follows the fastest speed: give scene.time_step";
  if (norm(s.gravity) > 0.0) return "gravity does work on what moves: its entry is the observer's";
  for (const auto& e : s.events)
    if (e.kind != Event::Kind::merge && e.kind != Event::Kind::split) return "an event holds what would move";
  return has_places(s);
}

std::string has_other_numbers(const Scene& s) {
  if (!s.inflows.empty()) return "the scene has an inflow";
  if (!s.sources.empty()) return "the scene has a source of heat";
  for (const auto& e : s.events)
    if (e.region || !e.keyframes.empty()) return "an event names a region or keyframes";
  return {};
}

// --- order, threads, ulp

void as_it_is(const ChangedScene&, Trajectory&) {}

void two_threads(ChangedScene& changed) { changed.threads = 2; }

/// A well-mixed number of a counter [Steele, Lea & Flood 2014, splitmix64].
std::uint64_t mixed(std::uint64_t n) {
  std::uint64_t z = (n + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// Row of the changed scene -> row of the scene itself.
std::vector<std::size_t> shuffled(std::size_t count) {
  std::vector<std::size_t> row(count);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t n = count; n > 1; --n) std::swap(row[n - 1], row[mixed(n) % n]);
  return row;
}

template <class T>
void gather(std::vector<T>& values, const std::vector<std::size_t>& from) {
  if (values.size() < from.size()) return;  // a column that the scene or the engine does not have
  const auto old = values;
  for (std::size_t n = 0; n < from.size(); ++n) values[n] = old[from[n]];
}

void shuffle(ChangedScene& changed) {
  auto& p = changed.initial;
  const auto from = shuffled(p.size());
  gather(p.position, from);
  gather(p.velocity, from);
  gather(p.mass, from);
  gather(p.temperature, from);
  gather(p.phase, from);
  gather(p.body, from);
  gather(p.material, from);
  gather(p.source, from);
}

void sort_back(const ChangedScene& before, Trajectory& run) {
  const auto from = shuffled(before.initial.size());
  std::vector<std::size_t> back(from.size());
  for (std::size_t n = 0; n < from.size(); ++n) back[from[n]] = n;
  for (auto& s : run.frames) {
    gather(s.position, back);
    gather(s.velocity, back);
    gather(s.mass, back);
    gather(s.temperature, back);
    gather(s.temperature_error, back);
    gather(s.density, back);
    gather(s.pressure, back);
    gather(s.liquid_fraction, back);
    gather(s.phase, back);
    gather(s.body, back);
    gather(s.material, back);
    gather(s.id, back);
    for (std::size_t i = 0; i < std::min(s.id.size(), back.size()); ++i)
      if (s.id[i] >= 0) s.id[i] = static_cast<int>(i);
  }
}

void nudge(ChangedScene& changed) {
  std::uint64_t n = 0;
  for (auto& r : changed.initial.position)
    for (std::size_t a = 0; a < 3; ++a) r[a] = std::nextafter(r[a], mixed(n++) % 2 ? INFINITY : -INFINITY);
}

// --- space, time and units

void mirror(ChangedScene& changed) { turn(mirror_x, changed); }
void mirror_back(const ChangedScene&, Trajectory& run) {
  for (auto& s : run.frames) turn(mirror_x, s);
}

void rotate_axes(ChangedScene& changed) { turn(next_axis, changed); }
void rotate_back_axes(const ChangedScene&, Trajectory& run) {
  for (auto& s : run.frames) turn(next_axis.inverse(), s);
}

/// As fast as the fastest particle, in a direction that no axis or symmetry of a scene is likely to share.
Vec3 boost_velocity(const ChangedScene& changed) {
  double fastest = 0.0;
  for (const auto& v : changed.initial.velocity) fastest = std::max(fastest, norm(v));
  return fastest * Vec3{0.625, -0.5, 0.59375};
}

void boost(ChangedScene& changed) {
  const Vec3 U = boost_velocity(changed);
  for (auto& v : changed.initial.velocity) v += U;
}
void ride_along(const ChangedScene& before, Trajectory& run) {
  const Vec3 U = boost_velocity(before);
  for (auto& s : run.frames) ride(-U, s);
}

void other_measures(ChangedScene& changed) { measure_in(other_units, changed); }
void own_measures(const ChangedScene&, Trajectory& run) {
  for (auto& s : run.frames)
    measure_in({1.0 / other_units.length, 1.0 / other_units.time, 1.0 / other_units.mass}, s);
}

}  // namespace

const std::vector<InvarianceChange>& invariance_changes() {
  constexpr std::string_view sums =
      "sums in another order: round-off, grown over the steps of a run that is not chaotic";
  static const std::vector<InvarianceChange> list{
      {"threads", "2 threads instead of 1", 0.0, "every sum has a fixed order: the same bits", always,
       two_threads, as_it_is},
      {"order", "the particles in another order", 1e-10, sums, always, shuffle, sort_back},
      {"ulp", "each coordinate one unit in the last place up or down", 1e-10,
       "round-off of the start, grown over the steps of a run that is not chaotic", always, nudge, as_it_is},
      {"boost", "every velocity plus one constant, seen from the moving frame", 1e-10,
       "round-off of places that lie further out, grown over the steps", is_not_closed, boost, ride_along},
      {"mirror", "the scene, its gravity and its domain mirrored in x", 1e-10, sums, has_places, mirror,
       mirror_back},
      {"rotation", "the scene, its gravity and its domain turned, x to y to z to x", 1e-10, sums, has_places,
       rotate_axes, rotate_back_axes},
      {"units",
       "length, time and mass in units of 1/1024 m, 1/16 s, 1/4096 kg: powers of 2, so that only a number "
       "with a unit in the "
       "code shows",
       1e-12, "library functions whose last bit depends on the exponent", has_other_numbers, other_measures,
       own_measures}};
  return list;
}

const InvarianceChange& invariance_change(std::string_view name) {
  const auto& all = invariance_changes();
  const auto at = std::find_if(all.begin(), all.end(), [&](const auto& c) { return c.name == name; });
  if (at != all.end()) return *at;
  std::vector<std::string_view> words;
  for (const auto& c : all) words.push_back(c.name);
  throw InputError(
      fmt::format("no invariance test is named \"{}\": write one of {}", name, fmt::join(words, " ")));
}

}  // namespace tripoint

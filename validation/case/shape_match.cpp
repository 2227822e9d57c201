// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/shape_match.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/mesh.hpp"
#include "sampling/sample.hpp"
#include "sampling/shape_distance.hpp"
#include "scene/geometry.hpp"

namespace tripoint {
namespace {

constexpr double most = 0.01;

/// The particles of a body; where it crosses a periodic side, some are wrapped to the other one.
struct Sampled {
  std::vector<Vec3> place;
  std::vector<double> mass;
};

/// What the particles of a body differ by from its shape.
struct Difference {
  double mass = 0.0, centre = 0.0;  ///< [1]; [m]
  double moments = 0.0;             ///< largest of the principal ones [1]
  double of_cells = 0.0;            ///< the same, each particle with the moment of its own cell
};

/// @param own added to each principal moment [kg m2]   @param planar of a layer the greatest, about y, counts
double moments_off(const MassProperties& particles, const MassProperties& shape, double own, bool planar) {
  double worst = 0.0;
  for (std::size_t k = planar ? 2 : 0; k < 3; ++k) {
    const double off = (particles.principal_inertia[k] + own) / shape.principal_inertia[k] - 1.0;
    if (std::abs(off) > std::abs(worst)) worst = off;
  }
  return worst;
}

Difference difference(const MassProperties& particles, const MassProperties& shape, const Scene& s) {
  return {particles.mass / shape.mass - 1.0, norm(particles.centre - shape.centre),
          moments_off(particles, shape, 0.0, s.is_planar()),
          moments_off(particles, shape, particles.mass * s.spacing * s.spacing / 6.0, s.is_planar())};
}

/// In words; empty where the particles fill their shape.
std::string in_words(const Difference& d, const MassProperties& particles, const MassProperties& shape,
                     double least_extent) {
  const bool light = std::abs(d.mass) > most, aside = d.centre > most * least_extent,
             other = std::abs(d.of_cells) > most;
  if (!light && !aside && !other) return {};
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (light)
    add(fmt::format("its particles weigh {:.4g} kg, its shape {:.4g} kg ({:+.1f} %)", particles.mass,
                    shape.mass, 100.0 * d.mass));
  if (std::abs(d.moments) > most)
    add(fmt::format("its moments of inertia are {:+.1f} % off", 100.0 * d.moments));
  if (aside) add(fmt::format("its centre of mass is {:.3g} m off", d.centre));
  return text;
}

/// Multiples of the spacing help a box; nothing but finer particles helps what is round.
std::string help(const Shape& shape, double spacing) {
  const bool fits = shape.kind == Shape::Kind::box && std::ranges::all_of(std::array{0, 1, 2}, [&](int a) {
                      const double n = bounds(shape).extent()[static_cast<std::size_t>(a)] / spacing;
                      return std::abs(n - std::round(n)) < 1e-6;
                    });
  return shape.kind != Shape::Kind::box || fits
             ? "refine scene.spacing, or write shape_mass = true where it is rigid"
             : fmt::format(
                   "make its sides multiples of scene.spacing = {:g} m, refine it, or write shape_mass = "
                   "true where it is rigid",
                   spacing);
}

bool crosses_periodic_side(const Scene& s, const Bounds& b) {
  for (std::size_t a = 0; a < 3; ++a)
    if (s.periodic[a] && (b.min[a] < (*s.min)[a] || b.max[a] > (*s.max)[a])) return true;
  return false;
}

std::size_t triangles_of(const Shape& shape) {
  std::size_t count =
      shape.kind == Shape::Kind::mesh ? read_mesh(shape.file, shape.scale).triangles.size() : 0;
  for (const Shape& part : shape.of) count += triangles_of(part);
  return count;
}

/// Calls f(body, particles, shape) for each body that moves and has a shape of finite bounds. Of a wall no
/// number counts.
template <class F>
void for_each_free(const Scene& s, const InitialState& state, F f) {
  std::vector<Sampled> bodies(s.bodies.size());
  for (std::size_t i = 0; i < state.size(); ++i) {
    auto& b = bodies[static_cast<std::size_t>(state.source[i])];
    b.place.push_back(state.position[i]);
    b.mass.push_back(state.mass[i]);
  }
  for (std::size_t n = 0; n < s.bodies.size(); ++n) {
    const Body& b = s.bodies[n];
    if (b.motion != Motion::free || s.jitter > 0.0 || carries_given_mass(b)) continue;
    const auto shape = mass_of_shape(b.shape, s.material(b.material).density, s.spacing, s.space());
    if (shape && shape->mass > 0.0) f(b, mass_properties(bodies[n].place, bodies[n].mass), *shape);
  }
}

}  // namespace

std::vector<MeshBody> mesh_bodies(const Scene& s, const InitialState& state) {
  std::vector<MeshBody> list;
  for (std::size_t n = 0; n < s.bodies.size(); ++n) {
    const Body& b = s.bodies[n];
    const auto triangles = triangles_of(b.shape);
    const auto shape = triangles > 0
                           ? mass_of_shape(b.shape, s.material(b.material).density, s.spacing, s.space())
                           : std::nullopt;
    if (!shape) continue;
    MeshBody m{n, triangles, bounds(b.shape).extent(), *shape, 0.0};
    for (std::size_t i = 0; i < state.size(); ++i)
      if (state.source[i] == static_cast<int>(n)) m.particles += state.mass[i];
    list.push_back(m);
  }
  return list;
}

std::vector<Finding> mesh_notes(const Scene& s, const InitialState& state) {
  std::vector<Finding> notes;
  for (const auto& m : mesh_bodies(s, state)) {
    const Body& b = s.bodies[m.body];
    const double density = s.material(b.material).density;
    notes.push_back(
        {false,
         fmt::format(
             "body \"{}\" is a mesh of {} triangles, {:.4g} x {:.4g} x {:.4g} m, {:.4g} m3: {:.6g} kg by its "
             "shape, "
             "{:.6g} kg by its particles; where its file is not in metres, shape.scale puts that right",
             b.name, m.triangles, m.extent.x, m.extent.y, m.extent.z, m.shape.mass / density, m.shape.mass,
             m.particles),
         b.place});
  }
  return notes;
}

std::vector<Finding> unlike_their_shapes(const Scene& s, const InitialState& state) {
  std::vector<Finding> findings;
  for_each_free(s, state, [&](const Body& b, const MassProperties& particles, const MassProperties& shape) {
    const Bounds reach = bounds(b.shape);
    const Vec3 extent = reach.extent();
    Difference d = difference(particles, shape, s);
    if (b.phase == Phase::liquid || crosses_periodic_side(s, reach)) d = {d.mass, 0.0, 0.0, 0.0};
    const auto what = in_words(d, particles, shape, std::min({extent.x, extent.y, extent.z}));
    if (!what.empty())
      findings.push_back(
          {false, fmt::format("body \"{}\": {}: {}", b.name, what, help(b.shape, s.spacing)), b.place});
  });
  return findings;
}

std::vector<Finding> moment_notes(const Scene& s, const InitialState& state) {
  std::vector<Finding> notes;
  for_each_free(s, state, [&](const Body& b, const MassProperties& particles, const MassProperties& shape) {
    const Difference d = difference(particles, shape, s);
    if (b.phase != Phase::rigid || std::abs(d.moments) <= most || std::abs(d.of_cells) > most ||
        std::abs(d.mass) > most)
      return;
    notes.push_back(
        {false,
         fmt::format(
             "body \"{}\" has so few particles that their moments of inertia are {:+.1f} % off those of its "
             "shape; every engine gets those of the particles",
             b.name, 100.0 * d.moments),
         b.place});
  });
  return notes;
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
// What a hit and a rest show of an engine: energy that is made, and surfaces that sink into the floor.
#include <algorithm>
#include <cmath>

#include "scene/geometry.hpp"
#include "scene/mesh.hpp"
#include "validation/metrics/frames.hpp"
#include "validation/metrics/impact_quantities.hpp"
#include "validation/metrics/members.hpp"

namespace tripoint {
namespace {

// --- energy ---------------------------------------------------------------------------------------------------------------

/// Kinetic and potential energy of the particles of free bodies that the metric takes [J].
double free_energy(const MetricInput& in, const Snapshot& s) {
  long double sum = 0;
  for (std::size_t i = 0; i < in.initial.size(); ++i) {
    if (!takes(in, i) || !is_alive(s, i) ||
        in.job.bodies.at(static_cast<std::size_t>(in.initial.source[i])).motion != Motion::free)
      continue;
    const double m = particle_mass(in, s, i);
    sum += static_cast<long double>(m) * (0.5 * dot(s.velocity[i], s.velocity[i]) - dot(in.job.scene.gravity, s.position[i]));
  }
  return double(sum);
}

/// Gravity and hits can only take energy. An excess of a frame over all frames before it is made by the engine.
MetricValue energy_gain(const MetricInput& in, const Frames& frames) {
  if (frames.size() < 2) return not_formed("an energy gain needs two output times or more");
  MetricValue v;
  v.value = 0.0;
  double least = INFINITY;
  for (const auto* s : frames) {
    if (s->position.size() < in.initial.size() || s->velocity.size() < in.initial.size())
      return not_formed("the trajectory has no positions and velocities");
    const double now = free_energy(in, *s);
    if (!std::isfinite(now)) return not_formed("the energy is not finite at t = " + std::to_string(s->time) + " s");
    least = std::min(least, now);
    if (now - least > v.value) {
      v.value = now - least;
      v.note = "most at t = " + std::to_string(s->time) + " s";
    }
    v.times.push_back(s->time);
    v.series.push_back(now);
  }
  return v;
}

// --- depth ----------------------------------------------------------------------------------------------------------------

/// Least height of the shape's surface along a unit vector, the shape being turned about `centre` and put to `at`. [m]
double lowest(const Shape& shape, const Vec3& centre, const BodyState& at, const Vec3& up) {
  const auto height = [&](const Vec3& x) { return dot(at.position + rotate(at.orientation, x - centre), up); };
  double least = INFINITY;
  switch (shape.kind) {
    case Shape::Kind::sphere:
      return height(shape.centre) - shape.radius;
    case Shape::Kind::unite:
      for (const Shape& part : shape.of) least = std::min(least, lowest(part, centre, at, up));
      return least;
    case Shape::Kind::mesh:
      for (const Vec3& p : read_mesh(shape.file, shape.scale).points) least = std::min(least, height(p));
      return least;
    case Shape::Kind::box:
      for (int k = 0; k < 8; ++k)
        least = std::min(least, height({k & 1 ? shape.max.x : shape.min.x, k & 2 ? shape.max.y : shape.min.y,
                                        k & 4 ? shape.max.z : shape.min.z}));
      return least;
    default:
      return not_a_number;
  }
}

FrameError sunk(const FramePair& f) {
  const auto axis = f.in.reference.measuring().axis;
  const auto level = f.in.reference.number_at("value", f.now.time);
  if (!axis || !level)
    return problem("sunk needs the floor: reference = {function = \"stated\", args = {axis = \"z\", value = 0.0}}");
  const auto body = job_body(f.in);
  const long row = body_row(f.in);
  if (row < 0 || static_cast<std::size_t>(row) >= f.now.bodies.size() ||
      !finite(f.now.bodies[static_cast<std::size_t>(row)].position))
    return problem("the trajectory does not have the body");
  Vec3 up;
  up[*axis] = f.in.job.scene.gravity[*axis] > 0.0 ? -1.0 : 1.0;
  const double floor = *level * up[*axis];
  const double depth = floor - lowest(f.in.job.scene.body(f.in.choice.body).shape, f.in.job.bodies[body].properties.centre,
                                      f.now.bodies[static_cast<std::size_t>(row)], up);
  return std::isfinite(depth) ? single(std::max(0.0, depth)) : problem("sunk knows boxes, spheres, meshes and unions of them");
}

}  // namespace

const std::vector<Quantity>& impact_quantities() {
  static const std::vector<Quantity> list{
      {{"sunk", "m",
        "depth of the lowest point of the body's own shape below the stated place along the stated axis; 0 above it"},
       sunk}};
  return list;
}

const std::vector<RunQuantity>& impact_run_quantities() {
  static const std::vector<RunQuantity> list{{{"energy_gain", "J",
                                               "largest rise of the kinetic and potential energy of free bodies (or of the body) "
                                               "over the least of all earlier frames; needs no reference"},
                                              energy_gain}};
  return list;
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
// What a hit and a rest show of an engine: energy that is made, and surfaces that sink into the floor.
#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/mesh.hpp"
#include "scene/geometry.hpp"
#include "validation/metrics/frames.hpp"
#include "validation/metrics/impact_quantities.hpp"
#include "validation/metrics/members.hpp"

namespace tripoint {
namespace {

// --- energy

/// Kinetic and potential energy of the particles of free bodies that the metric takes [J].
double free_energy(const MetricInput& in, const Snapshot& s) {
  long double sum = 0;
  for (std::size_t i = 0; i < in.initial.size(); ++i) {
    if (!takes(in, i) || !is_alive(s, i) || is_driven(in, i)) continue;
    const double m = particle_mass(in, s, i);
    sum += static_cast<long double>(m) *
           (0.5 * dot(s.velocity[i], s.velocity[i]) - dot(in.job.scene.gravity, s.position[i]));
  }
  return double(sum);
}

/// Mean velocity of each free body that the metric takes, by its row in Job::bodies.
std::map<int, Vec3> mean_velocities(const MetricInput& in, const Snapshot& s) {
  std::map<int, Vec3> sum;
  std::map<int, double> mass;
  for (std::size_t i = 0; i < in.initial.size(); ++i) {
    if (!takes(in, i) || is_driven(in, i) || !is_alive(s, i)) continue;
    const double m = particle_mass(in, s, i);
    sum[in.initial.source[i]] += m * s.velocity[i];
    mass[in.initial.source[i]] += m;
  }
  for (auto& [body, v] : sum) v = (1.0 / mass[body]) * v;
  return sum;
}

/// Whether nothing pushes harder than a floor with friction does between two frames. A hit pushes harder, and
/// stores energy.
bool is_quiet(const MetricInput& in, const Snapshot& before, const Snapshot& now) {
  constexpr double floor_with_friction = 1.5;  // sqrt(1 + mu^2) with mu = 1, in units of the weight
  const double dt = now.time - before.time;
  const auto then = mean_velocities(in, before);
  for (const auto& [body, v] : mean_velocities(in, now)) {
    const auto old = then.find(body);
    if (old == then.end()) continue;
    const double push = norm(v - old->second - dt * in.job.scene.gravity),
                 round_off = 1e-6 * norm(old->second);
    if (push > floor_with_friction * dt * norm(in.job.scene.gravity) + round_off) return false;
  }
  return true;
}

/// Frames whose energy is a bound for all later ones. In a hit a contact stores energy, and gives it back; so
/// does an elastic body at any time after the start.
std::vector<bool> bounds_later(const MetricInput& in, const Frames& frames) {
  std::vector<bool> bounds(frames.size(), true);
  bool stores = false;
  for (std::size_t i = 0; i < in.initial.size() && !stores; ++i)
    stores = takes(in, i) && !is_driven(in, i) && in.initial.phase[i] == static_cast<int>(Phase::elastic);
  for (std::size_t n = 1; n < frames.size(); ++n) {
    const bool quiet = is_quiet(in, *frames[n - 1], *frames[n]);
    bounds[n] = bounds[n] && quiet && !stores;
    if (n > 1) bounds[n - 1] = bounds[n - 1] && quiet;
  }
  return bounds;
}

/// What gives energy to free bodies, beside gravity: empty where nothing does.
std::string giver_of_energy(const MetricInput& in) {
  if (!in.job.scene.forces.empty()) return "a force of the scene";
  for (const JobBody& b : in.job.bodies)
    if (b.motion == Motion::prescribed && (norm(b.velocity) > 0.0 || b.keyframes.size() > 1))
      return "the led body " + b.name;
  return {};
}

/// Gravity and hits can only take energy. An excess of a frame over all bounds before it is made by the
/// engine.
MetricValue energy_gain(const MetricInput& in, const Frames& frames) {
  if (frames.size() < 2) return not_formed("an energy gain needs two output times or more");
  for (const auto* s : frames)
    if (s->position.size() < in.initial.size() || s->velocity.size() < in.initial.size())
      return not_formed("the trajectory has no positions and velocities");
  if (const auto giver = giver_of_energy(in); !giver.empty())
    return not_formed(giver + " gives energy, so that a gain is no error");
  const auto bounds = bounds_later(in, frames);
  MetricValue v;
  v.value = 0.0;
  double least = INFINITY;
  for (std::size_t n = 0; n < frames.size(); ++n) {
    const double now = free_energy(in, *frames[n]), time = frames[n]->time;
    if (!std::isfinite(now))
      return not_formed("the energy is not finite at t = " + std::to_string(time) + " s");
    if (now - least > v.value) {
      v.value = now - least;
      v.note = "most at t = " + std::to_string(time) + " s";
    }
    if (bounds[n]) least = std::min(least, now);
    v.times.push_back(time);
    v.series.push_back(now);
  }
  return v;
}

// --- depth

double lowest(const Shape& shape, const Vec3& centre, const BodyState& at, const Vec3& up);

/// A turned shape is the shape that is not turned, of a body whose orientation begins with that turn.
double lowest_of_turned(const Shape& shape, const Vec3& centre, BodyState at, const Vec3& up) {
  const Vec3 middle = turning_centre(shape);
  at.orientation = at.orientation * shape.rotation;
  return lowest(not_turned(shape), middle + rotate_back(shape.rotation, centre - middle), at, up);
}

/// Least height of the shape's surface along a unit vector, the shape being turned about `centre` and put to
/// `at`. [m]
double lowest(const Shape& shape, const Vec3& centre, const BodyState& at, const Vec3& up) {
  if (is_turned(shape)) return lowest_of_turned(shape, centre, at, up);
  const auto height = [&](const Vec3& x) {
    return dot(at.position + rotate(at.orientation, x - centre), up);
  };
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
    case Shape::Kind::cylinder: {
      const Vec3 axis = rotate(at.orientation, shape.axis);
      const double rim = shape.radius * std::sqrt(std::max(0.0, 1.0 - dot(axis, up) * dot(axis, up)));
      return std::min(height(shape.base), height(shape.base + shape.length * shape.axis)) - rim;
    }
    default:
      return not_a_number;
  }
}

FrameError sunk(const FramePair& f) {
  const auto axis = f.in.reference.measuring().axis;
  const auto level = f.in.reference.number_at("value", f.now.time);
  if (!axis || !level)
    return problem(
        "sunk needs the floor: reference = {function = \"stated\", args = {axis = \"z\", value = 0.0}}");
  const auto body = job_body(f.in);
  const long row = body_row(f.in);
  if (row < 0 || static_cast<std::size_t>(row) >= f.now.bodies.size() ||
      !finite(f.now.bodies[static_cast<std::size_t>(row)].position))
    return problem("the trajectory does not have the body");
  Vec3 up;
  up[*axis] = f.in.job.scene.gravity[*axis] > 0.0 ? -1.0 : 1.0;
  const double floor = *level * up[*axis];
  const double depth =
      floor - lowest(f.in.job.scene.body(f.in.choice.body).shape, f.in.job.bodies[body].properties.centre,
                     f.now.bodies[static_cast<std::size_t>(row)], up);
  return std::isfinite(depth) ? single(std::max(0.0, depth))
                              : problem("sunk knows boxes, spheres, cylinders, meshes and unions of them");
}

}  // namespace

const std::vector<Quantity>& impact_quantities() {
  static const std::vector<Quantity> list{{{"sunk", "m",
                                            "depth of the lowest point of the body's own shape below the "
                                            "stated place along the stated axis; 0 above it"},
                                           sunk}};
  return list;
}

const std::vector<RunQuantity>& impact_run_quantities() {
  static const std::vector<RunQuantity> list{
      {{"energy_gain", "J",
        "largest rise of the kinetic and potential energy of free "
        "bodies over the least of earlier frames outside hits. Of "
        "elastic bodies, over the start. None where a force or a moving body gives energy"},
       energy_gain}};
  return list;
}

}  // namespace tripoint

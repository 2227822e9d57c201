// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/resting.hpp"

#include <cmath>

#include "files/job.hpp"
#include "scene/geometry.hpp"
#include "validation/references/heat_scene.hpp"

namespace tripoint {
namespace {

/// Bodies at rest: a free box lies face on face on the held one below it.
class Resting : public Reference {
 public:
  explicit Resting(std::vector<BodyState> rows) : rows_(std::move(rows)) {}
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    out.bodies = rows_;
    return out;
  }

 private:
  std::vector<BodyState> rows_;
};

std::unique_ptr<Reference> make_resting(const ReferenceInput& in) {
  auto scene = box_on_floor(in, "resting");
  scene.start[scene.block].position[scene.axis] = scene.rest;
  return std::make_unique<Resting>(std::move(scene.start));
}

}  // namespace

BoxOnFloor box_on_floor(const ReferenceInput& in, const char* function) {
  const std::string name = function;
  if (norm(in.job.scene.gravity) == 0.0 || in.job.bodies.size() != 2)
    throw InputError(name + " holds for one free box or ball above one held body, with gravity");
  BoxOnFloor s;
  s.axis = axis_of(in.job.scene.gravity, name + ": gravity");
  s.up = in.job.scene.gravity[s.axis] > 0.0 ? -1.0 : 1.0;
  s.block = 2;
  for (std::size_t b = 0; b < 2; ++b) {
    BodyState row;
    row.position = in.job.bodies[b].properties.centre;
    row.mass = in.job.bodies[b].properties.mass;
    s.start.push_back(row);
    if (in.job.bodies[b].motion == Motion::free) s.block = b;
  }
  if (s.block == 2 || in.job.bodies[1 - s.block].motion != Motion::fixed)
    throw InputError(name + " needs one free and one fixed body");
  const auto box = body_along(s.axis, s.block, in.job, in.initial),
             floor = body_along(s.axis, 1 - s.block, in.job, in.initial);
  const Shape& shape = in.job.scene.body(in.job.bodies[s.block].name).shape;
  if (has_turned_part(shape)) throw InputError(name + " holds for a body that is not turned");
  // a ball's particles end below its surface
  const double half = shape.kind == Shape::Kind::sphere ? shape.radius : 0.5 * box.length();
  s.rest = (s.up > 0.0 ? floor.high : floor.low) + s.up * half;
  return s;
}

ReferenceEntry resting_entry() {
  return {{"resting", "analytic", "impenetrability: faces touch", "a box at rest on the floor below it", {}},
          make_resting};
}

}  // namespace tripoint

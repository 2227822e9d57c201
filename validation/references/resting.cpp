// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "validation/references/functions.hpp"
#include "validation/references/heat_scene.hpp"

namespace tripoint {
namespace {

/// Bodies at rest: a free box lies face on face on the held one below it.
class Resting : public Reference {
 public:
  Resting(const ReferenceInput& in, std::vector<BodyState> rows) : rows_(std::move(rows)) { (void)in; }
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
  if (norm(in.job.scene.gravity) == 0.0 || in.job.bodies.size() != 2) throw InputError("resting holds for one free box above one held body, with gravity");
  const auto axis = axis_of(in.job.scene.gravity, "resting: gravity");
  const double up = in.job.scene.gravity[axis] > 0.0 ? -1.0 : 1.0;
  std::vector<BodyState> rows;
  std::size_t block = 2;
  for (std::size_t b = 0; b < 2; ++b) {
    BodyState s;
    s.position = in.job.bodies[b].properties.centre;
    s.mass = in.job.bodies[b].properties.mass;
    rows.push_back(s);
    if (in.job.bodies[b].motion == Motion::free) block = b;
  }
  if (block == 2 || in.job.bodies[1 - block].motion != Motion::fixed) throw InputError("resting needs one free and one fixed body");
  const auto box = body_along(axis, block, in.job, in.initial), floor = body_along(axis, 1 - block, in.job, in.initial);
  const double contact = up > 0.0 ? floor.high : floor.low;
  rows[block].position[axis] = contact + up * 0.5 * box.length();
  return std::make_unique<Resting>(in, std::move(rows));
}

}  // namespace

ReferenceEntry resting_entry() {
  return {{"resting", "analytic", "impenetrability: faces touch", "a box at rest on the floor below it", {}}, make_resting};
}

}  // namespace tripoint

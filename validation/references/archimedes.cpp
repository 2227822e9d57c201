// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "files/job.hpp"
#include "scene/geometry.hpp"
#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

/// A body floats where it displaces its own weight. Numbers: draught [m]. For the metric of that name the
/// pool: up (+1, -1), floor [m], pool_area, block_area [m2], liquid_volume [m3]. Also keel [m] (bottom of the
/// body below its centre).
class Archimedes : public LiquidReference {
 public:
  Archimedes(const ReferenceInput& in, std::size_t axis, std::map<std::string, double, std::less<>> numbers)
      : LiquidReference(in.job, in.initial), axis_(axis), numbers_(std::move(numbers)) {}
  [[nodiscard]] Measuring measuring() const override { return {.axis = axis_}; }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    const auto found = numbers_.find(quantity);
    return found == numbers_.end() ? std::nullopt : std::optional(found->second);
  }

 protected:
  [[nodiscard]] LiquidState state(const Vec3&, double, std::size_t) const override { return {}; }

 private:
  std::size_t axis_;
  std::map<std::string, double, std::less<>> numbers_;
};

std::unique_ptr<Reference> make_archimedes(const ReferenceInput& in) {
  const auto& job = in.job;
  if (norm(job.scene.gravity) == 0.0) throw InputError("archimedes: the scene has no gravity");
  const auto axis = axis_of(job.scene.gravity, "archimedes: gravity");
  const auto liquid = only_liquid(job, "archimedes"), block = solid_body(in, Motion::free, "archimedes");
  const auto& shape = job.scene.bodies.at(block).shape;
  if (!is_upright_box(shape)) throw InputError("archimedes holds for a floating box");
  const double up = job.scene.gravity[axis] > 0.0 ? -1.0 : 1.0;
  double pool = 1.0, area = 1.0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (k == axis) continue;
    if (!is_endless(job.scene, k)) throw InputError("archimedes: the pool must be periodic across gravity");
    const auto box = body_along(k, block, job, in.initial);
    pool *= (*job.scene.max)[k] - (*job.scene.min)[k];
    area *= box.length();
  }
  const auto water = body_along(axis, liquid, job, in.initial),
             box = body_along(axis, block, job, in.initial);
  const double ratio = material_of_body(job, block).density / material_of_body(job, liquid).density;
  if (ratio >= 1.0) throw InputError("archimedes: body `" + job.bodies[block].name + "` sinks");
  const double volume = job.bodies[liquid].properties.mass / material_of_body(job, liquid).density;
  return std::make_unique<Archimedes>(
      in, axis,
      std::map<std::string, double, std::less<>>{{"draught", ratio * box.length()},
                                                 {"up", up},
                                                 {"floor", up > 0.0 ? water.low : -water.high},
                                                 {"pool_area", pool},
                                                 {"block_area", area},
                                                 {"liquid_volume", volume},
                                                 {"keel", 0.5 * box.length()}});
}

}  // namespace

ReferenceEntry archimedes_entry() {
  return {{"archimedes",
           "analytic",
           "Archimedes, On Floating Bodies: a floating body displaces its own weight",
           "draught of a floating box in a pool that is periodic across gravity",
           {{"body", "", "the floating body; default the scene's only free one", ArgumentType::word}}},
          make_archimedes};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/references/collapse_mesh.hpp"
#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

constexpr double fewest_cells = 4.0, most_cells = 80.0, cells_unless_given = 20.0;
constexpr int curve_points = 20;  // of even times until the end, the end itself left out

/// The front of an inviscid column as a curve in time, as an experiment would have it.
class CollapsingColumn : public Reference {
 public:
  CollapsingColumn(std::size_t axis, MeasuredCurve front) : axis_(axis), front_(std::move(front)) {}
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    return out;
  }
  [[nodiscard]] Measuring measuring() const override { return {.axis = axis_}; }
  [[nodiscard]] const MeasuredCurve* measured(std::string_view column) const override {
    return column == "front" ? &front_ : nullptr;
  }

 private:
  std::size_t axis_;
  MeasuredCurve front_;
};

/// The axis of gravity, downwards. @throws InputError where it points elsewhere
std::size_t downward_axis(const Scene& scene) {
  const Vec3& g = scene.gravity;
  for (std::size_t k = 0; k < 3; ++k)
    if (g[k] < 0.0 && norm(g) == -g[k]) return k;
  throw InputError("collapsing_column needs gravity along the negative direction of one axis");
}

std::unique_ptr<Reference> make_column(const ReferenceInput& in) {
  const auto& scene = in.job.scene;
  const auto& box = scene.bodies.at(only_liquid(in.job, "collapsing_column")).shape;
  const auto axis = in.args.axis("axis").value_or(0), down = downward_axis(scene);
  if (box.kind != Shape::Kind::box || axis == down)
    throw InputError("collapsing_column needs a box of liquid and an axis across gravity along which it runs");
  const double cells = in.args.number("cells").value_or(cells_unless_given);
  if (!(cells >= fewest_cells && cells <= most_cells) || cells != std::floor(cells))
    throw InputError("collapsing_column: cells across the width are a whole number from 4 to 80");
  MeasuredCurve curve;
  for (int n = 1; n < curve_points; ++n) curve.time.push_back(scene.end_time * n / curve_points);
  const LiquidColumn column{box.max[axis] - box.min[axis], box.max[down] - box.min[down], norm(scene.gravity)};
  const auto found = collapse_fronts(column, static_cast<int>(cells), curve.time);
  for (const double x : found.front) curve.value.push_back(box.min[axis] + x);
  curve.uncertainty = found.difference;
  return std::make_unique<CollapsingColumn>(axis, std::move(curve));
}

}  // namespace

ReferenceEntry collapsing_column_entry() {
  return {{"collapsing_column",
           "self",
           "Lagrange's equations of an incompressible mesh that moves with the liquid, stepped by Verlet's scheme; its standard "
           "uncertainty is what half as many cells change",
           "front of a box of inviscid liquid, let go against a wall on a floor, both without friction",
           {{"axis", "", "x, y or z: along which the front runs, away from the wall; x", ArgumentType::axis},
            {"cells", "1", "of the mesh across the column's width, 4 to 80; 20", ArgumentType::number}}},
          make_column};
}

}  // namespace tripoint

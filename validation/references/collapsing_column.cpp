// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "files/job.hpp"
#include "scene/geometry.hpp"
#include "validation/references/collapse_mesh.hpp"
#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

constexpr double fewest_cells = 4.0, most_cells = 80.0, cells_unless_given = 20.0;
constexpr int pressure_points = 100;
constexpr int curve_points = 20;  // of even times until the end, the end itself left out

/// A curve between its points by straight lines, empty outside.
std::optional<double> along(const std::vector<double>& time, const std::vector<double>& value, double at) {
  const auto next = std::lower_bound(time.begin(), time.end(), at);
  if (next == time.end() || (next == time.begin() && at < *next)) return {};
  const auto k = static_cast<std::size_t>(std::max<std::ptrdiff_t>(1, next - time.begin()));
  return value[k - 1] + (at - time[k - 1]) / (time[k] - time[k - 1]) * (value[k] - value[k - 1]);
}

/// The front of an inviscid column as a curve in time, as an experiment would have it. Where a point is
/// stated, also the pressure there.
class CollapsingColumn : public Reference {
 public:
  CollapsingColumn(std::size_t axis, MeasuredCurve front, std::optional<Vec3> point, MeasuredCurve pressure)
      : axis_(axis), front_(std::move(front)), point_(point), pressure_(std::move(pressure)) {}
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    return out;
  }
  [[nodiscard]] Measuring measuring() const override { return {.axis = axis_, .point = point_}; }
  [[nodiscard]] std::optional<double> number_at(std::string_view quantity, double time) const override {
    return point_ && quantity == "pressure_at" ? along(pressure_.time, pressure_.value, time) : std::nullopt;
  }
  [[nodiscard]] std::optional<double> uncertainty(std::string_view quantity, double time) const override {
    return point_ && quantity == "pressure_at" ? along(pressure_.time, pressure_.uncertainty, time)
                                               : std::nullopt;
  }
  [[nodiscard]] const MeasuredCurve* measured(std::string_view column) const override {
    return column == "front" ? &front_ : nullptr;
  }

 private:
  std::size_t axis_;
  MeasuredCurve front_;
  std::optional<Vec3> point_;
  MeasuredCurve pressure_;
};

/// Pressure at a place in the liquid, from the start to the end [Pa].
MeasuredCurve pressure_curve(const ReferenceInput& in, const LiquidColumn& column, int cells, double x,
                             double y) {
  MeasuredCurve curve;
  for (int n = 0; n <= pressure_points; ++n)
    curve.time.push_back(in.job.scene.end_time * n / pressure_points);
  const auto found = collapse_pressures(column, cells, curve.time, x, y);
  const double unit = material_of_body(in.job, only_liquid(in.job, "collapsing_column")).density *
                      column.gravity * column.width;
  for (const double p : found.pressure) curve.value.push_back(unit * p);
  for (const double p : found.difference) curve.uncertainty.push_back(unit * p);
  return curve;
}

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
  if (!is_upright_box(box) || axis == down)
    throw InputError(
        "collapsing_column needs a box of liquid and an axis across gravity along which it runs");
  const double cells = in.args.number("cells").value_or(cells_unless_given);
  if (!(cells >= fewest_cells && cells <= most_cells) || cells != std::floor(cells))
    throw InputError("collapsing_column: cells across the width are a whole number from 4 to 80");
  MeasuredCurve curve;
  for (int n = 1; n < curve_points; ++n) curve.time.push_back(scene.end_time * n / curve_points);
  const LiquidColumn column{box.max[axis] - box.min[axis], box.max[down] - box.min[down],
                            norm(scene.gravity)};
  const auto found = collapse_fronts(column, static_cast<int>(cells), curve.time);
  for (const double x : found.front) curve.value.push_back(box.min[axis] + x);
  curve.uncertainty = found.difference;
  const auto point = in.args.vector("point");
  MeasuredCurve pressure;
  if (point)
    pressure = pressure_curve(in, column, static_cast<int>(cells), (*point)[axis] - box.min[axis],
                              (*point)[down] - box.min[down]);
  return std::make_unique<CollapsingColumn>(axis, std::move(curve), point, std::move(pressure));
}

}  // namespace

ReferenceEntry collapsing_column_entry() {
  return {{"collapsing_column",
           "self",
           "Lagrange's equations of an incompressible mesh, stepped by Verlet's scheme; its standard "
           "uncertainty is the change "
           "with half the cells",
           "front of a box of inviscid liquid, let go against a wall on a floor, both without friction; "
           "pressure at a point",
           {{"axis", "", "x, y or z: along which the front runs, away from the wall; x", ArgumentType::axis},
            {"cells", "1", "of the mesh across the column's width, 4 to 80; 20", ArgumentType::number},
            {"point", "m", "place in the liquid, for the quantity pressure_at", ArgumentType::vector}}},
          make_column};
}

}  // namespace tripoint

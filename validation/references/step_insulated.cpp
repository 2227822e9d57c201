// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "files/job.hpp"
#include "validation/references/functions.hpp"
#include "validation/references/heat_scene.hpp"
#include "validation/references/step_images.hpp"

namespace tripoint {
namespace {

class StepBar : public HeatReference {
 public:
  StepBar(const ReferenceInput& in, const StepImages& step, double behind, double ahead, double cell)
      : HeatReference(in.job, in.initial), step_(step), behind_(behind), ahead_(ahead), cell_(cell) {}
  [[nodiscard]] Measuring measuring() const override { return {.axis = step_.bar.axis}; }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "diffusivity") return step_.diffusivity;
    return {};
  }

 protected:
  [[nodiscard]] double temperature(const Vec3& place, double time) const override {
    return ahead_ + (behind_ - ahead_) * share_of_low_side(step_, place[step_.bar.axis], cell_, time);
  }

 private:
  StepImages step_;
  double behind_, ahead_, cell_;  // temperatures of the low and the high side
};

const TemperatureField& scene_step(const Job& job) {
  for (const auto& body : job.scene.bodies)
    if (body.temperature && body.temperature->kind == TemperatureField::Kind::step) return *body.temperature;
  throw InputError("step_insulated needs a body with temperature = {kind = \"step\", ...}");
}

std::unique_ptr<Reference> make_step(const ReferenceInput& in) {
  const auto& field = scene_step(in.job);
  const auto axis = axis_of(field.normal, "the normal of the step");
  const bool upward = field.normal[axis] > 0.0;
  StepImages step;
  step.bar = bar_along(axis, in.job, in.initial);
  step.place = in.args.number("place").value_or(field.point[axis]);
  step.diffusivity =
      in.args.number("diffusivity") ? *in.args.number("diffusivity") : common_diffusivity(in.job);
  if (step.place <= step.bar.low || step.place >= step.bar.high)
    throw InputError("the step lies outside the bar");
  const bool cells = in.args.flag("cell_average").value_or(in.job.resolution.walkers.has_value());
  const double low = upward ? field.behind : field.ahead, high = upward ? field.ahead : field.behind;
  return std::make_unique<StepBar>(in, step, low, high, cells ? in.job.scene.spacing : 0.0);
}

}  // namespace

ReferenceEntry step_insulated_entry() {
  return {{"step_insulated",
           "analytic",
           "Carslaw & Jaeger, Conduction of Heat in Solids, 1959: method of images with the error function",
           "a step of temperature in a bar with insulated ends, or in a periodic one (then with the second "
           "step at the periodic "
           "boundary)",
           {{"place", "m", "of the step along its axis; default the point of the body's step"},
            {"diffusivity", "m2/s", "k/(rho c_p); default of the bodies' material"},
            {"cell_average", "",
             "means over cells of one spacing instead of values at points; default true for runs by walkers",
             ArgumentType::flag}}},
          make_step};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "files/job.hpp"
#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

/// Start of a sphere in still liquid. Numbers: acceleration along gravity's line, upward positive [m/s2],
/// axis, up.
class AddedMass : public LiquidReference {
 public:
  AddedMass(const ReferenceInput& in, std::size_t axis, double acceleration)
      : LiquidReference(in.job, in.initial),
        axis_(axis),
        up_(in.job.scene.gravity[axis] > 0.0 ? -1.0 : 1.0),
        acceleration_(acceleration) {}
  [[nodiscard]] Measuring measuring() const override { return {.axis = axis_}; }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "acceleration") return acceleration_;
    if (quantity == "up") return up_;
    return {};
  }

 protected:
  [[nodiscard]] LiquidState state(const Vec3&, double, std::size_t) const override { return {}; }

 private:
  std::size_t axis_;
  double up_, acceleration_;
};

/// Rest density of the liquid, which may come in several bodies [kg/m3].
double liquid_density(const Job& job) {
  const auto liquids = liquid_bodies(job);
  if (liquids.empty()) throw InputError("added_mass: the scene has no liquid");
  const double density = material_of_body(job, liquids.front()).density;
  for (const auto b : liquids)
    if (material_of_body(job, b).density != density)
      throw InputError("added_mass holds for liquid of one density");
  return density;
}

std::unique_ptr<Reference> make_added_mass(const ReferenceInput& in) {
  if (norm(in.job.scene.gravity) == 0.0) throw InputError("added_mass: the scene has no gravity");
  const auto axis = axis_of(in.job.scene.gravity, "added_mass: gravity");
  const auto ball = solid_body(in, Motion::free, "added_mass");
  const auto& shape = in.job.scene.bodies.at(ball).shape;
  if (shape.kind != Shape::Kind::sphere) throw InputError("added_mass holds for a sphere");
  // The sphere that the particles are: their mass, and their volume, not the drawn one's.
  const double s = material_of_body(in.job, ball).density / liquid_density(in.job);
  const double coefficient =
      0.5 * (1.0 + 3.0 * std::pow(in.args.number("radius_over_wall").value_or(0.0), 3));
  return std::make_unique<AddedMass>(in, axis, (1.0 - s) / (s + coefficient) * norm(in.job.scene.gravity));
}

}  // namespace

ReferenceEntry added_mass_entry() {
  return {{"added_mass",
           "analytic",
           "Landau & Lifshitz, Fluid Mechanics, section 11: half of the displaced liquid; in a concentric "
           "shell 1/2 (1 + 3 "
           "(R/R_wall)^3)",
           "start of a sphere in still liquid: upward at (1 - s)/(s + 1/2) g, s the ratio of densities",
           {{"body", "", "the sphere; default the scene's only free body", ArgumentType::word},
            {"radius_over_wall", "1",
             "radius of the sphere over that of a concentric wall; default 0: far walls"}}},
          make_added_mass};
}

}  // namespace tripoint

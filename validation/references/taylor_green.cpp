// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

/// u = U (-cos kx sin ky, sin kx cos ky) exp(-2 nu k^2 t). Numbers: velocity_rate, at which it decays [1/s].
class TaylorGreen : public LiquidReference {
 public:
  TaylorGreen(const ReferenceInput& in, double speed, double wave_number, double viscosity, double density)
      : LiquidReference(in.job, in.initial), speed_(speed), k_(wave_number), rate_(2.0 * viscosity * wave_number * wave_number), density_(density) {}
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "velocity_rate") return rate_;
    return {};
  }

 protected:
  [[nodiscard]] LiquidState state(const Vec3& r, double time, std::size_t) const override {
    const double U = speed_ * std::exp(-rate_ * time);
    LiquidState s;
    s.velocity = {-U * std::cos(k_ * r.x) * std::sin(k_ * r.y), U * std::sin(k_ * r.x) * std::cos(k_ * r.y), 0.0};
    s.pressure = -0.25 * density_ * U * U * (std::cos(2.0 * k_ * r.x) + std::cos(2.0 * k_ * r.y));
    return s;
  }

 private:
  double speed_, k_, rate_, density_;
};

std::unique_ptr<Reference> make_vortices(const ReferenceInput& in) {
  const auto liquid = only_liquid(in.job, "taylor_green");
  const auto& v = in.job.scene.bodies.at(liquid).velocity;
  if (v.kind != VelocityField::Kind::taylor_green || !in.job.scene.periodic[0] || !in.job.scene.periodic[1])
    throw InputError("taylor_green needs a liquid with velocity = {kind = \"taylor_green\", ...}, periodic in x and y");
  return std::make_unique<TaylorGreen>(in, v.speed, 2.0 * std::numbers::pi / v.wavelength, kinematic_viscosity(in.job, liquid), material_of_body(in.job, liquid).density);
}

}  // namespace

ReferenceEntry taylor_green_entry() {
  return {{"taylor_green", "analytic", "Taylor & Green 1937: vortices that decay as exp(-2 nu k^2 t)", "a square of periodic vortices", {}}, make_vortices};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

/// One layer of liquid: heights above the origin, against gravity [m].
struct LiquidLayer {
  double low, high, density;
};

/// Layers of liquid at rest: the pressure is the weight above. A single one may be compressed by it, p = c^2 (rho - rho0): then
/// dp/dz = -rho g gives p = c^2 rho0 (exp(g (z_s - z)/c^2) - 1), and its surface has fallen to z_s = low + c^2/g ln(1 + g H/c^2),
/// where it has the mass of before. Numbers: bottom_pressure, interface_pressure [Pa], interface [m] (height of the highest
/// interface along the axis), axis.
class Hydrostatic : public LiquidReference {
 public:
  /// @param sound speed of sound of a single layer that its weight compresses [m/s], 0 = incompressible
  Hydrostatic(const ReferenceInput& in, std::size_t axis, std::vector<LiquidLayer> layers, double factor, double sound)
      : LiquidReference(in.job, in.initial),
        axis_(axis),
        up_(in.job.scene.gravity[axis] > 0.0 ? -1.0 : 1.0),
        gravity_(norm(in.job.scene.gravity)),
        factor_(factor),
        sound2_(sound * sound),
        layers_(std::move(layers)) {}

  [[nodiscard]] Measuring measuring() const override { return {.axis = axis_}; }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "bottom_pressure") return weight_above(layers_.front().low);
    if (layers_.size() > 1 && quantity == "interface") return up_ * layers_.back().low;
    if (layers_.size() > 1 && quantity == "interface_pressure") return weight_above(layers_.back().low);
    return {};
  }

 protected:
  [[nodiscard]] LiquidState state(const Vec3& place, double, std::size_t particle) const override {
    LiquidState s;
    s.velocity = {};
    s.pressure = weight_above(up_ * place[axis_]);
    for (const auto& layer : layers_)
      if (up_ * initial_.position[particle][axis_] < layer.high && std::isnan(s.density)) s.density = layer.density;
    return s;
  }

 private:
  /// Pressure at a height [Pa]: zero above the surface; below the floor it goes on rising.
  [[nodiscard]] double weight_above(double height) const {
    if (sound2_ > 0.0) {
      const auto& [low, high, density] = layers_.front();
      const double surface = low + sound2_ / gravity_ * std::log1p(gravity_ * (high - low) / sound2_);
      return factor_ * sound2_ * density * std::expm1(gravity_ * std::max(0.0, surface - height) / sound2_);
    }
    double p = 0.0;
    for (std::size_t n = 0; n < layers_.size(); ++n) {
      const double low = n == 0 ? std::min(height, layers_[n].low) : layers_[n].low;
      p += layers_[n].density * gravity_ * std::max(0.0, layers_[n].high - std::max(height, low));
    }
    return factor_ * p;
  }
  std::size_t axis_;
  double up_, gravity_, factor_, sound2_;
  std::vector<LiquidLayer> layers_;
};

std::vector<LiquidLayer> stacked_layers(const ReferenceInput& in, std::size_t axis) {
  const double up = in.job.scene.gravity[axis] > 0.0 ? -1.0 : 1.0;
  std::vector<LiquidLayer> layers;
  for (const std::size_t b : liquid_bodies(in.job)) {
    const auto along = body_along(axis, b, in.job, in.initial);
    layers.push_back({std::min(up * along.low, up * along.high), std::max(up * along.low, up * along.high),
                      material_of_body(in.job, b).density});
  }
  std::sort(layers.begin(), layers.end(), [](const auto& a, const auto& b) { return a.low < b.low; });
  for (std::size_t n = 1; n < layers.size(); ++n)
    if (std::abs(layers[n].low - layers[n - 1].high) > 1e-6 * (layers[n].high - layers[n].low))
      throw InputError("hydrostatic: the layers of liquid leave a gap or overlap");
  return layers;
}

std::unique_ptr<Reference> make_hydrostatic(const ReferenceInput& in) {
  if (norm(in.job.scene.gravity) == 0.0) throw InputError("hydrostatic: the scene has no gravity");
  if (liquid_bodies(in.job).empty()) throw InputError("hydrostatic: the scene has no liquid");
  const auto axis = axis_of(in.job.scene.gravity, "hydrostatic: gravity");
  const auto layers = stacked_layers(in, axis);
  const bool compressed = in.args.flag("compressed").value_or(false);
  if (compressed && layers.size() > 1) throw InputError("hydrostatic: compressed is for one layer of liquid");
  const double sound = compressed ? state_sound_speed(in.job, liquid_bodies(in.job).front()) : 0.0;
  return std::make_unique<Hydrostatic>(in, axis, layers, in.args.number("factor").value_or(1.0), sound);
}

}  // namespace

ReferenceEntry hydrostatic_entry() {
  return {{"hydrostatic",
           "analytic",
           "Archimedes, Pascal: the pressure is the weight of the liquid above",
           "liquid at rest, in layers stacked along gravity",
           {{"factor", "1",
             "of the whole pressure: what an equation that tends to 1/factor of the pressure gradient has to read; default 1"},
            {"compressed", "true or false",
             "the one layer is compressed by its weight, at the speed of sound of the scene: its surface has fallen; default "
             "false",
             ArgumentType::flag}}},
          make_hydrostatic};
}

}  // namespace tripoint

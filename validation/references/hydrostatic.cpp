// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "files/job.hpp"
#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

/// One layer of liquid: heights above the origin, against gravity [m].
struct LiquidLayer {
  double low, high, density;
  std::size_t body;
};

/// Layers of liquid at rest: the pressure is the weight above. They may be compressed by it, p = c^2 (rho -
/// rho0). Then dp/dz = -rho g gives p + c^2 rho0 = (p_t + c^2 rho0) exp(g (z_t - z)/c^2) in a layer with the
/// pressure p_t at its top z_t. The top has fallen to c^2/g ln(1 + g H/(c^2 + p_t/rho0)) above its bottom,
/// where the layer has its former mass. Numbers: bottom_pressure, interface_pressure [Pa], interface [m]
/// (height of the highest interface along the axis, before it has fallen), axis.
class Hydrostatic : public LiquidReference {
 public:
  /// @param sound speeds of sound of the layers that their weight compresses [m/s], none = incompressible
  Hydrostatic(const ReferenceInput& in, std::size_t axis, std::vector<LiquidLayer> layers, double factor,
              const std::vector<double>& sound)
      : LiquidReference(in.job, in.initial),
        axis_(axis),
        up_(in.job.scene.gravity[axis] > 0.0 ? -1.0 : 1.0),
        gravity_(norm(in.job.scene.gravity)),
        factor_(factor),
        layers_(std::move(layers)) {
    double low = layers_.front().low;
    for (std::size_t n = 0; n < sound.size(); ++n) {
      const double c2 = sound[n] * sound[n], above = weight_above(layers_[n].high) / factor_,
                   thickness = layers_[n].high - layers_[n].low;
      low += c2 / gravity_ * std::log1p(gravity_ * thickness / (c2 + above / layers_[n].density));
      pressed_.push_back({low, above, c2});
    }
  }

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
    const double height = up_ * place[axis_];
    s.pressure = pressed_.empty() ? weight_above(height) : pressure_at(height);
    for (const auto& layer : layers_)
      if (up_ * initial_.position[particle][axis_] < layer.high && std::isnan(s.density))
        s.density = layer.density;
    return s;
  }

 private:
  /// Pressure at a height [Pa]: zero above the surface; below the floor it goes on rising.
  [[nodiscard]] double weight_above(double height) const {
    double p = 0.0;
    for (std::size_t n = 0; n < layers_.size(); ++n) {
      const double low = n == 0 ? std::min(height, layers_[n].low) : layers_[n].low;
      p += layers_[n].density * gravity_ * std::max(0.0, layers_[n].high - std::max(height, low));
    }
    return factor_ * p;
  }
  /// The same where the weight compresses the layers.
  [[nodiscard]] double pressure_at(double height) const {
    std::size_t n = 0;
    while (n + 1 < pressed_.size() && height > pressed_[n].high) ++n;
    const auto& [high, above, c2] = pressed_[n];
    const double depth = gravity_ * std::max(0.0, high - height) / c2;
    return factor_ * (above * std::exp(depth) + c2 * layers_[n].density * std::expm1(depth));
  }
  /// A layer that is compressed: height of its top [m], pressure there [Pa], square of its speed of sound
  /// [m2/s2].
  struct Pressed {
    double high, above, sound2;
  };
  std::size_t axis_;
  double up_, gravity_, factor_;
  std::vector<LiquidLayer> layers_;
  std::vector<Pressed> pressed_;
};

std::vector<LiquidLayer> stacked_layers(const ReferenceInput& in, std::size_t axis) {
  const double up = in.job.scene.gravity[axis] > 0.0 ? -1.0 : 1.0;
  std::vector<LiquidLayer> layers;
  for (const std::size_t b : liquid_bodies(in.job)) {
    const auto along = body_along(axis, b, in.job, in.initial);
    layers.push_back({std::min(up * along.low, up * along.high), std::max(up * along.low, up * along.high),
                      material_of_body(in.job, b).density, b});
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
  std::vector<double> sound;
  for (const auto& layer : layers)
    if (in.args.flag("compressed").value_or(false)) sound.push_back(state_sound_speed(in.job, layer.body));
  return std::make_unique<Hydrostatic>(in, axis, layers, in.args.number("factor").value_or(1.0), sound);
}

}  // namespace

ReferenceEntry hydrostatic_entry() {
  return {{"hydrostatic",
           "analytic",
           "Archimedes, Pascal: the pressure is the weight of the liquid above",
           "liquid at rest, in layers stacked along gravity",
           {{"factor", "1", "fraction of the pressure that a printed equation of state must show; default 1"},
            {"compressed", "true or false",
             "each layer is compressed by its weight, at its speed of sound; default false",
             ArgumentType::flag}}},
          make_hydrostatic};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/not_a_number.hpp"
#include "files/job.hpp"
#include "validation/references/functions.hpp"
#include "validation/references/heat_scene.hpp"
#include "validation/references/two_layers.hpp"

namespace tripoint {
namespace {

class Contact : public HeatReference {
 public:
  Contact(const ReferenceInput& in, std::size_t axis, const TwoLayers& layers)
      : HeatReference(in.job, in.initial), axis_(axis), layers_(layers), solution_(layers) {}
  [[nodiscard]] Measuring measuring() const override { return {.axis = axis_}; }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    const auto& s = layers_;
    if (quantity == "contact_temperature")
      return (s.effusivity_low * s.start_low + s.effusivity_high * s.start_high) /
             (s.effusivity_low + s.effusivity_high);
    return {};
  }

 protected:
  [[nodiscard]] double temperature(const Vec3& place, double time) const override {
    return solution_.at(place[axis_], time);
  }

 private:
  std::size_t axis_;
  TwoLayers layers_;
  TwoLayerSolution solution_;
};

double uniform_temperature(const ReferenceInput& in, std::size_t body) {
  const std::string refusal =
      "two_conductivities: body `" + in.job.bodies[body].name + "` must start at one temperature";
  if (in.initial.temperature.size() != in.initial.size()) throw InputError(refusal);
  double value = not_a_number;
  for (std::size_t i = 0; i < in.initial.size(); ++i) {
    if (in.initial.source[i] != static_cast<int>(body)) continue;
    if (std::isnan(value)) value = in.initial.temperature[i];
    if (in.initial.temperature[i] != value) throw InputError(refusal);
  }
  return value;
}

/// The axis along which one body ends where the other begins.
std::size_t contact_axis(const ReferenceInput& in) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto a = body_along(axis, 0, in.job, in.initial), b = body_along(axis, 1, in.job, in.initial);
    const double gap = std::min(std::abs(a.high - b.low), std::abs(b.high - a.low));
    if (gap > 1e-6 * (a.length() + b.length())) continue;
    if (in.job.scene.periodic[axis])
      throw InputError("two_conductivities: the contact axis is periodic, so the bodies touch twice");
    return axis;
  }
  throw InputError("two_conductivities: the two bodies do not touch along x, y or z");
}

std::unique_ptr<Reference> make_contact(const ReferenceInput& in) {
  if (in.job.bodies.size() != 2) throw InputError("two_conductivities holds for two bodies");
  const auto axis = contact_axis(in);
  auto a = body_along(axis, 0, in.job, in.initial), b = body_along(axis, 1, in.job, in.initial);
  std::size_t low = 0, high = 1;
  if (a.low > b.low) {
    std::swap(a, b);
    std::swap(low, high);
  }
  TwoLayers s;
  s.interface = a.high;
  s.length_low = a.length();
  s.length_high = b.length();
  s.diffusivity_low = diffusivity(in.job, low);
  s.diffusivity_high = diffusivity(in.job, high);
  s.effusivity_low = effusivity(in.job, low);
  s.effusivity_high = effusivity(in.job, high);
  s.start_low = uniform_temperature(in, low);
  s.start_high = uniform_temperature(in, high);
  return std::make_unique<Contact>(in, axis, s);
}

}  // namespace

ReferenceEntry two_conductivities_entry() {
  return {{"two_conductivities",
           "analytic",
           "Carslaw & Jaeger, Conduction of Heat in Solids, 1959: composite solids; eigenfunctions once a "
           "front has reached an end",
           "two bodies of different material and temperature in perfect contact, ends insulated",
           {}},
          make_contact};
}

}  // namespace tripoint

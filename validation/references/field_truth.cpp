// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/field_truth.hpp"
#include "core/not_a_number.hpp"

namespace tripoint {

std::vector<ReferenceArgument> truth_fields() {
  return {{"value", "", "formula of t: what a quantity that is a single number is compared with, in its unit",
           ArgumentType::formula},
          {"temperature", "K", "formula of the true temperature at x, y, z and t", ArgumentType::formula},
          {"pressure", "Pa", "formula of the true pressure", ArgumentType::formula},
          {"density", "kg/m3", "formula of the true density", ArgumentType::formula},
          {"velocity_x", "m/s",
           "formula of the x component of velocity; a component that is not given is 0 where one is",
           ArgumentType::formula},
          {"velocity_y", "m/s", "formula of its y component", ArgumentType::formula},
          {"velocity_z", "m/s", "formula of its z component", ArgumentType::formula}};
}

std::string field_of_probe(std::string_view quantity, const Measuring& measuring) {
  for (const std::string_view field : {"temperature", "pressure", "density"})
    if (quantity == std::string(field) + "_at") return std::string(field);
  if (quantity != "velocity_at" || !measuring.axis) return {};
  return std::string("velocity_") + static_cast<char>('x' + *measuring.axis);
}

Snapshot truth_of_fields(const Snapshot& now, const FieldOf& field) {
  Snapshot out;
  out.time = now.time;
  const auto fill = [&](const char* name, std::vector<double>& column) {
    const auto f = field(name);
    for (std::size_t i = 0; f && i < now.position.size(); ++i) column.push_back(f(now.position[i]));
  };
  fill("temperature", out.temperature);
  fill("pressure", out.pressure);
  fill("density", out.density);
  const std::function<double(const Vec3&)> v[3] = {field("velocity_x"), field("velocity_y"),
                                                   field("velocity_z")};
  if (!v[0] && !v[1] && !v[2]) return out;
  for (const Vec3& r : now.position) {
    Vec3 value;
    for (std::size_t k = 0; k < 3; ++k) value[k] = v[k] ? v[k](r) : finite(r) ? 0.0 : not_a_number;
    out.velocity.push_back(value);
  }
  return out;
}

}  // namespace tripoint

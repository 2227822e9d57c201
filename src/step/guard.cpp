// SPDX-License-Identifier: BSD-3-Clause
#include "step/guard.hpp"

#include <cmath>

#include "core/errors.hpp"

namespace tripoint {
namespace {

struct Guarded {
  const Field<double>* field;
  const char *name, *stage;
};
/// Fields in the order in which a step writes them.
constexpr Guarded guarded[] = {
    {&field::position_x, "position", "drift"}, {&field::position_y, "position", "drift"},
    {&field::position_z, "position", "drift"}, {&field::temperature, "temperature", "drift"},
    {&field::density, "density", "density"},   {&field::temperature_rate, "temperature_rate", "rates"},
    {&field::heat_rate, "heat_rate", "rates"}, {&field::velocity_x, "velocity", "kick"},
    {&field::velocity_y, "velocity", "kick"},  {&field::velocity_z, "velocity", "kick"},
};

/// The sum of a column times zero is not finite when one of its values is not: no branch in the loop.
bool all_finite(std::span<const double> values) {
  double zero = 0.0;
  for (const double v : values) zero += 0.0 * v;
  return zero == 0.0;
}

}  // namespace

void check_finite(const World& world) {
  const Particles& p = world.particles;
  for (const Guarded& g : guarded) {
    if (!p.has(g.field->name)) continue;
    const auto values = p[*g.field];
    if (all_finite(values)) continue;
    for (std::size_t id = 0; id < p.size(); ++id) {
      const std::size_t i = p.row(id);
      if (std::isfinite(values[i])) continue;
      throw Diverged(static_cast<long>(id), p[field::body][i], g.name, g.stage, world.time,
                     std::string(g.name) + " of particle " + std::to_string(id) + " is not finite after " + g.stage + " at " +
                         std::to_string(world.time) + " s");
    }
  }
}

}  // namespace tripoint

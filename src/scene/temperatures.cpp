// SPDX-License-Identifier: BSD-3-Clause
#include "scene/temperatures.hpp"

#include <algorithm>
#include <cmath>

#include "scene/effect_rule.hpp"

namespace tripoint {
namespace {

void add(TemperatureRange& range, double T) {
  range.least = std::min(range.least, T);
  range.greatest = std::max(range.greatest, T);
}

void add(TemperatureRange& range, const TemperatureField& f) {
  switch (f.kind) {
    case TemperatureField::Kind::constant:
      return add(range, f.value);
    case TemperatureField::Kind::cosine:
      add(range, f.mean - std::abs(f.amplitude));
      return add(range, f.mean + std::abs(f.amplitude));
    case TemperatureField::Kind::step:
      add(range, f.behind);
      return add(range, f.ahead);
    case TemperatureField::Kind::expression:
      add(range, 0.0);
      return add(range, INFINITY);  // anything
  }
}

bool conducts(const Material& m) { return m.conductivity && m.heat_capacity; }

}  // namespace

TemperatureRange temperatures_of(const Scene& s) {
  TemperatureRange range;
  for (const auto& b : s.bodies)
    if (b.temperature) add(range, *b.temperature);
  for (const auto& b : s.bodies)
    if (const double held = value_of(s.material(b.material).values, "surface_temperature"); held > 0.0)
      add(range, held);
  for (const auto& f : s.inflows)
    if (f.temperature) add(range, *f.temperature);
  for (const auto& e : s.events)
    if (e.temperature) add(range, *e.temperature);
  for (const auto& h : s.sources) {
    if (h.ambient) add(range, *h.ambient);
    for (const auto& given : {h.heat, h.density, h.flux})
      if (given && *given != 0.0) add(range, *given > 0.0 ? INFINITY : 0.0);
  }
  return range;
}

bool has_heat(const Body& b, const Material& m) { return b.temperature && conducts(m); }

std::optional<double> equal_temperature(const Scene& s) {
  const TemperatureRange range = temperatures_of(s);
  if (range.least != range.greatest || !(range.least > 0.0))
    return {};  // 0 K and below: a scene built without a file, whose particles have their own
  const bool bodies =
      std::ranges::all_of(s.bodies, [&](const Body& b) { return has_heat(b, s.material(b.material)); });
  const bool inflows = std::ranges::all_of(
      s.inflows, [&](const Inflow& f) { return f.temperature && conducts(s.material(f.material)); });
  if (!bodies || !inflows) return {};
  if (calls_for(s, &EffectRule::changes_temperatures)) return {};
  return range.least;
}

std::optional<double> value_at(const TemperatureField& f, const Vec3& r) {
  switch (f.kind) {
    case TemperatureField::Kind::constant:
      return f.value;
    case TemperatureField::Kind::cosine:
      return f.mean + f.amplitude * std::cos(dot(f.wave_vector, r) + f.phase);
    case TemperatureField::Kind::step:
      return dot(r - f.point, f.normal) < 0.0 ? f.behind : f.ahead;
    case TemperatureField::Kind::expression:
      break;
  }
  return {};
}

}  // namespace tripoint

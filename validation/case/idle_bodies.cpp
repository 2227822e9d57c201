// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "sampling/lattice.hpp"
#include "scene/effect_rule.hpp"
#include "scene/geometry.hpp"
#include "validation/case/idle_search.hpp"

/// Bodies and inflows that say what nothing of the scene can do.
namespace tripoint {
namespace {

/// Distance between the boxes around the particles of two bodies, across periodic sides too [m]: never more
/// than that of their particles.
double gap(const IdleSearch& in, std::size_t a, std::size_t b) {
  std::array<Bounds, 2> box{};
  box.fill({{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}});
  for (std::size_t i = 0; i < in.state.size(); ++i) {
    const auto source = static_cast<std::size_t>(in.state.source[i]);
    if (source != a && source != b) continue;
    Bounds& of = box[source == a ? 0 : 1];
    for (std::size_t k = 0; k < 3; ++k) {
      of.min[k] = std::min(of.min[k], in.state.position[i][k]);
      of.max[k] = std::max(of.max[k], in.state.position[i][k]);
    }
  }
  Vec3 apart;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto between = [&](double shift) {
      return std::max({0.0, box[1].min[k] + shift - box[0].max[k], box[0].min[k] - shift - box[1].max[k]});
    };
    apart[k] = between(0.0);
    if (!in.scene.periodic[k]) continue;
    const double width = (*in.scene.max)[k] - (*in.scene.min)[k];
    apart[k] = std::min({apart[k], between(width), between(-width)});
  }
  return norm(apart);
}

/// Between two rigid bodies there is no bond.
void joint(IdleSearch& in, const Body& b, const std::string& name) {
  const auto other = std::ranges::find(in.scene.bodies, name, &Body::name);
  if (other == in.scene.bodies.end()) return;
  const auto place = in.given("body." + b.name + ".joined_to");
  if (b.phase != Phase::elastic && other->phase != Phase::elastic && !in.calls("phase"))
    return in.error(
        place,
        fmt::format("bodies \"{}\" and \"{}\": bonds join elastic bodies to others, and neither is elastic: "
                    "merge rigid bodies by an event at 0 s, or by a union of their shapes",
                    b.name, name));
  const auto first = static_cast<std::size_t>(&b - in.scene.bodies.data()),
             second = static_cast<std::size_t>(other - in.scene.bodies.begin());
  const double reach = bond_reach(in.scene) * in.scene.spacing;
  if (gap(in, first, second) > reach)
    in.error(place, fmt::format("bodies \"{}\" and \"{}\" are {:.3g} m apart, and bonds reach {:.3g} "
                                "spacings = {:.3g} m: nothing "
                                "joins them; move them together",
                                b.name, name, gap(in, first, second), bond_reach(in.scene), reach));
}

void body(IdleSearch& in, const Body& b) {
  const std::string path = "body." + b.name + ".";
  if (in.outside(bounds(b.shape)))
    in.error(b.place,
             fmt::format(
                 "body \"{}\" lies wholly outside scene.min and scene.max: move it in, or enlarge the domain",
                 b.name));
  if (!b.keyframes.empty()) in.keyframes(b.keyframes, fmt::format("body \"{}\"", b.name), b.place);
  const bool wets = !in.scene.inflows.empty() || std::ranges::any_of(in.scene.bodies, [](const Body& other) {
    return other.phase == Phase::liquid;
  }) || in.calls("phase");
  if (b.free_slip && !wets)
    in.warn(in.given(path + "slip"),
            fmt::format("body \"{}\": slip is what a liquid does along it, and the scene has none: remove it",
                        b.name));
  if (b.free_slip && wets && b.phase == Phase::liquid && !in.calls("phase"))
    in.warn(in.given(path + "slip"), fmt::format("body \"{}\" is liquid, and slip is of the solid that a "
                                                 "liquid glides along: give it to the walls",
                                                 b.name));
  if (const auto place = in.given(path + "joins"); !place.file.empty() && !in.calls("phase"))
    in.warn(place, fmt::format("body \"{}\": joins acts where matter freezes, and here {}: remove it", b.name,
                               in.why_idle("phase")));
  for (const auto& other : b.joined_to) joint(in, b, other);
}

void inflow(IdleSearch& in, const Inflow& f, std::size_t number) {
  const auto path = fmt::format("inflow.{}.", number);
  if (in.outside(bounds(f.shape)))
    in.error(in.given(path + "material"),
             "the inflow lies wholly outside scene.min and scene.max: move it in, or enlarge the domain");
  if (f.temperature && !in.calls("heat"))
    in.error(
        in.given(path + "temperature"),
        fmt::format("the temperature of the inflow is not followed: {}; give every body one, or remove it",
                    in.why_idle("heat")));
  Body source;
  source.name = fmt::format("inflow {}", number);
  source.material = f.material;
  source.shape = f.shape;
  try {
    static_cast<void>(fill(in.scene, source));
  } catch (const InputError&) {
    in.error(
        in.given(path + "material"),
        fmt::format(
            "the shape of the inflow holds no particle at spacing {} m: enlarge it, or refine scene.spacing",
            in.scene.spacing));
  }
}

}  // namespace

void find_idle_bodies(IdleSearch& in) {
  for (const Body& b : in.scene.bodies) body(in, b);
  for (std::size_t n = 0; n < in.scene.inflows.size(); ++n) inflow(in, in.scene.inflows[n], n + 1);
}

}  // namespace tripoint

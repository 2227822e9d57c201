// SPDX-License-Identifier: BSD-3-Clause
#include "effects/carried_liquid/scheme.hpp"

#include <string_view>

#include "scene/shared_terms.hpp"

namespace tripoint::carried_liquid {
namespace {

template <Pair pair, Damping damping>
Scheme made() {
  Scheme s{};
  s.gradients = pair_term<Gradients<pair>>;
  s.forces = pair_term<Forces<pair, damping>>;
  s.damping = damping;
  s.beta = 0.1;
  s.delta = 0.1;
  s.shift = Shift::by_sound;
  s.strength = 0.16;
  s.tie = Tie::relaxed;
  s.relax = 0.02;
  s.follows = false;
  s.hold = 1;
  s.courant = 0.25;
  if (pair != Pair::own) return s;
  s.delta = 0.05;
  s.strength = 0.1;
  s.hold = 3;
  s.courant = 0.4;
  return s;
}

/// Noise alone is damped, and the shift knows no speed but that of the neighbours.
template <Pair pair>
Scheme limited() {
  Scheme s = made<pair, Damping::limited_residue>();
  s.shift = Shift::by_speed;
  s.strength = 2.0;
  s.tie = Tie::none;
  s.follows = true;
  s.hold = 1;  // a step of sound damps as `residue`
  return s;
}

}  // namespace

Scheme scheme_of(const Scene& scene) {
  const auto takes = [&](std::string_view word) { return scene.takes_form(term::pressure, word); };
  if (takes("reverse_riemann")) {
    Scheme s = made<Pair::reverse_plain, Damping::limited>();
    s.delta = 1.0;
    s.tie = Tie::summed;
    return s;
  }
  if (takes("mean")) return made<Pair::mean, Damping::residue>();
  if (takes("adjoint_limited")) return limited<Pair::own>();
  if (takes("reverse")) return limited<Pair::reverse>();
  return made<Pair::own, Damping::residue>();
}

}  // namespace tripoint::carried_liquid

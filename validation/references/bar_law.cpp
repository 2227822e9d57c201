// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/bar_law.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/errors.hpp"

namespace tripoint {
namespace {

double shear_modulus(const BarLaw& b) { return 0.5 * b.young / (1.0 + b.poisson_ratio); }
double bulk_modulus(const BarLaw& b) { return b.young / (3.0 * (1.0 - 2.0 * b.poisson_ratio)); }
bool yields(const BarLaw& b) { return std::isfinite(b.elastic_limit); }

/// The plastic component follows share * strain within +-half; the size of the plastic tensor is factor *
/// |component|.
struct Play {
  double share, half, factor;
};
Play play_of(const BarLaw& b) {
  // Free sides: the elastic strain is (e, -nu e, -nu e), its deviator sqrt(2/3)(1 + nu) e. Held sides: dev
  // E_11 = 2/3 E_11, |e'| = sqrt(3/2) e'_11.
  if (b.sides == BarSides::confined)
    return {2.0 / 3.0, std::sqrt(2.0 / 3.0) * b.elastic_limit, std::sqrt(1.5)};
  return {1.0, std::sqrt(1.5) * b.elastic_limit / (1.0 + b.poisson_ratio), std::sqrt(1.5)};
}

/// Second Piola-Kirchhoff stress along the bar in the law's own strain.
double stress(const BarLaw& b, double strain, double plastic) {
  if (b.sides == BarSides::confined)
    return bulk_modulus(b) * strain + 2.0 * shear_modulus(b) * (2.0 / 3.0 * strain - plastic);
  return b.stiffness() * (strain - plastic);
}

double stored(const BarLaw& b, double strain, double plastic) {
  if (b.sides != BarSides::confined) return 0.5 * b.stiffness() * (strain - plastic) * (strain - plastic);
  const double deviator = 2.0 / 3.0 * strain - plastic;
  return 0.5 * bulk_modulus(b) * strain * strain + 1.5 * shear_modulus(b) * deviator * deviator;
}

}  // namespace

double BarLaw::stiffness() const {
  const double nu = poisson_ratio;
  if (sides == BarSides::plane_strain) return young / (1.0 - nu * nu);
  return sides == BarSides::confined ? young * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu)) : young;
}

double BarLaw::yield_stress() const { return std::sqrt(6.0) * shear_modulus(*this) * elastic_limit; }

BarState stretched(const BarLaw& b, const BarState& from, double stretch) {
  const double F = 1.0 + b.moment * (stretch - 1.0), strain = b.strain_factor * (F * F - 1.0);
  BarState s = from;
  s.stretch = stretch;
  if (yields(b)) {
    if (b.sides == BarSides::plane_strain)
      throw InputError(
          "yielding in plane strain has no closed form: leave both sides of the bar free, or hold both");
    const auto play = play_of(b);
    const double cap = b.plastic_limit / play.factor;
    s.plastic =
        std::clamp(std::clamp(from.plastic, play.share * strain - play.half, play.share * strain + play.half),
                   -cap, cap);
    s.dissipated += b.volume * b.yield_stress() * std::abs(s.plastic - from.plastic);
  }
  s.force = b.volume * stress(b, strain, s.plastic) * 2.0 * b.strain_factor * F * b.moment;
  s.elastic = b.volume * stored(b, strain, s.plastic);
  return s;
}

double unloaded_stretch(const BarLaw& b, const BarState& from) {
  const double side = from.force > 0.0 ? -1.0 : 1.0;
  double reach = 0.01;
  while (reach < 0.5 && side * stretched(b, from, from.stretch + side * reach).force < 0.0) reach *= 1.5;
  double near = from.stretch, far = from.stretch + side * reach;
  for (int n = 0; n < 80; ++n) {
    const double middle = 0.5 * (near + far);
    (side * stretched(b, from, middle).force < 0.0 ? near : far) = middle;
  }
  return 0.5 * (near + far);
}

LatticeFactors elastic_lattice_factors(double h) {
  using std::numbers::pi;
  const int reach = static_cast<int>(std::ceil(h));
  const double c = pi / (8.0 * std::pow(h, 4) * (pi / 3.0 - 8.0 / pi + 16.0 / (pi * pi)));
  double sum = 0.0, moment = 0.0;  // of W and of |W'| x^2/r, at unit spacing
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k) {
        const double r = std::sqrt(static_cast<double>(i * i + j * j + k * k));
        if (r >= h) continue;
        const double angle = (r + h) * pi / (2.0 * h);
        sum += c * 2.0 * h / pi * (std::cos(angle) + 1.0);
        if (r > 0.0) moment += c * std::sin(angle) * i * i / r;
      }
  return {moment / sum, 1.0 / sum};
}

}  // namespace tripoint

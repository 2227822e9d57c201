// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "sph/solid.hpp"

/// Plastic flow after [O'Brien, Bargteil, Hodgins 2002] (model 8.8): formulas of one particle.
namespace tripoint::plastic {

struct YieldLimits {
  /// g1: deviatoric elastic strain at which flow begins [1]
  double elastic = std::numeric_limits<double>::infinity();
  double plastic = std::numeric_limits<double>::infinity();  ///< g2: largest plastic strain [1]
};

/// A strain that has flowed lies on its limit to round-off. Only a strain farther beyond flows, so that a
/// second call changes no bit.
inline constexpr double on_the_limit = 1.0 + 1e-12;

/// |a|, Frobenius.
[[nodiscard]] inline double size(const Symmetric& a) noexcept { return std::sqrt(contraction(a, a)); }

/// Von Mises' equivalent of a stress [Pa].
[[nodiscard]] inline double von_mises(const Symmetric& S) noexcept {
  return std::sqrt(1.5) * size(deviator(S));
}
/// The stress at which g1 yields, as J2 flow has it: sqrt(6) mu g1 [Pa].
[[nodiscard]] inline double yield_stress(double shear_modulus, double elastic_limit) noexcept {
  return std::sqrt(6.0) * shear_modulus * elastic_limit;
}

/// |eps_p| with the strain of a sheet or chain across itself: flow keeps the volume, though only the part
/// within the range is stored.
[[nodiscard]] inline double plastic_size(const Symmetric& plastic, int rank) noexcept {
  const double across = rank < 3 ? trace(plastic) * trace(plastic) / (3 - rank) : 0.0;
  return std::sqrt(contraction(plastic, plastic) + across);
}

/// Share of its direction by which the strain flows: 1 - g1/|e'|, 0 below the limit.
/// @param passed value that the limit is compared with @param limit of the same unit
[[nodiscard]] inline double excess(double passed, double limit) noexcept {
  return passed > limit * on_the_limit ? 1.0 - limit / passed : 0.0;
}

/// eps_p after it grew: back to g2, along itself, where it would be larger. A strain that was larger before,
/// as a broken bond can leave it, may stay so and not grow: flow never gives energy back.
[[nodiscard]] inline Symmetric capped(const Symmetric& grown, const Symmetric& before, int rank,
                                      double plastic_limit) noexcept {
  const double most = std::max(plastic_limit, plastic_size(before, rank)), is = plastic_size(grown, rank);
  return is > most ? (most / is) * grown : grown;
}

/// eps_p of a particle with all three directions: e' = dev(eps - eps_p); eps_p += (1 - g1/|e'|) e' where |e'|
/// > g1; then the cap. In these terms it is J2 flow with yield_stress(). @param strain total
[[nodiscard]] inline Symmetric flowed(const Symmetric& strain, const Symmetric& plastic,
                                      const YieldLimits& limits) noexcept {
  const Symmetric e = deviator(strain - plastic);
  const double share = excess(size(e), limits.elastic);
  return share > 0.0 ? capped(plastic + share * e, plastic, 3, limits.plastic) : plastic;
}

/// The same for a sheet or chain, rank 2 or 1, within the range of P. e' = P (eps - eps_p) P flows where von
/// Mises' equivalent of its stress passes the yield stress, down to it.
/// @param elastic e'   @param stress of e' [Pa]   @param yields yield_stress() [Pa]
[[nodiscard]] inline Symmetric flowed_flat(const Symmetric& elastic, const Symmetric& stress,
                                           const Symmetric& plastic, int rank, double yields,
                                           double plastic_limit) noexcept {
  const double share = excess(von_mises(stress), yields);
  return share > 0.0 ? capped(plastic + share * elastic, plastic, rank, plastic_limit) : plastic;
}

/// Energy that flow turns to heat per volume [J/m3], the work of the stress, on its limit again, on the
/// strain that flows. Against a leapfrog's work this is second order, where the drop of the stored energy at
/// the strain of the step's end is first.
[[nodiscard]] constexpr double dissipated(const Symmetric& stress_after, const Symmetric& flow) noexcept {
  return contraction(stress_after, flow);
}

}  // namespace tripoint::plastic

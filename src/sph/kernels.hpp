// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cassert>
#include <cmath>
#include <numbers>

#include "core/dimensions.hpp"

/// Smoothing kernels. h is the support radius, h > 0 [m]: W = 0 for r >= h. r is a distance, r >= 0 [m].
/// Each integrates to 1 over space, or over the plane times a depth of 1 m: tests/sph/kernels_test.cpp.
/// Printed factors are of three dimensions. Constants are formed once, so that a pair pass only multiplies.
/// `..._inside` is for r <= h alone, where no check is needed that r is within the support. A pass leaves out
/// the pairs beyond it in one place. Such a function has the unit of the one without `_inside`.
namespace tripoint {

/// poly6 [Mueller, Charypar, Gross 2003, (20)], the paper's density kernel (4): W(r) = 315/(64 pi h^9) (h^2 -
/// r^2)^3.
class Poly6 {
 public:
  explicit Poly6(double h, Dimensions d = Dimensions::three) noexcept
      : h_(h),
        c_(d == Dimensions::three ? 315.0 / (64.0 * std::numbers::pi * std::pow(h, 9))
                                  : 4.0 / (std::numbers::pi * std::pow(h, 8) * layer_depth)) {
    assert(h > 0.0);
  }
  /// W(r) [1/m3]
  [[nodiscard]] double value(double r) const noexcept { return value_of_square(r * r); }
  /// W of r^2 [m2], which needs no root [1/m3]
  [[nodiscard]] double value_of_square(double r2) const noexcept {
    return r2 < h_ * h_ ? value_of_square_inside(r2) : 0.0;
  }
  template <class V>
  [[nodiscard]] V value_of_square_inside(V r2) const noexcept {
    const V q = h_ * h_ - r2;
    return c_ * q * q * q;
  }

 private:
  double h_, c_;
};

/// spiky [Mueller, Charypar, Gross 2003, (21)], the paper's pressure kernel (7): W(r) = 15/(pi h^6) (h -
/// r)^3.
class Spiky {
 public:
  explicit Spiky(double h, Dimensions d = Dimensions::three) noexcept
      : h_(h),
        c_(d == Dimensions::three ? 15.0 / (std::numbers::pi * std::pow(h, 6))
                                  : 10.0 / (std::numbers::pi * std::pow(h, 5) * layer_depth)) {
    assert(h > 0.0);
  }
  /// W(r) [1/m3]
  template <class V>
  [[nodiscard]] V value(V r) const noexcept {
    return r < h_ ? c_ * (h_ - r) * (h_ - r) * (h_ - r) : 0.0;
  }
  /// W'(r) [1/m4]
  template <class V>
  [[nodiscard]] V derivative(V r) const noexcept {
    return r < h_ ? derivative_inside(r) : 0.0;
  }
  template <class V>
  [[nodiscard]] V derivative_inside(V r) const noexcept {
    return (-3.0 * c_) * ((h_ - r) * (h_ - r));
  }
  /// W'(r)/r [1/m5]; 0 at r = 0, where the force has no direction
  template <class V>
  [[nodiscard]] V derivative_over_r(V r) const noexcept {
    return r > 0.0 ? derivative(r) / r : 0.0;
  }

 private:
  double h_, c_;
};

/// Viscosity kernel [Mueller, Charypar, Gross 2003, (22)], the paper's kernel of viscosity (8) and heat (21).
/// W(r) = 15/(2 pi h^3) (-q^3/2 + q^2 + 1/(2q) - 1), q = r/h; in the plane that of the same Laplacian but for
/// its factor, 40/(pi h^2) (q^2/4 - q^3/9 - ln(q)/6 - 5/36).
class ViscosityKernel {
 public:
  explicit ViscosityKernel(double h, Dimensions d = Dimensions::three) noexcept
      : h_(h),
        c_(d == Dimensions::three ? 45.0 / (std::numbers::pi * std::pow(h, 6))
                                  : 40.0 / (std::numbers::pi * std::pow(h, 5) * layer_depth)),
        d_(d) {
    assert(h > 0.0);
  }
  /// W(r) [1/m3]; infinite at r = 0
  [[nodiscard]] double value(double r) const noexcept {
    if (r >= h_) return 0.0;
    const double q = r / h_;
    if (d_ == Dimensions::two)
      return c_ * h_ * h_ * h_ * (q * q / 4.0 - q * q * q / 9.0 - std::log(q) / 6.0 - 5.0 / 36.0);
    return 15.0 / (2.0 * std::numbers::pi * h_ * h_ * h_) * (-0.5 * q * q * q + q * q + 0.5 / q - 1.0);
  }
  /// lap W(r) = 45/(pi h^6) (h - r) [1/m5]
  template <class V>
  [[nodiscard]] V laplacian(V r) const noexcept {
    return r < h_ ? laplacian_inside(r) : 0.0;
  }
  template <class V>
  [[nodiscard]] V laplacian_inside(V r) const noexcept {
    return c_ * (h_ - r);
  }

 private:
  double h_, c_;
  Dimensions d_;
};

/// Elasticity kernel (17), made for solids of as few as two particles.
/// W(r) = c (2h/pi) (cos((r + h) pi/(2h)) + 1), c = pi / (8 h^4 (pi/3 - 8/pi + 16/pi^2)).
class ElasticityKernel {
 public:
  explicit ElasticityKernel(double h, Dimensions d = Dimensions::three) noexcept
      : h_(h), c_(d == Dimensions::three ? constant(h) : planar_constant(h)) {
    assert(h > 0.0);
  }
  /// W(r) [1/m3]
  [[nodiscard]] double value(double r) const noexcept {
    using std::numbers::pi;
    return r < h_ ? c_ * (2.0 * h_ / pi) * (std::cos((r + h_) * pi / (2.0 * h_)) + 1.0) : 0.0;
  }
  /// W'(r) = -c sin((r + h) pi/(2h)) [1/m4]
  [[nodiscard]] double derivative(double r) const noexcept {
    using std::numbers::pi;
    return r < h_ ? -c_ * std::sin((r + h_) * pi / (2.0 * h_)) : 0.0;
  }

 private:
  static double constant(double h) noexcept {
    using std::numbers::pi;
    return pi / (8.0 * std::pow(h, 4) * (pi / 3.0 - 8.0 / pi + 16.0 / (pi * pi)));
  }
  static double planar_constant(double h) noexcept {
    using std::numbers::pi;
    return 1.0 / (4.0 * h * h * h * (0.5 - 4.0 / (pi * pi)) * layer_depth);
  }
  double h_, c_;
};

/// Wendland's C2 kernel [Wendland 1995] in three dimensions, the corrected forms' one kernel:
/// W(r) = 21/(2 pi h^3) (1 - q)^4 (1 + 4q), q = r/h.
class WendlandC2 {
 public:
  explicit WendlandC2(double h, Dimensions d = Dimensions::three) noexcept
      : h_(h),
        per_h_(1.0 / h),
        c_(d == Dimensions::three ? 21.0 / (2.0 * std::numbers::pi * h * h * h)
                                  : 7.0 / (std::numbers::pi * h * h * layer_depth)),
        g_(d == Dimensions::three ? 210.0 / (std::numbers::pi * std::pow(h, 5))
                                  : 140.0 / (std::numbers::pi * std::pow(h, 4) * layer_depth)) {
    assert(h > 0.0);
  }
  /// W(r) [1/m3]
  template <class V>
  [[nodiscard]] V value(V r) const noexcept {
    return r < h_ ? value_inside(r) : 0.0;
  }
  template <class V>
  [[nodiscard]] V value_inside(V r) const noexcept {
    const V q = r * per_h_, t2 = (1.0 - q) * (1.0 - q);
    return t2 * t2 * (c_ + (4.0 * c_) * q);
  }
  /// W'(r)/r = -210/(pi h^5) (1 - q)^3 [1/m5]: finite at r = 0, no division
  template <class V>
  [[nodiscard]] V derivative_over_r(V r) const noexcept {
    return r < h_ ? derivative_over_r_inside(r) : 0.0;
  }
  template <class V>
  [[nodiscard]] V derivative_over_r_inside(V r) const noexcept {
    const V t = 1.0 - r * per_h_;
    return (-g_ * t) * (t * t);
  }
  /// W'(r) [1/m4]
  template <class V>
  [[nodiscard]] V derivative(V r) const noexcept {
    return r * derivative_over_r(r);
  }

 private:
  double h_, per_h_, c_, g_;
};

/// Core of pairs that exert pressure on each other (model 8.3): energy 1/2 kappa (reach - r)^2 for r < reach.
/// It keeps particles apart where the clamped pressure leaves no repulsion.
struct Core {
  double stiffness = 0.0;  ///< kappa [N/m]
  double reach = 0.0;      ///< scene.core_reach times dx [m]
  /// Repulsion over r, kappa (reach/r - 1) [N/m]; finite at r = 0, so that its product with r is 0. @param r
  /// [m]
  /// @param per_r2 1/r^2, finite at r = 0 [1/m2]
  template <class V>
  [[nodiscard]] V force_over_r(V r, V per_r2) const noexcept {
    return r < reach ? stiffness * (reach * (r * per_r2) - 1.0) : 0.0;
  }
  /// Energy of one pair [J]. @param r [m]
  [[nodiscard]] double energy(double r) const noexcept {
    return r < reach ? 0.5 * stiffness * (reach - r) * (reach - r) : 0.0;
  }
};

/// Weight constant + square r^2 of a pair in `central` viscosity (model 8.5): 1 unless the scene asks for
/// isotropic shear.
struct ShearWeight {
  double constant = 1.0, square = 0.0;  ///< [1], [1/m2]
  [[nodiscard]] bool even() const noexcept { return square == 0.0; }
  /// The coefficient times the weight, in the unit of the coefficient. @param r2 square of the distance [m2]
  template <class V>
  [[nodiscard]] V weighted(V coefficient, V r2) const noexcept {
    return coefficient * (constant + square * r2);
  }
};

/// The kernels at one support radius, and the scene's numbers that pair terms share, handed to every pair.
struct PairKernels {
  /// @param support radius h [m]
  explicit PairKernels(double support, Dimensions d = Dimensions::three) noexcept
      : poly6(support, d),
        spiky(support, d),
        viscosity(support, d),
        wendland(support, d),
        central(2.0 * (number_of(d) + 2.0)) {}
  Poly6 poly6;
  Spiky spiky;
  ViscosityKernel viscosity;
  WendlandC2 wendland;
  Core core;                         ///< none unless a scene sets it
  double central;                    ///< factor of central viscosity, 10 or in the plane 8 [1]
  double per_gradient_moment = 1.0;  ///< 1 over the lattice moment of -2 W'/r at the scene's h/dx [1]
  ShearWeight shear;                 ///< 1 unless a scene sets it
  double half_step = 0.0;            ///< half of the drift, for terms that look halfway back [s]
};

}  // namespace tripoint

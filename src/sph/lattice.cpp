// SPDX-License-Identifier: BSD-3-Clause
#include "sph/lattice.hpp"

#include <algorithm>
#include <cmath>

#include "sph/kernels.hpp"

namespace tripoint {
namespace {

/// Calls visit(r) for the lattice points of spacing 1 with |r| < q.
template <class Visit>
void for_all_lattice(double q, Dimensions dims, Visit visit) {
  const int n = static_cast<int>(std::ceil(q)), deep = dims == Dimensions::three ? n : 0;
  for (int z = -n; z <= n; ++z) {
    for (int y = -deep; y <= deep; ++y) {
      for (int x = -n; x <= n; ++x) {
        const Vec3 r{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        if (norm(r) < q) visit(r);
      }
    }
  }
}

/// The same but for the origin.
template <class Visit>
void for_lattice(double q, Dimensions dims, Visit visit) {
  for_all_lattice(q, dims, [&](const Vec3& r) {
    if (norm(r) > 0.0) visit(r);
  });
}

template <class Value, class Derivative, class Laplacian>
LatticeMoments moments(double q, Dimensions dims, double self, Value value, Derivative derivative,
                       Laplacian laplacian) {
  LatticeMoments m;
  m.density = m.layer = self;
  const double d = number_of(dims);
  for_lattice(q, dims, [&](const Vec3& x) {
    const double r = norm(x);
    ++m.neighbours;
    m.density += value(r);
    if (x.z == 0.0) m.layer += value(r);
    m.gradient -= r * derivative(r) / d;
    m.laplacian += r * r * laplacian(r) / (2.0 * d);
  });
  return m;
}

double none(double) { return 0.0; }

}  // namespace

LatticeMoments poly6_moments(double q, Dimensions dims) {
  const Poly6 w(q, dims);
  return moments(
      q, dims, w.value(0.0), [&](double r) { return w.value(r); }, none, none);
}

LatticeMoments spiky_moments(double q, Dimensions dims) {
  const Spiky w(q, dims);
  return moments(
      q, dims, w.value(0.0), [&](double r) { return w.value(r); }, [&](double r) { return w.derivative(r); },
      none);
}

LatticeMoments viscosity_moments(double q, Dimensions dims) {
  const ViscosityKernel w(q, dims);
  return moments(q, dims, 0.0, none, none, [&](double r) { return w.laplacian(r); });
}

LatticeMoments elasticity_moments(double q, Dimensions dims) {
  const ElasticityKernel w(q, dims);
  return moments(
      q, dims, w.value(0.0), [&](double r) { return w.value(r); }, [&](double r) { return w.derivative(r); },
      none);
}

LatticeMoments wendland_moments(double q, Dimensions dims) {
  const WendlandC2 w(q, dims);
  return moments(
      q, dims, w.value(0.0), [&](double r) { return w.value(r); }, [&](double r) { return w.derivative(r); },
      none);
}

LatticeLayer layer_under_surface(double q, int above, Dimensions dims) {
  const WendlandC2 kernel(q, dims);
  double full = 0.0;
  LatticeLayer layer;
  for_all_lattice(q, dims, [&](const Vec3& d) {
    const double r = norm(d), w = kernel.value(r);
    full += w;
    if (d.z > above) return;
    layer.sum += w;
    layer.slope += kernel.derivative_over_r(r) * d.z;
  });
  layer.slope = q * std::abs(layer.slope) / layer.sum;
  layer.sum /= full;
  return layer;
}

ShearModuli shear_moduli(double q, const ShearWeight& weight, Dimensions dims) {
  const WendlandC2 kernel(q, dims);
  const double per_modulus = -(number_of(dims) + 2.0);
  ShearModuli sums;
  for_lattice(q, dims, [&](const Vec3& d) {
    const double r2 = dot(d, d),
                 K = per_modulus * weight.weighted(kernel.derivative_over_r(std::sqrt(r2)), r2) / r2;
    const double second = dims == Dimensions::three ? d.y : d.z;
    // Product of the coordinates along the two diagonals
    const double across = 0.5 * (d.x * d.x - second * second);
    sums.axes += K * (d.x * d.x) * (second * second);
    sums.diagonals += K * across * across;
  });
  const double moment = wendland_moments(q, dims).gradient;
  return {sums.axes / moment, sums.diagonals / moment};
}

/// Moduli are linear in the weight: c + s r^2 makes them equal where c (their difference by 1) = s (that by
/// r^2). Their mean over all directions is 3/5 axes + 2/5 diagonals; in the plane both count alike.
ShearWeight isotropic_shear(double q, Dimensions dims) {
  const ShearModuli by_one = shear_moduli(q, {1.0, 0.0}, dims), by_square = shear_moduli(q, {0.0, 1.0}, dims);
  const bool three = dims == Dimensions::three;
  const auto mean = [&](const ShearModuli& m) {
    return (three ? 0.6 : 0.5) * m.axes + (three ? 0.4 : 0.5) * m.diagonals;
  };
  const double ratio = (by_square.axes - by_square.diagonals) / (by_one.diagonals - by_one.axes),
               c_over_s = std::max(0.0, ratio);
  const double s = 1.0 / (mean(by_square) + c_over_s * mean(by_one));
  return {c_over_s * s, s};
}

namespace {

/// Weight of a layer a from the interface that the energy of unlike pairs with the kernel K gives, times
/// 2/(rho - rho') [1/m].
double lifted(double q, double a, const InterfaceKernel& K, Dimensions dims) {
  const WendlandC2 W(q, dims);
  double sum = 0.0;
  for_lattice(q, dims, [&](const Vec3& d) {
    const double r = norm(d);
    if (d.z > a) sum -= d.z * d.z * K.derivative_over_r(W, r) + K.value(W, r);
  });
  return sum;
}

/// Missing part of its weight, times 2/(rho - rho') [1/m].
double missing(double q, double a, Dimensions dims) {
  const WendlandC2 W(q, dims);
  double sum = 0.0;
  for_lattice(q, dims, [&](const Vec3& d) {
    if (d.z > a) sum -= 2.0 * (d.z - a) * d.z * W.derivative_over_r(norm(d));
  });
  return sum;
}

}  // namespace

/// Two linear equations, one for each layer.
InterfaceKernel interface_kernel(double q, Dimensions dims) {
  const InterfaceKernel by_one{1.0, 0.0}, by_square{0.0, 1.0};
  const double first = lifted(q, 0.5, by_one, dims), first_square = lifted(q, 0.5, by_square, dims),
               second = lifted(q, 1.5, by_one, dims), second_square = lifted(q, 1.5, by_square, dims);
  const double determinant = first * second_square - first_square * second;
  if (determinant == 0.0) return {missing(q, 0.5, dims) / first, 0.0};
  return {(missing(q, 0.5, dims) * second_square - first_square * missing(q, 1.5, dims)) / determinant,
          (first * missing(q, 1.5, dims) - missing(q, 0.5, dims) * second) / determinant};
}

double paper_heat_rate(double spacing, double support, const Vec3& wave_vector) {
  const double q = support / spacing;
  const ViscosityKernel w(support);
  const double volume = spacing * spacing * spacing / poly6_moments(q).density;
  double rate = 0.0;
  for_lattice(q, Dimensions::three, [&](const Vec3& x) {
    const Vec3 r = spacing * x;
    rate += volume * w.laplacian(norm(r)) * (1.0 - std::cos(dot(wave_vector, r)));
  });
  return rate;
}

}  // namespace tripoint

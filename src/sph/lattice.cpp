// SPDX-License-Identifier: BSD-3-Clause
#include "sph/lattice.hpp"

#include <cmath>

#include "sph/kernels.hpp"

namespace tripoint {
namespace {

/// Calls visit(r) for the lattice points of spacing 1 with 0 < |r| < q.
template <class Visit>
void for_lattice(double q, Visit visit) {
  const int n = static_cast<int>(std::ceil(q));
  for (int z = -n; z <= n; ++z) {
    for (int y = -n; y <= n; ++y) {
      for (int x = -n; x <= n; ++x) {
        const Vec3 r{static_cast<double>(x), static_cast<double>(y), static_cast<double>(z)};
        if (norm(r) > 0.0 && norm(r) < q) visit(r);
      }
    }
  }
}

template <class Value, class Derivative, class Laplacian>
LatticeMoments moments(double q, double self, Value value, Derivative derivative, Laplacian laplacian) {
  LatticeMoments m;
  m.density = m.layer = self;
  for_lattice(q, [&](const Vec3& x) {
    const double r = norm(x);
    ++m.neighbours;
    m.density += value(r);
    if (x.z == 0.0) m.layer += value(r);
    m.gradient -= r * derivative(r) / 3.0;
    m.laplacian += r * r * laplacian(r) / 6.0;
  });
  return m;
}

double none(double) { return 0.0; }

}  // namespace

LatticeMoments poly6_moments(double q) {
  const Poly6 w(q);
  return moments(
      q, w.value(0.0), [&](double r) { return w.value(r); }, none, none);
}

LatticeMoments spiky_moments(double q) {
  const Spiky w(q);
  return moments(
      q, w.value(0.0), [&](double r) { return w.value(r); }, [&](double r) { return w.derivative(r); }, none);
}

LatticeMoments viscosity_moments(double q) {
  const ViscosityKernel w(q);
  return moments(q, 0.0, none, none, [&](double r) { return w.laplacian(r); });
}

LatticeMoments elasticity_moments(double q) {
  const ElasticityKernel w(q);
  return moments(
      q, w.value(0.0), [&](double r) { return w.value(r); }, [&](double r) { return w.derivative(r); }, none);
}

LatticeMoments wendland_moments(double q) {
  const WendlandC2 w(q);
  return moments(
      q, w.value(0.0), [&](double r) { return w.value(r); }, [&](double r) { return w.derivative(r); }, none);
}

double paper_heat_rate(double spacing, double support, const Vec3& wave_vector) {
  const double q = support / spacing;
  const ViscosityKernel w(support);
  const double volume = spacing * spacing * spacing / poly6_moments(q).density;
  double rate = 0.0;
  for_lattice(q, [&](const Vec3& x) {
    const Vec3 r = spacing * x;
    rate += volume * w.laplacian(norm(r)) * (1.0 - std::cos(dot(wave_vector, r)));
  });
  return rate;
}

}  // namespace tripoint

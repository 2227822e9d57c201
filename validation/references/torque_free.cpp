// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/torque_free.hpp"

#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>

#include "core/errors.hpp"

namespace tripoint {
namespace {

using Real = long double;
using Triple = std::array<Real, 3>;
using Matrix = std::array<Triple, 3>;
constexpr int panels_a_period = 64;  // the integrand is smooth on a panel: 20 Gauss points reach long double

Real dot3(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Triple cross3(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Triple unit(const Triple& a) {
  const Real n = std::sqrt(dot3(a, a));
  return {a[0] / n, a[1] / n, a[2] / n};
}
Triple times(const Matrix& m, const Triple& v) { return {dot3(m[0], v), dot3(m[1], v), dot3(m[2], v)}; }
Matrix transposed(const Matrix& m) {
  return {{{m[0][0], m[1][0], m[2][0]}, {m[0][1], m[1][1], m[2][1]}, {m[0][2], m[1][2], m[2][2]}}};
}
Matrix product(const Matrix& a, const Matrix& b) {
  const Matrix c = transposed(b);
  return {{{dot3(a[0], c[0]), dot3(a[0], c[1]), dot3(a[0], c[2])},
           {dot3(a[1], c[0]), dot3(a[1], c[1]), dot3(a[1], c[2])},
           {dot3(a[2], c[0]), dot3(a[2], c[1]), dot3(a[2], c[2])}}};
}
Matrix matrix_of(const Quaternion& unnormalised) {
  const Real n = std::sqrt(Real(unnormalised.w) * unnormalised.w + Real(unnormalised.x) * unnormalised.x +
                           Real(unnormalised.y) * unnormalised.y + Real(unnormalised.z) * unnormalised.z);
  const Real w = unnormalised.w / n, x = unnormalised.x / n, y = unnormalised.y / n, z = unnormalised.z / n;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}
/// Shepperd's choice of the largest component, so that no difference cancels.
Quaternion quaternion_of(const Matrix& m) {
  const Real trace = m[0][0] + m[1][1] + m[2][2];
  const std::array<Real, 4> size{trace, m[0][0], m[1][1], m[2][2]};
  std::size_t k = 0;
  for (std::size_t i = 1; i < 4; ++i) k = size[i] > size[k] ? i : k;
  std::array<Real, 4> q{};
  if (k == 0) {
    q = {1 + trace, m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]};
  } else {
    const std::size_t a = k - 1, b = (a + 1) % 3, c = (a + 2) % 3;
    q[0] = m[c][b] - m[b][c];
    q[1 + a] = 1 + m[a][a] - m[b][b] - m[c][c];
    q[1 + b] = m[b][a] + m[a][b];
    q[1 + c] = m[c][a] + m[a][c];
  }
  const Real n = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  return {double(q[0] / n), double(q[1] / n), double(q[2] / n), double(q[3] / n)};
}
/// Frame whose third axis is along L: rows e3 x l, l x (e3 x l), l. Turns principal components into it.
Matrix nutation(const Triple& momentum) {
  const Triple l = unit(momentum), node = unit(cross3({0, 0, 1}, l));
  return {node, cross3(l, node), l};
}
Matrix turn_about_z(Real angle) {
  const Real c = std::cos(angle), s = std::sin(angle);
  return {{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
}

}  // namespace

TorqueFree::TorqueFree(const Vec3& inertia, const Quaternion& axes, const Vec3& spin) : spin_(spin) {
  const Vec3 w = rotate_back(axes, spin);
  const Vec3 momentum{inertia.x * w.x, inertia.y * w.y, inertia.z * w.z};
  // Round-off of the moments (1e-15 relative) must not turn a steady spin into a tumbling one.
  steady_ = norm(cross(w, momentum)) <= 1e-13 * norm(w) * norm(momentum);
  if (!steady_) choose_axes(inertia, axes, spin);
}

/// Orders the principal axes so that the elliptic solution holds: the third is the one about which L
/// circulates in the body.
void TorqueFree::choose_axes(const Vec3& inertia, const Quaternion& axes, const Vec3& spin) {
  std::array<std::size_t, 3> order{0, 1, 2};
  const auto moment = [&](std::size_t k) { return inertia[order[k]]; };
  if (moment(1) > moment(2)) std::swap(order[1], order[2]);
  if (moment(0) > moment(1)) std::swap(order[0], order[1]);
  if (moment(1) > moment(2)) std::swap(order[1], order[2]);
  const Matrix columns = transposed(matrix_of(axes));  // rows: the principal axes in the world
  const Triple world{spin.x, spin.y, spin.z};
  const Real I1 = moment(0), I2 = moment(1), I3 = moment(2), w1 = dot3(columns[order[0]], world),
             w3 = dot3(columns[order[2]], world);
  // L^2 - 2 E I2 without its cancellation; below zero the circulation is about the axis of the least moment.
  if (I1 * (I1 - I2) * w1 * w1 + I3 * (I3 - I2) * w3 * w3 < 0) std::swap(order[0], order[2]);
  Triple a = columns[order[0]], b = columns[order[1]], c = columns[order[2]];
  if (dot3(cross3(a, b), c) < 0) c = {-c[0], -c[1], -c[2]};
  inertia_ = {moment(0), moment(1), moment(2)};
  principal_ = transposed({a, b, c});
  solve(times({a, b, c}, world));
}

void TorqueFree::solve(const Triple& w) {
  const auto [I1, I2, I3] = inertia_;
  const Real A = I1 * (I3 - I1) * w[0] * w[0] + I2 * (I3 - I2) * w[1] * w[1];  // 2 E I3 - L^2
  const Real B = I2 * (I2 - I1) * w[1] * w[1] + I3 * (I3 - I1) * w[2] * w[2];  // L^2 - 2 E I1
  amplitude_ = {std::sqrt(A / (I1 * (I3 - I1))), std::sqrt(A / (I2 * (I3 - I2))),
                std::sqrt(B / (I3 * (I3 - I1)))};
  rate_ = std::sqrt((I3 - I2) * B / (I1 * I2 * I3));
  modulus_ = std::sqrt((I2 - I1) * A / ((I3 - I2) * B));
  if (!(modulus_ < 1))
    throw InputError("the spin lies on the separatrix of the middle axis: it has no period and no flip time");
  momentum_ = std::sqrt(I1 * I1 * w[0] * w[0] + I2 * I2 * w[1] * w[1] + I3 * I3 * w[2] * w[2]);
  // Two signs may be flipped at will (the equations keep their form); the third follows the sense of the
  // circulation.
  const Real sign = w[2] < 0 ? -1 : 1, sense = I3 > I2 ? 1 : -1;
  amplitude_ = {sign * amplitude_[0], sense * amplitude_[1], sign * amplitude_[2]};
  const Real angle = std::atan2(w[1] / amplitude_[1], w[0] / amplitude_[0]);
  quarter_ = boost::math::ellint_1(modulus_);
  start_phase_ = boost::math::ellint_1(modulus_, angle);
  store_panels();
  start_ = product(principal_, transposed(nutation({I1 * w[0], I2 * w[1], I3 * w[2]})));
}

TorqueFree::Triple TorqueFree::omega(Real time) const {
  Real cn = 0, dn = 0;
  const Real phase = std::fmod(rate_ * time + start_phase_, 4 * quarter_);
  const Real sn = boost::math::jacobi_elliptic(modulus_, phase, &cn, &dn);
  return {amplitude_[0] * cn, amplitude_[1] * sn, amplitude_[2] * dn};
}

/// d psi/dt = |L| (I1 w1^2 + I2 w2^2)/(I1^2 w1^2 + I2^2 w2^2): smooth, and of period 2 K/rate.
TorqueFree::Real TorqueFree::precession_rate(Real time) const {
  const Triple w = omega(time);
  const Real p = inertia_[0] * w[0] * w[0], q = inertia_[1] * w[1] * w[1];
  return momentum_ * (p + q) / (inertia_[0] * p + inertia_[1] * q);
}

TorqueFree::Real TorqueFree::integral(Real from, Real to) const {
  if (from == to) return 0;
  return boost::math::quadrature::gauss<Real, 20>::integrate([this](Real t) { return precession_rate(t); },
                                                             from, to);
}

void TorqueFree::store_panels() {
  panel_ = 2 * quarter_ / rate_ / panels_a_period;
  panels_.assign(1, 0);
  for (int n = 0; n < panels_a_period; ++n)
    panels_.push_back(panels_.back() + integral(n * panel_, (n + 1) * panel_));
}

TorqueFree::Real TorqueFree::precession(Real time) const {
  const Real period = panel_ * panels_a_period, turns = std::floor(time / period),
             rest = time - turns * period;
  const auto n = std::min(static_cast<std::size_t>(rest / panel_), panels_.size() - 2);
  return turns * panels_.back() + panels_[n] + integral(static_cast<Real>(n) * panel_, rest);
}

TorqueFree::Matrix TorqueFree::attitude(Real time) const {
  const Triple w = omega(time);
  const Triple momentum{inertia_[0] * w[0], inertia_[1] * w[1], inertia_[2] * w[2]};
  return product(start_, product(turn_about_z(precession(time)), nutation(momentum)));
}

Quaternion TorqueFree::rotation(double time) const {
  if (time == 0.0) return {};
  if (steady_) return from_rotation_vector(time * spin_);
  return quaternion_of(product(attitude(time), transposed(principal_)));
}

Vec3 TorqueFree::angular_velocity(double time) const {
  if (steady_) return spin_;
  const Triple w = times(attitude(time), omega(time));
  return {double(w[0]), double(w[1]), double(w[2])};
}

std::optional<double> TorqueFree::flip_interval() const {
  if (steady_) return {};
  return double(2 * quarter_ / rate_);
}

std::vector<double> TorqueFree::flips(double end) const {
  std::vector<double> list;
  if (steady_) return list;
  // sn vanishes at the even multiples of the quarter period.
  for (Real n = std::floor(start_phase_ / (2 * quarter_)) + 1;; ++n) {
    const Real time = (2 * quarter_ * n - start_phase_) / rate_;
    if (time > end) return list;
    list.push_back(double(time));
  }
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <Eigen/Dense>
#include <numbers>
#include <optional>

#include "core/counter_noise.hpp"
#include "core/errors.hpp"
#include "sampling/lattice.hpp"
#include "sampling/sample.hpp"
#include "sampling/shape_distance.hpp"
#include "scene/geometry.hpp"
#include "scene/motion.hpp"
#include "scene/temperatures.hpp"

#include "tables/expression.hpp"

/// Particles of a scene at time 0: places on the lattice, mass rho0 dx^3, velocity and temperature by their
/// fields.
namespace tripoint {
namespace {

constexpr int terms = 10;  ///< 1, x, y, z, xx, yy, zz, xy, xz, yz
using Terms = Eigen::Matrix<double, terms, 1>;

Terms terms_at(const Vec3& r) {
  Terms t;
  t << 1.0, r.x, r.y, r.z, r.x * r.x, r.y * r.y, r.z * r.z, r.x * r.y, r.x * r.z, r.y * r.z;
  return t;
}

/// Mass, centre and the tensor of inertia about it, of axes x, y, z.
struct Wanted {
  double mass;
  Vec3 centre;
  Eigen::Matrix3d inertia;
};

Eigen::Matrix3d tensor_of(const MassProperties& p) {
  const Quaternion& q = p.principal_axes;
  const Eigen::Matrix3d axes = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
  const Eigen::Vector3d moments(p.principal_inertia.x, p.principal_inertia.y, p.principal_inertia.z);
  return axes * moments.asDiagonal() * axes.transpose();
}

/// What the particles weigh where nothing is given, or the shape does.
MassProperties before_given(const Scene& s, const Body& b, const MassProperties& own, double density) {
  if (!b.shape_mass) return own;
  const auto shape = mass_of_shape(b.shape, density, s.spacing, s.space());
  if (!shape || !(shape->mass > 0.0))
    throw InputError(
        b.place, fmt::format("body \"{}\": its shape has no mass of its own: leave out shape_mass", b.name));
  return *shape;
}

Wanted wanted_of(const Body& b, const MassProperties& from) {
  const double mass = b.mass.value_or(from.mass);
  Wanted w{mass, b.centre.value_or(from.centre), tensor_of(from) * (mass / from.mass)};
  if (!b.inertia) return w;
  w.inertia = Eigen::Vector3d(b.inertia->x, b.inertia->y, b.inertia->z).asDiagonal();
  w.inertia(0, 1) = w.inertia(1, 0) = b.products.x;
  w.inertia(0, 2) = w.inertia(2, 0) = b.products.y;
  w.inertia(1, 2) = w.inertia(2, 1) = b.products.z;
  return w;
}

/// Sums of the terms over the masses, places in spacings from an origin [kg].
Terms sums_of(const Wanted& w, const Vec3& origin, double spacing) {
  const Vec3 c = (w.centre - origin) / spacing;
  const Eigen::Matrix3d I = w.inertia / (spacing * spacing);
  const Eigen::Matrix3d second = 0.5 * I.trace() * Eigen::Matrix3d::Identity() - I;  // sum of m d d^T
  Terms t;
  t << w.mass, w.mass * c.x, w.mass * c.y, w.mass * c.z, second(0, 0) + w.mass * c.x * c.x,
      second(1, 1) + w.mass * c.y * c.y, second(2, 2) + w.mass * c.z * c.z, second(0, 1) + w.mass * c.x * c.y,
      second(0, 2) + w.mass * c.x * c.z, second(1, 2) + w.mass * c.y * c.z;
  return t;
}

}  // namespace

bool carries_given_mass(const Body& b) { return b.mass || b.centre || b.inertia || b.shape_mass; }

namespace {

constexpr double carried_to = 1e-9;  ///< of the given numbers

/// Factors of the masses that are a quadratic function of place, the smallest change; empty where it does
/// not carry the sums, or not by masses above 0.
std::vector<double> quadratic_factors(const std::vector<Terms>& at, double mass, const Terms& sums) {
  Eigen::Matrix<double, terms, terms> A = Eigen::Matrix<double, terms, terms>::Zero();
  for (const Terms& t : at) A += mass * t * t.transpose();
  const Terms factor = A.completeOrthogonalDecomposition().solve(sums);
  bool carried = (A * factor - sums).norm() <= carried_to * sums.norm();
  std::vector<double> factors;
  for (const Terms& t : at) {
    factors.push_back(factor.dot(t));
    carried = carried && factors.back() > 0.0;
  }
  return carried ? factors : std::vector<double>{};
}

/// Factors that are the exponential of such a function, always above 0: the masses of greatest entropy, which
/// exist wherever any masses carry the sums. Newton's method on the convex function sum m exp(f.t) - f.sums;
/// empty where it finds no least value.
std::vector<double> exponential_factors(const std::vector<Terms>& at, double mass, const Terms& sums) {
  constexpr int most_steps = 100;
  constexpr double near = 1e-4;  // of the sums: from there on Newton's whole step lands
  Terms f = Terms::Zero();
  const auto value = [&](const Terms& trial) {
    double sum = -trial.dot(sums);
    for (const Terms& t : at) sum += mass * std::exp(trial.dot(t));
    return sum;
  };
  for (int n = 0; n < most_steps; ++n) {
    Terms slope = -sums;
    Eigen::Matrix<double, terms, terms> H = Eigen::Matrix<double, terms, terms>::Zero();
    for (const Terms& t : at) {
      const double m = mass * std::exp(f.dot(t));
      slope += m * t;
      H += m * t * t.transpose();
    }
    if (!slope.allFinite() || !H.allFinite()) return {};
    const double off = slope.norm() / sums.norm();
    if (off <= 1e-14 || (n + 1 == most_steps && off <= carried_to)) {
      std::vector<double> factors;
      for (const Terms& t : at) factors.push_back(std::exp(f.dot(t)));
      return factors;
    }
    const Terms step = H.completeOrthogonalDecomposition().solve(slope);
    double part = 1.0;
    const double now = value(f), fall = slope.dot(step);
    while (off > near && part > 1e-10 && !(value(f - part * step) <= now - 1e-4 * part * fall)) part *= 0.5;
    f -= part * step;
  }
  return {};
}

}  // namespace

std::vector<double> particle_masses(const Scene& s, const Body& b, const std::vector<Vec3>& places) {
  const double spacing = s.spacing, density = s.material(b.material).density;
  std::vector<double> mass(places.size(), density * spacing * spacing * cell_depth(s));
  if (!carries_given_mass(b)) return mass;
  const MassProperties own = mass_properties(places, mass);
  const Wanted wanted = wanted_of(b, before_given(s, b, own, density));
  std::vector<Terms> at;
  for (const Vec3& r : places) at.push_back(terms_at((r - own.centre) / spacing));
  const Terms sums = sums_of(wanted, own.centre, spacing);
  auto factors = quadratic_factors(at, mass.front(), sums);
  if (factors.empty()) factors = exponential_factors(at, mass.front(), sums);
  if (factors.empty())
    throw InputError(b.place, fmt::format("body \"{}\": its {} particles cannot carry the mass, centre and "
                                          "moments that are given: refine scene.spacing, or give what its "
                                          "shape can have",
                                          b.name, places.size()));
  for (std::size_t i = 0; i < places.size(); ++i) mass[i] *= factors[i];
  return mass;
}

namespace {

// About 2 GB here; far beyond the particles that one machine steps
constexpr std::size_t max_particles = 20'000'000;

/// Fields with their expressions compiled once.
class TemperatureAt {
 public:
  explicit TemperatureAt(const TemperatureField& f) : field_(f) {
    if (f.kind == TemperatureField::Kind::expression) expression_.emplace(f.expression);
  }
  double operator()(const Vec3& r) const { return expression_ ? (*expression_)(r) : *value_at(field_, r); }

 private:
  const TemperatureField& field_;
  std::optional<Expression> expression_;
};

class VelocityAt {
 public:
  VelocityAt(const VelocityField& f, bool planar) : field_(f), planar_(planar) {
    if (f.kind == VelocityField::Kind::expression)
      for (const auto& text : f.expression) expressions_.emplace_back(text);
  }
  Vec3 operator()(const Vec3& r) const {
    switch (field_.kind) {
      case VelocityField::Kind::constant:
        return field_.value;
      case VelocityField::Kind::cosine:
        return field_.mean + std::cos(dot(field_.wave_vector, r) + field_.phase) * field_.amplitude;
      case VelocityField::Kind::linear: {
        const Vec3 d = r - field_.centre;
        return {dot(field_.gradient[0], d), dot(field_.gradient[1], d), dot(field_.gradient[2], d)};
      }
      case VelocityField::Kind::taylor_green: {
        const double k = 2.0 * std::numbers::pi / field_.wavelength, second = planar_ ? r.z : r.y;
        const double along = -field_.speed * std::cos(k * r.x) * std::sin(k * second),
                     across = field_.speed * std::sin(k * r.x) * std::cos(k * second);
        return planar_ ? Vec3{along, 0.0, across} : Vec3{along, across, 0.0};
      }
      case VelocityField::Kind::expression:
        return {expressions_[0](r), expressions_[1](r), expressions_[2](r)};
    }
    return {};
  }

 private:
  const VelocityField& field_;
  bool planar_;
  std::vector<Expression> expressions_;
};

/// Velocity of each particle of a body: its field and its spin about the centre of mass, or its prescribed
/// motion.
std::vector<Vec3> velocities(const Scene& s, const Body& b, const std::vector<Vec3>& centres,
                             const std::vector<double>& mass) {
  std::vector<Vec3> out(centres.size());
  if (b.motion == Motion::fixed) return out;
  Vec3 centre;
  if (carries_given_mass(b)) {
    centre = mass_properties(centres, mass).centre;
  } else {
    for (const auto& r : centres) centre += r;
    centre = centre / static_cast<double>(centres.size());  // equal masses
  }
  const VelocityAt field(b.velocity, s.is_planar());
  const auto start = b.keyframes.empty() ? PrescribedState{centre, {}, b.angular_velocity, {}}
                                         : prescribed_state(b.keyframes, centre, {}, {}, 0.0);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Vec3 own = b.keyframes.empty() ? field(centres[i]) : start.velocity;
    out[i] = own + cross(start.angular_velocity, centres[i] - centre);
    if (!finite(out[i]))
      throw InputError(b.place, fmt::format("body \"{}\": its velocity is not finite at ({}, {}, {}) m",
                                            b.name, centres[i].x, centres[i].y, centres[i].z));
    if (s.is_planar() && out[i].y != 0.0)
      throw InputError(b.place, fmt::format("body \"{}\" has a velocity along y: scene.dimensions = 2 has x "
                                            "and z alone",
                                            b.name));
  }
  return out;
}

/// A spin that moves no particle would be lost in silence: of one particle, or about the line that all of a
/// body lie on.
void refuse_lost_spin(const Scene& s, const Body& b, const std::vector<Vec3>& centres) {
  if (b.motion != Motion::free || b.angular_velocity == Vec3{}) return;
  const double w = norm(b.angular_velocity);
  const Vec3 line = centres.back() - centres.front();
  const auto off_line = [&](const Vec3& r) {
    return norm(cross(r - centres.front(), line)) > 1e-6 * s.spacing * norm(line);
  };
  if (norm(line) > 0.0 && (std::any_of(centres.begin(), centres.end(), off_line) ||
                           std::abs(dot(b.angular_velocity, line)) <= 1e-9 * w * norm(line)))
    return;
  if (centres.size() == 1)
    throw InputError(b.place, fmt::format("body \"{}\" is one particle, which cannot spin: remove "
                                          "angular_velocity, or refine scene.spacing",
                                          b.name));
  throw InputError(
      b.place,
      fmt::format("body \"{}\" is a line of {} particles, and a spin about its own axis moves none of "
                  "them: leave out that part of angular_velocity, or make the body wider than one spacing",
                  b.name, centres.size()));
}

void check_temperatures(const Scene& s) {
  const auto heated =
      std::find_if(s.bodies.begin(), s.bodies.end(), [](const Body& b) { return b.temperature.has_value(); });
  if (heated == s.bodies.end()) return;
  for (const auto& b : s.bodies)
    if (!b.temperature)
      throw InputError(
          b.place,
          fmt::format(
              "body \"{}\" has no temperature, but \"{}\" has: give every body one, or none; a body that "
              "takes up no heat has a temperature too, and a material of conductivity 1e-12 W/m/K",
              b.name, heated->name));
}

/// Shifts each particle at random. A body that keyframes lead keeps its centre, which is where they begin: it
/// would jump there.
/// @param first number of the body's first particle, on which the shifts depend
void disturb(const Scene& s, const Body& b, std::size_t first, std::vector<Vec3>& centres) {
  Vec3 mean;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    Vec3 shift;
    for (std::size_t a = 0; a < 3; ++a) shift[a] = s.jitter * s.spacing * counter_noise(s.seed, first + i, a);
    if (s.is_planar()) shift.y = 0.0;
    centres[i] += shift;
    mean += shift / static_cast<double>(centres.size());
  }
  if (b.motion != Motion::prescribed) return;
  for (Vec3& centre : centres) centre -= mean;
}

Settler settler = nullptr;

InitialState laid(const Scene& s) {
  check_temperatures(s);
  InitialState out;
  const auto rows = body_rows(s);
  for (std::size_t n = 0; n < s.bodies.size(); ++n) {
    const Body& b = s.bodies[n];
    const auto material = std::find_if(s.materials.begin(), s.materials.end(),
                                       [&](const Material& m) { return m.name == b.material; });
    auto centres = fill(s, b);
    if (out.size() + centres.size() > max_particles)
      throw InputError(b.place, fmt::format("more than {} particles by body \"{}\": coarsen scene.spacing",
                                            max_particles, b.name));
    refuse_lost_spin(s, b, centres);
    if (s.jitter > 0.0 && b.jitters) disturb(s, b, out.size(), centres);
    const std::vector<double> mass = particle_masses(s, b, centres);
    const auto velocity = velocities(s, b, centres, mass);
    std::optional<TemperatureAt> temperature;
    if (b.temperature) temperature.emplace(*b.temperature);
    for (std::size_t i = 0; i < centres.size(); ++i) {
      out.position.push_back(wrapped(s, centres[i]));
      out.velocity.push_back(velocity[i]);
      out.mass.push_back(mass[i]);
      out.phase.push_back(static_cast<int>(b.phase));
      out.body.push_back(rows[n]);
      out.material.push_back(static_cast<int>(material - s.materials.begin()));
      out.source.push_back(static_cast<int>(n));
      if (!temperature) continue;
      const double T = (*temperature)(centres[i]);
      if (!std::isfinite(T) || T <= 0.0)
        throw InputError(
            b.place,
            fmt::format("body \"{}\": its temperature is {} K at ({}, {}, {}) m: it must be above 0 K",
                        b.name, T, centres[i].x, centres[i].y, centres[i].z));
      out.temperature.push_back(T);
    }
  }
  return out;
}

}  // namespace

void set_settler(Settler s) noexcept { settler = s; }

InitialState sample(const Scene& s) {
  if (!s.settle) return laid(s);
  if (!settler) throw InputError("settle = true needs the solver, and this program has none");
  return settler(s, laid(s));
}

std::vector<int> body_rows(const Scene& s) {
  std::vector<int> rows;
  int next = 0;
  for (const auto& b : s.bodies) rows.push_back(b.phase == Phase::liquid ? -1 : next++);
  return rows;
}

}  // namespace tripoint

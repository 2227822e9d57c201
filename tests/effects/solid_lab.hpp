// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <random>

#include "effects/elastic/elastic.hpp"
#include "effects/elastic/fields.hpp"
#include "effects/fluid_lab.hpp"
#include "solids/solid_particles.hpp"

/// Small scenes of deformable solids.
namespace tripoint::lab {

inline constexpr double dx = 0.1;  ///< spacing of the elastic blocks of tests [m]

/// Material 0 is elastic: E = 1 Pa, rho = 1 kg/m3 unless said; no stiffness, so that bodies do not touch.
inline Lab elastic_lab(double spacing, double poisson = 0.3, Mode mode = Mode::corrected) {
  Lab lab(spacing, mode);
  Material& m = lab.scene.materials[0];
  m.density = 1.0;
  m.conductivity.reset();
  m.heat_capacity.reset();
  m.young_modulus = 1.0;
  m.poisson_ratio = poisson;
  m.solid = SolidKind::elastic;
  return lab;
}

/// Moves every particle by up to `amplitude` spacings, before the solver measures reference vectors.
inline void jitter_all(Lab& lab, double amplitude, const Vec3& along = {1.0, 1.0, 1.0}) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> uniform(-amplitude * lab.scene.spacing,
                                                 amplitude * lab.scene.spacing);
  for (Vec3& r : lab.initial.position)
    r += {along.x * uniform(random), along.y * uniform(random), along.z * uniform(random)};
}

/// The solids of a scene, put where a test wants them: strain, forces and energy as the solver finds them
/// there.
class Deformable {
 public:
  explicit Deformable(const Lab& lab, int threads = 1)
      : state_(Simulation(lab.scene, lab.initial, {.threads = threads}).state()),
        effect_(elastic::make(lab.scene)),
        start_(lab.initial.position) {
    place([](const Vec3& r) { return r; });
  }
  /// The solids of a run of this scene, as they are now.
  Deformable(const Lab& lab, const Simulation& now)
      : state_(now.state()), effect_(elastic::make(lab.scene)), start_(lab.initial.position) {
    place([](const Vec3& r) { return r; });
  }
  /// Each particle at to(its place at the start).
  template <class Place>
  void place(Place to) {
    for (std::size_t id = 0; id < start_.size(); ++id)
      positions(state_.particles).set(state_.particles.row(id), to(start_[id]));
    update();
  }
  void move(std::size_t id, const Vec3& by) {
    const std::size_t row = state_.particles.row(id);
    positions(state_.particles).set(row, state_.particles.position(row) + by);
    update();
  }
  [[nodiscard]] Vec3 force(std::size_t id) const {
    return state_.particles.vector(state_.particles.row(id), field::elastic_force);
  }
  [[nodiscard]] double energy() const {
    double sum = 0.0;
    for (std::size_t id = 0; id < start_.size(); ++id)
      sum += solid::deformation_energy(state_, static_cast<std::uint32_t>(id)).total();
    return sum;
  }
  /// Greatest Frobenius norm of the strains.
  [[nodiscard]] double greatest_strain() const {
    double most = 0.0;
    for (std::size_t id = 0; id < start_.size(); ++id) {
      const Symmetric e = strain(id);
      most = std::max(most, std::sqrt(contraction(e, e)));
    }
    return most;
  }
  [[nodiscard]] double greatest_force() const {
    double most = 0.0;
    for (std::size_t id = 0; id < start_.size(); ++id) most = std::max(most, norm(force(id)));
    return most;
  }
  [[nodiscard]] Symmetric strain(std::size_t id) const {
    const Particles& p = state_.particles;
    const std::size_t i = p.row(id);
    return {p[field::strain.xx][i], p[field::strain.yy][i], p[field::strain.zz][i],
            p[field::strain.yz][i], p[field::strain.xz][i], p[field::strain.xy][i]};
  }
  [[nodiscard]] std::size_t size() const { return start_.size(); }
  [[nodiscard]] State& state() { return state_; }
  void update() {
    effect_->state(state_, state_.awake());
    effect_->bonds(state_, state_.formed());
  }

 private:
  State state_;
  std::unique_ptr<Effect> effect_;
  std::vector<Vec3> start_;
};

/// Turned by a radian and strained by some 5 %, differently everywhere.
inline Vec3 bent(const Vec3& r) {
  const Vec3 s = r + Vec3{0.3 * r.x * r.y + 0.05 * r.x, 0.2 * r.x * r.x - 0.04 * r.y,
                          0.25 * r.y * r.z + 0.1 * r.x * r.y};
  return rotate(from_rotation_vector({0.3, 0.8, -0.5}), s);
}

/// Worst difference of the forces from central differences of the energy, over the greatest force.
inline double worst_gradient_error(Deformable& body) {
  double worst = 0.0;
  const double scale = body.greatest_force(), step = 1e-6 * dx;
  for (std::size_t id = 0; id < body.size(); id += 1 + body.size() / 12) {
    const Vec3 f = body.force(id);
    for (std::size_t a = 0; a < 3; ++a) {
      Vec3 by;
      by[a] = step;
      body.move(id, by);
      const double above = body.energy();
      body.move(id, -2.0 * by);
      const double below = body.energy();
      body.move(id, by);
      worst = std::max(worst, std::abs(f[a] + (above - below) / (2.0 * step)) / scale);
    }
  }
  return worst;
}

}  // namespace tripoint::lab

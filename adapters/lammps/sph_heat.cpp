// SPDX-License-Identifier: GPL-2.0-only
// Lengths are scaled to spacings and a particle has mass and density 1. Then sph/heatconduction's
// 2 m_i m_j/(m_i + m_j) (rho_i + rho_j)/(rho_i rho_j) D (e_i - e_j) W'/r is the diffusion of e = T with D in
// spacings^2/s.
#include "adapters/lammps/sph_heat.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/lammps/heat_scene.hpp"

namespace tripoint::lammps {
namespace {

constexpr double heat_support = 3.0;      // [spacings]
constexpr double diffusion_number = 0.1;  ///< D dt / dx2; explicit, and first order in time

class SphHeat final : public Model {
 public:
  SphHeat(const Job& job, const InitialState& state)
      : job_(job),
        state_(state),
        choice_(choice_for(job)),
        library_(job.output + "/log.lammps"),
        time_(job.times.front()) {
    double greatest = 0.0;
    for (const Body& b : job.scene.bodies) greatest = std::max(greatest, scaled_diffusivity(b));
    limit_ = wanted_time_step(job).value_or(diffusion_number / greatest);
    make_box();
    make_particles();
    make_pairs();
    library_.run(choice_.commands);
  }

  void advance_to(double time) override {
    clock_.run(library_, steps_in(time - time_, limit_));
    time_ = time;
    const std::vector<double> T = library_.scalars("esph");
    for (std::size_t i = 0; i < T.size(); ++i)
      if (!std::isfinite(T[i]))
        throw Diverged(static_cast<long>(i), -1, "temperature", "run", time, "the temperature is not finite");
  }

  [[nodiscard]] Snapshot observe() const override {
    return at_rest(job_, state_, time_, clock_.total(), library_.scalars("esph"));
  }
  [[nodiscard]] Readback readback() const override { return rest_readback(job_, limit_); }
  void account(Result& result) const override {
    result.steps = clock_.total();
    result.time_step_bound = wanted_time_step(job_) ? "given" : "0.1 dx2/D";
  }

 private:
  [[nodiscard]] double scaled_diffusivity(const Body& b) const {
    return diffusivity(job_.scene, b) / (job_.scene.spacing * job_.scene.spacing);
  }

  [[nodiscard]] double cutoff() const { return choice_.cutoff.value_or(heat_support); }

  /// Periodic directions take the scene's domain; elsewhere the box is wide and particle ends insulate by
  /// themselves.
  void make_box() {
    const Scene& scene = job_.scene;
    Vec3 lo = state_.position.front(), hi = lo;
    for (const Vec3& x : state_.position)
      for (std::size_t k = 0; k < 3; ++k) {
        lo[k] = std::min(lo[k], x[k]);
        hi[k] = std::max(hi[k], x[k]);
      }
    std::string edges;
    for (std::size_t k = 0; k < 3; ++k) {
      const double margin = cutoff() * scene.spacing;
      const double from = scene.periodic[k] && scene.min ? (*scene.min)[k] : lo[k] - margin,
                   to = scene.periodic[k] && scene.max ? (*scene.max)[k] : hi[k] + margin;
      origin_[k] = from;
      edges += fmt::format(" 0 {:.17g}", (to - from) / scene.spacing);
    }
    const auto letter = [&](std::size_t k) { return scene.periodic[k] ? 'p' : 'f'; };
    library_.run(
        fmt::format("units lj\natom_style sph\natom_modify map array sort 0 0.0\nboundary {} {} {}\n",
                    letter(0), letter(1), letter(2)));
    library_.run(
        fmt::format("region box block{}\ncreate_box {} box\nmass * 1.0\n", edges, scene.bodies.size()));
  }

  /// A type a body of the case.
  void make_particles() {
    std::vector<int> type;
    std::vector<Vec3> position;
    for (std::size_t i = 0; i < state_.size(); ++i) {
      type.push_back(state_.source[i] + 1);
      position.push_back((state_.position[i] - origin_) / job_.scene.spacing);
    }
    library_.create_atoms(type, position, {});
    library_.run("set group all sph/cv 1.0 sph/rho 1.0");
    library_.set_scalars("esph", state_.temperature);
  }

  /// Between two bodies the harmonic mean, which keeps the interface without a jump. Held bodies are left out
  /// of the integration.
  void make_pairs() {
    library_.run("pair_style sph/heatconduction");
    const auto& bodies = job_.scene.bodies;
    std::string live;
    for (std::size_t a = 0; a < bodies.size(); ++a) {
      for (std::size_t b = a; b < bodies.size(); ++b) {
        const double D_a = scaled_diffusivity(bodies[a]), D_b = scaled_diffusivity(bodies[b]);
        library_.run(fmt::format("pair_coeff {} {} {:.17g} {:.17g}", a + 1, b + 1,
                                 2.0 * D_a * D_b / (D_a + D_b), cutoff()));
      }
      if (!bodies[a].temperature_held) live += fmt::format(" {}", a + 1);
    }
    library_.run("neighbor 0.3 bin\nneigh_modify every 1000000 delay 0 check no\nthermo 0\n");
    if (!live.empty()) library_.run("group live type" + live + "\nfix heat live sph/stationary");
  }

  Job job_;
  InitialState state_;
  Choice choice_;
  Library library_;
  Clock clock_;
  double time_, limit_ = 0.0;
  Vec3 origin_;
};

}  // namespace

std::string why_no_sph_heat(const Job& job) {
  if (const std::string reason = why_no_conduction(job); !reason.empty()) return reason;
  const Scene& scene = job.scene;
  const double first = heat_per_volume(scene, scene.bodies.front());
  for (const Body& b : scene.bodies)
    if (std::abs(heat_per_volume(scene, b) / first - 1.0) > 1e-9)
      return fmt::format(
          "sph/heatconduction conserves heat between equal heat capacities only, and that of {} differs from "
          "that of {}",
          b.name, scene.bodies.front().name);
  return {};
}

std::unique_ptr<Model> make_sph_heat(const Job& job, const InitialState& state) {
  return std::make_unique<SphHeat>(job, state);
}

}  // namespace tripoint::lammps

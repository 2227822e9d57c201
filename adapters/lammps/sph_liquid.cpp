// SPDX-License-Identifier: GPL-2.0-only
// In LAMMPS a particle of the liquid has mass 1 and rest density 1. Sound goes one spacing in a unit of time.
//
// It has known faults, measured in docs/engines.md. Walls act about half a spacing outside their surface, as
// the velocity is not reflected in them. A particle's density only follows the continuity equation, and
// nothing brings it back to that of its neighbours' positions. There is no clamp, so that stretched liquid
// pulls, and particles pair up under the Lucy kernel. The viscosity acts along the difference of velocities,
// which brakes a liquid that turns. fix sph lets sound grow at w2 dt/4.
#include "adapters/lammps/sph_liquid.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/lammps/particle_model.hpp"

namespace tripoint::lammps {
namespace {

constexpr double gamma = 7.0;  // sph/taitwater knows no other
constexpr double sound_courant = 0.06, viscous_number = 0.1;

const JobBody& liquid_of(const Job& job) {
  return *std::find_if(job.bodies.begin(), job.bodies.end(),
                       [](const JobBody& b) { return b.phase == Phase::liquid; });
}

/// Speed of sound of the scene's equation of state: one k a scene, its largest [m/s].
double sound_speed(const Scene& scene) {
  double k = 0.0;
  for (const Material& m : scene.materials) k = std::max(k, m.stiffness.value_or(0.0));
  return std::sqrt(k);
}

double greatest_viscosity(const Scene& scene) {
  double mu = 0.0;
  for (const Body& b : scene.bodies)
    if (b.phase == Phase::liquid) mu = std::max(mu, scene.material(b.material).viscosity);
  return mu;
}

double liquid_support_of(const Job& job) {
  return choice_for(job).cutoff.value_or(job.resolution.support_ratio);
}

Units liquid_units(const Job& job) {
  const double dx = job.resolution.spacing, rho0 = job.scene.material(liquid_of(job).material).density;
  return {dx, dx / sound_speed(job.scene), rho0 * dx * dx * dx, {}};
}

double liquid_step_limit(const Job& job) {
  const Units u = liquid_units(job);
  const double nu = greatest_viscosity(job.scene) / u.density();
  const double sound = sound_courant * liquid_support_of(job) * u.time;
  return nu > 0.0 ? std::min(sound, viscous_number * u.length * u.length / nu) : sound;
}

class SphLiquid final : public ParticleModel {
 public:
  SphLiquid(const Job& job, const InitialState& state)
      : ParticleModel(job, state, liquid_units(job), liquid_step_limit(job)),
        support_(liquid_support_of(job)),
        viscous_(greatest_viscosity(job.scene) > 0.0) {
    make_particles("atom_style sph\nnewton on", "", support_, type_a_body());
    for (std::size_t b = 0; b < job.bodies.size(); ++b) {  // walls are made of still liquid
      const double mass = job.bodies[b].phase == Phase::liquid
                              ? particle_mass(state, static_cast<int>(b), job.bodies[b].name)
                              : units_.mass;
      library_.run(fmt::format("mass {} {:.17g}", b + 1, mass / units_.mass));
    }
    library_.run(
        "set group all sph/rho 1.0 sph/e 0.0 sph/cv 1.0\ncomm_modify vel yes\nneighbor 0.3 bin\nneigh_modify "
        "every 1 delay 0 "
        "check yes\nthermo 0");
    make_gravity();
    make_pairs();
    library_.run("fix move free sph");
    if (make_group("walls", [](const JobBody& b) { return b.motion == Motion::fixed; }))
      library_.run("fix walls walls sph/stationary");
    library_.run(choice_.commands);
  }

  [[nodiscard]] Snapshot observe() const override;
  void account(Result& result) const override {
    result.steps = clock_.total();
    result.time_step_bound = wanted_time_step(job_) ? "given" : "sound, viscosity";
    result.extra["support_in_spacings"] = support_;
    result.extra["sound_speed"] = units_.speed();
    result.message = fmt::format(
        "pair sph/taitwater{}, Lucy kernel of support {:g} dx, c = {:g} m/s; density by continuity, started "
        "at rest density; no "
        "clamp",
        viscous_ ? "/morris" : "", support_, units_.speed());
  }

 private:
  [[nodiscard]] double viscosity(std::size_t a, std::size_t b) const;
  void make_pairs();
  [[nodiscard]] bool is_liquid(std::size_t particle) const {
    return state_.phase[particle] == static_cast<int>(Phase::liquid);
  }
  double support_;
  bool viscous_;
};

/// Harmonic between liquids; the liquid's own at a wall, none where that slips. In LAMMPS's units.
double SphLiquid::viscosity(std::size_t a, std::size_t b) const {
  const Scene& scene = job_.scene;
  const auto& A = scene.bodies[a];
  const auto& B = scene.bodies[b];
  const double mu_a = scene.material(A.material).viscosity, mu_b = scene.material(B.material).viscosity,
               unit = units_.pressure() * units_.time;
  if (A.phase == Phase::liquid && B.phase == Phase::liquid)
    return mu_a + mu_b > 0.0 ? 2.0 * mu_a * mu_b / (mu_a + mu_b) / unit : 0.0;
  if (A.phase != Phase::liquid && B.phase != Phase::liquid) return 0.0;
  return (A.phase == Phase::liquid ? B.free_slip : A.free_slip)
             ? 0.0
             : (A.phase == Phase::liquid ? mu_a : mu_b) / unit;
}

void SphLiquid::make_pairs() {
  library_.run(viscous_ ? "pair_style sph/taitwater/morris" : "pair_style sph/taitwater");
  for (std::size_t a = 0; a < job_.bodies.size(); ++a)
    for (std::size_t b = a; b < job_.bodies.size(); ++b)
      library_.run(
          fmt::format("pair_coeff {} {} 1.0 1.0 {:.17g} {:.17g}", a + 1, b + 1, viscosity(a, b), support_));
}

/// Stored in a particle [J]: m int p/rho^2 drho.
double compression_energy(double stiffness, double mass, double s) {
  return mass * stiffness / gamma *
         (std::pow(s, gamma - 1.0) / (gamma - 1.0) + 1.0 / s - gamma / (gamma - 1.0));
}

Snapshot SphLiquid::observe() const {
  Snapshot s = particles();
  const double c2 = units_.speed() * units_.speed();
  s.energy["compression"] = 0.0;
  for (const double rho : library_.scalars("rho")) {
    const std::size_t i = s.density.size();
    s.density.push_back(rho * units_.density());
    s.pressure.push_back(units_.density() * c2 / gamma * (std::pow(rho, gamma) - 1.0));
    s.energy["compression"] += compression_energy(c2, s.mass[i], rho);
  }
  for (const JobBody& b : job_.bodies) {
    if (b.index < 0) continue;
    BodyState wall;
    wall.position = b.properties.centre;
    wall.mass = b.properties.mass;
    s.bodies.push_back(wall);
  }
  return s;
}

std::string why_no_wall(const JobBody& b) {
  if (b.phase == Phase::elastic)
    return fmt::format("{} is elastic; sph/taitwater knows liquids and fixed walls only", b.name);
  if (b.motion == Motion::free)
    return fmt::format("{} is a free rigid body; sph/taitwater is run here between fixed walls only", b.name);
  if (b.motion == Motion::prescribed)
    return fmt::format("{} is prescribed; walls of sph/taitwater are at rest here", b.name);
  return {};
}

}  // namespace

std::string why_no_sph_liquid(const Job& job) {
  const Scene& scene = job.scene;
  if (!scene.events.empty()) return "sph/taitwater is run here without events";
  if (!scene.inflows.empty()) return "sph/taitwater is run here without inflow";
  double rho0 = 0.0;
  for (const JobBody& b : job.bodies) {
    if (b.phase != Phase::liquid) {
      if (const std::string reason = why_no_wall(b); !reason.empty()) return reason;
      continue;
    }
    if (b.motion != Motion::free)
      return fmt::format("{} is a liquid that is held; sph/taitwater lets it flow", b.name);
    const double density = scene.material(b.material).density;
    if (rho0 > 0.0 && density != rho0)
      return fmt::format(
          "sph/taitwater weighs neighbours by mass and smears the density where liquids meet; {} has another "
          "one",
          b.name);
    rho0 = density;
  }
  return sound_speed(scene) > 0.0 ? ""
                                  : "the scene gives no stiffness and no speed that one could follow from";
}

std::unique_ptr<Model> make_sph_liquid(const Job& job, const InitialState& state) {
  return std::make_unique<SphLiquid>(job, state);
}

}  // namespace tripoint::lammps

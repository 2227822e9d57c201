// SPDX-License-Identifier: GPL-2.0-only
// In LAMMPS spacing, mass of a particle, heat capacity and the speed of sound of the liquid are 1. Energy is
// temperature [K].
//
// It is known to be another model, measured in docs/engines.md. Solids are networks of equal central springs
// out to the second neighbours. On the cubic lattice this is an isotropic solid of Poisson's ratio 1/4 and E
// = 5/2 stiffness/spacing, whatever the scene says. Bonds and contacts are damped. Matter melts and freezes
// at one temperature. Viscous heat is not counted.
#include "adapters/lammps/rheo.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/lammps/heat_scene.hpp"
#include "adapters/lammps/particle_model.hpp"
#include "adapters/lammps/rheo_bodies.hpp"
#include "adapters/lammps/rheo_scene.hpp"

namespace tripoint::lammps {
namespace {

constexpr double rheo_support = 3.0;  ///< [spacings]
constexpr double bonds_within = 1.5;  ///< [spacings]: first and second neighbours of the cubic lattice
constexpr double damping = 0.1;       ///< of bonds and contacts, of the critical one
/// Of a full set of neighbours, the share of RHEO's examples (22 of 28 in 2D)
constexpr double surface_share = 0.79;
constexpr double rheo_courant = 0.25, diffusion_number = 0.1;

class Rheo final : public ParticleModel {
 public:
  Rheo(const Job& job, const InitialState& state)
      : ParticleModel(job, state, rheo_units(job), step_limit(job)),
        support_(choice_.cutoff.value_or(rheo_support)),
        bodies_(job, state) {
    flows_ = anything_free(job);
    make_particles("atom_style hybrid rheo/thermal bond\nnewton off\ncomm_modify vel yes",
                   " bond/types 1 extra/bond/per/atom 60 extra/special/per/atom 120", support_,
                   type_a_body());
    library_.run("mass * 1.0\nneighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\nthermo 0");
    make_gravity();
    make_pairs();
    make_bonds();
    make_fixes();
    set_state();
    if (flows_) library_.run("compute piece free fragment/atom single yes");
    library_.run(choice_.commands);
    hold_from(time_);
    library_.run("run 0 post no");  // phases and temperatures as RHEO sees them
  }

  /// In pieces over which ends keep their velocity and heated bodies their temperature.
  void advance_to(double time) override {
    while (time_ < time - 1e-12 * job_.times.back()) {
      ParticleModel::advance_to(std::min(time, hold_from(time_)));
    }
    refuse_molten_walls();
    bodies_.follow(pieces());
  }

  [[nodiscard]] Snapshot observe() const override;
  void account(Result& result) const override {
    result.steps = clock_.total();
    result.time_step_bound = wanted_time_step(job_) ? "given" : "sound, bonds, viscosity, heat";
    result.extra["support_in_spacings"] = support_;
    result.extra["bond_modulus"] = bond_modulus(job_) * units_.pressure();
    result.message = fmt::format(
        "RHEO, quintic spline of support {:g} dx; solids are bonds of E = {:.3g} Pa and Poisson's ratio 1/4, "
        "damped; "
        "orientations are not followed",
        support_, bond_modulus(job_) * units_.pressure());
  }

 private:
  static double step_limit(const Job&);
  void make_pairs();
  void make_bonds();
  void make_fixes();
  void set_state();
  /// Sets velocities and temperatures that the scene holds from a time on. @return when they next change
  double hold_from(double time);
  void hold(const std::string& name, const std::string& ids, const std::string& command);
  bool heat(const Event&, const std::string& name);
  void refuse_molten_walls() const;
  [[nodiscard]] double stiffness() const { return 0.4 * bond_modulus(job_); }  ///< E = 5/2 k/dx
  [[nodiscard]] std::vector<int> pieces() const;

  double support_;
  bool flows_ = false;  ///< some body is free: only then are liquid particles shifted off their places
  RheoBodies bodies_;
  std::map<std::string, std::string> held_;
  std::map<std::size_t, bool> ovens_;  ///< heating events that are on
};

double Rheo::step_limit(const Job& job) {
  const Units u = rheo_units(job);
  // C11 of the bonds is 3 k/dx
  double step = rheo_courant / std::max(1.0, std::sqrt(3.0 * 0.4 * bond_modulus(job)));
  for (std::size_t b = 0; b < job.bodies.size(); ++b) {
    const RheoMatter m = rheo_matter(job, b);
    for (const double diffusivity : {m.viscosity, job.bodies[b].temperature_held ? 0.0 : m.conductivity})
      if (diffusivity > 0.0) step = std::min(step, diffusion_number / diffusivity);
  }
  return step * u.time;
}

/// Contact of solids that are not bonded is as stiff as a bond, over one spacing.
void Rheo::make_pairs() {
  const double gamma = 2.0 * damping * std::sqrt(stiffness());
  library_.run(fmt::format(
      "pair_style hybrid/overlay rheo {:.17g} harmonic/means rheo/solid\npair_coeff * * rheo\npair_coeff * * "
      "rheo/solid {:.17g} 1.0 {:.17g}",
      support_, stiffness(), gamma));
}

/// Each solid within itself, and with those it is joined to.
void Rheo::make_bonds() {
  library_.run("special_bonds lj 0.0 1.0 1.0 coul 0.0 1.0 1.0");
  for (std::size_t a = 0; a < job_.bodies.size(); ++a) {
    if (job_.bodies[a].phase == Phase::liquid) continue;
    library_.run(fmt::format("group body{} id{}", a, ids_of(a)));
    if (members(a).size() > 1)
      library_.run(fmt::format("create_bonds many body{0} body{0} 1 0.0 {1}", a, bonds_within));
    for (std::size_t b = 0; b < a; ++b)
      if (are_joined(job_.scene.bodies[a], job_.scene.bodies[b]))
        library_.run(fmt::format("create_bonds many body{} body{} 1 0.0 {}", b, a, bonds_within));
  }
  library_.run("special_bonds lj 0.0 1.0 1.0 coul 1.0 1.0 1.0\nbond_style bpm/spring");
  library_.run(
      fmt::format("bond_coeff 1 {:.17g} 1.0 {:.17g}", stiffness(), 2.0 * damping * std::sqrt(stiffness())));
}

void Rheo::make_fixes() {
  const double full = 4.0 / 3.0 * 3.14159265358979323846 * support_ * support_ * support_;
  library_.run(
      fmt::format("fix flow all rheo {:.17g} quintic 0 thermal", support_) +
      (flows_ ? fmt::format(" shift surface/detection coordination {:.0f} 8", surface_share * full) : ""));
  std::string viscosity, conductivity, melting;
  for (std::size_t b = 0; b < job_.bodies.size(); ++b) {
    const RheoMatter m = rheo_matter(job_, b);
    viscosity += fmt::format(" {} constant {:.17g}", b + 1, m.viscosity);
    conductivity += fmt::format(" conductivity {} constant {:.17g}", b + 1, m.conductivity);
    if (m.melts) melting += fmt::format(" Tfreeze {} constant {:.17g}", b + 1, m.melting);
    if (m.melts && m.latent > 0.0)
      melting += fmt::format(" latent/heat {} constant {:.17g}", b + 1, m.latent);
  }
  library_.run("fix viscosity all rheo/viscosity" + viscosity + "\nfix pressure all rheo/pressure * linear");
  library_.run("fix heat all rheo/thermal specific/heat * constant 1.0" + conductivity + melting +
               fmt::format(" react {} 1", job_.scene.merge_distance));
}

void Rheo::set_state() {
  library_.run("set group all rheo/rho 1.0 rheo/status 0");
  std::vector<double> energy = state_.temperature;
  for (std::size_t b = 0; b < job_.bodies.size(); ++b) {
    const RheoMatter m = rheo_matter(job_, b);
    if (job_.bodies[b].phase != Phase::liquid) library_.run(fmt::format("set group body{} rheo/status 1", b));
    for (const std::size_t i : members(b))
      energy[i] += m.melts && job_.bodies[b].phase == Phase::liquid ? m.latent : 0.0;
  }
  library_.set_scalars("esph", energy);
}

void Rheo::hold(const std::string& name, const std::string& ids, const std::string& command) {
  std::string& last = held_[name];
  if (last == command) return;
  if (last.empty()) library_.run("group " + name + " id" + ids);
  library_.run(command);
  last = command;
  clock_.set_up_again();
}

double Rheo::hold_from(double time) {
  const double end = job_.times.back();
  double until = end;
  for (std::size_t b = 0; b < job_.bodies.size(); ++b) {
    if (job_.bodies[b].temperature_held)
      hold(fmt::format("warm{}", b), ids_of(b),
           fmt::format("fix warm{0} warm{0} add/heat constant 0.0 overwrite yes", b));
    if (job_.bodies[b].motion == Motion::free) continue;
    const Drive drive = drive_at(job_.bodies[b], time, end);
    until = std::min(until, drive.until);
    const Vec3 v = drive.velocity / units_.speed();
    hold(fmt::format("end{}", b), ids_of(b),
         fmt::format("velocity end{0} set {1:.17g} {2:.17g} {3:.17g}\nfix end{0} end{0} setforce 0.0 0.0 0.0",
                     b, v.x, v.y, v.z));
  }
  for (std::size_t e = 0; e < job_.scene.events.size(); ++e) {
    const Event& event = job_.scene.events[e];
    const double stop = event.until.value_or(end), now = 1e-9 * end;
    bool& burns = ovens_[e];
    if (!burns && event.time <= time + now && time < stop - now)
      burns = heat(event, fmt::format("oven{}", e));
    if (burns && time >= stop - now) {
      burns = false;
      library_.run(fmt::format("unfix oven{}", e));
      clock_.set_up_again();
    }
    for (const double change : {event.time, stop})
      if (change > time + now) until = std::min(until, change);
  }
  return until;
}

/// From now on the particles that the event takes now keep its temperature. @return whether it takes any
bool Rheo::heat(const Event& event, const std::string& name) {
  const std::vector<Vec3> place = clock_.total() > 0 ? library_.vectors("x") : std::vector<Vec3>();
  std::vector<double> energy = library_.scalars("esph");
  std::string ids;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const auto source = static_cast<std::size_t>(state_.source[i]);
    const Vec3 r = place.empty() ? state_.position[i] : units_.origin + units_.length * place[i];
    if (!takes(event, job_.bodies[source].name, r)) continue;
    energy[i] = rheo_energy(rheo_matter(job_, source), *event.temperature);
    ids += fmt::format(" {}", i + 1);
  }
  if (ids.empty()) return false;
  library_.set_scalars("esph", energy);
  library_.run("group " + name + " id" + ids + "\nfix " + name + " " + name +
               " add/heat constant 0.0 overwrite yes");
  clock_.set_up_again();
  return true;
}

/// They were given no melting point.
void Rheo::refuse_molten_walls() const {
  if (!flows_) return;
  const std::vector<double> T = library_.scalars("temperature");
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const JobBody& b = job_.bodies[static_cast<std::size_t>(state_.source[i])];
    const auto& melting = job_.scene.material(b.material).t_melt;
    if (b.motion != Motion::free && melting && T[i] > *melting)
      throw EngineError(fmt::format(
          "{} is held and would melt by t = {:.6g} s; RHEO shifts molten particles beside free ones", b.name,
          time_));
  }
}

constexpr int solid_bit = 1;

/// A label for each piece of free solid matter; a held body is one of its own, whatever froze to it.
std::vector<int> Rheo::pieces() const {
  const std::vector<double> label = flows_ ? library_.compute("piece") : std::vector<double>(state_.size());
  const std::vector<int> status = library_.integers("rheo_status");
  std::vector<int> piece(label.size(), -1);
  for (std::size_t i = 0; i < label.size(); ++i) {
    const int source = state_.source[i];
    const bool held = job_.bodies[static_cast<std::size_t>(source)].motion != Motion::free;
    if (status[i] & solid_bit)
      piece[i] = held ? static_cast<int>(state_.size()) + 1 + source : static_cast<int>(label[i]);
  }
  return piece;
}

Snapshot Rheo::observe() const {
  Snapshot s = particles();
  s.temperature = library_.scalars("temperature");
  s.body = bodies_.rows();
  const std::vector<double> rho = library_.scalars("rho"), energy = library_.scalars("esph");
  s.energy["thermal"] = s.energy["latent"] = 0.0;
  for (std::size_t i = 0; i < state_.size(); ++i) {
    const JobBody& from = job_.bodies[static_cast<std::size_t>(state_.source[i])];
    const RheoMatter m = rheo_matter(job_, static_cast<std::size_t>(state_.source[i]));
    const double c = *job_.scene.materials[static_cast<std::size_t>(s.material[i])].heat_capacity;
    s.phase[i] = static_cast<int>(s.body[i] < 0                ? Phase::liquid
                                  : from.phase == Phase::rigid ? Phase::rigid
                                                               : Phase::elastic);
    s.density.push_back(rho[i] * units_.density());
    s.liquid_fraction.push_back(m.melts && m.latent > 0.0
                                    ? std::clamp((energy[i] - s.temperature[i]) / m.latent, 0.0, 1.0)
                                : s.body[i] < 0 ? 1.0
                                                : 0.0);
    s.energy["thermal"] += s.mass[i] * c * s.temperature[i];
    s.energy["latent"] += s.mass[i] * c * (energy[i] - s.temperature[i]);
  }
  s.bodies = bodies_.states(s);
  return s;
}

}  // namespace

std::unique_ptr<Model> make_rheo(const Job& job, const InitialState& state) {
  return std::make_unique<Rheo>(job, state);
}

}  // namespace tripoint::lammps

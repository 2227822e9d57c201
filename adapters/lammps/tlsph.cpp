// SPDX-License-Identifier: GPL-2.0-only
// In LAMMPS spacing, density and Young's modulus are 1: with SI numbers at millimetres smd/tlsph
// stops in the second step. Joined ends are made of the matter they hold, and their velocity is set.
#include "adapters/lammps/tlsph.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapters/lammps/body_fit.hpp"
#include "adapters/lammps/layer.hpp"
#include "adapters/lammps/particle_model.hpp"

namespace tripoint::lammps {
namespace {

constexpr double elastic_support = 2.01;  ///< [spacings]: each particle and 32 neighbours
constexpr double hourglass = 10.0;        ///< of the manual's examples
constexpr double elastic_courant = 0.2;   ///< dt c_L / support

const Material& elastic_material(const Job& job) {
  const auto found = std::find_if(job.bodies.begin(), job.bodies.end(), [](const JobBody& b) {
    return b.phase == Phase::elastic && b.motion == Motion::free;
  });
  return job.scene.material(found->material);
}

/// Speed of the longitudinal wave [m/s].
double wave_speed(const Material& m) {
  const double nu = *m.poisson_ratio;
  return std::sqrt(*m.young_modulus * (1.0 - nu) / ((1.0 + nu) * (1.0 - 2.0 * nu) * m.density));
}

Units elastic_units(const Job& job) {
  const double dx = job.resolution.spacing;
  const Material& m = elastic_material(job);
  return {dx, dx / std::sqrt(*m.young_modulus / m.density), m.density * dx * dx * dx, {}};
}

double elastic_support_of(const Job& job) { return choice_for(job).cutoff.value_or(elastic_support); }

double elastic_step_limit(const Job& job) {
  return elastic_courant * elastic_support_of(job) * job.resolution.spacing /
         wave_speed(elastic_material(job));
}

class Tlsph final : public ParticleModel {
 public:
  Tlsph(const Job& job, const InitialState& whole, Layer layer)
      : ParticleModel(job, layer.state, elastic_units(job), elastic_step_limit(job)),
        whole_(whole),
        layer_(std::move(layer)) {
    flat_ = job.scene.periodic[2];
    make_particles("atom_style smd\nnewton off\ncomm_modify vel yes", "", 3.0 * elastic_support_of(job),
                   one_type());
    library_.run(fmt::format("set group all mol 1 volume 1.0 diameter {:.17g} smd/mass/density 1.0",
                             elastic_support_of(job)));
    library_.run(fmt::format("neighbor {:.17g} bin\nneigh_modify every 10 delay 0 check yes\nthermo 0",
                             elastic_support_of(job)));
    make_gravity();
    library_.run("group tlsph union all\npair_style smd/tlsph");
    library_.run(
        fmt::format("pair_coeff 1 1 *COMMON 1.0 1.0 {:.17g} 0.0 0.0 {} 1.0 *STRENGTH_LINEAR *EOS_LINEAR *END",
                    *elastic_material(job).poisson_ratio, hourglass));
    library_.run("fix move tlsph smd/integrate_tlsph");
    library_.run(choice_.commands);
  }

  /// In pieces over which every driven end keeps its velocity.
  void advance_to(double time) override {
    while (time_ < time * (1.0 - 1e-12)) {
      double until = time;
      for (std::size_t b = 0; b < job_.bodies.size(); ++b) {
        if (job_.bodies[b].motion == Motion::free) continue;
        const Drive drive = drive_at(job_.bodies[b], time_, job_.times.back());
        until = std::min(until, drive.until);
        hold(b, drive.velocity);
      }
      ParticleModel::advance_to(until);
    }
  }

  [[nodiscard]] Snapshot observe() const override {
    Snapshot s = flat_ ? all_layers(layer_, whole_, particles()) : particles();
    s.bodies.resize(job_.bodies.size());
    for (std::size_t b = 0; b < job_.bodies.size(); ++b) {
      std::vector<std::size_t> members;
      for (std::size_t i = 0; i < whole_.size(); ++i)
        if (whole_.source[i] == static_cast<int>(b)) members.push_back(i);
      s.bodies[b] = fit_body(job_.bodies[b].properties, members, whole_, s);
      if (held_.count(b)) s.bodies[b].force = force_on_end(b);
    }
    return s;
  }

  void account(Result& result) const override {
    result.steps = clock_.total();
    result.time_step_bound = wanted_time_step(job_) ? "given" : "elastic wave";
    result.extra["support_in_spacings"] = elastic_support_of(job_);
    result.message = fmt::format("smd/tlsph, support {:g} dx, hourglass {:g}, no artificial viscosity{}",
                                 elastic_support_of(job_), hourglass,
                                 flat_ ? "; one layer in plane strain stands for all along z" : "");
  }

 private:
  /// Force of the object on an end, which fix smd/setvel keeps from moving the end [N].
  [[nodiscard]] Vec3 force_on_end(std::size_t b) const {
    Vec3 force;
    for (std::size_t k = 0; k < 3; ++k)
      force[k] = static_cast<double>(layer_.count) * units_.mass * units_.acceleration() *
                 library_.fix_value(fmt::format("end{}", b), static_cast<int>(k));
    return force;
  }

  void hold(std::size_t b, const Vec3& velocity) {
    const Vec3 v = velocity / units_.speed();
    const std::string command =
        fmt::format("fix end{0} end{0} smd/setvel {1:.17g} {2:.17g} {3:.17g}", b, v.x, v.y, v.z);
    std::string& last = held_[b];
    if (last.empty()) library_.run(fmt::format("group end{} id{}", b, ids_of(b)));
    if (last != command) {
      if (!last.empty()) library_.run(fmt::format("unfix end{}", b));
      library_.run(command);
      clock_.set_up_again();
    }
    last = command;
  }

  InitialState whole_;
  Layer layer_;
  std::map<std::size_t, std::string> held_;
};

std::string why_not_matter(const Job& job, const JobBody& b) {
  const Material& m = job.scene.material(b.material);
  if (b.phase == Phase::liquid)
    return fmt::format("{} is liquid; smd/tlsph runs elastic objects alone", b.name);
  if (b.phase == Phase::rigid && b.motion == Motion::free)
    return fmt::format("{} is a free rigid body; smd/tlsph knows held and driven ends only", b.name);
  if (is_turned(b)) return fmt::format("{} is turned; fix smd/setvel sets one velocity for all", b.name);
  if (b.phase != Phase::elastic) return {};
  if (!m.young_modulus || !m.poisson_ratio)
    return fmt::format("{} has no Young's modulus or no Poisson's ratio", m.name);
  if (m.elastic_limit || m.fracture_stretch)
    return fmt::format("{} yields or breaks; smd/tlsph's laws of plasticity and damage are others", m.name);
  const Vec3& I = b.properties.principal_inertia;
  if (I.x + I.y - I.z <= 1e-9 * I.z)
    return fmt::format("{} is one particle thin; smd/tlsph keeps the moduli of the bulk there", b.name);
  return {};
}

/// Bodies that hang together with the first, by joined_to, one way or the other.
std::string why_not_one_object(const Scene& scene) {
  std::vector<std::size_t> reached{0};
  for (std::size_t n = 0; n < reached.size(); ++n)
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
      if (std::find(reached.begin(), reached.end(), b) == reached.end() &&
          are_joined(scene.bodies[reached[n]], scene.bodies[b]))
        reached.push_back(b);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    if (std::find(reached.begin(), reached.end(), b) == reached.end())
      return fmt::format(
          "{} is not joined to {}, and contact in MACHDYN is a penalty of its own that is not set up here",
          scene.bodies[b].name, scene.bodies.front().name);
  return {};
}

}  // namespace

std::string why_no_tlsph(const Job& job) {
  if (!job.scene.events.empty())
    return "smd/tlsph keeps its reference shape for the whole run: no merge, split or other events";
  if (!job.scene.inflows.empty()) return "no inflow into smd/tlsph";
  bool free = false;
  std::string material;
  for (const JobBody& b : job.bodies) {
    if (const std::string reason = why_not_matter(job, b); !reason.empty()) return reason;
    free = free || (b.phase == Phase::elastic && b.motion == Motion::free);
    if (b.phase != Phase::elastic) continue;
    if (!material.empty() && b.material != material)
      return fmt::format("smd/tlsph has no coefficients between two materials, and {} is of another one",
                         b.name);
    material = b.material;
  }
  if (!free) return "no elastic body is free";
  const auto& wraps = job.scene.periodic;
  if (wraps[0] || wraps[1] || wraps[2])
    if (const std::string reason = why_no_layer(job); !reason.empty()) return reason;
  return why_not_one_object(job.scene);
}

std::unique_ptr<Model> make_tlsph(const Job& job, const InitialState& state) {
  return std::make_unique<Tlsph>(job, state,
                                 job.scene.periodic[2] ? lowest_layer(job, state) : Layer{state, {}, 1});
}

}  // namespace tripoint::lammps

// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "files/job.hpp"
#include "validation/references/heat_scene.hpp"
#include "validation/references/solid_scene.hpp"

namespace tripoint {
namespace {

/// A standing wave of small amplitude in an elastic body: v = A cos(k.r + phase) cos(w t). Along k the
/// stiffness is that of a bar whose sides are free or held; across it the shear modulus. Numbers: frequency w
/// [rad/s], wave_vector.x, .y, .z [rad/m], phase, polarisation.x, .y, .z.
class ElasticWave : public Reference {
 public:
  ElasticWave(const VelocityField& start, double frequency) : start_(start), frequency_(frequency) {}
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out;
    out.time = time;
    return out;
  }
  [[nodiscard]] Measuring measuring() const override {
    return {.wave = MeasuredWave{start_.wave_vector, start_.phase,
                                 (1.0 / norm(start_.amplitude)) * start_.amplitude}};
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "frequency") return frequency_;
    return {};
  }

 private:
  VelocityField start_;
  double frequency_;
};

std::unique_ptr<Reference> make_wave(const ReferenceInput& in) {
  const auto body = elastic_body(in, "elastic_wave");
  const auto& start = in.job.scene.bodies.at(body).velocity;
  if (start.kind != VelocityField::Kind::cosine || norm(start.wave_vector) == 0.0 ||
      norm(start.amplitude) == 0.0)
    throw InputError("elastic_wave needs an elastic body with velocity = {kind = \"cosine\", ...}");
  if (norm(start.mean) > 0.0) throw InputError("elastic_wave: the body must not move on the mean");
  const auto axis = axis_of(start.wave_vector, "elastic_wave: the wave vector");
  const double along = std::abs(start.amplitude[axis]) / norm(start.amplitude);
  if (along > 1e-12 && along < 1.0 - 1e-12)
    throw InputError("elastic_wave: the body must swing along its wave vector or across it");
  const auto law = bar_law(in, body, axis);
  const double density = in.job.scene.material(in.job.bodies[body].material).density;
  const double shear = law.modulus() / law.stiffness() * elastic_constants(in.job, body).shear();
  return std::make_unique<ElasticWave>(
      start, norm(start.wave_vector) * std::sqrt((along > 0.5 ? law.modulus() : shear) / density));
}

}  // namespace

ReferenceEntry elastic_wave_entry() {
  return {
      {"elastic_wave",
       "analytic",
       "Landau & Lifshitz, Theory of Elasticity, sections 22 and 25: w = k sqrt(modulus/density); as printed "
       "with the lattice's "
       "gradient moment (17)",
       "a standing wave in an elastic body that starts as a cosine of velocity. Its modulus is E, E/(1 - "
       "nu^2) or the P-wave "
       "modulus by `sides`, or the shear modulus",
       {{"body", "", "default the scene's only free elastic body", ArgumentType::word},
        {"sides", "",
         "free, plane_strain (one direction held) or confined (both); default by the periodic directions "
         "across the wave vector",
         ArgumentType::word},
        {"form", "", "paper or corrected; default the run's mode of the elastic term", ArgumentType::word},
        {"support_ratio", "", "h/dx of the printed form; default the run's"}}},
      make_wave};
}

}  // namespace tripoint

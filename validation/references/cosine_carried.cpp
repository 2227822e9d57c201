// SPDX-License-Identifier: BSD-3-Clause
#include "files/job.hpp"
#include "validation/references/cosine_wave.hpp"
#include "validation/references/functions.hpp"

namespace tripoint {
namespace {

/// The scene in the frame that moves along with it: at rest.
Job at_rest(const Job& job) {
  Job still = job;
  for (auto& body : still.bodies) body.velocity = {};
  return still;
}

/// The decay of cosine_mode seen from a frame in which the medium moves: every particle carries its
/// temperature along.
class CarriedCosine : public Reference {
 public:
  CarriedCosine(std::unique_ptr<Reference> still, const Vec3& velocity)
      : still_(std::move(still)), velocity_(velocity) {}
  [[nodiscard]] Snapshot at(double time) const override {
    Snapshot out = still_->at(time);
    for (auto& r : out.position) r += time * velocity_;
    out.velocity.assign(out.position.size(), velocity_);
    return out;
  }
  /// Numbers are those of places at the start, where the particles' temperatures belong.
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    return still_->number(quantity);
  }
  [[nodiscard]] Measuring measuring() const override { return still_->measuring(); }

 private:
  std::unique_ptr<Reference> still_;
  Vec3 velocity_;
};

std::unique_ptr<Reference> make_carried(const ReferenceInput& in) {
  if (in.job.bodies.empty()) throw InputError("cosine_carried: the scene has no bodies");
  const Vec3 velocity = in.job.bodies.front().velocity;
  for (const auto& body : in.job.bodies)
    if (norm(body.velocity - velocity) > 0.0 || norm(body.angular_velocity) > 0.0)
      throw InputError("cosine_carried: all must move at one velocity");
  if (norm(in.job.scene.gravity) > 0.0) throw InputError("cosine_carried: the scene has gravity");
  const Job still = at_rest(in.job);
  const auto wave = cosine_wave(in);
  refuse_open_ends(wave, {in.args, still, in.initial});
  const double D = in.args.number("diffusivity") ? *in.args.number("diffusivity") : common_diffusivity(still);
  return std::make_unique<CarriedCosine>(
      std::make_unique<DecayingCosine>(ReferenceInput{in.args, still, in.initial}, wave,
                                       D * dot(wave.wave_vector, wave.wave_vector)),
      velocity);
}

}  // namespace

ReferenceEntry cosine_carried_entry() {
  auto args = cosine_arguments();
  args.push_back({"diffusivity", "m2/s", "k/(rho c_p); default of the bodies' material"});
  return {{"cosine_carried", "analytic",
           "separation of variables in the moving frame: T = mean + A exp(-D k^2 t) cos(k.(r - U t) + phase)",
           "decay of one cosine mode in a medium that moves as a whole", args},
          make_carried};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "files/job.hpp"
#include "validation/references/liquid_scene.hpp"

namespace tripoint {
namespace {

/// A standing wave of small amplitude: u = U cos(k.r + phase) cos(w t), p = rho c U sin(k.r + phase) sin(w
/// t), w = c k. Numbers: frequency w [rad/s], wave_vector.x, .y, .z [rad/m], phase [rad].
class SoundWave : public LiquidReference {
 public:
  SoundWave(const ReferenceInput& in, const VelocityField& start, double sound_speed, double density)
      : LiquidReference(in.job, in.initial), start_(start), c_(sound_speed), density_(density) {}
  [[nodiscard]] Measuring measuring() const override {
    return {.wave = MeasuredWave{start_.wave_vector, start_.phase, {}}};
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "frequency") return frequency();
    return {};
  }

 protected:
  [[nodiscard]] LiquidState state(const Vec3& place, double time, std::size_t) const override {
    const double angle = dot(start_.wave_vector, place) + start_.phase, w = frequency();
    LiquidState s;
    s.velocity = (std::cos(angle) * std::cos(w * time)) * start_.amplitude;
    s.pressure = density_ * c_ * dot(start_.amplitude, start_.wave_vector) / norm(start_.wave_vector) *
                 std::sin(angle) * std::sin(w * time);
    s.density = density_ + s.pressure / (c_ * c_);
    return s;
  }

 private:
  [[nodiscard]] double frequency() const { return c_ * norm(start_.wave_vector); }
  VelocityField start_;
  double c_, density_;
};

std::unique_ptr<Reference> make_sound(const ReferenceInput& in) {
  const auto liquid = only_liquid(in.job, "sound_wave");
  const auto& start = in.job.scene.bodies.at(liquid).velocity;
  if (start.kind != VelocityField::Kind::cosine || norm(start.wave_vector) == 0.0)
    throw InputError("sound_wave needs a liquid with velocity = {kind = \"cosine\", ...}");
  if (norm(start.mean) > 0.0) throw InputError("sound_wave: the liquid must not move on the mean");
  if (norm(cross(start.amplitude, start.wave_vector)) >
      1e-12 * norm(start.amplitude) * norm(start.wave_vector))
    throw InputError("sound_wave: sound swings along its wave vector");
  const double c =
      in.args.number("sound_speed") ? *in.args.number("sound_speed") : state_sound_speed(in.job, liquid);
  return std::make_unique<SoundWave>(in, start, c, material_of_body(in.job, liquid).density);
}

}  // namespace

ReferenceEntry sound_wave_entry() {
  return {{"sound_wave",
           "analytic",
           "Landau & Lifshitz, Fluid Mechanics, section 64: standing plane wave of small amplitude, w = c k",
           "a standing wave of sound that starts as a cosine of velocity",
           {{"sound_speed", "m/s", "default of the equation of state: sqrt(k rho_ref/rho0)"}}},
          make_sound};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "files/job.hpp"
#include "validation/references/cosine_wave.hpp"
#include "validation/references/functions.hpp"

namespace tripoint {
namespace {

/// The wave between ends that are held at its mean, which is what their blocks keep.
class SineBetweenHeldEnds : public DecayingCosine {
 public:
  SineBetweenHeldEnds(const ReferenceInput& in, const CosineWave& wave, double rate, const BarAxis& bar)
      : DecayingCosine(in, wave, rate, HeldEnds::allowed), bar_(bar), mean_(wave.mean) {}

 protected:
  [[nodiscard]] double temperature(const Vec3& place, double time) const override {
    const double s = place[bar_.axis];
    return s > bar_.low && s < bar_.high ? DecayingCosine::temperature(place, time) : mean_;
  }

 private:
  BarAxis bar_;
  double mean_;
};

/// The one body that is not held. @throws InputError when there are none or more
std::size_t free_body(const Job& job) {
  std::size_t found = job.bodies.size();
  for (std::size_t b = 0; b < job.bodies.size(); ++b) {
    if (job.bodies[b].temperature_held) continue;
    if (found != job.bodies.size())
      throw InputError("a sine between held ends needs all bodies but one with temperature_held = true");
    found = b;
  }
  if (found == job.bodies.size())
    throw InputError("a sine between held ends needs one body whose temperature is not held");
  return found;
}

std::unique_ptr<Reference> make_sine(const ReferenceInput& in) {
  const auto wave = cosine_wave(in);
  const BarAxis bar = body_along(axis_of(wave.wave_vector, "between held ends the wave vector"),
                                 free_body(in.job), in.job, in.initial);
  const double k = wave.wave_vector[bar.axis];
  for (const double end : {bar.low, bar.high})
    if (std::abs(std::cos(k * end + wave.phase)) > 1e-9)
      throw InputError(
          "the wave is not at its mean at the held ends: choose the phase so that they are nodes");
  const double D =
      in.args.number("diffusivity") ? *in.args.number("diffusivity") : common_diffusivity(in.job);
  return std::make_unique<SineBetweenHeldEnds>(in, wave, D * k * k, bar);
}

}  // namespace

ReferenceEntry sine_held_ends_entry() {
  auto args = cosine_arguments();
  args.push_back({"diffusivity", "m2/s", "k/(rho c_p); default of the bodies' material"});
  return {{"sine_held_ends", "analytic",
           "separation of variables: mean + A exp(-D k^2 t) cos(k.r + phase), nodes at the ends",
           "decay of one mode of a body between blocks whose temperature is held at the mean", args},
          make_sine};
}

}  // namespace tripoint

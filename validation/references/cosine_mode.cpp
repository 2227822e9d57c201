// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <numbers>

#include "validation/references/cosine_wave.hpp"
#include "validation/references/functions.hpp"

namespace tripoint {
namespace {

std::unique_ptr<Reference> make_cosine(const ReferenceInput& in) {
  const auto wave = cosine_wave(in);
  refuse_open_ends(wave, in);
  const double D =
      in.args.number("diffusivity") ? *in.args.number("diffusivity") : common_diffusivity(in.job);
  return std::make_unique<DecayingCosine>(in, wave, D * dot(wave.wave_vector, wave.wave_vector));
}

}  // namespace

ReferenceEntry cosine_mode_entry() {
  auto args = cosine_arguments();
  args.push_back({"diffusivity", "m2/s", "k/(rho c_p); default of the bodies' material"});
  return {{"cosine_mode", "analytic", "separation of variables: mean + A exp(-D k^2 t) cos(k.r + phase)",
           "decay of one cosine mode in a periodic medium, or between insulated ends where the wave is level "
           "there",
           args},
          make_cosine};
}

}  // namespace tripoint

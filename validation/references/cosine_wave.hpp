// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "validation/references/functions.hpp"
#include "validation/references/heat_scene.hpp"

namespace tripoint {

/// mean + amplitude cos(wave_vector.r + phase) [K], [rad/m], [rad].
struct CosineWave {
  double mean = 0.0, amplitude = 0.0, phase = 0.0;
  Vec3 wave_vector;
  [[nodiscard]] double shape(const Vec3& r) const;  ///< the cosine [1]
};

/// From the arguments, else from the first body that starts with a cosine. @throws InputError when there is
/// none
[[nodiscard]] CosineWave cosine_wave(const ReferenceInput&);
[[nodiscard]] std::vector<ReferenceArgument> cosine_arguments();

/// @throws InputError unless whole waves fit each periodic direction and the wave is level at each insulated
/// end
void refuse_open_ends(const CosineWave&, const ReferenceInput&);

/// The wave, its amplitude falling as exp(-rate t). Numbers: decay_rate [1/s], and the wave itself.
class DecayingCosine : public HeatReference {
 public:
  DecayingCosine(const ReferenceInput&, const CosineWave&, double rate, HeldEnds = HeldEnds::refused);
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override;
  [[nodiscard]] Measuring measuring() const override;

 protected:
  [[nodiscard]] double temperature(const Vec3& place, double time) const override;

 private:
  CosineWave wave_;
  double rate_;
};

}  // namespace tripoint

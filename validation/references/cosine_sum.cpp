// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "validation/references/cosine_wave.hpp"

namespace tripoint {
namespace {

constexpr std::size_t most_waves = 4;

/// Several cosines, each decaying at its own rate: T = mean + sum A_n exp(-D k_n^2 t) cos(k_n.r + phase_n).
class CosineSum : public HeatReference {
 public:
  CosineSum(const ReferenceInput& in, double mean, std::vector<CosineWave> waves, double diffusivity)
      : HeatReference(in.job, in.initial), mean_(mean), diffusivity_(diffusivity), waves_(std::move(waves)) {}
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "diffusivity") return diffusivity_;
    return {};
  }

 protected:
  [[nodiscard]] double temperature(const Vec3& place, double time) const override {
    double T = mean_;
    for (const auto& w : waves_)
      T += w.amplitude * std::exp(-diffusivity_ * dot(w.wave_vector, w.wave_vector) * time) * w.shape(place);
    return T;
  }

 private:
  double mean_, diffusivity_;
  std::vector<CosineWave> waves_;
};

std::vector<CosineWave> waves_of(const ReferenceInput& in) {
  std::vector<CosineWave> waves;
  for (std::size_t n = 1; n <= most_waves; ++n) {
    const auto tail = "_" + std::to_string(n);
    const auto amplitude = in.args.number("amplitude" + tail);
    const auto wave_vector = in.args.vector("wave_vector" + tail);
    if (!amplitude && !wave_vector) continue;
    if (!amplitude || !wave_vector)
      throw InputError("cosine_sum: wave " + std::to_string(n) + " needs both amplitude" + tail +
                       " and wave_vector" + tail);
    waves.push_back({0.0, *amplitude, in.args.number("phase" + tail).value_or(0.0), *wave_vector});
    refuse_open_ends(waves.back(), in);
  }
  if (waves.empty()) throw InputError("cosine_sum needs amplitude_1 and wave_vector_1");
  return waves;
}

std::unique_ptr<Reference> make_sum(const ReferenceInput& in) {
  const auto mean = in.args.number("mean");
  if (!mean) throw InputError("cosine_sum needs the argument `mean`");
  auto waves = waves_of(in);
  double size = 0.0;
  for (const auto& w : waves) size += std::abs(w.amplitude);
  auto sum = std::make_unique<CosineSum>(in, *mean, std::move(waves),
                                         in.args.number("diffusivity").value_or(common_diffusivity(in.job)));
  // The scene's formula and these arguments are written apart: they must say the same
  const auto start = sum->at(0.0).temperature;
  for (std::size_t i = 0; i < in.initial.size(); ++i)
    if (!(std::abs(start[i] - in.initial.temperature[i]) <= 1e-9 * size))
      throw InputError("cosine_sum: the scene does not start with the waves that the arguments name");
  return sum;
}

std::vector<ReferenceArgument> sum_arguments() {
  std::vector<ReferenceArgument> list{
      {"mean", "K", "needed"}, {"diffusivity", "m2/s", "k/(rho c_p); default of the bodies' material"}};
  for (std::size_t n = 1; n <= most_waves; ++n) {
    const auto tail = "_" + std::to_string(n);
    list.push_back({"amplitude" + tail, "K", "of wave " + std::to_string(n)});
    list.push_back({"wave_vector" + tail, "rad/m", "of wave " + std::to_string(n) + ", in any direction",
                    ArgumentType::vector});
    list.push_back({"phase" + tail, "rad", "of wave " + std::to_string(n) + "; default 0"});
  }
  return list;
}

}  // namespace

ReferenceEntry cosine_sum_entry() {
  return {
      {"cosine_sum", "analytic",
       "separation of variables: each wave decays by itself, T = mean + sum A exp(-D k^2 t) cos(k.r + phase)",
       "decay of up to four waves in different directions in a periodic medium: no symmetry",
       sum_arguments()},
      make_sum};
}

}  // namespace tripoint

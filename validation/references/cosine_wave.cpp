// SPDX-License-Identifier: BSD-3-Clause
#include "validation/references/cosine_wave.hpp"
#include "files/job.hpp"

#include <cmath>
#include <numbers>

namespace tripoint {
namespace {

const TemperatureField* scene_cosine(const Job& job) {
  for (const auto& body : job.scene.bodies)
    if (body.temperature && body.temperature->kind == TemperatureField::Kind::cosine)
      return &*body.temperature;
  return nullptr;
}

}  // namespace

double CosineWave::shape(const Vec3& r) const { return std::cos(dot(wave_vector, r) + phase); }

std::vector<ReferenceArgument> cosine_arguments() {
  return {{"mean", "K", "default of the body's cosine"},
          {"amplitude", "K", "default of the body's cosine"},
          {"wave_vector", "rad/m", "default of the body's cosine", ArgumentType::vector},
          {"phase", "rad", "default of the body's cosine"}};
}

CosineWave cosine_wave(const ReferenceInput& in) {
  CosineWave wave;
  const auto* field = scene_cosine(in.job);
  if (field) wave = {field->mean, field->amplitude, field->phase, field->wave_vector};
  wave.mean = in.args.number("mean").value_or(wave.mean);
  wave.amplitude = in.args.number("amplitude").value_or(wave.amplitude);
  wave.phase = in.args.number("phase").value_or(wave.phase);
  wave.wave_vector = in.args.vector("wave_vector").value_or(wave.wave_vector);
  if (norm(wave.wave_vector) == 0.0 || wave.amplitude == 0.0)
    throw InputError(
        "the cosine mode needs a body with temperature = {kind = \"cosine\", ...} or the arguments "
        "wave_vector and amplitude");
  return wave;
}

void refuse_open_ends(const CosineWave& wave, const ReferenceInput& in) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double k = wave.wave_vector[axis];
    if (k == 0.0) continue;
    const auto bar = bar_along(axis, in.job, in.initial);
    if (bar.periodic) {
      const double waves = k * bar.length() / (2.0 * std::numbers::pi);
      if (std::abs(waves - std::round(waves)) > 1e-9)
        throw InputError("no whole number of waves fits the periodic direction");
      continue;
    }
    axis_of(wave.wave_vector, "between insulated ends the wave vector");
    if (std::abs(std::sin(k * bar.low + wave.phase)) > 1e-9 ||
        std::abs(std::sin(k * bar.high + wave.phase)) > 1e-9)
      throw InputError(
          "the wave is not level at the insulated ends: choose the phase so that they are crests or troughs");
  }
}

DecayingCosine::DecayingCosine(const ReferenceInput& in, const CosineWave& wave, double rate, HeldEnds held)
    : HeatReference(in.job, in.initial, held), wave_(wave), rate_(rate) {}

double DecayingCosine::temperature(const Vec3& place, double time) const {
  return wave_.mean + wave_.amplitude * std::exp(-rate_ * time) * wave_.shape(place);
}

std::optional<double> DecayingCosine::number(std::string_view quantity) const {
  if (quantity == "decay_rate") return rate_;
  return {};
}

/// The axis is the one along which the wave is shortest.
Measuring DecayingCosine::measuring() const {
  std::size_t k = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (std::abs(wave_.wave_vector[i]) > std::abs(wave_.wave_vector[k])) k = i;
  return {.axis = k, .wave = MeasuredWave{wave_.wave_vector, wave_.phase, {}}};
}

}  // namespace tripoint

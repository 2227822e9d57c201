// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "files/trajectory.hpp"
#include "references/scenes.hpp"
#include "validation/audit/audit.hpp"
#include "validation/case/choices.hpp"
#include "validation/metrics/metric.hpp"

/// Runs made from a reference, to be broken by the tests.
namespace tripoint::test {

/// A trajectory that is the truth itself, as an engine would hand it over.
inline Trajectory perfect_run(const Prepared& s, const Reference& truth) {
  Trajectory run;
  for (const double t : s.job.times) {
    Snapshot frame = truth.at(t);
    for (std::size_t i = 0; i < s.initial.size(); ++i) frame.id.push_back(static_cast<int>(i));
    frame.mass = s.initial.mass;
    frame.material = s.initial.material;
    if (frame.phase.empty()) frame.phase = s.initial.phase;
    if (frame.body.empty()) frame.body = s.initial.body;
    run.frames.push_back(frame);
  }
  return run;
}

inline MetricChoice metric(const std::string& quantity, const std::string& norm,
                           const std::string& body = "") {
  MetricChoice choice;
  choice.name = "m";
  choice.quantity = quantity;
  choice.norm = from_word<Norm>(norm);
  choice.body = body;
  return choice;
}

/// A scene, its truth and a perfect run of it.
struct Trial {
  Prepared s;
  std::shared_ptr<const Reference> truth;
  Trajectory run;
  Trial(Prepared prepared, const std::string& name, const Settings& args = {})
      : s(std::move(prepared)),
        truth(make_reference(function(name, args), s.job, s.initial)),
        run(perfect_run(s, *truth)) {}
  [[nodiscard]] MetricValue value(const MetricChoice& choice) const {
    return evaluate(choice, s.job, s.initial, run, *truth);
  }
  [[nodiscard]] std::string sound() const { return audit(s.job, s.initial, run); }
};

inline Prepared thrown_block() {
  auto s = block({1, 2, 3}, 1.0, 10);
  s.job.scene.gravity = {0, 0, -9.81};
  s.job.bodies[0].velocity = {1, 0, 5};
  for (auto& v : s.initial.velocity) v += Vec3{1, 0, 5};
  return s;
}

/// cos(k x + 0.7) in a periodic bar, 20 particles a wavelength.
inline Prepared warm_bar() {
  const double dx = 0.005, k = 2 * pi / 0.1;
  auto s = bar(
      {20, 4, 4}, dx, [&](const Vec3& r) { return 300.0 + 10.0 * std::cos(k * r.x + 0.7); }, 60.0, 10, true);
  TemperatureField field;
  field.kind = TemperatureField::Kind::cosine;
  field.mean = 300.0;
  field.amplitude = 10.0;
  field.phase = 0.7;
  field.wave_vector = {k, 0, 0};
  s.job.scene.bodies[0].temperature = field;
  return s;
}

}  // namespace tripoint::test

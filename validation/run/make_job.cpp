// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <cmath>

#include "files/job.hpp"
#include "sampling/sample.hpp"
#include "scene/contact_law.hpp"
#include "validation/case/case.hpp"
#include "validation/metrics/metric.hpp"
#include "validation/references/measuring.hpp"
#include "validation/results/expected_refusal.hpp"
#include "validation/run/plan_runs.hpp"

namespace tripoint {
namespace {

/// Particles of one [[body]], gathered.
struct Gathered {
  std::vector<Vec3> position, velocity;
  std::vector<double> mass;
};

Gathered gather(const InitialState& initial, int source) {
  Gathered g;
  for (std::size_t i = 0; i < initial.size(); ++i)
    if (initial.source[i] == source) {
      g.position.push_back(initial.position[i]);
      g.velocity.push_back(initial.velocity[i]);
      g.mass.push_back(initial.mass[i]);
    }
  return g;
}

JobBody job_body(const Body& body, int row, const Gathered& particles) {
  JobBody b;
  b.name = body.name;
  b.material = body.material;
  b.index = row;
  b.phase = body.phase;
  b.motion = body.motion;
  b.keyframes = body.keyframes;
  b.temperature_held = body.temperature_held;
  b.angular_velocity = body.angular_velocity;
  if (particles.mass.empty()) return b;
  b.properties = mass_properties(particles.position, particles.mass);
  Vec3 momentum;
  for (std::size_t i = 0; i < particles.mass.size(); ++i)
    momentum += particles.mass[i] * particles.velocity[i];
  b.velocity = momentum / b.properties.mass;
  return b;
}

/// Where a metric's number is read: its reference's statement of the place, without that of the value.
JobGauge gauge_of(const Case& value, const MetricChoice& metric) {
  JobGauge gauge{metric.name, metric.quantity, metric.body, {}};
  const auto& args = metric.reference.value_or(value.reference).args;
  for (const ReferenceArgument& stated : measuring_arguments()) {
    const auto at = args.find(stated.name);
    if (stated.of_place && at != args.end()) gauge.where.insert(*at);
  }
  return gauge;
}

/// A law that all pairs have in common is handed over as settings too. An engine's own setting goes before
/// it.
void add_contact_law(Job& job) {
  const CommonContact common = common_contact(job.scene);
  if (common.differs) return;
  if (common.friction) job.settings.try_emplace("friction", *common.friction);
  if (common.restitution) job.settings.try_emplace("restitution", *common.restitution);
}

}  // namespace

std::vector<double> output_times(double interval, double end) {
  std::vector<double> times{0.0};
  if (!(interval > 0.0)) interval = end;
  for (long k = 1;; ++k) {
    const double t = static_cast<double>(k) * interval;
    if (t >= end * (1.0 - 1e-9)) break;
    times.push_back(t);
  }
  times.push_back(end);
  return times;
}

std::string sampling_key(const Scene& scene) {
  auto key = fmt::format("dx={:.17g}", scene.spacing);
  if (scene.jitter > 0.0) key += fmt::format("-jitter={:g}-seed={}", scene.jitter, scene.seed);
  if (scene.settle) key += fmt::format("-settled-seed={}", scene.seed);
  return key;
}

Job make_job(const Case& value, const EnginePlan& engine, const RunPlan& run, const Scene& scene,
             const InitialState& initial) {
  Job job;
  job.case_id = value.id;
  job.scene = scene;
  const auto rows = body_rows(scene);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    job.bodies.push_back(job_body(scene.bodies[b], rows[b], gather(initial, static_cast<int>(b))));
  job.resolution = {scene.spacing, scene.support_ratio, scene.time_step, run.walkers, run.iterations};
  job.preset = engine.preset;
  job.settings = engine.settings;
  for (const char* own : {"wall_limit", refuses_setting})
    job.settings.erase(own);  // the harness's own: an engine need not know them
  add_contact_law(job);
  if (run.walkers) job.settings["walkers"] = *run.walkers;
  if (run.iterations) job.settings["iterations"] = *run.iterations;
  job.reference = value.reference;
  for (const auto& metric : value.metrics)
    if (can_be_gauged(metric.quantity)) job.gauges.push_back(gauge_of(value, metric));
  job.seed = scene.seed;
  job.times = output_times(scene.output_interval, scene.end_time);
  job.output.assign(1, '.');  // GCC 12 warns of an overlap in the assignment of a literal here
  return job;
}

}  // namespace tripoint

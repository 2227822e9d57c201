// SPDX-License-Identifier: BSD-3-Clause
#include "validation/metrics/members.hpp"

namespace tripoint {

std::optional<double> truth_of(const MetricInput& in, const char* quantity, double time) {
  // a frequency, a swing and a change since the start do not depend on where from they are counted
  const auto norm = in.choice.norm;
  if (swings(norm) || norm == Norm::drift) return 0.0;
  const auto named = in.reference.number_at(quantity, time);
  return named ? named : in.reference.number_at("value", time);
}

std::optional<double> number_or_value(const MetricInput& in, const char* quantity) {
  const auto named = in.reference.number(quantity);
  return named ? named : in.reference.number("value");
}

FrameError against_truth(const FramePair& f, const char* quantity, double measured) {
  const auto truth = truth_of(f.in, quantity, f.now.time);
  if (!truth)
    return problem(std::string("the reference does not know the ") + quantity + " and states no value");
  return single(measured - *truth);
}

bool is_alive(const Snapshot& s, std::size_t i) { return i >= s.id.size() || s.id[i] != -1; }

bool is_driven(const MetricInput& in, std::size_t i) {
  if (i >= in.initial.size() || in.initial.source[i] < 0) return false;
  const auto body = static_cast<std::size_t>(in.initial.source[i]);
  return body < in.job.bodies.size() && in.job.bodies[body].motion != Motion::free;
}

bool takes_free(const MetricInput& in, std::size_t i) {
  return takes(in, i) && !(in.choice.body.empty() && is_driven(in, i));
}

bool takes_liquid(const MetricInput& in, const Snapshot& s, std::size_t i) {
  if (!takes_free(in, i) || !is_alive(s, i)) return false;
  return i < s.phase.size() ? s.phase[i] == 0 : i >= in.initial.size() || in.initial.phase[i] == 0;
}

bool of_stated_phase(const MetricInput& in, const Snapshot& s, std::size_t i) {
  const auto phase = in.reference.measuring().phase;
  if (!phase) return true;
  return *phase == MeasuredPhase::solid ? s.phase[i] != 0 : s.phase[i] == static_cast<int>(*phase);
}

double particle_mass(const MetricInput& in, const Snapshot& s, std::size_t i) {
  if (i < s.mass.size()) return s.mass[i];
  return i < in.initial.size() ? in.initial.mass[i] : not_a_number;
}

long double heat_per_mass(const Material& m, const Snapshot& s, std::size_t i) {
  const bool melts = i < s.liquid_fraction.size();
  const double L = m.latent_heat.value_or(0.0), T = s.temperature[i];
  if (!m.solid_heat_capacity)
    return static_cast<long double>(*m.heat_capacity) * T + (melts ? L * s.liquid_fraction[i] : 0.0);
  if (!melts)
    return static_cast<long double>(i < s.phase.size() && s.phase[i] == 0 ? *m.heat_capacity
                                                                          : *m.solid_heat_capacity) *
           T;
  const long double f = s.liquid_fraction[i],
                    liquid = static_cast<long double>(*m.solid_heat_capacity) * *m.t_melt + L +
                             static_cast<long double>(*m.heat_capacity) * (T - *m.t_melt);
  return (1 - f) * *m.solid_heat_capacity * T + f * liquid;
}

std::vector<std::size_t> sampled(const MetricInput& in, std::size_t body) {
  std::vector<std::size_t> list;
  for (std::size_t i = 0; i < in.initial.size(); ++i)
    if (in.initial.source[i] == static_cast<int>(body)) list.push_back(i);
  return list;
}

std::size_t job_body(const MetricInput& in) {
  for (std::size_t b = 0; b < in.job.bodies.size(); ++b)
    if (in.job.bodies[b].name == in.choice.body) return b;
  throw InputError(in.choice.place, "metric `" + in.choice.name + "` must name its body");
}

std::size_t other_body(const MetricInput& in) {
  const auto other = in.reference.measuring().other;
  if (!other)
    throw InputError(
        in.choice.place,
        "metric `" + in.choice.name +
            "` needs a second body: reference = {function = \"stated\", args = {other = \"NAME\"}}");
  return *other;
}

RigidBody motion_of(const MetricInput& in, const Snapshot& s, const std::vector<std::size_t>& members) {
  std::vector<std::size_t> alive, rows;
  std::vector<Vec3> position, velocity;
  std::vector<double> mass;
  for (const auto i : members)
    if (is_alive(s, i)) alive.push_back(i);
  if (alive.empty())
    throw InputError(in.choice.place, "metric `" + in.choice.name + "`: its body has no particles left");
  const Vec3 first = s.position[alive.front()];
  for (const auto i : alive) {
    rows.push_back(rows.size());
    position.push_back(first + displacement(in.job.scene, s.position[i], first));
    velocity.push_back(s.velocity[i]);
    mass.push_back(particle_mass(in, s, i));
  }
  return rigid_body(rows, position, velocity, mass);
}

}  // namespace tripoint

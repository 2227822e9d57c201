// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/audit/audit_parts.hpp"

namespace tripoint {
namespace {

bool is_finite(double v) { return std::isfinite(v); }
bool is_finite(int) { return true; }
bool is_finite(const Vec3& v) { return finite(v); }
bool is_positive(double v) { return std::isfinite(v) && v > 0.0; }

/// The first value of a column of particles that is not finite, or outside its set.
template <class T, class Inside>
std::string outside(const Snapshot& s, const std::vector<T>& column, const char* name, const char* set,
                    Inside inside) {
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (dead(s, i) || (is_finite(column[i]) && inside(column[i]))) continue;
    const std::string of = std::string(name) + " of particle " + std::to_string(i) + " is ";
    if (!is_finite(column[i])) return of + "not finite" + at_time(s);
    if constexpr (!std::is_same_v<T, Vec3>) return of + set + ": " + figure(column[i]) + at_time(s);
  }
  return {};
}

/// The first text that is not empty.
std::string first_fault(std::initializer_list<std::string> texts) {
  const auto found =
      std::find_if(texts.begin(), texts.end(), [](const std::string& t) { return !t.empty(); });
  return found == texts.end() ? "" : *found;
}

std::string wrong_columns(const Snapshot& s) {
  const auto any = [](const auto&) { return true; };
  return first_fault(
      {outside(s, s.position, "position", "", any), outside(s, s.velocity, "velocity", "", any),
       outside(s, s.temperature, "temperature", "", any), outside(s, s.pressure, "pressure", "", any),
       outside(s, s.temperature_error, "temperature_error", "below 0", [](double e) { return e >= 0.0; }),
       outside(s, s.density, "density", "not positive", is_positive),
       outside(s, s.mass, "mass", "not positive", is_positive),
       outside(s, s.liquid_fraction, "liquid_fraction", "not in 0 to 1",
               [](double f) { return f >= 0.0 && f <= 1.0; })});
}

/// Of walkers a temperature is known to its standard error alone. Scenes that count from another zero are
/// left alone.
std::string below_absolute_zero(const Audited& run, const Snapshot& s) {
  const auto& start = run.initial.temperature;
  if (std::any_of(start.begin(), start.end(), [](double T) { return !(T > 0.0); })) return {};
  for (std::size_t i = 0; i < s.temperature.size(); ++i) {
    const double error = i < s.temperature_error.size() ? s.temperature_error[i] : 0.0;
    if (!dead(s, i) && s.temperature[i] + 6.0 * error <= 0.0)
      return "temperature of particle " + std::to_string(i) +
             " is not above 0 K: " + figure(s.temperature[i]) + at_time(s);
  }
  return {};
}

std::string wrong_codes(const Audited& run, const Snapshot& s) {
  const auto within = [](int low, std::size_t end) {
    return [low, end](int code) { return code >= low && code < static_cast<int>(end); };
  };
  const auto& materials = run.job.scene.materials;
  return first_fault({outside(s, s.phase, "phase", "none of 0, 1, 2", within(0, 3)),
                      outside(s, s.body, "body", "no row of a body, nor -1",
                              within(-1, s.bodies.empty() ? 1u << 30 : s.bodies.size())),
                      materials.empty() ? ""
                                        : outside(s, s.material, "material", "no material of the job",
                                                  within(0, materials.size()))});
}

/// An engine that knows a body by its matter alone writes no number for its turning, in no frame.
bool states_turning(const Audited& run, std::size_t row) {
  return std::any_of(run.frames.begin(), run.frames.end(), [row](const Snapshot* s) {
    return row < s->bodies.size() && finite(s->bodies[row].angular_velocity);
  });
}

/// Tolerance of a norm of 1: roundings of an engine's own precision, over all its steps.
std::string wrong_body(const Audited& run, const Snapshot& s, std::size_t row) {
  const BodyState& b = s.bodies[row];
  const std::string of = " of " + row_name(run, row) + " is ";
  const auto& q = b.orientation;
  if (!is_there(b)) return finite(b.velocity) ? "position" + of + "not finite" + at_time(s) : "";
  if (!finite(b.velocity)) return "velocity" + of + "not finite" + at_time(s);
  const bool turns = states_turning(run, row);
  if (turns && !finite(b.angular_velocity)) return "angular velocity" + of + "not finite" + at_time(s);
  if ((turns || std::isfinite(norm(q))) && !(std::abs(norm(q) - 1.0) <= (run.is_single() ? 1e-4 : 1e-6)))
    return "orientation" + of + "no unit quaternion: (" + figure(q.w) + ", " + figure(q.x) + ", " +
           figure(q.y) + ", " + figure(q.z) + ")" + at_time(s);
  if (!is_positive(b.mass)) return "mass" + of + "not positive: " + figure(b.mass) + at_time(s);
  return {};
}

}  // namespace

std::string values_outside_their_set(const Audited& run, const Snapshot& s) {
  // Rows first: an engine may write them alone, and its particles are placed by them
  for (std::size_t row = 0; row < s.bodies.size(); ++row)
    if (auto why = wrong_body(run, s, row); !why.empty()) return why;
  return first_fault({wrong_columns(s), below_absolute_zero(run, s), wrong_codes(run, s)});
}

std::string lost_matter(const Audited& run, const Snapshot& s) {
  const auto& initial = run.initial;
  const bool may_leave = run.job.scene.removes_escaped || !run.job.scene.outflows.empty();
  for (std::size_t i = 0; i < std::min(s.id.size(), initial.size()); ++i)
    if (dead(s, i) && !(may_leave && initial.body[i] < 0))
      return "particle " + std::to_string(i) + " is lost" + at_time(s);
  if (!s.mass.empty() && s.mass.size() < initial.size()) return "masses are missing" + at_time(s);
  for (std::size_t i = 0; i < std::min(s.mass.size(), initial.size()); ++i)
    if (!dead(s, i) && !(std::abs(s.mass[i] - initial.mass[i]) <= 1e-12 * initial.mass[i]))
      return "the mass of particle " + std::to_string(i) + " has changed" + at_time(s);
  return {};
}

}  // namespace tripoint

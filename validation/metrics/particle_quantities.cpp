// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>
#include <tuple>

#include "tables/nearest.hpp"
#include "validation/metrics/members.hpp"

namespace tripoint {
namespace {

using Columns = std::vector<double> Snapshot::*;

/// Fault of sample i, or an empty text; `absent` when it is in neither. A value that is not finite is never
/// dropped.
enum class Sample { good, absent, bad };
Sample look(const Snapshot& now, std::size_t i, bool run_finite, bool truth_finite) {
  if (run_finite && truth_finite) return Sample::good;
  const bool dead = i < now.id.size() && now.id[i] == -1;
  return dead && !run_finite && !truth_finite ? Sample::absent : Sample::bad;
}

std::string bad_sample(const char* what, std::size_t i, bool run_finite) {
  return std::string(what) + " of particle " + std::to_string(i) + " is " +
         (run_finite ? "there, but not in the reference" : "not finite or missing");
}

template <class T>
std::string unequal(const std::vector<T>& run, const std::vector<T>& truth, const char* what) {
  if (truth.empty()) return std::string("the reference does not know the ") + what;
  if (run.empty()) return std::string("the trajectory has no ") + what;
  if (run.size() != truth.size())
    return std::string(what) + ": " + std::to_string(run.size()) + " particles against " +
           std::to_string(truth.size());
  return {};
}

FrameError vector_error(const FramePair& f, std::vector<Vec3> Snapshot::*column, const char* what,
                        bool wrap) {
  const auto &run = f.now.*column, &truth = f.truth.*column;
  if (auto why = unequal(run, truth, what); !why.empty()) return problem(why);
  FrameError out;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (!takes(f.in, i)) continue;
    const auto state = look(f.now, i, finite(run[i]), finite(truth[i]));
    if (state == Sample::bad) return problem(bad_sample(what, i, finite(run[i])));
    if (state == Sample::absent) continue;
    out.add(norm(wrap ? displacement(f.in.job.scene, run[i], truth[i]) : run[i] - truth[i]),
            rest_volume(f.in, i), static_cast<long>(i));
  }
  return out;
}

/// Against the reference's column, else against the one number that the case states for all.
FrameError scalar_error(const FramePair& f, Columns column, const char* what) {
  const auto& run = f.now.*column;
  const auto stated = f.in.reference.number_at("value", f.now.time);
  const auto truth =
      (f.truth.*column).empty() && stated ? std::vector<double>(run.size(), *stated) : f.truth.*column;
  if (auto why = unequal(run, truth, what); !why.empty()) return problem(why);
  FrameError out;
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (!takes(f.in, i)) continue;
    const bool a = std::isfinite(run[i]), b = std::isfinite(truth[i]);
    const auto state = look(f.now, i, a, b);
    if (state == Sample::bad) return problem(bad_sample(what, i, a));
    if (state == Sample::good) out.add(run[i] - truth[i], rest_volume(f.in, i), static_cast<long>(i));
  }
  return out;
}

/// Standard error of particle i: of the run, and of the truth where that is another run.
double sigma_of(const FramePair& f, long i) {
  const auto of = [&](const std::vector<double>& column) {
    return static_cast<std::size_t>(i) < column.size() ? column[static_cast<std::size_t>(i)] : 0.0;
  };
  return std::hypot(of(f.now.temperature_error), of(f.truth.temperature_error));
}

/// Particles that share one count of walkers (same temperature, same standard error) are one sample, not many
/// independent ones.
FrameError pooled(const FramePair& f, const FrameError& all) {
  FrameError out;
  std::map<std::tuple<double, double, double>, std::size_t> group;
  for (std::size_t n = 0; n < all.error.size(); ++n) {
    const double sigma = sigma_of(f, all.row[n]);
    const auto [at, fresh] = group.try_emplace(
        {f.now.temperature[static_cast<std::size_t>(all.row[n])], sigma, all.error[n]}, out.error.size());
    if (fresh) {
      out.add(all.error[n], all.weight[n], all.row[n]);
      out.sigma.push_back(sigma);
    } else {
      out.weight[at->second] += all.weight[n];
    }
  }
  return out;
}

FrameError temperature_difference(const FramePair& f) {
  const auto all = scalar_error(f, &Snapshot::temperature, "temperature");
  const bool exact = f.now.temperature_error.empty() && f.truth.temperature_error.empty();
  if (!all.problem.empty() || exact) return all;
  for (const long row : all.row)  // before they are grouped by it
    if (!std::isfinite(sigma_of(f, row))) return problem("a standard error of the temperature is not finite");
  return pooled(f, all);
}

/// The standard error itself: no truth is needed, 0 is best.
FrameError temperature_standard_error(const FramePair& f) {
  if (f.now.temperature_error.size() != f.in.initial.size())
    return problem("the trajectory has no temperature_error");
  FrameError out;
  for (std::size_t i = 0; i < f.now.temperature_error.size(); ++i) {
    if (!takes(f.in, i)) continue;
    if (!std::isfinite(f.now.temperature_error[i])) return problem(bad_sample("temperature_error", i, false));
    out.add(f.now.temperature_error[i], rest_volume(f.in, i), static_cast<long>(i));
  }
  return out;
}

FrameError stated_phase_count(const FramePair& f) {
  if (f.now.phase.empty()) return problem("the trajectory has no phase");
  double count = 0.0;
  for (std::size_t i = 0; i < f.now.phase.size(); ++i)
    count += takes(f.in, i) && is_alive(f.now, i) && of_stated_phase(f.in, f.now, i) ? 1.0 : 0.0;
  return against_truth(f, "phase_count", count);
}

/// Largest difference in the number of particles of one phase.
FrameError phase_count(const FramePair& f) {
  if (f.truth.phase.empty() && f.in.reference.measuring().phase) return stated_phase_count(f);
  if (auto why = unequal(f.now.phase, f.truth.phase, "phase"); !why.empty()) return problem(why);
  double count[3] = {0, 0, 0};
  for (std::size_t i = 0; i < f.now.phase.size(); ++i) {
    if (!takes(f.in, i)) continue;
    for (int p = 0; p < 3; ++p)
      count[p] += (f.now.phase[i] == p ? 1.0 : 0.0) - (f.truth.phase[i] == p ? 1.0 : 0.0);
  }
  double worst = 0.0;
  for (const double c : count) worst = std::abs(c) > std::abs(worst) ? c : worst;
  return single(worst);
}

}  // namespace

Vec3 displacement(const Scene& scene, const Vec3& r, const Vec3& r0) {
  Vec3 d = r - r0;
  if (!scene.min || !scene.max) return d;
  for (std::size_t k = 0; k < 3; ++k) {
    const double L = (*scene.max)[k] - (*scene.min)[k];
    if (scene.periodic[k] && L > 0.0) d[k] -= L * std::round(d[k] / L);
  }
  return d;
}

bool in_box(const Scene& scene, const Vec3& r, const Vec3& low, const Vec3& high) {
  const Vec3 middle = 0.5 * (low + high), image = middle + displacement(scene, r, middle);
  for (std::size_t k = 0; k < 3; ++k) {
    const double at = scene.periodic[k] && std::isfinite(middle[k]) ? image[k] : r[k];
    if (at < low[k] || at > high[k]) return false;
  }
  return true;
}

double rest_volume(const MetricInput& in, std::size_t i) {
  if (i >= in.initial.size()) return 0.0;
  const auto material = static_cast<std::size_t>(in.initial.material[i]);
  const bool known =
      material < in.job.scene.materials.size() && in.job.scene.materials[material].density > 0.0;
  return in.initial.mass[i] / (known ? in.job.scene.materials[material].density : 1.0);
}

bool takes(const MetricInput& in, std::size_t i) {
  if (in.choice.body.empty()) return true;
  if (i >= in.initial.size()) return false;
  const auto source = static_cast<std::size_t>(in.initial.source[i]);
  return source < in.job.bodies.size() && in.job.bodies[source].name == in.choice.body;
}

long body_row(const MetricInput& in) {
  if (in.choice.body.empty()) return -1;
  std::vector<std::string> names;
  for (const auto& b : in.job.bodies) {
    if (b.name == in.choice.body) return b.index;
    names.push_back(b.name);
  }
  throw InputError(in.choice.place, "metric `" + in.choice.name + "` names body `" +
                                        printable(in.choice.body) + "`" + suggestion(in.choice.body, names));
}

const std::vector<Quantity>& particle_quantities() {
  static const std::vector<Quantity> list{
      {{"position", "m",
        "distance of particles from their true positions; with `body` of its centre of mass, or along an "
        "axis minus a stated "
        "value"},
       [](const FramePair& f) { return vector_error(f, &Snapshot::position, "position", true); }},
      {{"velocity", "m/s",
        "difference of velocities of particles; with `body` of its centre of mass, or its size (component) "
        "minus the stated "
        "value"},
       [](const FramePair& f) { return vector_error(f, &Snapshot::velocity, "velocity", false); }},
      {{"temperature", "K",
        "difference of temperatures (from the reference's field, else from the stated value), weighted by "
        "rest volume"},
       temperature_difference},
      {{"temperature_error", "K", "the run's own standard error of temperature (walkers)"},
       temperature_standard_error},
      {{"pressure", "Pa", "difference of pressures, likewise"},
       [](const FramePair& f) { return scalar_error(f, &Snapshot::pressure, "pressure"); }},
      {{"density", "kg/m3", "difference of densities, likewise"},
       [](const FramePair& f) { return scalar_error(f, &Snapshot::density, "density"); }},
      {{"phase_count", "1",
        "largest difference in the number of liquid, elastic or rigid particles; of the stated phase, from "
        "the stated value"},
       phase_count}};
  return list;
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/metrics/frames.hpp"
#include "validation/metrics/members.hpp"

namespace tripoint {
namespace {

std::string no_phases(const Snapshot& s) {
  return s.phase.size() < s.position.size() || s.phase.empty() ? "the trajectory has no phases" : "";
}

template <class Keep>
double mass_where(const FramePair& f, Keep keep) {
  long double sum = 0;
  for (std::size_t i = 0; i < f.now.phase.size(); ++i)
    if (is_alive(f.now, i) && of_stated_phase(f.in, f.now, i) && keep(i))
      sum += particle_mass(f.in, f.now, i);
  return double(sum);
}

FrameError mass_of_phase(const FramePair& f) {
  if (auto why = no_phases(f.now); !why.empty()) return problem(why);
  return against_truth(f, "mass_of_phase", mass_where(f, [&](std::size_t i) { return takes(f.in, i); }));
}

// --- mass in a box

/// A box at rest, or one that moves and turns with a body from where that body began.
struct Box {
  Vec3 low, high;
  const BodyState* body = nullptr;  // it follows
  Vec3 start;                       // that body's first centre
  [[nodiscard]] bool holds(const Scene& scene, const Vec3& place) const {
    if (!body) return in_box(scene, place, low, high);
    const Vec3 away = displacement(scene, place, body->position);
    return in_box({}, start + rotate_back(body->orientation, away), low, high);
  }
};

/// Reason why there is no box, or an empty text.
std::string box_of(const FramePair& f, Box& box) {
  const auto measuring = f.in.reference.measuring();
  if (!measuring.box)
    return "mass_in_region needs a box: reference = {function = \"stated\", args = {min = [...], max = "
           "[...]}}";
  box.low = measuring.box->low;
  box.high = measuring.box->high;
  if (!measuring.follows) return {};
  const long row = body_row(f.in);
  if (row < 0 || static_cast<std::size_t>(row) >= f.now.bodies.size() ||
      !finite(f.now.bodies[static_cast<std::size_t>(row)].position))
    return "the box follows a solid body that the metric must name, and that must live";
  box.body = &f.now.bodies[static_cast<std::size_t>(row)];
  box.start = f.in.job.bodies[job_body(f.in)].properties.centre;
  return {};
}

FrameError mass_in_region(const FramePair& f) {
  Box box;
  if (auto why = no_phases(f.now); !why.empty()) return problem(why);
  if (auto why = box_of(f, box); !why.empty()) return problem(why);
  const bool outside = f.in.reference.measuring().outside;
  return against_truth(f, "mass_in_region", mass_where(f, [&](std::size_t i) {
                         return (box.body || takes(f.in, i)) &&
                                box.holds(f.in.job.scene, f.now.position[i]) != outside;
                       }));
}

// --- a front

/// Volume that has changed phase over the bar's cross-section: finer than a particle where it holds a liquid
/// fraction.
std::string front(const FramePair& f, double& place, double& truth) {
  const auto [bar, melts] = std::pair{f.in.reference.measuring().bar, f.in.reference.measuring().melts};
  const auto area = f.in.reference.number("area"),
             exact = f.in.reference.number_at("front_position", f.now.time);
  if (!bar || !area || !melts || !exact) return "the reference knows no front";
  if (auto why = no_phases(f.now); !why.empty() && f.now.liquid_fraction.empty()) return why;
  long double volume = 0;
  for (const auto i : sampled(f.in, *bar)) {
    const double liquid = i < f.now.liquid_fraction.size() ? f.now.liquid_fraction[i]
                          : f.now.phase[i] == 0            ? 1.0
                                                           : 0.0;
    volume += static_cast<long double>(rest_volume(f.in, i)) * (*melts ? liquid : 1.0 - liquid);
  }
  place = double(volume) / *area;
  truth = *exact;
  return {};
}

FrameError front_position(const FramePair& f) {
  double place = 0.0, truth = 0.0;
  if (auto why = front(f, place, truth); !why.empty()) return problem(why);
  return single(place - truth);
}

FrameError front_ratio(const FramePair& f) {
  double place = 0.0, truth = 0.0;
  if (auto why = front(f, place, truth); !why.empty()) return problem(why);
  return truth > 0.0 ? single(place / truth - 1.0)
                     : problem("the front has not started: choose a window or `at` after the start");
}

// --- back and forth

/// How often each particle changes between liquid and solid; empty when a frame has no phases.
std::vector<long> changes(const MetricInput& in, const std::vector<std::vector<int>>& phases) {
  std::vector<long> count(in.initial.size(), 0);
  for (std::size_t n = 0; n < phases.size(); ++n) {
    if (phases[n].size() < count.size()) return {};
    for (std::size_t i = 0; n > 0 && i < count.size(); ++i)
      count[i] += takes(in, i) && (phases[n][i] == 0) != (phases[n - 1][i] == 0) ? 1 : 0;
  }
  return count;
}

/// Changes beyond a particle's first one, the most of any particle: less the stated value, else those of the
/// truth's phases, else none.
MetricValue toggles(const MetricInput& in, const Frames& frames) {
  std::vector<std::vector<int>> run, true_phases;
  for (const auto* s : frames) {
    run.push_back(s->phase);
    true_phases.push_back(in.reference.truth_for(*s).phase);
  }
  const auto count = changes(in, run), truth = changes(in, true_phases);
  if (count.empty()) return not_formed("the trajectory has no phases");
  const auto returns = [](const std::vector<long>& list) {
    return list.empty() ? 0L : std::max(0L, *std::max_element(list.begin(), list.end()) - 1);
  };
  const auto stated = in.reference.number("value");
  const auto worst = std::max_element(count.begin(), count.end());
  MetricValue v;
  v.value = static_cast<double>(returns(count)) - (stated ? *stated : static_cast<double>(returns(truth)));
  v.note = "particle " + std::to_string(worst - count.begin()) + " changed " + std::to_string(*worst) +
           " times, seen at output times";
  return v;
}

}  // namespace

const std::vector<Quantity>& phase_quantities() {
  static const std::vector<Quantity> list{
      {{"mass_of_phase", "kg", "mass of the particles of the stated phase minus the stated value"},
       mass_of_phase},
      {{"mass_in_region", "kg",
        "mass (of the stated phase) in the stated box, or outside it, minus the stated value"},
       mass_in_region},
      {{"front_position", "m",
        "volume that has melted (frozen) over the bar's cross-section, minus the true place of the front"},
       front_position},
      {{"front_ratio", "1", "the same over the true place, minus 1"}, front_ratio}};
  return list;
}

const std::vector<RunQuantity>& phase_run_quantities() {
  static const std::vector<RunQuantity> list{{{"toggles", "1",
                                               "most returns of a particle to a phase that it had left, seen "
                                               "at output times, minus the true number"},
                                              toggles}};
  return list;
}

}  // namespace tripoint

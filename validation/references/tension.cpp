// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "files/job.hpp"
#include "validation/references/heat_scene.hpp"
#include "validation/references/solid_scene.hpp"

namespace tripoint {
namespace {

/// The bar between its ends: their places in time, and its state by the law.
struct Bar {
  std::size_t row = 0, axis = 0;
  double length = 0.0, area = 0.0;
  /// Middle shares of the length: for the modulus, for other stretches
  double gauge = 0.5, stretch_gauge = 1.0;
  BarLaw law;
  /// Rows in Job::bodies of the bodies that hold its ends
  std::optional<std::size_t> low, high;
  double release = std::numeric_limits<double>::infinity();  ///< time at which an end is let go [s]
  double tear = std::numeric_limits<double>::infinity();     ///< stretch at which it parts
};

/// Displacement along an axis of a held body [m]: of its keyframes, straight between them, else at its
/// constant velocity.
double displaced(const JobBody& body, std::size_t axis, double time) {
  if (body.motion == Motion::fixed) return 0.0;
  const auto& keys = body.keyframes;
  if (keys.empty()) return body.velocity[axis] * time;
  const double start = body.properties.centre[axis];
  if (time <= keys.front().time) return keys.front().position[axis] - start;
  for (std::size_t n = 1; n < keys.size(); ++n) {
    if (time > keys[n].time) continue;
    const double share = (time - keys[n - 1].time) / (keys[n].time - keys[n - 1].time);
    return keys[n - 1].position[axis] + share * (keys[n].position[axis] - keys[n - 1].position[axis]) - start;
  }
  return keys.back().position[axis] - start;
}

/// A homogeneous bar between driven ends. Numbers: bar, axis, area [m2], gauge, modulus [Pa], yield_stress
/// [Pa], residual_stretch, event_time of the tear [s]; in time: stretch, reaction [N]. The ledger's terms
/// elastic and plastic [J] are in its snapshots.
class Tension : public Reference {
 public:
  Tension(const Job& job, Bar bar) : job_(job), bar_(std::move(bar)) {
    times_.insert(0.0);
    for (const auto& end : {bar_.low, bar_.high})
      for (std::size_t n = 0; end && n < job_.bodies[*end].keyframes.size(); ++n)
        times_.insert(job_.bodies[*end].keyframes[n].time);
    find_tear();
    find_residual();
  }
  [[nodiscard]] Snapshot at(double time) const override {
    const auto s = state(time);
    Snapshot out;
    out.time = time;
    out.energy["elastic"] = s.elastic * bar_.area * bar_.length;
    out.energy["plastic"] = s.dissipated * bar_.area * bar_.length;
    return out;
  }
  [[nodiscard]] Measuring measuring() const override { return {.axis = bar_.axis, .bar = bar_.row}; }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "area") return bar_.area;
    if (quantity == "gauge") return bar_.gauge;
    if (quantity == "stretch_gauge") return bar_.stretch_gauge;
    if (quantity == "modulus") return bar_.law.modulus();
    if (quantity == "yield_stress" && std::isfinite(bar_.law.elastic_limit)) return bar_.law.yield_stress();
    if (quantity == "residual_stretch") return residual_;
    if (quantity == "event_time") return torn_;
    return {};
  }
  [[nodiscard]] std::optional<double> number_at(std::string_view quantity, double time) const override {
    if (quantity == "stretch") return state(time).stretch;
    if (quantity == "reaction") return state(time).force * bar_.area;
    return number(quantity);
  }

 private:
  [[nodiscard]] double driven_stretch(double time) const {
    const auto end = [&](const std::optional<std::size_t>& body) {
      return body ? displaced(job_.bodies[*body], bar_.axis, time) : 0.0;
    };
    return 1.0 + (end(bar_.high) - end(bar_.low)) / bar_.length;
  }
  /// Between the keyframes the stretch is monotone, so that each is one step of the law.
  [[nodiscard]] BarState driven(double time) const {
    BarState s;
    for (const double t : times_)
      if (t < time) s = stretched(bar_.law, s, driven_stretch(t));
    return stretched(bar_.law, s, driven_stretch(time));
  }
  /// Torn or let go, and at rest again, it bears nothing and keeps its plastic strain.
  [[nodiscard]] BarState state(double time) const {
    const double free_from = std::min(bar_.release, torn_.value_or(std::numeric_limits<double>::infinity()));
    if (time < free_from) return driven(time);
    const auto last = driven(free_from);
    auto rest = stretched(bar_.law, last, unloaded_stretch(bar_.law, last));
    rest.force = 0.0;  // round-off of the bisection
    return rest;
  }
  void find_tear() {
    double before = 0.0;
    for (const double t : times_) {
      if (driven_stretch(t) >= bar_.tear && t > before) {
        const double a = driven_stretch(before), b = driven_stretch(t);
        torn_ = before + (bar_.tear - a) / (b - a) * (t - before);
        return;
      }
      before = t;
    }
  }
  void find_residual() {
    if (!std::isfinite(bar_.law.elastic_limit) || times_.size() < 2) return;
    const double longest = *std::max_element(times_.begin(), times_.end(), [&](double a, double b) {
      return driven_stretch(a) < driven_stretch(b);
    });
    if (driven_stretch(longest) > 1.0) residual_ = unloaded_stretch(bar_.law, driven(longest));
  }

  Job job_;
  Bar bar_;
  std::set<double> times_;
  std::optional<double> residual_, torn_;
};

void find_ends(const ReferenceInput& in, Bar& bar) {
  const double middle = in.job.bodies[bar.row].properties.centre[bar.axis];
  for (std::size_t b = 0; b < in.job.bodies.size(); ++b) {
    const auto& body = in.job.bodies[b];
    if (b == bar.row || body.phase == Phase::liquid || body.motion == Motion::free) continue;
    auto& end = body.properties.centre[bar.axis] < middle ? bar.low : bar.high;
    if (end) throw InputError("tension: two bodies hold the same end of the bar");
    end = b;
  }
  if (!bar.low || !bar.high)
    throw InputError("tension: the bar needs a fixed or prescribed solid body at each end");
  for (const auto& event : in.job.scene.events) {
    if (event.kind != Event::Kind::release) continue;
    for (const auto& name : event.bodies)
      if (name == in.job.bodies[*bar.low].name || name == in.job.bodies[*bar.high].name)
        bar.release = std::min(bar.release, event.time);
  }
}

std::unique_ptr<Reference> make_tension(const ReferenceInput& in) {
  Bar bar;
  bar.row = elastic_body(in, "tension");
  bar.axis = long_axis(in, bar.row);
  const auto size = extents(in, bar.row);
  bar.length = in.args.number("length").value_or(size[bar.axis]);
  bar.area = in.args.number("area").value_or(size[(bar.axis + 1) % 3] * size[(bar.axis + 2) % 3]);
  bar.gauge = in.args.number("gauge").value_or(bar.gauge);
  bar.stretch_gauge = in.args.number("gauge").value_or(bar.stretch_gauge);
  if (!(bar.gauge > 0.0) || bar.gauge > 1.0)
    throw InputError("argument `gauge` of reference function tension must be above 0 and at most 1");
  bar.law = bar_law(in, bar.row, bar.axis);
  bar.tear = in.job.scene.material(in.job.bodies[bar.row].material).fracture_stretch.value_or(bar.tear);
  find_ends(in, bar);
  return std::make_unique<Tension>(in.job, bar);
}

}  // namespace

ReferenceEntry tension_entry() {
  return {
      {"tension",
       "analytic",
       "homogeneous St Venant-Kirchhoff bar, von Mises flow (O'Brien, Bargteil, Hodgins 2002); as printed "
       "with the gradient "
       "moment (17)",
       "reaction, stretch, stored and dissipated energy of an elastic box between two held ends, driven by "
       "keyframes, to the "
       "tear",
       {{"body", "", "the bar; default the scene's only free elastic body", ArgumentType::word},
        {"length", "m", "between the held ends; default of the bar's box"},
        {"area", "m2", "cross-section; default of the bar's box or the periodic domain"},
        {"sides", "",
         "free, plane_strain (one direction held) or confined (both); default by the periodic directions",
         ArgumentType::word},
        {"form", "", "paper or corrected; default the run's mode of the elastic term", ArgumentType::word},
        {"support_ratio", "", "h/dx of the printed form; default the run's"},
        {"gauge", "",
         "middle fraction of the length over which stretches are measured; default 0.5 for the modulus, 1 "
         "for "
         "others"}}},
      make_tension};
}

}  // namespace tripoint

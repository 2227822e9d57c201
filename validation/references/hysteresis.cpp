// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "files/job.hpp"
#include "validation/references/functions.hpp"
#include "validation/references/region.hpp"

namespace tripoint {
namespace {

/// Phases under a programme of temperatures that heat events set. Matter is liquid since the last one above
/// t_melt, solid since the last one below t_solid, unchanged by those between.
class Hysteresis : public Reference {
 public:
  Hysteresis(const Job& job, const InitialState& initial) : job_(job), initial_(initial) {
    std::stable_sort(job_.scene.events.begin(), job_.scene.events.end(),
                     [](const Event& a, const Event& b) { return a.time < b.time; });
    refuse_other_heat();
  }
  [[nodiscard]] Snapshot at(double time) const override {
    std::vector<int> phase;
    for (std::size_t i = 0; i < initial_.size(); ++i) phase.push_back(phase_of(i, time - round_off()));
    return state(time, std::move(phase));
  }
  /// A frame at the very time of an event may show the phase before or after it, at the start too.
  [[nodiscard]] Snapshot truth_for(const Snapshot& now) const override {
    auto phase = at(now.time).phase;
    for (std::size_t i = 0; i < phase.size() && i < now.phase.size(); ++i)
      if (const int after = phase_of(i, now.time + round_off()); now.phase[i] == after) phase[i] = after;
    return state(now.time, std::move(phase));
  }

 private:
  [[nodiscard]] const Material& material(std::size_t i) const {
    return job_.scene.materials.at(static_cast<std::size_t>(initial_.material[i]));
  }
  [[nodiscard]] bool heats(const Event& e, std::size_t i) const {
    if (e.kind != Event::Kind::heat) return false;
    const auto& name = job_.bodies.at(static_cast<std::size_t>(initial_.source[i])).name;
    if (!e.bodies.empty() && std::find(e.bodies.begin(), e.bodies.end(), name) == e.bodies.end())
      return false;
    return !e.region || inside(*e.region, initial_.position[i]);
  }
  [[nodiscard]] static Snapshot state(double time, std::vector<int> phase) {
    Snapshot out;
    out.time = time;
    out.phase = std::move(phase);
    for (const int p : out.phase)
      out.liquid_fraction.push_back(p == static_cast<int>(Phase::liquid) ? 1.0 : 0.0);
    return out;
  }
  // To which output times are met
  [[nodiscard]] double round_off() const { return 1e-9 * job_.scene.end_time; }
  /// After all events before a time.
  [[nodiscard]] int phase_of(std::size_t i, double time) const {
    int phase = initial_.phase[i];
    const auto& m = material(i);
    if (!m.t_melt) return phase;
    for (const auto& e : job_.scene.events) {
      if (!(e.time < time) || !heats(e, i)) continue;
      if (*e.temperature > *m.t_melt) phase = static_cast<int>(Phase::liquid);
      if (*e.temperature < m.t_solid.value_or(*m.t_melt))
        phase = static_cast<int>(m.solid == SolidKind::rigid ? Phase::rigid : Phase::elastic);
    }
    return phase;
  }
  void refuse_other_heat() const {
    bool any = false;
    for (const auto& e : job_.scene.events) {
      if (e.kind != Event::Kind::heat) continue;
      any = true;
      if (!e.temperature) throw InputError(e.place, "hysteresis: the heat event needs a temperature");
      for (std::size_t i = 0; i < initial_.size(); ++i)
        if (material(i).t_melt && !heats(e, i))
          throw InputError(
              e.place, "hysteresis: each heat event must hold all that can melt, else conduction decides");
    }
    if (!any) throw InputError("hysteresis needs heat events");
  }
  Job job_;
  InitialState initial_;
};

std::unique_ptr<Reference> make_hysteresis(const ReferenceInput& in) {
  return std::make_unique<Hysteresis>(in.job, in.initial);
}

}  // namespace

ReferenceEntry hysteresis_entry() {
  return {{"hysteresis",
           "analytic",
           "relay with two thresholds: melts above t_melt, freezes below t_solid, keeps its phase between "
           "(model 8.9)",
           "phases of all particles under heat events that hold everything that can melt",
           {}},
          make_hysteresis};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/idle_keys.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/effect_rule.hpp"
#include "scene/initial_state.hpp"
#include "validation/case/idle_search.hpp"
#include "validation/case/read_case.hpp"

/// Parts of a case that no run of it can show: common code of the searches for them, and their order.
namespace tripoint {

IdleSearch::IdleSearch(const CaseReading& of, const Scene& its_scene, const InitialState& its_state)
    : reading(of), value(of.value), scene(its_scene), state(its_state) {
  for (const Mode mode : value.modes) scenes.push_back(scene_for(value, {mode, {}, {}, {}, {}, {}}));
}

SourcePlace IdleSearch::given(const std::string& key) const {
  for (const auto& d : reading.decisions)
    if (d.given && d.key == key) return d.place;
  return {};
}

bool IdleSearch::calls(std::string_view effect) const {
  return any_mode([&](const Scene& s) { return calls_for(s, effect); });
}

std::string IdleSearch::why_idle(std::string_view effect) const {
  for (const CalledEffect& e : idle_effects(scenes.front()))
    if (e.name == effect) return e.why;
  return "";
}

bool IdleSearch::outside(const Bounds& box) const {
  if (!(scene.min && scene.max)) return false;
  for (std::size_t a = 0; a < 3; ++a)
    if (!scene.periodic[a] && (box.max[a] <= (*scene.min)[a] || box.min[a] >= (*scene.max)[a])) return true;
  return false;
}

void IdleSearch::keyframes(const std::vector<Keyframe>& frames, const std::string& whose,
                           const SourcePlace& place) {
  const double end = scene.end_time;
  const auto after =
      std::ranges::count_if(frames, [&](const Keyframe& k) { return k.time > end * (1.0 + 1e-9); });
  if (after == 0) return;
  if (after == std::ssize(frames))
    return warn(
        place,
        fmt::format(
            "{}: its first keyframe is at {} s, after end_time = {} s: it stands still for the whole run",
            whose, frames.front().time, end));
  const auto& last = frames[frames.size() - static_cast<std::size_t>(after) - 1];
  const auto stands = [&](const Keyframe& k) {
    return k.time <= last.time ||
           (k.position == last.position && angle_between(k.rotation, last.rotation) < 1e-9);
  };
  if (std::ranges::all_of(frames, stands)) return;  // it only stays where it has come to
  const bool under_way = last.time < end * (1.0 - 1e-9);
  warn(place,
       fmt::format("{}: {} of its {} keyframes come after end_time = {} s{}: lengthen the run, or shorten "
                   "the keyframes",
                   whose, after, frames.size(), end,
                   under_way ? fmt::format(" and it is on its way to that of {} s when the run ends",
                                           frames[frames.size() - static_cast<std::size_t>(after)].time)
                             : " and are never followed"));
}

std::vector<Finding> idle_keys(const CaseReading& reading, const Scene& scene, const InitialState& state) {
  IdleSearch search(reading, scene, state);
  find_idle_events(search);
  find_idle_bodies(search);
  find_idle_effect_keys(search);
  find_idle_judgement(search);
  return std::move(search.findings);
}

}  // namespace tripoint

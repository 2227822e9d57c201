// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>

#include "scene/geometry.hpp"
#include "scene/meeting.hpp"
#include "validation/case/idle_search.hpp"

/// Events that find nothing to act on.
namespace tripoint {
namespace {

bool names(const std::vector<std::string>& list, const std::string& name) {
  return std::ranges::find(list, name) != list.end();
}

/// Whether a body is where it began as long as nothing but the scene's own keys moves it.
bool stays(const Body& b) {
  return b.motion == Motion::fixed ||
         (b.motion == Motion::prescribed && b.keyframes.empty() && greatest_speed(b) == 0.0);
}

/// Whether the event would act on a particle at the start.
bool finds_something(const IdleSearch& in, const Event& e) {
  const auto inside = inside_region(in.scene, *e.region);
  std::vector<long> within(in.scene.bodies.size(), 0), all(in.scene.bodies.size(), 0);
  for (std::size_t i = 0; i < in.state.size(); ++i) {
    const auto source = static_cast<std::size_t>(in.state.source[i]);
    ++all[source];
    within[source] += inside(in.state.position[i]);
  }
  for (std::size_t n = 0; n < in.scene.bodies.size(); ++n) {
    const Body& b = in.scene.bodies[n];
    if (!e.bodies.empty() && !names(e.bodies, b.name)) continue;
    if (e.kind == Event::Kind::heat && within[n] > 0) return true;
    if (b.phase == Phase::liquid) continue;
    // a grip takes a rigid body by most of its particles
    const bool as_a_whole = e.kind == Event::Kind::grip && b.phase == Phase::rigid;
    if (as_a_whole ? b.motion == Motion::free && 2 * within[n] > all[n] : within[n] > 0) return true;
  }
  return false;
}

/// Whether something may be in the event's region by then that was not there at the start.
bool may_come(const IdleSearch& in, const Event& e) {
  if (!(e.time > 0.0)) return false;
  if (e.bodies.empty() && !in.scene.inflows.empty()) return true;
  const bool earlier = std::ranges::any_of(in.scene.events, [&](const Event& other) {
    return other.time < e.time && other.kind != Event::Kind::heat && other.kind != Event::Kind::hold;
  });
  return earlier || std::ranges::any_of(in.scene.bodies, [&](const Body& b) {
           return (e.bodies.empty() || names(e.bodies, b.name)) && !stays(b);
         });
}

/// Whether a body, or all that a grip of that name holds, is held when the event comes. Its own motion, a
/// hold or a grip not yet ended may hold it.
bool is_held(const IdleSearch& in, const std::string& name, const Event& by) {
  bool held = std::ranges::any_of(in.scene.bodies,
                                  [&](const Body& b) { return b.name == name && b.motion != Motion::free; });
  std::vector<const Event*> before;
  for (const Event& e : in.scene.events)
    if (&e != &by && e.time <= by.time) before.push_back(&e);
  std::ranges::stable_sort(before, {}, &Event::time);
  for (const Event* e : before) {
    const bool takes = (e->kind == Event::Kind::hold && names(e->bodies, name)) ||
                       (e->kind == Event::Kind::grip &&
                        (e->name == name || std::ranges::any_of(in.scene.bodies, [&](const Body& b) {
                           return b.name == name && b.phase == Phase::rigid;
                         })));
    if (takes && (!e->until || *e->until > by.time)) held = true;
    if (e->kind == Event::Kind::release && names(e->bodies, name)) held = false;
  }
  return held;
}

void release(IdleSearch& in, const Event& e) {
  for (const std::string& name : e.bodies) {
    const bool of_the_scene =
        std::ranges::any_of(in.scene.bodies, [&](const Body& b) { return b.name == name; });
    const bool grip = std::ranges::any_of(
        in.scene.events, [&](const Event& g) { return g.kind == Event::Kind::grip && g.name == name; });
    if ((!of_the_scene && !grip) || is_held(in, name, e)) continue;
    in.error(
        e.place,
        fmt::format(
            "\"{}\" is not held at {} s, so that nothing is released: name a body that a hold, or its own "
            "motion, holds then, or the grip that has it",
            name, e.time));
  }
}

void hold(IdleSearch& in, const Event& e) {
  for (const Body& b : in.scene.bodies)
    if (names(e.bodies, b.name) && b.motion == Motion::fixed && is_held(in, b.name, e))
      in.error(
          e.place,
          fmt::format("body \"{}\" is fixed, so that holding it changes nothing: remove it from the event",
                      b.name));
}

void event(IdleSearch& in, const Event& e) {
  if (e.region && !finds_something(in, e)) {
    const char* what =
        e.kind == Event::Kind::grip
            ? "no solid that a grip can take (an elastic particle, or more than half of a free rigid body)"
        : e.kind == Event::Kind::split ? "no particle of a solid"
                                       : "no particle";
    const auto text = fmt::format("{} lies in the region of this event at the start", what);
    if (may_come(in, e))
      in.warn(e.place, fmt::format("{}: it acts only on what has come there by t = {} s; check the region",
                                   text, e.time));
    else
      in.error(
          e.place,
          fmt::format("{}, and none can come: move the region to what it is meant for, or remove the event",
                      text));
  }
  if (e.kind == Event::Kind::release) release(in, e);
  if (e.kind == Event::Kind::hold) hold(in, e);
  if (!e.keyframes.empty()) in.keyframes(e.keyframes, "the grip", e.place);
}

}  // namespace

void find_idle_events(IdleSearch& in) {
  for (const Event& e : in.scene.events) event(in, e);
}

}  // namespace tripoint

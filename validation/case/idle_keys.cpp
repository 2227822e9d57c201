// SPDX-License-Identifier: BSD-3-Clause
#include "validation/case/idle_keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/effect_rule.hpp"
#include "scene/geometry.hpp"
#include "scene/lattice.hpp"
#include "scene/meeting.hpp"
#include "scene/shared_terms.hpp"

/// What a case says and no run of it can show: events that find nothing to act on, and keys that nothing of the scene reads.
namespace tripoint {
namespace {

bool names(const std::vector<std::string>& list, const std::string& name) { return std::ranges::find(list, name) != list.end(); }

/// Whether a body is where it began as long as nothing but the scene's own keys moves it.
bool stays(const Body& b) {
  return b.motion == Motion::fixed || (b.motion == Motion::prescribed && b.keyframes.empty() && greatest_speed(b) == 0.0);
}

class IdleKeys {
 public:
  IdleKeys(const CaseReading& reading, const Scene& scene, const InitialState& state)
      : reading_(reading), case_(reading.value), scene_(scene), state_(state) {
    for (const Mode mode : case_.modes) scenes_.push_back(scene_for(case_, {mode, {}, {}, {}, {}, {}}));
  }

  std::vector<Finding> run() {
    for (const Event& e : scene_.events) event(e);
    for (const Body& b : scene_.bodies) body(b);
    for (std::size_t n = 0; n < scene_.inflows.size(); ++n) inflow(scene_.inflows[n], n + 1);
    for (const Material& m : scene_.materials) material(m);
    scene();
    judgement();
    return std::move(findings_);
  }

 private:
  void error(const SourcePlace& place, std::string what) { findings_.push_back({true, std::move(what), place}); }
  void warn(const SourcePlace& place, std::string what) { findings_.push_back({false, std::move(what), place}); }

  /// Where the file says this key; a place without file where it does not.
  [[nodiscard]] SourcePlace given(const std::string& key) const {
    for (const auto& d : reading_.decisions)
      if (d.given && d.key == key) return d.place;
    return {};
  }
  [[nodiscard]] bool any_mode(const auto& test) const { return std::ranges::any_of(scenes_, test); }
  [[nodiscard]] bool calls(const std::string& effect) const {
    return any_mode([&](const Scene& s) { return calls_for(s, effect); });
  }
  [[nodiscard]] bool corrected(const Term& one) const {
    return any_mode([&](const Scene& s) { return s.mode_of(one) == Mode::corrected; });
  }
  [[nodiscard]] std::string why_idle(const std::string& effect) const {
    for (const CalledEffect& e : idle_effects(scenes_.front()))
      if (e.name == effect) return e.why;
    return "";
  }

  /// Particles of each body that the event would act on at the start.
  [[nodiscard]] bool finds_something(const Event& e) const {
    const auto inside = inside_of(*e.region, scene_.spacing);
    std::vector<long> in(scene_.bodies.size(), 0), all(scene_.bodies.size(), 0);
    for (std::size_t i = 0; i < state_.size(); ++i) {
      const auto source = static_cast<std::size_t>(state_.source[i]);
      ++all[source];
      in[source] += inside(state_.position[i]);
    }
    for (std::size_t n = 0; n < scene_.bodies.size(); ++n) {
      const Body& b = scene_.bodies[n];
      if (!e.bodies.empty() && !names(e.bodies, b.name)) continue;
      if (e.kind == Event::Kind::heat && in[n] > 0) return true;
      if (b.phase == Phase::liquid) continue;
      const bool as_a_whole =
          e.kind == Event::Kind::grip && b.phase == Phase::rigid;  // a grip takes a rigid body by most of its particles
      if (as_a_whole ? b.motion == Motion::free && 2 * in[n] > all[n] : in[n] > 0) return true;
    }
    return false;
  }

  /// Whether something may be in the event's region by then that was not there at the start.
  [[nodiscard]] bool may_come(const Event& e) const {
    if (!(e.time > 0.0)) return false;
    if (e.bodies.empty() && !scene_.inflows.empty()) return true;
    const bool earlier = std::ranges::any_of(scene_.events, [&](const Event& other) {
      return other.time < e.time && other.kind != Event::Kind::heat && other.kind != Event::Kind::hold;
    });
    return earlier || std::ranges::any_of(scene_.bodies, [&](const Body& b) {
             return (e.bodies.empty() || names(e.bodies, b.name)) && !stays(b);
           });
  }

  void event(const Event& e) {
    if (e.region && !finds_something(e)) {
      const char* what = e.kind == Event::Kind::grip
                             ? "no solid that a grip can take (an elastic particle, or more than half of a free rigid body)"
                         : e.kind == Event::Kind::split ? "no particle of a solid"
                                                        : "no particle";
      const auto text = fmt::format("{} lies in the region of this event at the start", what);
      if (may_come(e))
        warn(e.place, fmt::format("{}: it acts only on what has come there by t = {} s; check the region", text, e.time));
      else
        error(e.place, fmt::format("{}, and none can come: move the region to what it is meant for, or remove the event", text));
    }
    if (e.kind == Event::Kind::release) release(e);
    if (e.kind == Event::Kind::hold) hold(e);
    if (!e.keyframes.empty()) keyframes(e.keyframes, "the grip", e.place);
  }

  /// Whether a body, or what a grip of that name holds, is held when the event comes: by its own motion, a hold or a grip not yet
  /// ended.
  [[nodiscard]] bool is_held(const std::string& name, const Event& by) const {
    bool held = std::ranges::any_of(scene_.bodies, [&](const Body& b) { return b.name == name && b.motion != Motion::free; });
    std::vector<const Event*> before;
    for (const Event& e : scene_.events)
      if (&e != &by && e.time <= by.time) before.push_back(&e);
    std::ranges::stable_sort(before, {}, &Event::time);
    for (const Event* e : before) {
      const bool takes =
          (e->kind == Event::Kind::hold && names(e->bodies, name)) ||
          (e->kind == Event::Kind::grip && (e->name == name || std::ranges::any_of(scene_.bodies, [&](const Body& b) {
                                              return b.name == name && b.phase == Phase::rigid;
                                            })));
      if (takes && (!e->until || *e->until > by.time)) held = true;
      if (e->kind == Event::Kind::release && names(e->bodies, name)) held = false;
    }
    return held;
  }

  void release(const Event& e) {
    for (const std::string& name : e.bodies) {
      const bool of_the_scene = std::ranges::any_of(scene_.bodies, [&](const Body& b) { return b.name == name; });
      const bool grip =
          std::ranges::any_of(scene_.events, [&](const Event& g) { return g.kind == Event::Kind::grip && g.name == name; });
      if ((!of_the_scene && !grip) || is_held(name, e)) continue;
      error(e.place, fmt::format("\"{}\" is not held at {} s, so that nothing is released: name a body that a hold, or its own "
                                 "motion, holds then, or the grip that has it",
                                 name, e.time));
    }
  }

  void hold(const Event& e) {
    for (const Body& b : scene_.bodies)
      if (names(e.bodies, b.name) && b.motion == Motion::fixed && is_held(b.name, e))
        error(e.place, fmt::format("body \"{}\" is fixed, so that holding it changes nothing: remove it from the event", b.name));
  }

  void keyframes(const std::vector<Keyframe>& frames, const std::string& whose, const SourcePlace& place) {
    const double end = scene_.end_time;
    const auto after = std::ranges::count_if(frames, [&](const Keyframe& k) { return k.time > end * (1.0 + 1e-9); });
    if (after == 0) return;
    if (after == std::ssize(frames))
      return warn(
          place, fmt::format("{}: its first keyframe is at {} s, after end_time = {} s: it stands still for the whole run", whose,
                             frames.front().time, end));
    const auto& last = frames[frames.size() - static_cast<std::size_t>(after) - 1];
    const auto stands = [&](const Keyframe& k) {
      return k.time <= last.time || (k.position == last.position && angle_between(k.rotation, last.rotation) < 1e-9);
    };
    if (std::ranges::all_of(frames, stands)) return;  // it only stays where it has come to
    const bool under_way = last.time < end * (1.0 - 1e-9);
    warn(place, fmt::format("{}: {} of its {} keyframes come after end_time = {} s{}: lengthen the run, or shorten the keyframes",
                            whose, after, frames.size(), end,
                            under_way ? fmt::format(" and it is on its way to that of {} s when the run ends",
                                                    frames[frames.size() - static_cast<std::size_t>(after)].time)
                                      : " and are never followed"));
  }

  /// Whether the box lies wholly beyond a side of the domain that is not periodic.
  [[nodiscard]] bool outside(const Bounds& box) const {
    if (!(scene_.min && scene_.max)) return false;
    for (std::size_t a = 0; a < 3; ++a)
      if (!scene_.periodic[a] && (box.max[a] <= (*scene_.min)[a] || box.min[a] >= (*scene_.max)[a])) return true;
    return false;
  }

  void body(const Body& b) {
    const std::string path = "body." + b.name + ".";
    if (outside(bounds(b.shape)))
      error(b.place,
            fmt::format("body \"{}\" lies wholly outside scene.min and scene.max: move it in, or enlarge the domain", b.name));
    if (!b.keyframes.empty()) keyframes(b.keyframes, fmt::format("body \"{}\"", b.name), b.place);
    const bool wets = !scene_.inflows.empty() ||
                      std::ranges::any_of(scene_.bodies, [](const Body& other) { return other.phase == Phase::liquid; }) ||
                      calls("phase");
    if (b.free_slip && !wets)
      warn(given(path + "slip"),
           fmt::format("body \"{}\": slip is what a liquid does along it, and the scene has none: remove it", b.name));
    if (b.free_slip && wets && b.phase == Phase::liquid && !calls("phase"))
      warn(given(path + "slip"),
           fmt::format("body \"{}\" is liquid, and slip is of the solid that a liquid glides along: give it to the walls",
                       b.name));
    if (const auto place = given(path + "joins"); !place.file.empty() && !calls("phase"))
      warn(place, fmt::format("body \"{}\": joins acts where matter freezes, and here {}: remove it", b.name, why_idle("phase")));
    for (const auto& other : b.joined_to) joint(b, other);
  }

  /// Between two rigid bodies there is no bond.
  void joint(const Body& b, const std::string& name) {
    const auto other = std::ranges::find(scene_.bodies, name, &Body::name);
    if (other == scene_.bodies.end()) return;
    const auto place = given("body." + b.name + ".joined_to");
    if (b.phase != Phase::elastic && other->phase != Phase::elastic && !calls("phase"))
      return error(place, fmt::format("bodies \"{}\" and \"{}\": bonds join elastic bodies to others, and neither is elastic: "
                                      "merge rigid bodies by an event at 0 s, or by a union of their shapes",
                                      b.name, name));
    const auto first = static_cast<std::size_t>(&b - scene_.bodies.data()),
               second = static_cast<std::size_t>(other - scene_.bodies.begin());
    const double reach = bond_reach(scene_) * scene_.spacing;
    if (gap(first, second) > reach)
      error(place, fmt::format("bodies \"{}\" and \"{}\" are {:.3g} m apart, and bonds reach {:.3g} spacings = {:.3g} m: nothing "
                               "joins them; move them together",
                               b.name, name, gap(first, second), bond_reach(scene_), reach));
  }

  /// Distance between the boxes around the particles of two bodies, across periodic sides too [m]: never more than that of their
  /// particles.
  [[nodiscard]] double gap(std::size_t a, std::size_t b) const {
    std::array<Bounds, 2> box{};
    box.fill({{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}});
    for (std::size_t i = 0; i < state_.size(); ++i) {
      const auto source = static_cast<std::size_t>(state_.source[i]);
      if (source != a && source != b) continue;
      Bounds& of = box[source == a ? 0 : 1];
      for (std::size_t k = 0; k < 3; ++k) {
        of.min[k] = std::min(of.min[k], state_.position[i][k]);
        of.max[k] = std::max(of.max[k], state_.position[i][k]);
      }
    }
    Vec3 apart;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto between = [&](double shift) {
        return std::max({0.0, box[1].min[k] + shift - box[0].max[k], box[0].min[k] - shift - box[1].max[k]});
      };
      apart[k] = between(0.0);
      if (!scene_.periodic[k]) continue;
      const double width = (*scene_.max)[k] - (*scene_.min)[k];
      apart[k] = std::min({apart[k], between(width), between(-width)});
    }
    return norm(apart);
  }

  void inflow(const Inflow& f, std::size_t number) {
    const auto path = fmt::format("inflow.{}.", number);
    if (outside(bounds(f.shape)))
      error(given(path + "material"),
            "the inflow lies wholly outside scene.min and scene.max: move it in, or enlarge the domain");
    if (f.temperature && !calls("heat"))
      error(
          given(path + "temperature"),
          fmt::format("the temperature of the inflow is not followed: {}; give every body one, or remove it", why_idle("heat")));
    Body source;
    source.name = fmt::format("inflow {}", number);
    source.material = f.material;
    source.shape = f.shape;
    try {
      static_cast<void>(fill(scene_, source));
    } catch (const InputError&) {
      error(given(path + "material"),
            fmt::format("the shape of the inflow holds no particle at spacing {} m: enlarge it, or refine scene.spacing",
                        scene_.spacing));
    }
  }

  void material(const Material& m) {
    const auto is_of = [&](const auto& user) { return user.material == m.name; };
    const bool used = std::ranges::any_of(scene_.bodies, is_of) || std::ranges::any_of(scene_.inflows, is_of);
    if (!used)
      return warn(given("material." + m.name + ".name"),
                  fmt::format("no body and no inflow is of material \"{}\": name it in one, or remove it", m.name));
    const std::string path = "material." + m.name + ".";
    for (const EffectRule& rule : effect_rules())
      for (const EffectKey& key : rule.keys)
        if (key.row.table == "material" && (key.limit || value_of(m.values, key.row.name) != 0.0)) material_key(m, rule, key);
    if (!calls("fracture")) return;
    const bool printed = any_mode([](const Scene& s) { return s.mode_of(term::elastic) == Mode::paper; });
    if (m.fracture_distance && !m.fracture_stretch && !printed)
      error(given(path + "fracture_distance"),
            fmt::format("fracture_distance is the limit of the printed form, and this case runs the corrected one, in which "
                        "\"{}\" never breaks: give fracture_stretch",
                        m.name));
    if (m.fracture_stretch && !m.fracture_distance && !corrected(term::elastic))
      error(given(path + "fracture_stretch"),
            fmt::format("fracture_stretch is the limit of the corrected form, and this case runs the printed one, in which "
                        "\"{}\" never breaks: give fracture_distance",
                        m.name));
  }

  void material_key(const Material& m, const EffectRule& rule, const EffectKey& key) {
    const auto place = given(fmt::format("material.{}.{}", m.name, key.row.name));
    if (place.file.empty()) return;
    const bool on = calls(std::string(rule.name));
    if (on && (!key.idle || any_mode([&](const Scene& run) { return key.idle(run).empty(); }))) return;
    warn(place, fmt::format("{} of material \"{}\" never acts: {}", key.row.name, m.name,
                            on ? key.idle(scenes_.front()) : why_idle(std::string(rule.name))));
  }

  void idle(const char* key, const std::string& why) {
    if (const auto place = given(std::string("scene.") + key); !place.file.empty())
      warn(place, fmt::format("scene.{} changes nothing: {}; remove it", key, why));
  }

  void scene() {
    const Scene& s = case_.scene;
    if (!calls("fluid")) idle("clamp", why_idle("fluid"));
    for (const EffectRule& rule : effect_rules())
      for (const EffectKey& key : rule.keys)
        if (key.row.table == "scene" && asks(s, key)) effect_key(rule, key);
    const bool breaks_up = calls("fracture") || std::ranges::any_of(s.events, [](const Event& e) {
                             return e.kind == Event::Kind::merge || e.kind == Event::Kind::split;
                           });
    if (!calls("phase") && !breaks_up && std::ranges::all_of(s.bodies, [](const Body& b) { return b.joined_to.empty(); }))
      idle("merge_distance", why_idle("phase"));
    for (const DeclaredTerm& one : declared_terms())
      if (const auto given = s.modes_given.find(one.term);
          given != s.modes_given.end() && given->second != s.mode && !acts(one.term))
        idle(fmt::format("modes.{}", one.term.name).c_str(), "no effect of this scene has that term");
  }

  /// Whether the scene wants what the key stands for: else there is nothing to miss. A number that is not 0 by default may be 0.
  static bool asks(const Scene& s, const EffectKey& key) {
    const auto kept = [&](const auto& member) {
      using Member = std::decay_t<decltype(member)>;
      if constexpr (std::is_same_v<Member, std::monostate>)
        return kept_number(s.values, key.row) != 0.0 || kept_number({}, key.row) != 0.0;
      else if constexpr (requires { s.*member; })
        return s.*member != Scene{}.*member;
      else
        return false;
    };
    return std::visit(kept, key.kept_in);
  }

  void effect_key(const EffectRule& rule, const EffectKey& key) {
    const auto name = std::string(key.row.name);
    if (!calls(std::string(rule.name)))
      idle(name.c_str(), why_idle(std::string(rule.name)));
    else if (key.idle && !any_mode([&](const Scene& run) { return key.idle(run).empty(); }))
      idle(name.c_str(), key.idle(scenes_.front()));
  }

  [[nodiscard]] bool acts(const Term& one) const {
    return acts_everywhere(one) || std::ranges::any_of(effect_rules(), [&](const EffectRule& rule) {
             return reads_term(rule, one) && calls(std::string(rule.name));
           });
  }

  void judgement() {
    const bool exact = std::ranges::any_of(case_.engines, [](const EngineChoice& e) { return e.name == "exact"; });
    const auto reads_it = [](const MetricChoice& m) { return !m.reference && m.norm != Norm::drift; };
    if (const auto place = given("reference.function");
        !place.file.empty() && !exact && !case_.metrics.empty() && std::ranges::none_of(case_.metrics, reads_it))
      warn(place,
           "[reference] is compared with nothing: each metric has a reference of its own, or measures a drift from the start");
    for (const MetricChoice& m : case_.metrics) {
      const auto place = given("metric." + m.name + ".at");
      const bool in_space = is_spatial(m.norm);
      if (!place.file.empty() && m.at != "end" && !in_space)
        warn(place, fmt::format("metric \"{}\": the norm {} is over all output times of the window, and reads no `at`: give a "
                                "window, or a norm in space (L1 L2 L2raw Linf chi)",
                                m.name, m.norm));
      if (const auto from = given("metric." + m.name + ".window"); !from.file.empty() && in_space && m.at != "all")
        warn(from, fmt::format("metric \"{}\": the norm {} is taken at `at` = \"{}\", and reads no window: write at = \"all\", "
                               "or remove the window",
                               m.name, m.norm, m.at));
    }
    for (const Gate& g : case_.gates) can_fail(g);
    for (std::size_t n = 0; n < case_.studies.size(); ++n) {
      const Study& s = case_.studies[n];
      const bool random = s.jitter > 0.0 || scene_.jitter > 0.0 || std::ranges::any_of(case_.engines, [](const EngineChoice& e) {
                            return e.name == "lammps" || e.settings.size() > e.settings.count("refuses");
                          });
      if (s.seeds > 1 && !random)
        warn(s.place, fmt::format("the study makes {} runs a level that differ by the seed alone, and nothing is random without "
                                  "jitter: give it a jitter, or remove seeds",
                                  s.seeds));
    }
  }

  /// A limit below 0 passes nothing; a floor of 0 under what is never negative passes anything.
  void can_fail(const Gate& g) {
    if (g.metric.ends_with(".order")) return;
    if (g.limit && *g.limit < 0.0)
      error(g.place, fmt::format("the gate on \"{}\" has limit {}, which nothing can pass: a limit is of the magnitude, which is "
                                 "never below 0; write a positive number, or a band",
                                 g.metric, *g.limit));
    const auto m = std::ranges::find(case_.metrics, g.metric, &MetricChoice::name);
    static constexpr std::array of_sizes{Norm::L1,  Norm::L2,  Norm::L2raw, Norm::L2mean,
                                         Norm::max, Norm::rms, Norm::drift, Norm::chi};
    const bool never_negative = m != case_.metrics.end() && std::ranges::find(of_sizes, m->norm) != of_sizes.end();
    if (never_negative && g.at_least && *g.at_least <= 0.0 && !g.limit && !g.band)
      error(g.place, fmt::format("the gate on \"{}\" passes anything: at least {} is asked, and the norm {} is never below 0; "
                                 "write a positive number, or a limit",
                                 g.metric, *g.at_least, m->norm));
  }

  const CaseReading& reading_;
  const Case& case_;
  const Scene& scene_;
  const InitialState& state_;
  std::vector<Scene> scenes_;  ///< one a mode of the case
  std::vector<Finding> findings_;
};

}  // namespace

std::vector<Finding> idle_keys(const CaseReading& reading, const Scene& scene, const InitialState& state) {
  return IdleKeys(reading, scene, state).run();
}

}  // namespace tripoint

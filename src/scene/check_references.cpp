// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/nearest.hpp"
#include "scene/phase_values.hpp"
#include "scene/readers.hpp"

/// Rules between the tables of a case: names that refer to each other, and what one key means for another.
namespace tripoint {
namespace {

template <class T>
std::vector<std::string> names_of(const std::vector<T>& list) {
  std::vector<std::string> names;
  for (const auto& t : list) names.push_back(t.name);
  return names;
}

bool holds(const std::vector<std::string>& list, const std::string& name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

class Checker {
 public:
  Checker(const Case& c, const Reading& reading) : case_(c), scene_(c.scene), reading_(reading) {}

  void check() {
    unique(scene_.materials, "material");
    unique(scene_.bodies, "body");
    unique(case_.metrics, "metric");
    bodies();
    events();
    kernel();
    printed_heat();
    judgement();
  }

 private:
  /// Place of a key that was given, else of its table.
  [[nodiscard]] SourcePlace place(const std::string& key, const SourcePlace& table) const {
    for (const auto& d : reading_.decisions)
      if (d.key == key && d.given) return d.place;
    return table.line > 0 || !table.file.empty() ? table : SourcePlace{case_.file, 0, 0};
  }

  template <class T>
  void unique(const std::vector<T>& list, const char* table) const {
    for (std::size_t i = 0; i < list.size(); ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (list[i].name == list[j].name)
          throw InputError(second_place(fmt::format("{}.{}.name", table, list[i].name)),
                           fmt::format("two tables [[{}]] are named \"{}\": rename one", table, printable(list[i].name)));
  }
  [[nodiscard]] SourcePlace second_place(const std::string& key) const {
    SourcePlace p{case_.file, 0, 0};
    for (const auto& d : reading_.decisions)
      if (d.key == key && d.given) p = d.place;
    return p;
  }

  void known_body(const std::string& name, const std::string& key, const SourcePlace& table,
                  const std::vector<std::string>& also = {}) const {
    auto known = names_of(scene_.bodies);
    known.insert(known.end(), also.begin(), also.end());
    if (!holds(known, name))
      throw InputError(place(key, table),
                       fmt::format("`{}`: no body is named \"{}\"{}", key, printable(name), suggestion(name, known)));
  }

  void bodies() const {
    for (const auto& b : scene_.bodies) {
      for (const auto& other : b.joined_to) {
        known_body(other, fmt::format("body.{}.joined_to", b.name), b.place);
        if (other == b.name)
          throw InputError(place(fmt::format("body.{}.joined_to", b.name), b.place),
                           fmt::format("body \"{}\" is joined to itself: remove it", b.name));
      }
      turning(b);
      const Material& m = scene_.material(b.material);
      if (b.temperature && !(m.conductivity && m.heat_capacity))
        throw InputError(place(fmt::format("body.{}.temperature", b.name), b.place),
                         fmt::format("body \"{}\" has a temperature, but its material \"{}\" lacks {}: give it (a conductivity "
                                     "of 1e-12 W/m/K insulates), or remove the temperatures of all bodies",
                                     b.name, m.name, m.conductivity ? "heat_capacity" : "conductivity"));
      if (!b.keyframes.empty() && b.keyframes.back().time < scene_.end_time && b.keyframes.size() < 2)
        throw InputError(place(fmt::format("body.{}.keyframes", b.name), b.place),
                         fmt::format("body \"{}\" has one keyframe: give at least two, the motion lies between them", b.name));
    }
  }

  /// A kernel of its own form belongs to each term: alone it cannot be another than what the scene runs.
  void kernel() const {
    const auto given = scene_.modes_given[static_cast<std::size_t>(Term::kernel)];
    if (!given || std::all_of(case_.modes.begin(), case_.modes.end(), [&](Mode m) { return m == *given; })) return;
    throw InputError(place("scene.modes.kernel", {}),
                     "each term brings the kernel of its form (as printed poly6, spiky and the viscosity kernel, corrected "
                     "Wendland C2), and none can have another: "
                     "set the terms that are meant (modes.density, modes.pressure, modes.viscosity, modes.heat), or remove it");
  }

  /// (21) and Fig. 5 as printed know one conductivity and one heat capacity of a material.
  void printed_heat() const {
    const bool paper = std::any_of(case_.modes.begin(), case_.modes.end(), [](Mode m) { return m == Mode::paper; });
    for (const Term term : {Term::heat, Term::phase}) {
      const auto given = scene_.modes_given[static_cast<std::size_t>(term)];
      if (given ? *given != Mode::paper : !paper) continue;
      for (const auto& b : scene_.bodies) {
        const Material& m = scene_.material(b.material);
        if (!b.temperature || !has_two_phases(m)) continue;
        throw InputError(
            place(fmt::format("material.{}.{}", m.name, m.solid_conductivity ? "solid_conductivity" : "solid_heat_capacity"),
                  b.place),
            fmt::format("heat as printed knows one conductivity and one heat capacity of a material, and \"{}\" has others when "
                        "solid: write modes.{} = \"corrected\", or leave solid_conductivity and solid_heat_capacity out",
                        m.name, to_string(term)));
      }
    }
  }

  /// A rigid body that reaches across a periodic direction may only turn about that axis: else it would not meet itself.
  void turning(const Body& b) const {
    if (b.phase != Phase::rigid || b.angular_velocity == Vec3{}) return;
    for (std::size_t a = 0; a < 3; ++a) {
      if (!scene_.periodic[a] || b.shape.kind != Shape::Kind::box) continue;
      const bool across = b.shape.max[a] - b.shape.min[a] >= 0.999 * ((*scene_.max)[a] - (*scene_.min)[a]);
      Vec3 other = b.angular_velocity;
      other[a] = 0.0;
      if (across && norm(other) > 0.0)
        throw InputError(place(fmt::format("body.{}.angular_velocity", b.name), b.place),
                         fmt::format("body \"{}\" reaches across the periodic direction {}: it can turn only about that axis",
                                     b.name, "xyz"[a]));
    }
  }

  void events() const {
    std::vector<std::string> born;
    for (const auto& e : scene_.events)
      if (!e.name.empty()) born.push_back(e.name);
    std::size_t n = 0;
    std::vector<std::pair<std::string, double>> absorbed;
    for (const auto& e : scene_.events)
      for (std::size_t k = 1; e.kind == Event::Kind::merge && k < e.bodies.size(); ++k)
        absorbed.emplace_back(e.bodies[k], e.time);
    for (const auto& e : scene_.events) {
      ++n;
      const auto path = e.name.empty() ? fmt::format("event.{}", n) : "event." + e.name;
      for (const auto& name : e.bodies) known_body(name, path + ".bodies", e.place, born);
      acts_on(e, path);
      if (e.time > scene_.end_time)
        throw InputError(place(path + ".time", e.place),
                         fmt::format("the event at {} s never comes: end_time is {} s; remove it, or lengthen the run", e.time,
                                     scene_.end_time));
      for (const auto& [name, time] : absorbed)
        if (e.time > time && holds(e.bodies, name))
          throw InputError(
              place(path + ".bodies", e.place),
              fmt::format("body \"{}\" is absorbed by a merge at {} s and is no more at {} s: name the body that absorbs it",
                          printable(name), time, e.time));
      if (e.kind == Event::Kind::heat &&
          std::none_of(scene_.bodies.begin(), scene_.bodies.end(), [](const Body& b) { return b.temperature.has_value(); }))
        throw InputError(place(path + ".temperature", e.place),
                         "no body has a temperature, so that nothing can be heated: give every body one");
      if (e.kind == Event::Kind::split && holds(names_of(scene_.bodies), e.name))
        throw InputError(
            place(path + ".name", e.place),
            fmt::format("a body \"{}\" exists already: give the part that splits off another name", printable(e.name)));
    }
    n = 0;
    for (const auto& f : scene_.inflows) {
      ++n;
      if (f.start >= scene_.end_time)
        throw InputError(
            place(fmt::format("inflow.{}.start", n), {}),
            fmt::format("nothing flows in before end_time = {} s, since start = {} s: begin sooner, or remove the inflow",
                        scene_.end_time, f.start));
      if (!holds(names_of(scene_.materials), f.material))
        throw InputError(place(fmt::format("inflow.{}.material", n), {}),
                         fmt::format("no material is named \"{}\"{}", printable(f.material),
                                     suggestion(f.material, names_of(scene_.materials))));
    }
  }

  /// Bodies that this kind of event cannot act on, or only as what they are not.
  void acts_on(const Event& e, const std::string& path) const {
    for (const auto& b : scene_.bodies) {
      if (!holds(e.bodies, b.name)) continue;
      const auto refuse = [&](const std::string& why) {
        throw InputError(place(path + ".bodies", e.place), fmt::format("body \"{}\" {}", b.name, why));
      };
      if ((e.kind == Event::Kind::merge || e.kind == Event::Kind::split) && b.phase == Phase::liquid)
        refuse("is liquid: only solids merge and split");
      if (e.kind == Event::Kind::release && b.phase == Phase::elastic && b.motion != Motion::free)
        refuse(
            "is elastic, and moves as a whole as long as its motion is not free, also after a release: make it free, and hold it "
            "by an event until then");
    }
  }

  void known_engine(const std::string& name, const std::string& key, const SourcePlace& table) const {
    if (name.empty() || case_.engines.empty()) return;  // no [engines]: whatever engine is there runs
    const auto known = names_of(case_.engines);
    if (!holds(known, name))
      throw InputError(place(key, table), fmt::format("`{}`: this case runs no engine \"{}\"{}; add [engines.{}]", key,
                                                      printable(name), suggestion(name, known), printable(name)));
  }

  void known_metric(std::string name, const std::string& key, const SourcePlace& table) const {
    const auto known = names_of(case_.metrics);
    if (holds(known, name)) return;
    std::string of = name;
    for (const std::string_view what : {".order", ".statistical"}) {
      if (of.ends_with(what)) of.resize(of.size() - what.size());
      if (holds(known, of)) return;
    }
    throw InputError(place(key, table),
                     fmt::format("`{}`: no [[metric]] is named \"{}\"{}", key, printable(name), suggestion(name, known)));
  }

  void judgement() const {
    std::size_t n = 0;
    for (const auto& m : case_.metrics) {
      if (!m.body.empty()) {
        std::vector<std::string> born;
        for (const auto& e : scene_.events)
          if (!e.name.empty()) born.push_back(e.name);
        known_body(m.body, fmt::format("metric.{}.body", m.name), m.place, born);
      }
      if (m.window[0] > scene_.end_time)
        throw InputError(place(fmt::format("metric.{}.window", m.name), m.place),
                         fmt::format("the window begins after end_time = {} s", scene_.end_time));
    }
    for (const auto& s : case_.studies) {
      const auto path = fmt::format("study.{}", ++n);
      known_engine(s.engine, path + ".engine", s.place);
      if (!s.metric.empty()) known_metric(s.metric, path + ".metric", s.place);
      if (s.mode != "not paper") known_mode(s.mode, path + ".mode", s.place);
    }
    n = 0;
    for (const auto& g : case_.gates) gate(g, fmt::format("gate.{}", ++n));
    n = 0;
    for (const auto& d : case_.defects) {
      const auto path = fmt::format("defect.{}", ++n);
      for (const auto& metric : d.killed_by) known_metric(metric, path + ".killed_by", d.place);
    }
  }

  void known_mode(const std::string& mode, const std::string& key, const SourcePlace& table) const {
    if (mode.empty()) return;
    if (mode != "corrected" && mode != "paper")
      throw InputError(place(key, table),
                       fmt::format("`{}`: unknown mode \"{}\": write corrected, paper or \"not paper\"", key, printable(mode)));
    if (std::find(case_.modes.begin(), case_.modes.end(), mode_from(mode)) == case_.modes.end())
      throw InputError(place(key, table),
                       fmt::format("`{}`: this case does not run mode \"{}\": add it to case.modes", key, mode));
  }

  void gate(const Gate& g, const std::string& path) const {
    known_metric(g.metric, path + ".metric", g.place);
    known_engine(g.engine, path + ".engine", g.place);
    if (g.mode != "not paper") known_mode(g.mode, path + ".mode", g.place);
    known_defect(g, path);
    if (g.metric.ends_with(".order") && case_.studies.empty() && !holds(names_of(case_.metrics), g.metric))
      throw InputError(place(path + ".metric", g.place),
                       fmt::format("`{}.metric`: \"{}\" needs a [[study]] to find an order with", path, printable(g.metric)));
    if (!g.level) return;
    for (const auto& s : case_.studies)
      if (std::any_of(s.levels.begin(), s.levels.end(), [&](double l) { return std::abs(l - *g.level) <= 1e-9 * l; })) return;
    throw InputError(
        place(path + ".level", g.place),
        fmt::format("`{}.level` = {}: no [[study]] has this level: write one of its levels, or remove it", path, *g.level));
  }

  /// "known defect NAME: ..." declares a defect of the engine. It is that of a named engine, is measured from below too, and
  /// excuses from a limit that is there.
  void known_defect(const Gate& g, const std::string& path) const {
    static constexpr std::string_view head = "known defect ";
    const auto end = g.reason.find_first_of(" :", head.size());
    if (!g.reason.starts_with(head) || end == std::string::npos || g.reason[end] != ':') return;
    const auto refuse = [&](const std::string& what) {
      throw InputError(place(path + ".reason", g.place), fmt::format("`{}.reason`: {}", path, what));
    };
    if (g.engine.empty() || !(g.band || g.at_least))
      refuse("a known defect is that of a named engine, and measured from below too: give engine, and band or at_least");
    if (std::none_of(case_.gates.begin(), case_.gates.end(),
                     [&](const Gate& a) { return a.engine.empty() && a.metric == g.metric; }))
      refuse(fmt::format("no gate without engine is on \"{}\": there is no limit to be excused from", printable(g.metric)));
  }

  const Case& case_;
  const Scene& scene_;
  const Reading& reading_;
};

}  // namespace

void check_references(const Case& c, const Reading& reading) { Checker(c, reading).check(); }

}  // namespace tripoint

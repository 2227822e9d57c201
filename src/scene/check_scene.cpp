// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scene/geometry.hpp"
#include "scene/joint_checks.hpp"
#include "scene/name_checks.hpp"
#include "scene/phase_values.hpp"
#include "scene/readers.hpp"
#include "scene/shared_terms.hpp"
#include "tables/nearest.hpp"

/// Rules between the tables of a scene: names that refer to each other, and the effect of one key on another.
namespace tripoint {
namespace {

class Checker : NameChecks {
 public:
  Checker(const Scene& scene, const std::vector<Mode>& runs, const Reading& reading)
      : NameChecks(reading), scene_(scene), runs_(runs), reading_(reading) {}

  void check() {
    unique(scene_.materials, "material");
    unique(scene_.bodies, "body");
    bodies();
    events();
    contact_laws();
    forces();
    springs();
    JointChecks(scene_, reading_).check();
    weights();
    sources();
    kernel();
    printed_heat();
  }

 private:
  void bodies() const {
    for (const auto& b : scene_.bodies) {
      for (const auto& other : b.joined_to) {
        known_body(scene_, other, fmt::format("body.{}.joined_to", b.name), b.place);
        if (other == b.name)
          throw InputError(place(fmt::format("body.{}.joined_to", b.name), b.place),
                           fmt::format("body \"{}\" is joined to itself: remove it", b.name));
      }
      turning(b);
      const Material& m = scene_.material(b.material);
      if (b.temperature && !(m.conductivity && m.heat_capacity))
        throw InputError(
            place(fmt::format("body.{}.temperature", b.name), b.place),
            fmt::format(
                "body \"{}\" has a temperature, but its material \"{}\" lacks {}: give it (a conductivity "
                "of 1e-12 W/m/K insulates), or remove the temperatures of all bodies",
                b.name, m.name, m.conductivity ? "heat_capacity" : "conductivity"));
      if (!b.keyframes.empty() && b.keyframes.back().time < scene_.end_time && b.keyframes.size() < 2)
        throw InputError(
            place(fmt::format("body.{}.keyframes", b.name), b.place),
            fmt::format("body \"{}\" has one keyframe: give at least two, the motion lies between them",
                        b.name));
    }
  }

  /// A kernel of its own form belongs to each term: alone it cannot differ from that of the scene.
  void kernel() const {
    const auto given = scene_.modes_given.find(term::kernel);
    if (given == scene_.modes_given.end() ||
        std::ranges::all_of(runs_, [&](Mode m) { return m == given->second; }))
      return;
    throw InputError(place("scene.modes.kernel", {}),
                     "each term brings the kernel of its form (as printed poly6, spiky and the viscosity "
                     "kernel, corrected "
                     "Wendland C2), and none can have another: "
                     "set the terms that are meant (model.density, model.pressure, model.viscosity, "
                     "model.heat), or remove it");
  }

  /// (21) and Fig. 5 as printed know one conductivity and one heat capacity of a material.
  void printed_heat() const {
    const bool paper = std::any_of(runs_.begin(), runs_.end(), [](Mode m) { return m == Mode::paper; });
    for (const Term& one : {term::heat, term::phase}) {
      const auto given = scene_.modes_given.find(one);
      if (given != scene_.modes_given.end() ? given->second != Mode::paper : !paper) continue;
      for (const auto& b : scene_.bodies) {
        const Material& m = scene_.material(b.material);
        if (!b.temperature || !has_two_phases(m)) continue;
        throw InputError(
            place(fmt::format("material.{}.{}", m.name,
                              m.solid_conductivity ? "solid_conductivity" : "solid_heat_capacity"),
                  b.place),
            fmt::format("heat as printed knows one conductivity and one heat capacity of a material, and "
                        "\"{}\" has others when "
                        "solid: let model.{} be corrected in every mode of case.modes, or leave "
                        "solid_conductivity and solid_heat_capacity out",
                        m.name, one.name));
      }
    }
  }

  /// A rigid body that reaches across a periodic direction may only turn about that axis: else it would not
  /// meet itself.
  void turning(const Body& b) const {
    if (b.phase != Phase::rigid || b.angular_velocity == Vec3{}) return;
    for (std::size_t a = 0; a < 3; ++a) {
      if (!scene_.periodic[a] || !is_upright_box(b.shape)) continue;
      const bool across = b.shape.max[a] - b.shape.min[a] >= 0.999 * ((*scene_.max)[a] - (*scene_.min)[a]);
      Vec3 other = b.angular_velocity;
      other[a] = 0.0;
      if (across && norm(other) > 0.0)
        throw InputError(
            place(fmt::format("body.{}.angular_velocity", b.name), b.place),
            fmt::format(
                "body \"{}\" reaches across the periodic direction {}: it can turn only about that axis",
                b.name, "xyz"[a]));
    }
  }

  void events() const {
    std::vector<std::string> born;
    for (const auto& e : scene_.events)
      if (!e.name.empty()) born.push_back(e.name);
    const std::vector<Absorbed> absorbed = absorbed_bodies();
    std::size_t n = 0;
    for (const auto& e : scene_.events) {
      ++n;
      const auto path = e.name.empty() ? fmt::format("event.{}", n) : "event." + e.name;
      for (const auto& name : e.bodies) known_body(scene_, name, path + ".bodies", e.place, born);
      acts_on(e, path);
      event_comes(e, path);
      for (const Absorbed& one : absorbed) names_present(e, path, one);
      event_has_its_means(e, path);
    }
    for (n = 0; n < scene_.inflows.size(); ++n) inflow(scene_.inflows[n], n + 1);
  }

  struct Absorbed {
    std::string body;
    double time;
  };
  [[nodiscard]] std::vector<Absorbed> absorbed_bodies() const {
    std::vector<Absorbed> list;
    for (const auto& e : scene_.events)
      for (std::size_t k = 1; e.kind == Event::Kind::merge && k < e.bodies.size(); ++k)
        list.push_back({e.bodies[k], e.time});
    return list;
  }
  void event_comes(const Event& e, const std::string& path) const {
    if (e.time > scene_.end_time)
      throw InputError(
          place(path + ".time", e.place),
          fmt::format("the event at {} s never comes: end_time is {} s; remove it, or lengthen the run",
                      e.time, scene_.end_time));
  }
  void names_present(const Event& e, const std::string& path, const Absorbed& absorbed) const {
    if (e.time > absorbed.time && holds(e.bodies, absorbed.body))
      throw InputError(place(path + ".bodies", e.place),
                       fmt::format("body \"{}\" is absorbed by a merge at {} s and is no more at {} s: "
                                   "name the body that absorbs it",
                                   printable(absorbed.body), absorbed.time, e.time));
  }
  void event_has_its_means(const Event& e, const std::string& path) const {
    if (e.kind == Event::Kind::heat &&
        std::ranges::none_of(scene_.bodies, [](const Body& b) { return b.temperature.has_value(); }))
      throw InputError(place(path + ".temperature", e.place),
                       "no body has a temperature, so that nothing can be heated: give every body one");
    if (e.kind == Event::Kind::split && holds(names_of(scene_.bodies), e.name))
      throw InputError(place(path + ".name", e.place),
                       fmt::format("a body \"{}\" exists already: give the part that splits off another name",
                                   printable(e.name)));
  }
  void inflow(const Inflow& f, std::size_t number) const {
    if (f.start >= scene_.end_time)
      throw InputError(place(fmt::format("inflow.{}.start", number), {}),
                       fmt::format("nothing flows in before end_time = {} s, since start = {} s: begin "
                                   "sooner, or remove the inflow",
                                   scene_.end_time, f.start));
    if (!holds(names_of(scene_.materials), f.material))
      throw InputError(place(fmt::format("inflow.{}.material", number), {}),
                       fmt::format("no material is named \"{}\"{}", printable(f.material),
                                   suggestion(f.material, names_of(scene_.materials))));
  }

  void contact_laws() const {
    std::vector<std::vector<std::string>> pairs;
    for (std::size_t n = 0; n < scene_.contact_laws.size(); ++n) {
      const ContactLaw& law = scene_.contact_laws[n];
      const auto where = place(fmt::format("contact.{}.materials", n + 1), law.place);
      for (const auto& name : law.materials)
        if (!holds(names_of(scene_.materials), name))
          throw InputError(where, fmt::format("no material is named \"{}\"{}", printable(name),
                                              suggestion(name, names_of(scene_.materials))));
      auto pair = law.materials;
      std::ranges::sort(pair);
      if (std::ranges::find(pairs, pair) != pairs.end())
        throw InputError(
            where, fmt::format("\"{}\" and \"{}\" have a [[contact]] already: write one of a pair", pair[0],
                               pair[1]));
      pairs.push_back(std::move(pair));
    }
  }

  void forces() const {
    for (std::size_t n = 0; n < scene_.forces.size(); ++n) {
      const AppliedForce& force = scene_.forces[n];
      const auto path = fmt::format("force.{}.body", n + 1);
      known_body(scene_, force.body, path, force.place);
      const Body& b = scene_.body(force.body);
      if (b.phase != Phase::rigid || b.motion != Motion::free)
        throw InputError(place(path, force.place),
                         fmt::format("\"{}\" is {}: a force acts on a free rigid body", b.name,
                                     b.phase == Phase::rigid ? to_string(b.motion) : to_string(b.phase)));
      if (scene_.material(b.material).t_melt || std::ranges::any_of(scene_.events, [](const Event& e) {
            return e.kind == Event::Kind::merge || e.kind == Event::Kind::split;
          }))
        throw InputError(place(path, force.place),
                         "a force acts on a body that stays one: remove the events of merge and split, or "
                         "t_melt of its material");
    }
  }

  void springs() const {
    for (std::size_t n = 0; n < scene_.springs.size(); ++n) {
      const Spring& s = scene_.springs[n];
      const auto path = fmt::format("spring.{}", n + 1);
      known_body(scene_, s.body, path + ".body", s.place);
      if (s.other != "world") known_body(scene_, s.other, path + ".other", s.place);
      for (const auto& b : scene_.bodies) {
        if (b.name != s.body && b.name != s.other) continue;
        if (b.phase != Phase::rigid || (b.name == s.body && b.motion != Motion::free))
          throw InputError(
              place(path, s.place),
              fmt::format("\"{}\" is {}: a spring holds a free rigid body to a rigid one or to "
                          "the world",
                          b.name, b.phase == Phase::rigid ? to_string(b.motion) : to_string(b.phase)));
      }
      if (std::ranges::any_of(scene_.events, [](const Event& e) {
            return e.kind == Event::Kind::merge || e.kind == Event::Kind::split;
          }))
        throw InputError(
            place(path, s.place),
            "a spring holds bodies that stay what they are: remove the events of merge and split");
    }
  }

  /// Masses and moments that are given.
  void weights() const {
    for (const auto& b : scene_.bodies) {
      const bool given = b.mass || b.centre || b.inertia;
      if (!given && !b.shape_mass) continue;
      const auto refuse = [&](const std::string& why) {
        throw InputError(b.place, fmt::format("body \"{}\" {}", b.name, why));
      };
      if (b.phase != Phase::rigid)
        refuse("is not rigid: mass, centre, inertia and shape_mass are of rigid bodies");
      if (b.mass &&
          std::ranges::any_of(scene_.bodies, [](const Body& one) { return one.phase == Phase::liquid; }))
        refuse("has a mass beside liquid, which feels a body by its density: give its material the density");
      if (scene_.jitter > 0.0 && b.jitters)
        refuse("has a given mass and particles that are shifted at random: write jitters = false");
    }
  }

  void sources() const {
    for (std::size_t n = 0; n < scene_.sources.size(); ++n) {
      const HeatSource& s = scene_.sources[n];
      const auto path = fmt::format("source.{}", n + 1);
      for (const auto& name : s.bodies) known_body(scene_, name, path + ".bodies", s.place);
      if (s.start >= scene_.end_time)
        throw InputError(place(path + ".start", s.place),
                         fmt::format("it begins at {} s, and end_time is {} s: begin sooner, or remove it",
                                     s.start, scene_.end_time));
      if (std::ranges::none_of(scene_.bodies, [](const Body& b) { return b.temperature.has_value(); }))
        throw InputError(place(path, s.place),
                         "no body has a temperature, so that nothing can be heated: give every body one");
    }
  }

  /// Refuses bodies that this kind of event cannot act on as they are.
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
            "is elastic, and moves as a whole as long as its motion is not free, also after a release: make "
            "it free, and hold it "
            "by an event until then");
    }
  }

  const Scene& scene_;
  const std::vector<Mode>& runs_;
  const Reading& reading_;
};

}  // namespace

void check_scene(const Scene& scene, const std::vector<Mode>& runs, const Reading& reading) {
  Checker(scene, runs, reading).check();
}

}  // namespace tripoint

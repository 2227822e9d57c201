// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <utility>

#include "adapters/scenes.hpp"
#include "scene/shared_terms.hpp"

/// Scenes in which bonds, bodies, phases or particles change, in the middle and elsewhere along x: what is
/// decided of the whole.
namespace tripoint::test {

/// A brittle bar with a neck, whose ends fly apart as it flies along x; one has a rigid cap.
inline Prepared brittle_bar(bool flows, Mode mode) {
  Scene s;
  s.spacing = 0.01;
  s.jitter = 0.05;
  s.modes[term::elastic] = mode;
  Material brittle = material(1000.0);
  brittle.solid = SolidKind::elastic;
  brittle.young_modulus = 1e6;
  brittle.poisson_ratio = 0.3;
  brittle.fracture_stretch = 1.1;
  brittle.fracture_distance = 2.1;
  brittle.stiffness = 100.0;
  if (flows) brittle.elastic_limit = 0.01;
  s.materials = {brittle};
  Shape neck;
  neck.kind = Shape::Kind::unite;
  neck.of = {box({-0.07, -0.02, -0.02}, {-0.01, 0.02, 0.02}), box({-0.01, -0.01, -0.01}, {0.01, 0.01, 0.01}),
             box({0.01, -0.02, -0.02}, {0.07, 0.02, 0.02})};
  Body bar = rigid("bar", neck);
  bar.phase = Phase::elastic;
  bar.joined_to = {"cap"};
  s.bodies = {bar, rigid("cap", box({0.07, -0.02, -0.02}, {0.09, 0.02, 0.02}))};
  Prepared p = prepare(s, 0.02, 1);
  for (std::size_t i = 0; i < p.initial.size(); ++i) {
    const Vec3 r = p.initial.position[i];
    p.initial.velocity[i] = {2.0 + 25.0 * r.x, 1.0 - 5.0 * r.z, 5.0 * r.y};
  }
  return p;
}

/// A bar that flies along x, and rings at one end at a step beyond its bound, which is forced: guards send it
/// back, early and past the middle.
inline Prepared ringing_bar() {
  Scene s;
  s.spacing = 1.0;
  s.time_step = 0.04;
  s.recovers = true;
  s.min = Vec3{-10.0, -10.0, -10.0};
  s.max = Vec3{60.0, 14.0, 14.0};
  Material rubber = material(1.0);
  rubber.solid = SolidKind::elastic;
  rubber.young_modulus = 1000.0;
  rubber.poisson_ratio = 0.3;
  s.materials = {rubber};
  Body bar = rigid("bar", box({0.0, 0.0, 0.0}, {12.0, 4.0, 4.0}));
  bar.phase = Phase::elastic;
  s.bodies = {bar};
  Prepared p = prepare(s, 8.0, 2);
  for (std::size_t i = 0; i < p.initial.size(); ++i) {
    const Vec3 r = p.initial.position[i] - Vec3{9.0, 2.0, 2.0};
    const double rings = r.x > 0.0 ? 1.0 : 0.0;
    p.initial.velocity[i] = {5.0 + rings * (0.4 * r.x + 0.1 * r.y), rings * (0.1 * r.z - 0.3 * r.y),
                             -0.1 * rings * r.z};
  }
  p.job.settings["force_time_step"] = true;
  return p;
}

inline Material wax(double latent_heat) {
  Material m = material(1000.0);
  m.solid = SolidKind::rigid;
  m.stiffness = 600.0;
  m.conductivity = 20.0;
  m.heat_capacity = 1000.0;
  m.t_melt = 350.0;
  m.t_solid = 345.0;
  m.latent_heat = latent_heat;
  return m;
}

inline TemperatureField constant(double T) {
  TemperatureField field;
  field.value = T;
  return field;
}

/// Two blocks that tumble past a film of liquid, which they cool: it freezes, and they are one. A third one
/// is hot in its middle, which melts: it is two.
inline Prepared merging_and_splitting(SolidKind solid) {
  Scene s;
  s.spacing = 1e-3;
  Material m = wax(5e3);
  m.solid = solid;
  if (solid == SolidKind::elastic) {
    m.young_modulus = 4e3;
    m.poisson_ratio = 0.3;
  }
  s.materials = {m};
  s.merge_distance = 1.5;
  const Phase phase = solid == SolidKind::elastic ? Phase::elastic : Phase::rigid;
  Body left =
      rigid("left", box({-0.005, -0.002, -0.002}, {-0.001, 0.002, 0.002}), {{0.4, 0, 0}, {0, 2.0, 0}});
  Body film = rigid("film", box({-0.001, -0.001, -0.001}, {0.001, 0.001, 0.001}), {{0.4, 0, 0}, {}});
  Body right =
      rigid("right", box({0.001, -0.002, -0.001}, {0.004, 0.002, 0.003}), {{0.39, 0.03, 0}, {0, 0, -3.0}});
  Body bar = rigid("bar", box({-0.004, 0.006, 0}, {0.005, 0.009, 0.003}), {{0.4, 0, 0}, {0, 0, 5.0}});
  left.phase = right.phase = bar.phase = phase;
  film.phase = Phase::liquid;
  left.temperature = right.temperature = constant(300.0);
  film.temperature = constant(355.0);
  bar.temperature = constant(300.0);
  s.bodies = {left, film, right, bar};
  Prepared p = prepare(s, 0.02, 1);
  for (std::size_t i = 0; i < p.initial.size(); ++i) {
    const double x = p.initial.position[i].x - 0.0005;
    if (p.initial.source[i] == 3) p.initial.temperature[i] = 300.0 + 120.0 * std::exp(-x * x / 4e-7);
  }
  return p;
}

/// Warm rubber that swings: what softens stores less, which is heat.
inline Prepared warm_rubber() {
  Scene s;
  s.spacing = 0.01;
  s.modes[term::phase] = Mode::paper;
  Material m = material(1000.0);
  m.solid = SolidKind::elastic;
  m.young_modulus = 1e5;
  m.poisson_ratio = 0.3;
  m.stiffness = 100.0;
  m.conductivity = 1e3;
  m.heat_capacity = 10.0;
  m.t_melt = 360.0;
  m.t_solid = 320.0;
  s.materials = {m};
  Body bar = rigid("bar", box({0, 0, 0}, {0.12, 0.03, 0.03}), {{0.5, 0, 0}, {0, 0, 20.0}});
  bar.phase = Phase::elastic;
  bar.temperature = constant(330.0);
  s.bodies = {bar};
  Prepared p = prepare(s, 0.02, 1);
  for (std::size_t i = 0; i < p.initial.size(); ++i)
    p.initial.temperature[i] = 300.0 + 400.0 * p.initial.position[i].x;
  return p;
}

/// Liquid flows in beyond all that was there, is held, let go and heated, while bodies are united and parted.
inline Prepared eventful() {
  Scene s;
  s.spacing = 0.01;
  s.gravity = {-2.0, 0, 0};
  Material oil = material(1000.0);
  oil.name = "oil";
  oil.viscosity = 0.5;
  oil.stiffness = 1.5e4;
  oil.conductivity = 100.0;
  oil.heat_capacity = 2000.0;
  s.materials = {material(1000.0), oil};
  s.materials[0].stiffness = 1.5e4;
  s.materials[0].conductivity = 100.0;
  s.materials[0].heat_capacity = 500.0;
  Body drop = rigid("drop", box({0.2, 0, 0}, {0.24, 0.04, 0.04}));
  drop.material = "oil";
  drop.phase = Phase::liquid;
  Body one = rigid("one", box({0.26, 0, 0}, {0.29, 0.04, 0.04}), {{0.5, 0, 0}, {0, 0, 1.0}}),
       two = rigid("two", box({0.30, 0, 0}, {0.33, 0.04, 0.03}), {{0.4, 0, 0}, {}});
  for (Body* b : {&drop, &one, &two}) b->temperature = constant(300.0);
  s.bodies = {drop, one, two};
  Inflow in;
  in.material = "oil";
  in.shape = box({0, 0, 0}, {0.03, 0.04, 0.04});
  in.velocity = {1.0, 0, 0};
  in.temperature = 350.0;
  in.stop = 1.0;
  s.inflows = {in};
  const auto event = [](Event::Kind kind, double time, std::vector<std::string> bodies) {
    Event e;
    e.kind = kind;
    e.time = time;
    e.bodies = std::move(bodies);
    return e;
  };
  Event unite = event(Event::Kind::merge, 0.01, {"one", "two"}),
        hold = event(Event::Kind::hold, 0.02, {"drop"}), warm = event(Event::Kind::heat, 0.025, {"one"}),
        part = event(Event::Kind::split, 0.04, {"one"});
  hold.until = 0.03;
  warm.until = 0.035;
  warm.temperature = 400.0;
  part.name = "piece";
  part.region = box({0.3, -1, -1}, {1, 1, 1});
  s.events = {unite, hold, warm, part};
  return prepare(s, 0.05, 1);
}

}  // namespace tripoint::test

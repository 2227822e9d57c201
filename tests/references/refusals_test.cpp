// SPDX-License-Identifier: BSD-3-Clause
// What each exact solution does not hold for: one change after another of a scene that it does hold for, and the words of the
// refusal.
#include <gtest/gtest.h>

#include <functional>

#include "references/melting.hpp"
#include "references/solids.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {
namespace {

using test::Prepared;
using Change = std::function<void(Prepared&, Settings&)>;

/// The words of the refusal, or none.
std::string refusal(Prepared s, const std::string& function, Settings args, const Change& change) {
  change(s, args);
  try {
    (void)make_reference(test::function(function, args), s.job, s.initial);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

struct Row {
  const char* words;
  Change change;
};

void hold(const std::string& function, const Prepared& s, const Settings& args, const std::vector<Row>& rows) {
  for (const auto& row : rows) {
    const auto said = refusal(s, function, args, row.change);
    if (*row.words)
      EXPECT_NE(said.find(row.words), std::string::npos) << function << ": " << row.words << " / " << said;
    else
      EXPECT_EQ(said, "") << function;
  }
}

const Row as_it_is{"", [](Prepared&, Settings&) {}};
const Row no_gravity{"gravity", [](Prepared& s, Settings&) { s.job.scene.gravity = {}; }};

/// A box of 0.4 m that starts 0.2 m above a floor.
Prepared falling_box() {
  Prepared s;
  s.job.scene.spacing = 0.1;
  s.job.scene.gravity = {0, 0, -10};
  test::add_body(s, "block", {{4, 4, 4}, 0.1, {0, 0, 0.2}, 2.0}, {});
  test::add_body(s, "floor", {{8, 8, 1}, 0.1, {-0.2, -0.2, -0.1}, 1.0}, {}, Motion::fixed);
  test::set_times(s, 1.0, 4);
  return s;
}

Prepared lying_box() {
  auto s = falling_box();
  auto& shape = s.job.scene.bodies[0].shape;
  shape.min.z -= 0.2, shape.max.z -= 0.2;
  return s;
}

TEST(Refusals, OfBodiesThatFallLieOrSlide) {
  hold("resting", falling_box(), {},
       {as_it_is,
        {"holds for one free box", [](Prepared& s, Settings&) { s.job.scene.gravity = {}; }},
        {"holds for one free box", [](Prepared& s, Settings&) { s.job.bodies.push_back(s.job.bodies[0]); }},
        {"must point along", [](Prepared& s, Settings&) { s.job.scene.gravity.x = 1.0; }},
        {"one free and one fixed body", [](Prepared& s, Settings&) { s.job.bodies[1].motion = Motion::prescribed; }},
        {"one free and one fixed body", [](Prepared& s, Settings&) { s.job.bodies[0].motion = Motion::fixed; }},
        {"one free and one fixed body", [](Prepared& s, Settings&) { s.job.bodies[1].motion = Motion::free; }}});
  hold("bouncing", falling_box(), {},
       {as_it_is,
        {"falls straight",
         [](Prepared& s, Settings&) {
           s.job.bodies[0].velocity = {1, 0, 0};
         }},
        {"falls straight",
         [](Prepared& s, Settings&) {
           s.job.bodies[0].velocity = {0, 1, 0};
         }},
        {"",
         [](Prepared& s, Settings&) {
           s.job.bodies[0].velocity = {0, 0, 1};
         }},
        {"falls straight",
         [](Prepared& s, Settings&) {
           s.job.bodies[0].angular_velocity = {0, 0, 1};
         }},
        {"from 0 to 1", [](Prepared&, Settings& a) { a["restitution"] = -0.01; }},
        {"from 0 to 1", [](Prepared&, Settings& a) { a["restitution"] = 1.01; }},
        {"", [](Prepared&, Settings& a) { a["restitution"] = 0.0; }},
        {"", [](Prepared&, Settings& a) { a["restitution"] = 1.0; }},
        {"above the floor", [](Prepared& s, Settings&) { s.job.bodies[0].properties.centre.z = 0.2; }},
        {"above the floor", [](Prepared& s, Settings&) { s.job.bodies[0].properties.centre.z = 0.1; }}});
  hold("landing", falling_box(), {},
       {{"not for a face", [](Prepared&, Settings&) {}},
        {"does not reach the floor", [](Prepared& s, Settings&) { test::set_times(s, 0.19, 4); }},
        {"without friction", [](Prepared& s, Settings&) { s.job.settings["friction"] = 0.1; }},
        {"not for a face", [](Prepared& s, Settings&) { s.job.settings["friction"] = 0.0; }},
        {"holds for a box", [](Prepared& s, Settings&) { s.job.scene.bodies[0].shape.kind = Shape::Kind::sphere; }}});
  hold("sliding", lying_box(), {{"friction", 0.5}},
       {as_it_is,
        no_gravity,
        {"one free body", [](Prepared& s, Settings&) { s.job.bodies.push_back(s.job.bodies[0]); }},
        {"fixed or prescribed", [](Prepared& s, Settings&) { s.job.bodies[1].motion = Motion::free; }},
        {"fixed or prescribed", [](Prepared& s, Settings&) { s.job.bodies[0].motion = Motion::fixed; }},
        {"fixed or prescribed",
         [](Prepared& s, Settings&) {
           s.job.bodies[1].keyframes = {{0.0, {}, {}}};
         }},
        {"fixed or prescribed",
         [](Prepared& s, Settings&) {
           s.job.bodies[1].angular_velocity = {0, 0, 1};
         }},
        {"a box or a ball on a box", [](Prepared& s, Settings&) { s.job.scene.bodies[0].shape.kind = Shape::Kind::cylinder; }},
        {"a box or a ball on a box", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.kind = Shape::Kind::half_space; }},
        {"must touch", [](Prepared& s, Settings&) { s.job.scene.bodies[0].shape.min.z -= 1e-8; }},
        {"leaves the plane", [](Prepared& s, Settings&) { s.job.bodies[0].velocity.z = 1.0; }},
        {"leaves the plane", [](Prepared& s, Settings&) { s.job.bodies[0].velocity.z = -1.0; }},
        {"not on one line", [](Prepared& s, Settings&) { s.job.scene.gravity.x = 1.0, s.job.bodies[0].velocity.y = 1.0; }},
        {"", [](Prepared& s, Settings&) { s.job.scene.gravity.x = 1.0, s.job.bodies[0].velocity.x = -1.0; }},
        {"does not turn",
         [](Prepared& s, Settings&) { s.job.bodies[0].velocity.x = 1.0, s.job.bodies[0].angular_velocity.y = 1.0; }},
        {"rolls about only",
         [](Prepared& s, Settings&) { s.job.bodies[0].velocity.x = 1.0, s.job.bodies[0].angular_velocity.z = 1.0; }},
        {"0 or more", [](Prepared&, Settings& a) { a["friction"] = -0.1; }},
        {"", [](Prepared&, Settings& a) { a["friction"] = 0.0; }},
        {"", [](Prepared&, Settings& a) { a["friction"] = 0.999; }},
        {"would tip", [](Prepared&, Settings& a) { a["friction"] = 1.001; }}});
  hold("rolling", lying_box(), {}, {{"holds for a ball", [](Prepared&, Settings&) {}}});
}

TEST(Refusals, OfFreeFlight) {
  const auto block = [] { return test::block({1, 2, 3}, 1.0, 4); };
  const auto event = [](Event::Kind kind) {
    return [kind](Prepared& s, Settings&) {
      s.job.scene.events.resize(1);
      s.job.scene.events[0].kind = kind, s.job.scene.events[0].time = 0.5;
    };
  };
  for (const char* name : {"ballistic", "torque_free"})
    hold(name, block(), {},
         {as_it_is,
          {"events", event(Event::Kind::merge)},
          {"not rigid", [](Prepared& s, Settings&) { s.job.bodies[0].phase = Phase::elastic; }},
          {"joined body", [](Prepared& s, Settings&) { s.job.scene.bodies[0].joined_to = {"floor"}; }},
          {"inflow", [](Prepared& s, Settings&) { s.job.scene.inflows.resize(1); }},
          {"has no particles", [](Prepared& s, Settings&) { s.initial.source.assign(s.initial.size(), 1); }}});
  hold("flip_time", test::block({0.01, 5, 0.01}, 1.0, 4), {},
       {as_it_is,
        {"without events", event(Event::Kind::merge)},
        {"no free body named `other`", [](Prepared&, Settings& a) { a["body"] = std::string("other"); }},
        {"", [](Prepared&, Settings& a) { a["body"] = std::string("block"); }},
        {"never flips", [](Prepared& s, Settings&) {
           s = test::block({0, 0, 5}, 1.0, 4);
         }}});
  hold("merge_in_flight", block(), {},
       {{"needs a merge event", [](Prepared&, Settings&) {}},
        {"needs a merge event", event(Event::Kind::split)},
        {"two bodies or more", event(Event::Kind::merge)}});
  hold("split_in_flight", block(), {},
       {{"needs a split event", [](Prepared&, Settings&) {}},
        {"needs a split event", event(Event::Kind::merge)},
        {"needs a region", event(Event::Kind::split)}});
  hold("keyframes", block(), {},
       {{"motion = \"prescribed\"", [](Prepared&, Settings&) {}},
        {"", [](Prepared& s, Settings&) { s.job.bodies[0].motion = Motion::prescribed; }}});
  hold("elastic_collision", test::cubes(), {},
       {as_it_is,
        {"without gravity",
         [](Prepared& s, Settings&) {
           s.job.scene.gravity = {0, 0, -1};
         }},
        {"for two bodies", [](Prepared& s, Settings&) { s.job.bodies.pop_back(); }},
        {"must point along", [](Prepared& s, Settings&) { s.job.bodies[0].velocity.y = 0.1; }},
        {"body `left` must be a free rigid body", [](Prepared& s, Settings&) { s.job.bodies[0].motion = Motion::fixed; }},
        {"body `right` must be a free rigid body", [](Prepared& s, Settings&) { s.job.bodies[1].phase = Phase::liquid; }},
        {"body `right` must be a free rigid body", [](Prepared& s, Settings&) { s.job.bodies[1].angular_velocity.x = 1.0; }},
        {"off-centre", [](Prepared& s, Settings&) { s.job.bodies[1].properties.centre.y += 1e-9; }},
        {"off-centre", [](Prepared& s, Settings&) { s.job.bodies[1].properties.centre.z -= 1e-9; }},
        {"approach each other", [](Prepared& s, Settings&) { s.job.bodies[0].velocity.x = -1.0; }},
        {"start apart", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.min.x = -0.2; }},
        {"", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.min.x = -0.199; }}});
}

TEST(Refusals, OfLiquids) {
  hold("archimedes", test::pool(350.0), {},
       {as_it_is,
        no_gravity,
        {"must point along", [](Prepared& s, Settings&) { s.job.scene.gravity.x = 1.0; }},
        {"one liquid, and the scene has 0", [](Prepared& s, Settings&) { s.job.bodies[0].phase = Phase::rigid; }},
        {"one free body, and the scene has 0", [](Prepared& s, Settings&) { s.job.bodies[1].motion = Motion::fixed; }},
        {"floating box", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere; }},
        {"periodic across gravity", [](Prepared& s, Settings&) { s.job.scene.periodic[0] = false; }},
        {"periodic across gravity", [](Prepared& s, Settings&) { s.job.scene.periodic[1] = false; }},
        {"`block` sinks", [](Prepared& s, Settings&) { s.job.scene.materials[1].density = 1000.0; }},
        {"", [](Prepared& s, Settings&) { s.job.scene.materials[1].density = 999.0; }}});
  hold("added_mass", test::pool(350.0), {},
       {{"holds for a sphere", [](Prepared&, Settings&) {}},
        no_gravity,
        {"", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere; }},
        {"no liquid", [](Prepared& s, Settings&) {
           s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere, s.job.bodies[0].phase = Phase::rigid,
           s.job.bodies[0].motion = Motion::fixed;
         }}});
  hold("hydrostatic", test::layers(5.0), {},
       {as_it_is,
        no_gravity,
        {"no liquid", [](Prepared& s, Settings&) { s.job.bodies[0].phase = s.job.bodies[1].phase = Phase::rigid; }},
        {"gap or overlap", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.min.z += 1e-6; }},
        {"gap or overlap", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.min.z -= 1e-6; }},
        {"", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.min.z += 1e-7; }},
        {"one layer", [](Prepared&, Settings& a) { a["compressed"] = true; }}});
  hold("poiseuille", test::channel({0.08, 0, 0}, {}), {},
       {as_it_is,
        {"gravity", [](Prepared& s, Settings&) { s.job.scene.gravity = {}; }},
        {"between two plates", [](Prepared& s, Settings&) { s.job.scene.periodic[0] = false; }},
        {"between two plates", [](Prepared& s, Settings&) { s.job.scene.periodic[2] = true; }},
        {"a plate on either side", [](Prepared& s, Settings&) { s.job.bodies.pop_back(); }},
        {"along the plates", [](Prepared& s, Settings&) { s.job.scene.gravity.z = 0.01; }},
        {"beside a body force at rest",
         [](Prepared& s, Settings&) {
           s.job.bodies[2].motion = Motion::prescribed, s.job.bodies[2].velocity = {1, 0, 0};
         }},
        {"needs a viscosity", [](Prepared& s, Settings&) { s.job.scene.materials[0].viscosity = 0.0; }},
        {"", [](Prepared& s, Settings& a) { s.job.scene.materials[0].viscosity = 0.0, a["kinematic_viscosity"] = 0.01; }}});
  hold("couette", test::channel({}, {2, 0, 0}), {},
       {as_it_is,
        {"no plate moves", [](Prepared& s, Settings&) { s.job.bodies[2].velocity = {}; }},
        {"no plate moves", [](Prepared& s, Settings&) { s.job.bodies[2].motion = Motion::fixed; }},
        {"driven by its plates alone", [](Prepared& s, Settings&) { s.job.scene.gravity.x = 1.0; }},
        {"along the plates", [](Prepared& s, Settings&) { s.job.bodies[2].velocity.z = 0.1; }}});
  const auto sound = test::swinging(test::sound_start(), 10);
  hold(
      "sound_wave", sound, {},
      {as_it_is,
       {"kind = \"cosine\"", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.kind = VelocityField::Kind::constant; }},
       {"kind = \"cosine\"", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.wave_vector = {}; }},
       {"move on the mean",
        [](Prepared& s, Settings&) {
          s.job.scene.bodies[0].velocity.mean = {0, 1, 0};
        }},
       {"along its wave vector", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.amplitude.y = 0.001; }},
       {"stiffness or a speed of sound", [](Prepared& s, Settings&) { s.job.scene.materials[0].stiffness.reset(); }},
       {"", [](Prepared& s, Settings& a) { s.job.scene.materials[0].stiffness.reset(), a["sound_speed"] = 10.0; }}});
  hold("taylor_green", sound, {},
       {{"periodic in x and y", [](Prepared& s, Settings&) { s.job.scene.periodic[0] = false; }},
        {"periodic in x and y", [](Prepared& s, Settings&) { s.job.scene.periodic[1] = false; }},
        {"or the arguments speed and wavelength", [](Prepared&, Settings&) {}},
        {"or the arguments speed and wavelength", [](Prepared&, Settings& a) { a["speed"] = 1.0; }},
        {"or the arguments speed and wavelength", [](Prepared&, Settings& a) { a["wavelength"] = 1.0; }},
        {"does not start with these vortices",
         [](Prepared& s, Settings& a) { s.job.scene.materials[0].viscosity = 1.0, a["speed"] = 1.0, a["wavelength"] = 1.0; }}});
  hold("liquid_ball", sound, {},
       {{"a sphere of liquid", [](Prepared&, Settings&) {}},
        {"does not turn", [](Prepared& s, Settings&) { s.job.scene.bodies[0].shape.kind = Shape::Kind::sphere; }},
        {"", [](Prepared& s, Settings&) {
           s.job.scene.bodies[0].shape.kind = Shape::Kind::sphere, s.job.scene.bodies[0].angular_velocity = {0, 0, 1};
         }}});
  hold("couette_cylinders", test::channel({}, {2, 0, 0}), {{"inner_radius", 0.1}, {"outer_radius", 0.2}},
       {{"periodic in z", [](Prepared&, Settings&) {}},
        {"", [](Prepared& s, Settings&) { s.job.scene.periodic[2] = true; }},
        {"inner_radius below outer_radius", [](Prepared&, Settings& a) { a["inner_radius"] = 0.2; }},
        {"inner_radius below outer_radius", [](Prepared&, Settings& a) { a.erase("inner_radius"); }},
        {"inner_radius below outer_radius", [](Prepared&, Settings& a) { a.erase("outer_radius"); }}});
  hold("collapsing_column", test::pool(350.0), {},
       {{"whole number from 4 to 80", [](Prepared&, Settings& a) { a["cells"] = 3.0; }},
        {"whole number from 4 to 80", [](Prepared&, Settings& a) { a["cells"] = 81.0; }},
        {"whole number from 4 to 80", [](Prepared&, Settings& a) { a["cells"] = 8.5; }},
        {"along the negative direction", [](Prepared& s, Settings&) { s.job.scene.gravity.z = 9.81; }},
        {"along the negative direction", [](Prepared& s, Settings&) { s.job.scene.gravity.x = -1.0; }},
        {"an axis across gravity", [](Prepared&, Settings& a) { a["axis"] = std::string("z"); }},
        {"needs a box of liquid", [](Prepared& s, Settings&) { s.job.scene.bodies[0].shape.kind = Shape::Kind::sphere; }}});
}

VelocityField drawn_out() {
  VelocityField v;
  v.kind = VelocityField::Kind::linear;
  v.gradient[0] = {-2, 0, 0}, v.gradient[1] = {0, 2, 0};
  return v;
}

TEST(Refusals, OfADropThatIsNotDrawnOutByHalves) {
  auto s = test::swinging(drawn_out(), 10);
  s.job.scene.bodies[0].shape.kind = Shape::Kind::cylinder, s.job.scene.bodies[0].shape.radius = 0.5;
  const char* words = "needs a cylinder of liquid along z";
  const auto with = [&](std::size_t row, const Vec3& gradient) {
    return Row{words, [=](Prepared& p, Settings&) { p.job.scene.bodies[0].velocity.gradient[row] = gradient; }};
  };
  hold("elliptic_drop", s, {},
       {as_it_is,
        with(0, {-1, 0, 0}),
        with(0, {2, 0, 0}),
        with(0, {-2, 0.1, 0}),
        with(1, {0.1, 2, 0}),
        with(2, {0, 0, 0.1}),
        {words,
         [](Prepared& p, Settings&) {
           p.job.scene.bodies[0].velocity.gradient[0].x = 2, p.job.scene.bodies[0].velocity.gradient[1].y = -2;
         }},
        {words, [](Prepared& p, Settings&) { p.job.scene.bodies[0].velocity.kind = VelocityField::Kind::constant; }},
        {words, [](Prepared& p, Settings&) { p.job.scene.bodies[0].shape.kind = Shape::Kind::box; }}});
}

/// A bar of 20 x 4 x 4 with a cosine along x, level at both ends, in one body or two of the same material.
Prepared warm(bool periodic, double phase) {
  const double k = 2.0 * test::pi / 0.1;
  auto s = test::bar(
      {20, 4, 4}, 0.005, [&](const Vec3& r) { return 300.0 + 10.0 * std::cos(k * r.x + phase); }, 10.0, 2, periodic);
  TemperatureField field;
  field.kind = TemperatureField::Kind::cosine;
  field.mean = 300.0, field.amplitude = 10.0, field.phase = phase, field.wave_vector = {k, 0, 0};
  s.job.scene.bodies[0].temperature = field;
  return s;
}

void second_body(Prepared& s, double conductivity) {
  auto other = s.job.scene.materials[0];
  other.name = "other", other.conductivity = conductivity;
  s.job.scene.materials.push_back(other);
  test::add_body(s, "second", {{2, 4, 4}, 0.005, {0.1, 0, 0}, 1.0}, {});
  s.job.bodies[1].material = "other";
  s.initial.temperature.resize(s.initial.size(), 300.0);
}

TEST(Refusals, OfHeat) {
  const auto at_rest = std::vector<Row>{
      as_it_is,
      {"`bar` moves", [](Prepared& s, Settings&) { s.job.bodies[0].velocity.y = 1.0; }},
      {"`bar` moves", [](Prepared& s, Settings&) { s.job.bodies[0].angular_velocity.y = 1.0; }},
      {"`bar` moves",
       [](Prepared& s, Settings&) {
         s.job.bodies[0].keyframes = {{0.0, {}, {}}};
       }},
      {"", [](Prepared& s, Settings&) { s.job.bodies[0].velocity.y = 1.0, s.job.bodies[0].motion = Motion::fixed; }},
      {"`bar` holds its temperature", [](Prepared& s, Settings&) { s.job.bodies[0].temperature_held = true; }},
      {"`bar` falls",
       [](Prepared& s, Settings&) {
         s.job.scene.gravity = {0, 0, -1};
       }},
      {"",
       [](Prepared& s, Settings&) {
         s.job.scene.gravity = {0, 0, -1}, s.job.bodies[0].motion = Motion::fixed;
       }},
      {"no events or inflows", [](Prepared& s, Settings&) { s.job.scene.events.resize(1); }},
      {"no events or inflows", [](Prepared& s, Settings&) { s.job.scene.inflows.resize(1); }},
      {"needs scene.min and scene.max", [](Prepared& s, Settings&) { s.job.scene.periodic[0] = true, s.job.scene.min.reset(); }},
      {"needs scene.min and scene.max", [](Prepared& s, Settings&) { s.job.scene.periodic[0] = true, s.job.scene.max.reset(); }},
      {"needs conductivity and heat_capacity", [](Prepared& s, Settings&) { s.job.scene.materials[0].conductivity.reset(); }},
      {"needs conductivity and heat_capacity", [](Prepared& s, Settings&) { s.job.scene.materials[0].heat_capacity.reset(); }},
      {"which the scene does not have", [](Prepared& s, Settings&) { s.job.bodies[0].material = "none"; }},
      {"the arguments wave_vector and amplitude", [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature.reset(); }},
      {"the arguments wave_vector and amplitude", [](Prepared&, Settings& a) { a["amplitude"] = 0.0; }}};
  hold("cosine_mode", warm(false, 0.0), {}, at_rest);
  hold("cosine_mode", warm(false, 0.0), {},
       {{"differ in diffusivity",
         [](Prepared& s, Settings&) { second_body(s, 3.0), s.job.scene.bodies[0].temperature->wave_vector.x = test::pi / 0.11; }},
        {"",
         [](Prepared& s, Settings&) { second_body(s, 2.0), s.job.scene.bodies[0].temperature->wave_vector.x = test::pi / 0.11; }},
        {"not level at the insulated ends", [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature->phase = 0.1; }},
        {"not level at the insulated ends",
         [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature->wave_vector.x *= 1.01; }},
        {"must point along", [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature->wave_vector.y = 3.0; }}});
  hold("cosine_mode", warm(true, 0.7), {}, {as_it_is, {"no whole number of waves", [](Prepared& s, Settings&) {
                                                         s.job.scene.bodies[0].temperature->wave_vector.x *= 1.5;
                                                       }}});
  hold("cosine_carried", warm(true, 0.7), {},
       {as_it_is,
        {"", [](Prepared& s, Settings&) { s.job.bodies[0].velocity.x = 1.0; }},
        {"at one velocity", [](Prepared& s, Settings&) { s.job.bodies[0].angular_velocity.x = 1.0; }},
        {"at one velocity", [](Prepared& s, Settings&) { second_body(s, 2.0), s.job.bodies[1].velocity.x = 1.0; }},
        {"", [](Prepared& s, Settings&) { second_body(s, 2.0), s.job.bodies[0].velocity.x = s.job.bodies[1].velocity.x = 1.0; }},
        {"has gravity", [](Prepared& s, Settings&) { s.job.scene.gravity.x = 1.0; }},
        {"has no bodies", [](Prepared& s, Settings&) { s.job.bodies.clear(); }}});
  hold("cosine_mode_lattice", warm(true, 0.7), {{"support_ratio", 2.5}},
       {as_it_is,
        {"all three directions periodic", [](Prepared& s, Settings&) { s.job.scene.periodic[2] = false; }},
        {"without jitter", [](Prepared& s, Settings&) { s.job.scene.jitter = 0.1; }},
        {"\"paper\" or \"corrected\"", [](Prepared&, Settings& a) { a["form"] = std::string("other"); }},
        {"", [](Prepared&, Settings& a) { a["form"] = std::string("paper"); }},
        {"", [](Prepared&, Settings& a) { a["form"] = std::string("corrected"); }}});
  const Settings wave{
      {"mean", 300.0}, {"amplitude_1", 10.0}, {"phase_1", 0.7}, {"wave_vector_1", std::vector<double>{20.0 * test::pi, 0, 0}}};
  hold("cosine_sum", warm(true, 0.7), wave,
       {as_it_is,
        {"the argument `mean`", [](Prepared&, Settings& a) { a.erase("mean"); }},
        {"wave 1 needs both", [](Prepared&, Settings& a) { a.erase("amplitude_1"); }},
        {"wave 1 needs both", [](Prepared&, Settings& a) { a.erase("wave_vector_1"); }},
        {"wave 4 needs both", [](Prepared&, Settings& a) { a["amplitude_4"] = 1.0; }},
        {"no argument `amplitude_5`", [](Prepared&, Settings& a) { a["amplitude_5"] = 1.0; }},
        {"needs amplitude_1 and wave_vector_1", [](Prepared&, Settings& a) { a.erase("amplitude_1"), a.erase("wave_vector_1"); }},
        {"does not start with the waves", [](Prepared& s, Settings&) { s.initial.temperature[5] += 1.1e-8; }},
        {"", [](Prepared& s, Settings&) { s.initial.temperature[5] += 0.9e-8; }}});
  hold("sine_held_ends", warm(false, -0.5 * test::pi), {},
       {as_it_is,
        {"one body whose temperature is not held", [](Prepared& s, Settings&) { s.job.bodies[0].temperature_held = true; }},
        {"all bodies but one", [](Prepared& s, Settings&) { second_body(s, 2.0); }},
        {"", [](Prepared& s, Settings&) { second_body(s, 2.0), s.job.bodies[1].temperature_held = true; }},
        {"differ in diffusivity", [](Prepared& s, Settings&) { second_body(s, 3.0), s.job.bodies[1].temperature_held = true; }},
        {"at its mean at the held ends", [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature->phase += 1e-3; }}});
  hold("two_conductivities", warm(false, 0.0), {},
       {{"for two bodies", [](Prepared&, Settings&) {}},
        {"must start at one temperature", [](Prepared& s, Settings&) { second_body(s, 3.0); }},
        {"", [](Prepared& s, Settings&) { second_body(s, 3.0), s.initial.temperature.assign(s.initial.size(), 300.0); }},
        {"must start at one temperature", [](Prepared& s, Settings&) { second_body(s, 3.0), s.initial.temperature.clear(); }},
        {"do not touch",
         [](Prepared& s, Settings&) {
           second_body(s, 3.0), s.job.scene.bodies[1].shape.min.x += 1e-6, s.job.scene.bodies[1].shape.max.x += 1e-6;
         }},
        {"touch twice", [](Prepared& s, Settings&) { second_body(s, 3.0), s.job.scene.periodic[0] = true; }}});
}

TEST(Refusals, OfAStepOfTemperature) {
  auto s = warm(false, 0.0);
  TemperatureField step;
  step.kind = TemperatureField::Kind::step, step.normal = {1, 0, 0}, step.point = {0.05, 0, 0}, step.behind = 400.0,
  step.ahead = 300.0;
  s.job.scene.bodies[0].temperature = step;
  const auto place = [](double x) { return [=](Prepared&, Settings& a) { a["place"] = x; }; };
  hold("step_insulated", s, {},
       {as_it_is,
        {"outside the bar", place(0.0)},
        {"outside the bar", place(0.1)},
        {"outside the bar", place(-0.01)},
        {"outside the bar", place(0.11)},
        {"", place(1e-9)},
        {"", place(0.1 - 1e-9)},
        {"kind = \"step\"",
         [](Prepared& p, Settings&) { p.job.scene.bodies[0].temperature->kind = TemperatureField::Kind::constant; }},
        {"kind = \"step\"", [](Prepared& p, Settings&) { p.job.scene.bodies[0].temperature.reset(); }},
        {"must point along", [](Prepared& p, Settings&) { p.job.scene.bodies[0].temperature->normal.y = 1.0; }}});
}

TEST(Refusals, OfMelting) {
  hold("stefan", test::stefan_bar({}), {},
       {as_it_is,
        {"needs a wall", [](Prepared& s, Settings&) { s.job.bodies[1].temperature_held = false; }},
        {"several bodies hold", [](Prepared& s, Settings&) { s.job.bodies[0].temperature_held = true; }},
        {"a material with t_melt", [](Prepared& s, Settings&) { s.job.scene.materials[0].t_melt.reset(); }},
        {"`walls`", [](Prepared&, Settings& a) { a["wall"] = std::string("walls"); }},
        {"", [](Prepared&, Settings& a) { a["wall"] = std::string("wall"), a["body"] = std::string("bar"); }},
        {"`bar` needs one temperature", [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature.reset(); }},
        {"`wall` needs one temperature",
         [](Prepared& s, Settings&) { s.job.scene.bodies[1].temperature->kind = TemperatureField::Kind::step; }},
        {"needs t_melt, heat_capacity and latent_heat",
         [](Prepared& s, Settings&) { s.job.scene.materials[0].latent_heat.reset(); }},
        {"needs t_melt, heat_capacity and latent_heat",
         [](Prepared& s, Settings&) { s.job.scene.materials[0].heat_capacity.reset(); }},
        {"", [](Prepared& s, Settings& a) { s.job.scene.materials[0].latent_heat.reset(), a["latent_heat"] = 1e5; }},
        {"must lie between", [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature->value = 310.0; }},
        {"must lie between",
         [](Prepared& s, Settings&) {
           s.job.scene.bodies[1].temperature->value = 299.0, s.job.scene.bodies[0].temperature->value = 280.0;
         }},
        {"half space", [](Prepared& s, Settings&) { test::set_times(s, 2000.0, 20); }},
        {"every direction is periodic", [](Prepared& s, Settings&) { s.job.scene.periodic[0] = true; }}});
  hold("hysteresis", test::heated_block(), {},
       {as_it_is,
        {"needs heat events", [](Prepared& s, Settings&) { s.job.scene.events.clear(); }},
        {"needs a temperature", [](Prepared& s, Settings&) { s.job.scene.events[2].temperature.reset(); }},
        {"must hold all that can melt", [](Prepared& s, Settings&) { s.job.scene.events[1].bodies = {"other"}; }},
        {"", [](Prepared& s, Settings&) { s.job.scene.events[1].bodies.clear(); }},
        {"", [](Prepared& s, Settings&) { s.job.scene.events[1].bodies = {"other"}, s.job.scene.materials[0].t_melt.reset(); }}});
}

TEST(Refusals, OfBarsAndBeams) {
  hold("cantilever", test::beam(2.0), {},
       {as_it_is,
        {"held at both ends",
         [](Prepared& s, Settings&) {
           test::add_matter(s, "other", Phase::rigid, {{3, 2, 2}, 0.01, {0.2, 0, 0}, 1.0}, {}, 1000.0, 0.0, Motion::fixed);
         }},
        {"holds the beam", [](Prepared& s, Settings&) { s.job.bodies[1].motion = Motion::free; }},
        {"holds the beam", [](Prepared& s, Settings&) { s.job.bodies[1].phase = Phase::liquid; }},
        {"across the beam",
         [](Prepared&, Settings& a) {
           a["direction"] = std::vector<double>{1, 0, 0};
         }},
        {"across the beam",
         [](Prepared& s, Settings&) {
           s.job.scene.gravity = {1, 0, 0};
         }},
        {"not at the free end", [](Prepared&, Settings& a) { a["tip"] = std::string("clamp"); }},
        {"needs a free elastic body", [](Prepared& s, Settings&) { s.job.bodies[0].phase = Phase::rigid; }},
        {"needs a free elastic body", [](Prepared& s, Settings&) { s.job.bodies[0].motion = Motion::fixed; }},
        {"names body `bem`", [](Prepared&, Settings& a) { a["body"] = std::string("bem"); }},
        {"one free elastic body", [](Prepared& s, Settings&) {
           test::add_matter(s, "other", Phase::elastic, {{3, 2, 2}, 0.01, {0.5, 0, 0}, 1.0}, {}, 1000.0);
         }}});
  const auto word = [](const char* key, const char* value) {
    return [=](Prepared&, Settings& a) { a[key] = std::string(value); };
  };
  hold("tension", test::driven_bar(1.1), {},
       {as_it_is,
        {"`sides` must be", word("sides", "half")},
        {"", word("sides", "free")},
        {"", word("sides", "plane_strain")},
        {"", word("sides", "confined")},
        {"`form` must be", word("form", "half")},
        {"", word("form", "corrected")},
        {"above 0 and at most 1", [](Prepared&, Settings& a) { a["gauge"] = 0.0; }},
        {"above 0 and at most 1", [](Prepared&, Settings& a) { a["gauge"] = 1.001; }},
        {"", [](Prepared&, Settings& a) { a["gauge"] = 1.0; }},
        {"at each end", [](Prepared& s, Settings&) { s.job.bodies[1].motion = Motion::free; }},
        {"at each end", [](Prepared& s, Settings&) { s.job.bodies[2].phase = Phase::liquid; }},
        {"hold the same end", [](Prepared& s, Settings&) { s.job.bodies[1].properties.centre.x = 0.3; }},
        {"no closed form", [](Prepared& s, Settings& a) {
           s.job.scene.materials[0].elastic_limit = 0.01, a["sides"] = std::string("plane_strain");
         }}});
  auto swinging = test::driven_bar(1.0);
  auto& v = swinging.job.scene.bodies[0].velocity;
  v.kind = VelocityField::Kind::cosine, v.wave_vector = {test::pi / 0.2, 0, 0}, v.amplitude = {0.1, 0, 0};
  hold("elastic_wave", swinging, {},
       {as_it_is,
        {"kind = \"cosine\"", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.kind = VelocityField::Kind::linear; }},
        {"kind = \"cosine\"", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.wave_vector = {}; }},
        {"kind = \"cosine\"", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.amplitude = {}; }},
        {"move on the mean", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.mean.z = 1.0; }},
        {"must point along", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.wave_vector.y = 1.0; }},
        {"along its wave vector or across", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.amplitude.y = 0.1; }},
        {"", [](Prepared& s, Settings&) {
           s.job.scene.bodies[0].velocity.amplitude = {0, 0.1, 0.1};
         }}});
  hold("spinning_rod", test::driven_bar(1.0), {},
       {{"across its length", [](Prepared&, Settings&) {}},
        {"across its length",
         [](Prepared& s, Settings&) {
           s.job.bodies[0].angular_velocity = {1, 1, 0};
         }},
        {"", [](Prepared& s, Settings&) {
           s.job.bodies[0].angular_velocity = {0, 1, 1};
         }}});
  hold("pressed_block", test::driven_bar(1.0), {},
       {{"the argument `pressure`", [](Prepared&, Settings&) {}}, {"", [](Prepared&, Settings& a) { a["pressure"] = 1e4; }}});
}

TEST(Refusals, OfWhatACaseStates) {
  const auto vector = [](double x, double y, double z) { return std::vector<double>{x, y, z}; };
  hold("stated", test::cubes(), {{"value", 1.0}},
       {as_it_is,
        {"must be a number", [](Prepared&, Settings& a) { a["value"] = std::string("one"); }},
        {"must be \"x\", \"y\" or \"z\"", [](Prepared&, Settings& a) { a["axis"] = std::string("w"); }},
        {"must be \"x\", \"y\" or \"z\"", [](Prepared&, Settings& a) { a["axis"] = std::string("{"); }},
        {"must be \"x\", \"y\" or \"z\"", [](Prepared&, Settings& a) { a["axis"] = std::string("xy"); }},
        {"must be three numbers",
         [](Prepared&, Settings& a) {
           a["point"] = std::vector<double>{1, 2};
         }},
        {"must be three numbers", [](Prepared&, Settings& a) { a["point"] = 1.0; }},
        {"must be true or false", [](Prepared&, Settings& a) { a["outside"] = 1.0; }},
        {"must be a text", [](Prepared&, Settings& a) { a["phase"] = 1.0; }},
        {"\"liquid\", \"elastic\", \"rigid\" or \"solid\"", [](Prepared&, Settings& a) { a["phase"] = std::string("gas"); }},
        {"names body `rigt`", [](Prepared&, Settings& a) { a["other"] = std::string("rigt"); }},
        {"both `min` and `max`", [=](Prepared&, Settings& a) { a["min"] = vector(0, 0, 0); }},
        {"both `min` and `max`", [=](Prepared&, Settings& a) { a["max"] = vector(0, 0, 0); }},
        {"above `min` in x", [=](Prepared&, Settings& a) { a["min"] = vector(1, 0, 0), a["max"] = vector(1, 1, 1); }},
        {"above `min` in y", [=](Prepared&, Settings& a) { a["min"] = vector(0, 1, 0), a["max"] = vector(1, 1, 1); }},
        {"above `min` in z", [=](Prepared&, Settings& a) { a["min"] = vector(0, 0, 2), a["max"] = vector(1, 1, 1); }},
        {"must be greater than 0", [](Prepared&, Settings& a) { a["frequency"] = 0.0; }},
        {"no argument `valu`", [](Prepared&, Settings& a) { a["valu"] = 0.0; }}});
  hold("cosine_mod", test::cubes(), {}, {{"unknown reference function `cosine_mod`", [](Prepared&, Settings&) {}}});
  hold("", test::cubes(), {}, {{"names no function", [](Prepared&, Settings&) {}}});
  const auto s = test::cubes();
  const auto truth = make_reference(test::function("stated", {{"value", 1.0},
                                                              {"axis", std::string("y")},
                                                              {"other", std::string("right")},
                                                              {"gauge", 0.25},
                                                              {"frequency", 3.0},
                                                              {"diffusivity", 2.0},
                                                              {"min", vector(0, 1, 2)},
                                                              {"max", vector(3, 4, 5)},
                                                              {"outside", true}}),
                                    s.job, s.initial);
  EXPECT_EQ(truth->measuring().axis, 1u);
  EXPECT_EQ(truth->measuring().other, 1u);
  EXPECT_EQ(truth->measuring().box->low.y, 1.0);
  EXPECT_EQ(truth->measuring().box->high.z, 5.0);
  EXPECT_TRUE(truth->measuring().outside);
  EXPECT_FALSE(truth->measuring().follows);
  EXPECT_EQ(truth->number("gauge"), 0.25);
  EXPECT_EQ(truth->number("stated_frequency"), 3.0);
  EXPECT_EQ(truth->number("diffusivity"), 2.0);
  EXPECT_EQ(truth->number("value"), 1.0);
}

}  // namespace
}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
// What the exact solutions of bodies and liquids do not hold for.
#include "references/refusals.hpp"

namespace tripoint {
namespace {

using test::as_it_is;
using test::Fault;
using test::hold;
using test::no_gravity;
using test::Prepared;

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
  shape.min.z -= 0.2;
  shape.max.z -= 0.2;
  return s;
}

TEST(Refusals, OfBodiesThatFallLieOrSlide) {
  hold("resting", falling_box(), {},
       {as_it_is,
        {"holds for one free box", [](Prepared& s, Settings&) { s.job.scene.gravity = {}; }},
        {"holds for one free box", [](Prepared& s, Settings&) { s.job.bodies.push_back(s.job.bodies[0]); }},
        {"must point along", [](Prepared& s, Settings&) { s.job.scene.gravity.x = 1.0; }},
        {"one free and one fixed body",
         [](Prepared& s, Settings&) { s.job.bodies[1].motion = Motion::prescribed; }},
        {"one free and one fixed body",
         [](Prepared& s, Settings&) { s.job.bodies[0].motion = Motion::fixed; }},
        {"one free and one fixed body",
         [](Prepared& s, Settings&) { s.job.bodies[1].motion = Motion::free; }}});
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
        {"holds for a box",
         [](Prepared& s, Settings&) { s.job.scene.bodies[0].shape.kind = Shape::Kind::sphere; }}});
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
        {"a box or a ball on a box",
         [](Prepared& s, Settings&) { s.job.scene.bodies[0].shape.kind = Shape::Kind::cylinder; }},
        {"a box or a ball on a box",
         [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.kind = Shape::Kind::half_space; }},
        {"must touch", [](Prepared& s, Settings&) { s.job.scene.bodies[0].shape.min.z -= 1e-8; }},
        {"leaves the plane", [](Prepared& s, Settings&) { s.job.bodies[0].velocity.z = 1.0; }},
        {"leaves the plane", [](Prepared& s, Settings&) { s.job.bodies[0].velocity.z = -1.0; }},
        {"not on one line",
         [](Prepared& s, Settings&) {
           s.job.scene.gravity.x = 1.0;
           s.job.bodies[0].velocity.y = 1.0;
         }},
        {"",
         [](Prepared& s, Settings&) {
           s.job.scene.gravity.x = 1.0;
           s.job.bodies[0].velocity.x = -1.0;
         }},
        {"does not turn",
         [](Prepared& s, Settings&) {
           s.job.bodies[0].velocity.x = 1.0;
           s.job.bodies[0].angular_velocity.y = 1.0;
         }},
        {"rolls about only",
         [](Prepared& s, Settings&) {
           s.job.bodies[0].velocity.x = 1.0;
           s.job.bodies[0].angular_velocity.z = 1.0;
         }},
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
      s.job.scene.events[0].kind = kind;
      s.job.scene.events[0].time = 0.5;
    };
  };
  for (const char* name : {"ballistic", "torque_free"})
    hold(
        name, block(), {},
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
        {"body `left` must be a free rigid body",
         [](Prepared& s, Settings&) { s.job.bodies[0].motion = Motion::fixed; }},
        {"body `right` must be a free rigid body",
         [](Prepared& s, Settings&) { s.job.bodies[1].phase = Phase::liquid; }},
        {"body `right` must be a free rigid body",
         [](Prepared& s, Settings&) { s.job.bodies[1].angular_velocity.x = 1.0; }},
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
        {"one liquid, and the scene has 0",
         [](Prepared& s, Settings&) { s.job.bodies[0].phase = Phase::rigid; }},
        {"one free body, and the scene has 0",
         [](Prepared& s, Settings&) { s.job.bodies[1].motion = Motion::fixed; }},
        {"floating box",
         [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere; }},
        {"periodic across gravity", [](Prepared& s, Settings&) { s.job.scene.periodic[0] = false; }},
        {"periodic across gravity", [](Prepared& s, Settings&) { s.job.scene.periodic[1] = false; }},
        {"`block` sinks", [](Prepared& s, Settings&) { s.job.scene.materials[1].density = 1000.0; }},
        {"", [](Prepared& s, Settings&) { s.job.scene.materials[1].density = 999.0; }}});
  hold("added_mass", test::pool(350.0), {},
       {{"holds for a sphere", [](Prepared&, Settings&) {}},
        no_gravity,
        {"", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere; }},
        {"no liquid", [](Prepared& s, Settings&) {
           s.job.scene.bodies[1].shape.kind = Shape::Kind::sphere;
           s.job.bodies[0].phase = Phase::rigid;
           s.job.bodies[0].motion = Motion::fixed;
         }}});
  hold("hydrostatic", test::layers(5.0), {},
       {as_it_is,
        no_gravity,
        {"no liquid",
         [](Prepared& s, Settings&) { s.job.bodies[0].phase = s.job.bodies[1].phase = Phase::rigid; }},
        {"gap or overlap", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.min.z += 1e-6; }},
        {"gap or overlap", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.min.z -= 1e-6; }},
        {"", [](Prepared& s, Settings&) { s.job.scene.bodies[1].shape.min.z += 1e-7; }},
        {"", [](Prepared&, Settings& a) { a["compressed"] = true; }}});
  hold("poiseuille", test::channel({0.08, 0, 0}, {}), {},
       {as_it_is,
        {"gravity", [](Prepared& s, Settings&) { s.job.scene.gravity = {}; }},
        {"between two plates", [](Prepared& s, Settings&) { s.job.scene.periodic[0] = false; }},
        {"between two plates", [](Prepared& s, Settings&) { s.job.scene.periodic[2] = true; }},
        {"a plate on either side", [](Prepared& s, Settings&) { s.job.bodies.pop_back(); }},
        {"along the plates", [](Prepared& s, Settings&) { s.job.scene.gravity.z = 0.01; }},
        {"beside a body force at rest",
         [](Prepared& s, Settings&) {
           s.job.bodies[2].motion = Motion::prescribed;
           s.job.bodies[2].velocity = {1, 0, 0};
         }},
        {"needs a viscosity", [](Prepared& s, Settings&) { s.job.scene.materials[0].viscosity = 0.0; }},
        {"", [](Prepared& s, Settings& a) {
           s.job.scene.materials[0].viscosity = 0.0;
           a["kinematic_viscosity"] = 0.01;
         }}});
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
       {"kind = \"cosine\"",
        [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.kind = VelocityField::Kind::constant; }},
       {"kind = \"cosine\"", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.wave_vector = {}; }},
       {"move on the mean",
        [](Prepared& s, Settings&) {
          s.job.scene.bodies[0].velocity.mean = {0, 1, 0};
        }},
       {"along its wave vector",
        [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.amplitude.y = 0.001; }},
       {"stiffness or a speed of sound",
        [](Prepared& s, Settings&) { s.job.scene.materials[0].stiffness.reset(); }},
       {"", [](Prepared& s, Settings& a) {
          s.job.scene.materials[0].stiffness.reset();
          a["sound_speed"] = 10.0;
        }}});
  hold("taylor_green", sound, {},
       {{"periodic in x and y", [](Prepared& s, Settings&) { s.job.scene.periodic[0] = false; }},
        {"periodic in x and y", [](Prepared& s, Settings&) { s.job.scene.periodic[1] = false; }},
        {"or the arguments speed and wavelength", [](Prepared&, Settings&) {}},
        {"or the arguments speed and wavelength", [](Prepared&, Settings& a) { a["speed"] = 1.0; }},
        {"or the arguments speed and wavelength", [](Prepared&, Settings& a) { a["wavelength"] = 1.0; }},
        {"does not start with these vortices", [](Prepared& s, Settings& a) {
           s.job.scene.materials[0].viscosity = 1.0;
           a["speed"] = 1.0;
           a["wavelength"] = 1.0;
         }}});
  hold("liquid_ball", sound, {},
       {{"a sphere of liquid", [](Prepared&, Settings&) {}},
        {"does not turn",
         [](Prepared& s, Settings&) { s.job.scene.bodies[0].shape.kind = Shape::Kind::sphere; }},
        {"", [](Prepared& s, Settings&) {
           s.job.scene.bodies[0].shape.kind = Shape::Kind::sphere;
           s.job.scene.bodies[0].angular_velocity = {0, 0, 1};
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
        {"needs a box of liquid",
         [](Prepared& s, Settings&) { s.job.scene.bodies[0].shape.kind = Shape::Kind::sphere; }}});
}

VelocityField drawn_out() {
  VelocityField v;
  v.kind = VelocityField::Kind::linear;
  v.gradient[0] = {-2, 0, 0};
  v.gradient[1] = {0, 2, 0};
  return v;
}

TEST(Refusals, OfADropThatIsNotDrawnOutByHalves) {
  auto s = test::swinging(drawn_out(), 10);
  s.job.scene.bodies[0].shape.kind = Shape::Kind::cylinder;
  s.job.scene.bodies[0].shape.radius = 0.5;
  const char* words = "needs a cylinder of liquid along z";
  const auto with = [&](std::size_t row, const Vec3& gradient) {
    return Fault{words,
                 [=](Prepared& p, Settings&) { p.job.scene.bodies[0].velocity.gradient[row] = gradient; }};
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
           p.job.scene.bodies[0].velocity.gradient[0].x = 2;
           p.job.scene.bodies[0].velocity.gradient[1].y = -2;
         }},
        {words,
         [](Prepared& p, Settings&) { p.job.scene.bodies[0].velocity.kind = VelocityField::Kind::constant; }},
        {words, [](Prepared& p, Settings&) { p.job.scene.bodies[0].shape.kind = Shape::Kind::box; }}});
}

}  // namespace
}  // namespace tripoint

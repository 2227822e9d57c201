// SPDX-License-Identifier: BSD-3-Clause
// What the exact solutions of heat, melting, bars and beams, and what a case states, do not hold for.
#include "references/refusals.hpp"

namespace tripoint {
namespace {

using test::as_it_is;
using test::Fault;
using test::hold;
using test::Prepared;

/// A bar of 20 x 4 x 4 with a cosine along x, level at both ends, in one body or two of the same material.
Prepared warm(bool periodic, double phase) {
  const double k = 2.0 * test::pi / 0.1;
  auto s = test::bar(
      {20, 4, 4}, 0.005, [&](const Vec3& r) { return 300.0 + 10.0 * std::cos(k * r.x + phase); }, 10.0, 2,
      periodic);
  TemperatureField field;
  field.kind = TemperatureField::Kind::cosine;
  field.mean = 300.0;
  field.amplitude = 10.0;
  field.phase = phase;
  field.wave_vector = {k, 0, 0};
  s.job.scene.bodies[0].temperature = field;
  return s;
}

void second_body(Prepared& s, double conductivity) {
  auto other = s.job.scene.materials[0];
  other.name = "other";
  other.conductivity = conductivity;
  s.job.scene.materials.push_back(other);
  test::add_body(s, "second", {{2, 4, 4}, 0.005, {0.1, 0, 0}, 1.0}, {});
  s.job.bodies[1].material = "other";
  s.initial.temperature.resize(s.initial.size(), 300.0);
}

TEST(Refusals, OfHeat) {
  const auto at_rest = std::vector<Fault>{
      as_it_is,
      {"`bar` moves", [](Prepared& s, Settings&) { s.job.bodies[0].velocity.y = 1.0; }},
      {"`bar` moves", [](Prepared& s, Settings&) { s.job.bodies[0].angular_velocity.y = 1.0; }},
      {"`bar` moves",
       [](Prepared& s, Settings&) {
         s.job.bodies[0].keyframes = {{0.0, {}, {}}};
       }},
      {"",
       [](Prepared& s, Settings&) {
         s.job.bodies[0].velocity.y = 1.0;
         s.job.bodies[0].motion = Motion::fixed;
       }},
      {"`bar` holds its temperature",
       [](Prepared& s, Settings&) { s.job.bodies[0].temperature_held = true; }},
      {"`bar` falls",
       [](Prepared& s, Settings&) {
         s.job.scene.gravity = {0, 0, -1};
       }},
      {"",
       [](Prepared& s, Settings&) {
         s.job.scene.gravity = {0, 0, -1};
         s.job.bodies[0].motion = Motion::fixed;
       }},
      {"no events, inflows or sources", [](Prepared& s, Settings&) { s.job.scene.events.resize(1); }},
      {"no events, inflows or sources", [](Prepared& s, Settings&) { s.job.scene.inflows.resize(1); }},
      {"needs scene.min and scene.max",
       [](Prepared& s, Settings&) {
         s.job.scene.periodic[0] = true;
         s.job.scene.min.reset();
       }},
      {"needs scene.min and scene.max",
       [](Prepared& s, Settings&) {
         s.job.scene.periodic[0] = true;
         s.job.scene.max.reset();
       }},
      {"needs conductivity and heat_capacity",
       [](Prepared& s, Settings&) { s.job.scene.materials[0].conductivity.reset(); }},
      {"needs conductivity and heat_capacity",
       [](Prepared& s, Settings&) { s.job.scene.materials[0].heat_capacity.reset(); }},
      {"which the scene does not have", [](Prepared& s, Settings&) { s.job.bodies[0].material = "none"; }},
      {"the arguments wave_vector and amplitude",
       [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature.reset(); }},
      {"the arguments wave_vector and amplitude", [](Prepared&, Settings& a) { a["amplitude"] = 0.0; }}};
  hold("cosine_mode", warm(false, 0.0), {}, at_rest);
  hold("cosine_mode", warm(false, 0.0), {},
       {{"differ in diffusivity",
         [](Prepared& s, Settings&) {
           second_body(s, 3.0);
           s.job.scene.bodies[0].temperature->wave_vector.x = test::pi / 0.11;
         }},
        {"",
         [](Prepared& s, Settings&) {
           second_body(s, 2.0);
           s.job.scene.bodies[0].temperature->wave_vector.x = test::pi / 0.11;
         }},
        {"not level at the insulated ends",
         [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature->phase = 0.1; }},
        {"not level at the insulated ends",
         [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature->wave_vector.x *= 1.01; }},
        {"must point along",
         [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature->wave_vector.y = 3.0; }}});
  hold("cosine_mode", warm(true, 0.7), {},
       {as_it_is, {"no whole number of waves", [](Prepared& s, Settings&) {
                     s.job.scene.bodies[0].temperature->wave_vector.x *= 1.5;
                   }}});
  hold("cosine_carried", warm(true, 0.7), {},
       {as_it_is,
        {"", [](Prepared& s, Settings&) { s.job.bodies[0].velocity.x = 1.0; }},
        {"at one velocity", [](Prepared& s, Settings&) { s.job.bodies[0].angular_velocity.x = 1.0; }},
        {"at one velocity",
         [](Prepared& s, Settings&) {
           second_body(s, 2.0);
           s.job.bodies[1].velocity.x = 1.0;
         }},
        {"",
         [](Prepared& s, Settings&) {
           second_body(s, 2.0);
           s.job.bodies[0].velocity.x = s.job.bodies[1].velocity.x = 1.0;
         }},
        {"has gravity", [](Prepared& s, Settings&) { s.job.scene.gravity.x = 1.0; }},
        {"has no bodies", [](Prepared& s, Settings&) { s.job.bodies.clear(); }}});
  hold("cosine_mode_lattice", warm(true, 0.7), {{"support_ratio", 2.5}},
       {as_it_is,
        {"make all directions periodic", [](Prepared& s, Settings&) { s.job.scene.periodic[2] = false; }},
        {"without jitter", [](Prepared& s, Settings&) { s.job.scene.jitter = 0.1; }},
        {"\"paper\" or \"corrected\"", [](Prepared&, Settings& a) { a["form"] = std::string("other"); }},
        {"", [](Prepared&, Settings& a) { a["form"] = std::string("paper"); }},
        {"", [](Prepared&, Settings& a) { a["form"] = std::string("corrected"); }}});
  const Settings wave{{"mean", 300.0},
                      {"amplitude_1", 10.0},
                      {"phase_1", 0.7},
                      {"wave_vector_1", std::vector<double>{20.0 * test::pi, 0, 0}}};
  hold("cosine_sum", warm(true, 0.7), wave,
       {as_it_is,
        {"the argument `mean`", [](Prepared&, Settings& a) { a.erase("mean"); }},
        {"wave 1 needs both", [](Prepared&, Settings& a) { a.erase("amplitude_1"); }},
        {"wave 1 needs both", [](Prepared&, Settings& a) { a.erase("wave_vector_1"); }},
        {"wave 4 needs both", [](Prepared&, Settings& a) { a["amplitude_4"] = 1.0; }},
        {"no whole number of waves",
         [](Prepared&, Settings& a) {
           a["wave_vector_1"] = std::vector<double>{30.0 * test::pi, 0, 0};
         }},
        {"no argument `amplitude_5`", [](Prepared&, Settings& a) { a["amplitude_5"] = 1.0; }},
        {"needs amplitude_1 and wave_vector_1",
         [](Prepared&, Settings& a) {
           a.erase("amplitude_1");
           a.erase("wave_vector_1");
         }},
        {"does not start with the waves", [](Prepared& s, Settings&) { s.initial.temperature[5] += 1.1e-8; }},
        {"", [](Prepared& s, Settings&) { s.initial.temperature[5] += 0.9e-8; }}});
  hold("sine_held_ends", warm(false, -0.5 * test::pi), {},
       {as_it_is,
        {"one body whose temperature is not held",
         [](Prepared& s, Settings&) { s.job.bodies[0].temperature_held = true; }},
        {"all bodies but one", [](Prepared& s, Settings&) { second_body(s, 2.0); }},
        {"",
         [](Prepared& s, Settings&) {
           second_body(s, 2.0);
           s.job.bodies[1].temperature_held = true;
         }},
        {"differ in diffusivity",
         [](Prepared& s, Settings&) {
           second_body(s, 3.0);
           s.job.bodies[1].temperature_held = true;
         }},
        {"at its mean at the held ends",
         [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature->phase += 1e-3; }}});
  hold("two_conductivities", warm(false, 0.0), {},
       {{"for two bodies", [](Prepared&, Settings&) {}},
        {"must start at one temperature", [](Prepared& s, Settings&) { second_body(s, 3.0); }},
        {"",
         [](Prepared& s, Settings&) {
           second_body(s, 3.0);
           s.initial.temperature.assign(s.initial.size(), 300.0);
         }},
        {"must start at one temperature",
         [](Prepared& s, Settings&) {
           second_body(s, 3.0);
           s.initial.temperature.clear();
         }},
        {"do not touch",
         [](Prepared& s, Settings&) {
           second_body(s, 3.0);
           s.job.scene.bodies[1].shape.min.x += 1e-6;
           s.job.scene.bodies[1].shape.max.x += 1e-6;
         }},
        {"touch twice", [](Prepared& s, Settings&) {
           second_body(s, 3.0);
           s.job.scene.periodic[0] = true;
         }}});
}

TEST(Refusals, OfAStepOfTemperature) {
  auto s = warm(false, 0.0);
  TemperatureField step;
  step.kind = TemperatureField::Kind::step;
  step.normal = {1, 0, 0};
  step.point = {0.05, 0, 0};
  step.behind = 400.0;
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
         [](Prepared& p, Settings&) {
           p.job.scene.bodies[0].temperature->kind = TemperatureField::Kind::constant;
         }},
        {"kind = \"step\"", [](Prepared& p, Settings&) { p.job.scene.bodies[0].temperature.reset(); }},
        {"must point along",
         [](Prepared& p, Settings&) { p.job.scene.bodies[0].temperature->normal.y = 1.0; }}});
}

TEST(Refusals, OfMelting) {
  hold(
      "stefan", test::stefan_bar({}), {},
      {as_it_is,
       {"needs a wall", [](Prepared& s, Settings&) { s.job.bodies[1].temperature_held = false; }},
       {"several bodies hold", [](Prepared& s, Settings&) { s.job.bodies[0].temperature_held = true; }},
       {"a material with t_melt", [](Prepared& s, Settings&) { s.job.scene.materials[0].t_melt.reset(); }},
       {"`walls`", [](Prepared&, Settings& a) { a["wall"] = std::string("walls"); }},
       {"",
        [](Prepared&, Settings& a) {
          a["wall"] = std::string("wall");
          a["body"] = std::string("bar");
        }},
       {"`bar` needs one temperature",
        [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature.reset(); }},
       {"`wall` needs one temperature",
        [](Prepared& s, Settings&) {
          s.job.scene.bodies[1].temperature->kind = TemperatureField::Kind::step;
        }},
       {"needs t_melt, heat_capacity and latent_heat",
        [](Prepared& s, Settings&) { s.job.scene.materials[0].latent_heat.reset(); }},
       {"needs t_melt, heat_capacity and latent_heat",
        [](Prepared& s, Settings&) { s.job.scene.materials[0].heat_capacity.reset(); }},
       {"",
        [](Prepared& s, Settings& a) {
          s.job.scene.materials[0].latent_heat.reset();
          a["latent_heat"] = 1e5;
        }},
       {"must lie between", [](Prepared& s, Settings&) { s.job.scene.bodies[0].temperature->value = 310.0; }},
       {"must lie between",
        [](Prepared& s, Settings&) {
          s.job.scene.bodies[1].temperature->value = 299.0;
          s.job.scene.bodies[0].temperature->value = 280.0;
        }},
       {"half space", [](Prepared& s, Settings&) { test::set_times(s, 2000.0, 20); }},
       {"every direction is periodic", [](Prepared& s, Settings&) { s.job.scene.periodic[0] = true; }}});
  hold("hysteresis", test::heated_block(), {},
       {as_it_is,
        {"needs heat events", [](Prepared& s, Settings&) { s.job.scene.events.clear(); }},
        {"needs a temperature", [](Prepared& s, Settings&) { s.job.scene.events[2].temperature.reset(); }},
        {"must hold all that can melt",
         [](Prepared& s, Settings&) { s.job.scene.events[1].bodies = {"other"}; }},
        {"", [](Prepared& s, Settings&) { s.job.scene.events[1].bodies.clear(); }},
        {"", [](Prepared& s, Settings&) {
           s.job.scene.events[1].bodies = {"other"};
           s.job.scene.materials[0].t_melt.reset();
         }}});
}

TEST(Refusals, OfBarsAndBeams) {
  hold("cantilever", test::beam(2.0), {},
       {as_it_is,
        {"held at both ends",
         [](Prepared& s, Settings&) {
           test::add_matter(s, "other", Phase::rigid, {{3, 2, 2}, 0.01, {0.2, 0, 0}, 1.0}, {}, 1000.0, 0.0,
                            Motion::fixed);
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
        {"must be \"paper\" or \"corrected\"", word("form", "half")},
        {"", word("form", "corrected")},
        {"above 0 and at most 1", [](Prepared&, Settings& a) { a["gauge"] = 0.0; }},
        {"above 0 and at most 1", [](Prepared&, Settings& a) { a["gauge"] = 1.001; }},
        {"", [](Prepared&, Settings& a) { a["gauge"] = 1.0; }},
        {"at each end", [](Prepared& s, Settings&) { s.job.bodies[1].motion = Motion::free; }},
        {"at each end", [](Prepared& s, Settings&) { s.job.bodies[2].phase = Phase::liquid; }},
        {"hold the same end", [](Prepared& s, Settings&) { s.job.bodies[1].properties.centre.x = 0.3; }},
        {"no closed form", [](Prepared& s, Settings& a) {
           s.job.scene.materials[0].elastic_limit = 0.01;
           a["sides"] = std::string("plane_strain");
         }}});
  auto swinging = test::driven_bar(1.0);
  auto& v = swinging.job.scene.bodies[0].velocity;
  v.kind = VelocityField::Kind::cosine;
  v.wave_vector = {test::pi / 0.2, 0, 0};
  v.amplitude = {0.1, 0, 0};
  hold(
      "elastic_wave", swinging, {},
      {as_it_is,
       {"kind = \"cosine\"",
        [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.kind = VelocityField::Kind::linear; }},
       {"kind = \"cosine\"", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.wave_vector = {}; }},
       {"kind = \"cosine\"", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.amplitude = {}; }},
       {"move on the mean", [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.mean.z = 1.0; }},
       {"must point along",
        [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.wave_vector.y = 1.0; }},
       {"along its wave vector or across",
        [](Prepared& s, Settings&) { s.job.scene.bodies[0].velocity.amplitude.y = 0.1; }},
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
       {{"the argument `pressure`", [](Prepared&, Settings&) {}},
        {"", [](Prepared&, Settings& a) { a["pressure"] = 1e4; }}});
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
        {"\"liquid\", \"elastic\", \"rigid\" or \"solid\"",
         [](Prepared&, Settings& a) { a["phase"] = std::string("gas"); }},
        {"names body `rigt`", [](Prepared&, Settings& a) { a["other"] = std::string("rigt"); }},
        {"both `min` and `max`", [=](Prepared&, Settings& a) { a["min"] = vector(0, 0, 0); }},
        {"both `min` and `max`", [=](Prepared&, Settings& a) { a["max"] = vector(0, 0, 0); }},
        {"above `min` in x",
         [=](Prepared&, Settings& a) {
           a["min"] = vector(1, 0, 0);
           a["max"] = vector(1, 1, 1);
         }},
        {"above `min` in y",
         [=](Prepared&, Settings& a) {
           a["min"] = vector(0, 1, 0);
           a["max"] = vector(1, 1, 1);
         }},
        {"above `min` in z",
         [=](Prepared&, Settings& a) {
           a["min"] = vector(0, 0, 2);
           a["max"] = vector(1, 1, 1);
         }},
        {"must be greater than 0", [](Prepared&, Settings& a) { a["frequency"] = 0.0; }},
        {"no argument `valu`", [](Prepared&, Settings& a) { a["valu"] = 0.0; }}});
  hold("cosine_mod", test::cubes(), {},
       {{"unknown reference function `cosine_mod`", [](Prepared&, Settings&) {}}});
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

// SPDX-License-Identifier: BSD-3-Clause
// What a case says and no run of it can show is found before it runs.
#include "validation/case/idle_keys.hpp"

#include <gtest/gtest.h>

#include "case_file.hpp"
#include "sampling/sample.hpp"

namespace tripoint::test {
namespace {

constexpr const char* brick = "[[material]]\nname = 'brick'\ndensity = 1000\n";
constexpr const char* jelly =
    "[[material]]\nname = 'jelly'\ndensity = 1000\nyoung_modulus = 1e5\npoisson_ratio = 0.3\n";
constexpr const char* ink = "[[material]]\nname = 'ink'\ndensity = 1000\nviscosity = 1\nsound_speed = 20\n";

std::string scene(const std::string& keys = "") {
  return "[scene]\nend_time = 1\nspacing = 0.1\n" + keys + "\n";
}
std::string body(const std::string& name, const std::string& material, const std::string& phase, double x,
                 const std::string& more = "") {
  const auto corner = [](double a) { return "[" + std::to_string(a) + ",0,0]"; };
  return "[[body]]\nname = '" + name + "'\nmaterial = '" + material + "'\nphase = '" + phase +
         "'\nshape = {kind = 'box', min = " + corner(x) + ", max = [" + std::to_string(x + 0.3) +
         ",0.3,0.3]}\n" + more + "\n";
}
std::string event(const std::string& keys) { return "[[event]]\n" + keys + "\n"; }
std::string box(double from, double to) {
  return "{kind = 'box', min = [" + std::to_string(from) + ",-1,-1], max = [" + std::to_string(to) + ",1,1]}";
}

/// What is said with these words in it: "error" or "warning", or "" for nothing.
std::string found(const std::string& text, const std::string& words) {
  const auto reading = read_text(text);
  const auto s = scene_for(reading.value, {});
  for (const auto& f : idle_keys(reading, s, sample(s))) {
    if (f.what.find(words) == std::string::npos) continue;
    EXPECT_FALSE(f.place.file.empty()) << f.what;
    EXPECT_GT(f.place.line, 0) << f.what;
    return f.error ? "error" : "warning";
  }
  return "";
}
bool silent(const std::string& text) {
  const auto reading = read_text(text);
  const auto s = scene_for(reading.value, {});
  const auto all = idle_keys(reading, s, sample(s));
  for (const auto& f : all) ADD_FAILURE() << f.what;
  return all.empty();
}

std::string cube(const std::string& more = "") { return brick + body("cube", "brick", "rigid", 0.0, more); }
std::string grip(double from, double to, double time = 0.0) {
  const auto t = std::to_string(time);
  return event("kind = 'grip'\nname = 'hand'\ntime = " + t + "\nregion = " + box(from, to) +
               "\nkeyframes = [{time = " + t + ", position = [0,0,0]}, {time = 1, position = [0,0,1]}]");
}

TEST(IdleKeys, FindNothingInASoundScene) {
  EXPECT_TRUE(silent(scene("gravity = [0,0,-9.81]") + cube() + grip(-1, 1)));
}

TEST(IdleKeys, FindARegionWithNothingInIt) {
  EXPECT_EQ(found(scene() + cube() + grip(5, 6), "in the region of this event"), "error") << "at the start";
  EXPECT_EQ(found(scene() + cube("motion = 'fixed'") + grip(5, 6, 0.5), "in the region of this event"),
            "error")
      << "nothing moves there";
  EXPECT_EQ(found(scene() + cube("velocity = [10,0,0]") + grip(5, 6, 0.5), "in the region of this event"),
            "warning")
      << "it may fly there";
  EXPECT_EQ(found(scene() + cube() + grip(0.2, 6), "more than half"), "error")
      << "a third of a rigid body is not enough";
  EXPECT_EQ(found(scene() + jelly + body("block", "jelly", "elastic", 0.0) + grip(0.2, 6), "in the region"),
            "")
      << "a third of an elastic one is";
  const auto warm = brick + std::string("conductivity = 1\nheat_capacity = 1000\n") +
                    body("cube", "brick", "rigid", 0.0, "temperature = 300");
  EXPECT_EQ(found(scene() + warm + event("kind = 'heat'\ntime = 0\ntemperature = 400\nregion = " + box(5, 6)),
                  "no particle lies in the region"),
            "error");
  EXPECT_EQ(
      found(scene() + warm + event("kind = 'heat'\ntime = 0\ntemperature = 400\nregion = " + box(0.2, 6)),
            "in the region"),
      "");
}

TEST(IdleKeys, FindAReleaseOfWhatIsFreeAndAHoldOfWhatIsFixed) {
  const auto release = event("kind = 'release'\ntime = 0.5\nbodies = ['cube']");
  const auto hold = [](const std::string& until) {
    return event("kind = 'hold'\ntime = 0.1\nbodies = ['cube']" + until);
  };
  EXPECT_EQ(found(scene() + cube() + release, "is not held"), "error");
  EXPECT_EQ(found(scene() + cube() + hold("") + release, "is not held"), "");
  EXPECT_EQ(found(scene() + cube() + hold("\nuntil = 0.2") + release, "is not held"), "error")
      << "the hold has ended";
  EXPECT_EQ(found(scene() + cube("motion = 'fixed'") + release, "is not held"), "");
  EXPECT_EQ(found(scene() + cube("motion = 'fixed'") + release +
                      event("kind = 'release'\ntime = 0.7\nbodies = ['cube']"),
                  "is not held at 0.7 s"),
            "error");
  EXPECT_EQ(found(scene() + cube() + grip(-1, 1) + event("kind = 'release'\ntime = 0.5\nbodies = ['hand']"),
                  "is not held"),
            "");
  EXPECT_EQ(found(scene() + cube("motion = 'fixed'") + hold(""), "changes nothing"), "error");
}

TEST(IdleKeys, FindKeyframesAfterTheEnd) {
  const auto led = [](const std::string& frames) {
    return cube("motion = 'prescribed'\nkeyframes = " + frames);
  };
  EXPECT_EQ(
      found(scene() + led("[{time = 0, position = [0.15,0.15,0.15]}, {time = 5, position = [1,0.15,0.15]}]"),
            "on its way to that of 5 s"),
      "warning");
  EXPECT_EQ(found(scene() + led("[{time = 0, position = [0.15,0.15,0.15]}, {time = 1, position = "
                                "[1,0.15,0.15]}, {time = 5, "
                                "position = [2,0.15,0.15]}]"),
                  "never followed"),
            "warning");
  EXPECT_EQ(
      found(scene() + led("[{time = 3, position = [0.15,0.15,0.15]}, {time = 5, position = [1,0.15,0.15]}]"),
            "stands still"),
      "warning");
  EXPECT_TRUE(silent(scene() +
                     led("[{time = 0, position = [0.15,0.15,0.15]}, {time = 1, position = [1,0.15,0.15]}]")));
  EXPECT_TRUE(silent(
      scene() +
      led("[{time = 0, position = [0.15,0.15,0.15]}, {time = 0.5, position = [1,0.15,0.15]}, {time = 5, "
          "position = [1,0.15,0.15]}]")))
      << "it stays there";
}

TEST(IdleKeys, FindMatterThatTheSceneCannotSee) {
  const std::string domain = "min = [-1,-1,-1]\nmax = [1,1,1]";
  EXPECT_EQ(found(scene(domain) + cube() + body("far", "brick", "rigid", 3.0, "motion = 'fixed'"),
                  "wholly outside"),
            "error");
  EXPECT_EQ(found(scene(domain) + cube() + body("near", "brick", "rigid", 0.5, "motion = 'fixed'"),
                  "wholly outside"),
            "");
  EXPECT_EQ(found(scene() + cube() + "[[material]]\nname = 'spare'\ndensity = 5\n", "\"spare\""), "warning");
  const auto inflow = [](const std::string& low, const std::string& high, const std::string& more = "") {
    return "[[inflow]]\nmaterial = 'ink'\nshape = {kind = 'box', min = " + low + ", max = " + high +
           "}\nvelocity = [0,0,-1]\n" + more;
  };
  const auto pool = ink + body("pool", "ink", "liquid", 0.0);
  EXPECT_TRUE(silent(scene(domain) + pool + inflow("[0,0,0.5]", "[0.3,0.3,0.8]")));
  EXPECT_EQ(
      found(scene(domain) + pool + inflow("[0,0,5]", "[0.3,0.3,5.3]"), "the inflow lies wholly outside"),
      "error");
  EXPECT_EQ(found(scene() + pool + inflow("[0,0,0.5]", "[0.001,0.001,0.501]"), "holds no particle"), "error");
  EXPECT_EQ(
      found(scene() + pool + inflow("[0,0,0.5]", "[0.3,0.3,0.8]", "temperature = 300\n"), "is not followed"),
      "error");
}

TEST(IdleKeys, FindJointsThatJoinNothing) {
  EXPECT_EQ(found(scene() + jelly + body("a", "jelly", "elastic", 0.0, "joined_to = ['b']") +
                      body("b", "jelly", "elastic", 0.3),
                  "joins"),
            "");
  EXPECT_EQ(found(scene() + jelly + body("a", "jelly", "elastic", 0.0, "joined_to = ['b']") +
                      body("b", "jelly", "elastic", 2.0),
                  "nothing joins them"),
            "error");
  EXPECT_EQ(found(scene() + brick + body("a", "brick", "rigid", 0.0, "joined_to = ['b']") +
                      body("b", "brick", "rigid", 0.3),
                  "neither is elastic"),
            "error");
}

TEST(IdleKeys, FindLimitsOfTheFormThatDoesNotRun) {
  const auto torn = [](const std::string& limit, const std::string& keys = "") {
    return scene(keys) + jelly + limit + body("block", "jelly", "elastic", 0.0);
  };
  EXPECT_EQ(found(torn("fracture_distance = 2.5\n"), "never breaks"), "error");
  EXPECT_EQ(found(torn("fracture_stretch = 1.5\n", "mode = 'paper'"), "never breaks"), "error");
  EXPECT_EQ(found(torn("fracture_stretch = 1.5\n"), "never breaks"), "");
  EXPECT_EQ(found(torn("fracture_distance = 2.5\n", "mode = 'paper'"), "never breaks"), "");
  EXPECT_EQ(
      found(scene() + brick + "elastic_limit = 0.1\n" + body("cube", "brick", "rigid", 0.0), "never acts"),
      "warning");
}

TEST(IdleKeys, FindKeysOfTheSceneThatNoEffectReads) {
  for (const char* key : {"transport_velocity = true",
                          "viscosity_form = 'laplacian'",
                          "clamp = false",
                          "contact_viscosity = 3",
                          "bulk_viscosity = 0.1",
                          "surface_weight = 0.4",
                          "isotropic_shear = 1",
                          "core_reach = 0.6",
                          "contact_stiffness = 3",
                          "contact_step = 0.3",
                          "face_pressure = 1",
                          "interface_weight = 1",
                          "mean_pressure = 1",
                          "sound_damping = 0.2",
                          "surface_exchange = 0",
                          "hourglass = 5",
                          "bending = 1",
                          "merge_distance = 1.2",
                          "modes.heat = 'paper'",
                          "modes.elastic = 'paper'"})
    EXPECT_EQ(found(scene(key) + cube(), "changes nothing"), "warning") << key;
  const auto pool = ink + body("pool", "ink", "liquid", 0.0);
  const auto summed = [](const std::string& keys) {  // of liquid that sums its density
    const bool printed = keys.find("paper") != std::string::npos && keys.find("walls") == std::string::npos;
    return scene(keys) + (printed ? "" : "[model]\npressure = 'conservative'\n");
  };
  for (const char* key : {"viscosity_form = 'laplacian'", "clamp = false", "modes.walls = 'paper'"})
    EXPECT_EQ(found(summed(key) + pool, "changes nothing"), "") << key;
  for (const char* key : {"viscosity_form = 'laplacian'", "transport_velocity = true"})
    EXPECT_EQ(found(summed(std::string("mode = 'paper'\n") + key) + pool, "changes nothing"), "warning")
        << key;
  for (const std::string key : {"mean_pressure = 1", "sound_damping = 0.2"}) {
    EXPECT_EQ(found(summed(key) + pool, "changes nothing"), "warning") << key;
    const std::string moved = key + "\ntransport_velocity = true\nclamp = false";
    EXPECT_EQ(found(summed(moved) + pool, "changes nothing"), "") << key;
    EXPECT_EQ(found(summed(moved + "\nmodes.state = 'paper'") + pool, "changes nothing"), "warning") << key;
  }
  EXPECT_EQ(found(summed("bulk_viscosity = 0.1") + pool, "changes nothing"), "");
  for (const char* key : {"mode = 'paper'", "clamp = false", "modes.pressure = 'paper'"})
    EXPECT_EQ(found(summed(std::string("bulk_viscosity = 0.1\n") + key) + pool, "changes nothing"), "warning")
        << key;
  EXPECT_EQ(found(summed("surface_weight = 0.4\ngravity = [0, 0, -9.81]") + pool, "changes nothing"), "");
  EXPECT_EQ(found(summed("surface_weight = 0.4") + pool, "changes nothing"), "warning");
  EXPECT_EQ(
      found(summed("surface_weight = 0.4\ngravity = [0, 0, -9.81]\nclamp = false") + pool, "changes nothing"),
      "warning");
  EXPECT_EQ(found(summed("contact_stiffness = 3") + pool, "changes nothing"), "warning");
  EXPECT_EQ(found(summed("contact_stiffness = 3") + pool + brick + body("block", "brick", "rigid", 0.5),
                  "changes nothing"),
            "");
  const auto hit = pool + brick + body("block", "brick", "rigid", 0.5);
  EXPECT_EQ(found(summed("contact_step = 0.3") + hit, "changes nothing"), "");
  EXPECT_EQ(found(summed("contact_step = 0.3") + pool, "changes nothing"), "warning");
  for (const char* key : {"time_step = 1e-3", "clamp = false", "modes.density = 'paper'",
                          "modes.pressure = 'paper'", "modes.state = 'paper'"})
    EXPECT_EQ(found(summed(std::string("contact_step = 0.3\n") + key) + hit, "changes nothing"), "warning")
        << key;
  EXPECT_EQ(found(summed("core_reach = 0.6") + pool, "changes nothing"), "");
  EXPECT_EQ(found(scene("core_reach = 0.6\nmode = 'paper'") + pool, "changes nothing"), "warning");
  EXPECT_EQ(found(summed("isotropic_shear = 1") + pool, "changes nothing"), "");
  const auto block = jelly + body("block", "jelly", "elastic", 0.5);
  EXPECT_EQ(found(summed("face_pressure = 1") + pool + block, "changes nothing"), "");
  EXPECT_EQ(found(summed("face_pressure = 1") + pool, "changes nothing"), "warning");
  for (const char* term : {"density", "pressure", "state", "elastic"})
    EXPECT_EQ(found(summed("face_pressure = 1\nmodes." + std::string(term) + " = 'paper'") + pool + block,
                    "changes nothing"),
              "warning")
        << term;
  EXPECT_EQ(found(summed("face_pressure = 1") + pool + jelly + "fracture_stretch = 1.5\n" +
                      body("block", "jelly", "elastic", 0.5),
                  "changes nothing"),
            "warning");
  const auto oil = "[[material]]\nname = 'oil'\ndensity = 800\n" + body("oil", "oil", "liquid", 0.5);
  EXPECT_EQ(found(summed("interface_weight = 1\ngravity = [0, 0, -9.81]") + pool + oil, "changes nothing"),
            "");
  EXPECT_EQ(found(summed("interface_weight = 1") + pool + oil, "changes nothing"), "warning");
  EXPECT_EQ(found(summed("interface_weight = 1\ngravity = [0, 0, -9.81]") + pool, "changes nothing"),
            "warning");
  EXPECT_EQ(found(summed("interface_weight = 1\ngravity = [0, 0, -9.81]\nclamp = false") + pool + oil,
                  "changes nothing"),
            "warning");
  for (const char* key : {"mode = 'paper'", "viscosity_form = 'laplacian'"})
    EXPECT_EQ(found(scene(std::string("isotropic_shear = 1\n") + key) + pool, "changes nothing"), "warning")
        << key;
  EXPECT_EQ(found(scene("hourglass = 5") + jelly + body("block", "jelly", "elastic", 0.0), "changes nothing"),
            "");
  EXPECT_EQ(found(scene("bending = 1") + jelly + body("block", "jelly", "elastic", 0.0), "changes nothing"),
            "");
  EXPECT_EQ(
      found(scene("bending = 1\nmodes.elastic = 'paper'") + jelly + body("block", "jelly", "elastic", 0.0),
            "changes nothing"),
      "warning");
  EXPECT_EQ(found(scene("hourglass = 5\nmodes.hourglass = 'paper'") + jelly +
                      body("block", "jelly", "elastic", 0.0),
                  "changes nothing"),
            "warning");
  const std::string near = "merge_distance = 1.2", two = cube() + body("other", "brick", "rigid", 0.5);
  EXPECT_EQ(found(scene(near) + two + event("kind = 'merge'\ntime = 0.5\nbodies = ['cube', 'other']"),
                  "changes nothing"),
            "");
  EXPECT_EQ(found(scene(near) + jelly + "fracture_stretch = 1.5\n" + body("block", "jelly", "elastic", 0.0),
                  "changes nothing"),
            "");
  EXPECT_EQ(found(scene(near) + jelly + body("a", "jelly", "elastic", 0.0, "joined_to = ['b']") +
                      body("b", "jelly", "elastic", 0.3),
                  "changes nothing"),
            "");
  EXPECT_EQ(found(scene() + cube("slip = 'free'"), "slip"), "warning");
  EXPECT_EQ(found(scene() + cube("joins = true"), "joins"), "warning");
}

TEST(IdleKeys, FindWhatTheJudgeDoesNotRead) {
  const auto metric = [](const std::string& more) {
    return "[[metric]]\nname = 'm'\nquantity = 'position'\n" + more + "\n";
  };
  const std::string truth = "[reference]\nkind = 'analytic'\nfunction = 'ballistic'\n";
  EXPECT_EQ(
      found(scene() + cube() + truth + metric("reference = {kind = 'analytic', function = 'ballistic'}"),
            "compared with nothing"),
      "warning");
  EXPECT_EQ(found(scene() + cube() + truth + metric(""), "compared with nothing"), "");
  EXPECT_EQ(found(scene() + cube() + truth + metric("norm = 'max'\nat = '0.5'"), "reads no `at`"), "warning");
  EXPECT_EQ(found(scene() + cube() + truth + metric("norm = 'L2'\nwindow = [0.1, 0.5]"), "reads no window"),
            "warning");
  EXPECT_EQ(found(scene() + cube() + truth + metric("window = [0.1, 9.0]"), "lasts until 9 s"), "warning");
  EXPECT_EQ(found(scene() + cube() + truth + metric("window = [0.1, 0.5]"), "lasts until"), "");
  EXPECT_EQ(found(scene() + cube() + truth + metric("") +
                      "[[study]]\naxis = 'time_step'\nlevels = [0.2, 0.1]\nseeds = 3\n",
                  "nothing is random"),
            "warning");
  EXPECT_EQ(found(scene() + cube() + truth + metric("") +
                      "[[study]]\naxis = 'time_step'\nlevels = [0.2, 0.1]\nseeds = 3\njitter = 0.1\n",
                  "nothing is random"),
            "");
}

TEST(IdleKeys, FindLimitsThatCannotFailOrCannotPass) {
  const auto judged = [](const std::string& norm, const std::string& limit) {
    return scene() + cube() + "[[metric]]\nname = 'm'\nquantity = 'position'\nnorm = '" + norm +
           "'\n[[gate]]\nmetric = 'm'\n" + limit + "\nreason = 'a test'\n";
  };
  EXPECT_EQ(found(judged("max", "limit = -1"), "nothing can pass"), "error");
  EXPECT_EQ(found(judged("max", "at_least = -5"), "passes anything"), "error");
  EXPECT_EQ(found(judged("L2", "at_least = 0"), "passes anything"), "error");
  EXPECT_EQ(found(judged("final", "at_least = -5"), "passes anything"), "")
      << "a single number keeps its sign";
  EXPECT_EQ(found(judged("max", "at_least = 0\nlimit = 1"), "passes anything"), "");
}

// --- refused by the reader

TEST(Refusals, OfKeysThatAnEventOfThisKindDoesNotRead) {
  const auto two = cube() + body("other", "brick", "rigid", 1.0);
  for (
      const char* keys :
      {"kind = 'merge'\nbodies = ['cube', 'other']\nuntil = 0.9",
       "kind = 'merge'\nbodies = ['cube', 'other']\nregion = {kind = 'sphere', centre = [0,0,0], radius = 1}",
       "kind = 'hold'\nbodies = ['cube']\ntemperature = 300",
       "kind = 'release'\nbodies = ['cube']\nregion = {kind = 'sphere', centre = [0,0,0], radius = 1}",
       "kind = 'grip'\nname = 'hand'\nbodies = ['cube']\nregion = {kind = 'sphere', centre = [0,0,0], radius "
       "= 1}\nkeyframes = [{time = 0.5, position = [0,0,0]}]"})
    EXPECT_NE(
        refusal(scene() + two + event(std::string("time = 0.5\n") + keys)).find("event does not read it"),
        std::string::npos)
        << keys;
  EXPECT_NE(refusal(scene() + two + event("time = 0.5\nkind = 'release'")).find("needs the key `bodies`"),
            std::string::npos);
}

TEST(Refusals, OfEventsThatWouldDoAnotherThingThanTheySay) {
  const auto pool = ink + body("pool", "ink", "liquid", 1.0);
  EXPECT_NE(refusal(scene() + cube() + pool + event("time = 0.5\nkind = 'merge'\nbodies = ['cube', 'pool']"))
                .find("only solids merge and split"),
            std::string::npos);
  EXPECT_NE(refusal(scene() + jelly + body("block", "jelly", "elastic", 0.0, "motion = 'fixed'") +
                    event("time = 0.5\nkind = 'release'\nbodies = ['block']"))
                .find("moves as a whole"),
            std::string::npos);
  EXPECT_NE(refusal(scene() + cube() +
                    event("time = 0.5\nkind = 'grip'\nname = 'hand'\nregion = " + box(-1, 1) +
                          "\nkeyframes = [{time = 0, position = [0,0,0]}, {time = 1, position = [0,0,1]}]"))
                .find("would jump"),
            std::string::npos);
  EXPECT_NE(
      refusal(scene() +
              cube("motion = 'prescribed'\nvelocity = [1,0,0]\nkeyframes = [{time = 0, position = [0,0,0]}, "
                   "{time = 1, position = [0,0,1]}]"))
          .find("give its velocities"),
      std::string::npos);
}

TEST(Refusals, OfAKernelOfAnotherFormThanTheTermsHave) {
  const auto pool = ink + body("pool", "ink", "liquid", 0.0);
  EXPECT_NE(refusal(scene("modes.kernel = 'paper'") + pool).find("brings the kernel of its form"),
            std::string::npos);
  EXPECT_NE(refusal(scene("mode = 'paper'\nmodes.kernel = 'corrected'") + pool)
                .find("brings the kernel of its form"),
            std::string::npos);
  EXPECT_EQ(refusal(scene("modes.kernel = 'corrected'") + pool), "");
  EXPECT_NE(refusal("[case]\nmodes = ['corrected', 'paper']\n" + scene("modes.kernel = 'corrected'") + pool)
                .find("brings the kernel of its form"),
            std::string::npos);
}

TEST(Refusals, OfDataThatNobodyReads) {
  const Folder folder;
  const auto data = folder.write("x.csv", "time,value\n0,1\n");
  const auto file = folder.write(
      "case.toml",
      scene() + cube() + "[reference]\nkind = 'analytic'\nfunction = 'ballistic'\nfile = 'x.csv'\n");
  EXPECT_THROW(static_cast<void>(read_case(file)), InputError);
}

}  // namespace
}  // namespace tripoint::test

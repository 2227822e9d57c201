// SPDX-License-Identifier: BSD-3-Clause
// Each key `modes.TERM` of the case file does something: with it a run has other bits, or the case is
// refused.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "core/errors.hpp"
#include "sampling/sample.hpp"
#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "step/simulation.hpp"
#include "validation/case/read_case.hpp"

namespace tripoint {
namespace {

/// Water on a floor, a jelly that spins and melts, and a rod that tumbles: every term acts within the first
/// steps.
constexpr const char* every_term = R"(
[scene]
end_time = 0.02
gravity = [0, 0, -9.81]
spacing = 0.01
[[material]]
name = "wax"
density = 1000
viscosity = 1
sound_speed = 20
young_modulus = 1e5
poisson_ratio = 0.3
conductivity = 20
heat_capacity = 1000
t_melt = 350
t_solid = 345
latent_heat = 1000
softens = true
[[material]]
name = "stone"
density = 2000
conductivity = 20
heat_capacity = 1000
[[body]]
name = "floor"
material = "stone"
phase = "rigid"
motion = "fixed"
temperature = 330
shape = {kind = "box", min = [0, 0, -0.03], max = [0.1, 0.06, 0]}
[[body]]
name = "pool"
material = "wax"
phase = "liquid"
temperature = 360
velocity = {kind = "linear", gradient = [[0, 0, 5], [0, 0, 0], [0, 0, 0]]}
shape = {kind = "box", min = [0, 0, 0], max = [0.04, 0.06, 0.04]}
[[body]]
name = "jelly"
material = "wax"
phase = "elastic"
temperature = {kind = "step", point = [0.075, 0, 0], normal = [1, 0, 0], behind = 349.9, ahead = 340}
angular_velocity = [0, 20, 0]
velocity = {kind = "linear", centre = [0.07, 0.03, 0.06], gradient = [[2, 0, 0], [0, -1, 0], [0, 0, -1]]}
shape = {kind = "box", min = [0.05, 0.01, 0.04], max = [0.09, 0.05, 0.08]}
[[body]]
name = "rod"
material = "stone"
phase = "rigid"
temperature = 340
angular_velocity = [3, 5, 7]
shape = {kind = "box", min = [0, 0, 0.1], max = [0.06, 0.04, 0.12]}
[[event]]
time = 0.004
kind = "heat"
bodies = ["jelly"]
region = {kind = "half_space", point = [0.06, 0, 0], normal = [1, 0, 0]}
temperature = 352
until = 0.008
)";

/// FNV-1a over the bits of the particles by id, after 20 ms. @throws InputError
std::uint64_t bits_with(const std::vector<std::string>& sets) {
  std::string folder = (std::filesystem::temp_directory_path() / "tripoint-modes-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) throw EngineError("no folder");
  const auto file = std::filesystem::path(folder) / "case.toml";
  std::ofstream(file) << every_term;
  Case value;
  try {
    value = read_case(file.string(), sets).value;
  } catch (...) {
    std::filesystem::remove_all(folder);
    throw;
  }
  std::filesystem::remove_all(folder);
  const Scene scene = scene_for(value, {});
  Simulation run(scene, sample(scene), {.threads = 1});
  run.advance_to(scene.end_time);
  std::uint64_t hash = 1469598103934665603ull;
  const auto add = [&](double v) { hash = (hash ^ std::bit_cast<std::uint64_t>(v)) * 1099511628211ull; };
  const Particles& p = run.state().particles;
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    for (const Vec3& v : {p.position(i), p.velocity(i)}) {
      add(v.x);
      add(v.y);
      add(v.z);
    }
    add(p[field::temperature][i]);
  }
  return hash;
}

TEST(Modes, EachTermChangesTheRunOrIsRefused) {
  const auto usual = bits_with({});
  EXPECT_EQ(bits_with({}), usual) << "else a difference would prove nothing";
  for (const DeclaredTerm& one : declared_terms()) {
    // Walls are of liquid that sums its density
    std::vector<std::string> sets;
    if (one.term == term::walls) sets.emplace_back("model.pressure=\"conservative\"");
    const auto corrected = sets.empty() ? usual : bits_with(sets);
    const auto with = [&](const std::string& set) {
      auto all = sets;
      all.push_back(set);
      return bits_with(all);
    };
    const std::string key = "scene.modes." + std::string(one.term.name);
    EXPECT_EQ(with(key + "=\"corrected\""), corrected) << key;
    try {
      EXPECT_NE(with(key + "=\"paper\""), corrected) << key << " is read and changes nothing";
    } catch (const InputError& refusal) {
      EXPECT_EQ(one.term.name, "kernel") << refusal.what();
    } catch (const Diverged& stopped) {
      // Pressure that pulls tears the scene: a guard stops it
      EXPECT_EQ(one.term.name, "clamp") << stopped.what();
    }
  }
}

}  // namespace
}  // namespace tripoint

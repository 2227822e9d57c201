// SPDX-License-Identifier: BSD-3-Clause
/// States of a scene as the solver has them, for oracle.py to compute again: the particles that it starts
/// with, then all columns, bonds, excluded pairs and the ledger before the first step and around a later one,
/// as one JSON document.
///   write-states CASE.toml MODE STEPS [KEY=VALUE...]
///   write-states --terms    the name of every pair term that is compiled, one a line
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <exception>
#include <iostream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "files/scene_json.hpp"
#include "pairs/pair_passes.hpp"
#include "sampling/sample.hpp"
#include "step/simulation.hpp"
#include "validation/case/read_case.hpp"

using namespace tripoint;
using Json = nlohmann::ordered_json;

namespace {

Json lists_of_bonds(const State& state) {
  Json lists = Json::array();
  for (std::size_t id = 0; id < state.bonds.particles(); ++id)
    for (const Bond& b : state.bonds.of(id))
      lists.push_back({id, b.other, b.x.x, b.x.y, b.x.z, b.gradient.x, b.gradient.y, b.gradient.z, b.weight,
                       state.bonds.of(b.other)[b.twin].other});
  return lists;
}

Json lists_of_excluded_pairs(const State& state) {
  Json lists = Json::array();
  for (std::size_t id = 0; id < state.own.particles(); ++id)
    for (const ExcludedPair& pair : state.own.of(id)) lists.push_back({id, pair.other, pair.weight});
  return lists;
}

/// Columns by name, in order of id.
Json columns_of(const Particles& particles) {
  Json columns;
  particles.for_each([&]<class T>(const FieldInfo& field, std::span<const T> values) {
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, int>) {
      Json& column = columns[std::string(field.name)] = Json::array();
      for (std::size_t id = 0; id < values.size(); ++id) column.push_back(values[particles.row(id)]);
    }
  });
  return columns;
}

Json columns_of(const Columns& bodies) {
  Json columns = Json::object();
  bodies.for_each([&]<class T>(const FieldInfo& field, std::span<const T> values) {
    Json& column = columns[std::string(field.name)] = Json::array();
    for (const T& value : values) {
      if constexpr (std::is_same_v<T, Vec3>)
        column.push_back({value.x, value.y, value.z});
      else if constexpr (std::is_same_v<T, Quaternion>)
        column.push_back({value.w, value.x, value.y, value.z});
      else
        column.push_back(value);
    }
  });
  return columns;
}

Json step_numbers_of(const State& state) {
  Json numbers = Json::object();
  for (const StepNumber& one : state.step_numbers.declared())
    numbers[std::string(one.name)] = state.step_numbers[one];
  return numbers;
}

Json state_of(Simulation& s) {
  const State& state = s.state();
  return {{"steps", s.steps()},
          {"step_numbers", step_numbers_of(state)},
          {"particles", columns_of(state.particles)},
          {"bodies", columns_of(state.bodies)},
          {"bonds", lists_of_bonds(state)},
          {"own_pairs", lists_of_excluded_pairs(state)},
          {"ledger", s.ledger().energy}};
}

/// Each once.
void print_terms() {
  std::set<std::string_view> names;
  const PairPasses passes = pair_passes(1);
  for (const auto& table : {passes.densities, passes.rates_of_scenes, passes.single})
    for (const PassFunction& pass : table)
      for (const PairTerm& term : pass.terms) names.insert(term.name);
  for (const std::string_view name : names) std::cout << name << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && std::string_view(argv[1]) == "--terms") {
    print_terms();
    return 0;
  }
  if (argc < 4) return std::cerr << "write-states CASE.toml MODE STEPS [KEY=VALUE...]\n", 2;
  try {
    RunChoice choice;
    choice.mode = mode_from(argv[2]);
    const long steps = std::atol(argv[3]);
    const Scene scene = scene_for(read_case(argv[1], {argv + 4, argv + argc}).value, choice);
    Simulation s(scene, sample(scene), {});
    Json states = Json::array({state_of(s)});
    s.advance_to(scene.end_time, [&] {
      if (s.steps() >= steps - 1) states.push_back(state_of(s));
      return s.steps() < steps;
    });
    if (s.steps() < steps) throw InputError("the scene ends before " + std::to_string(steps) + " steps");
    std::cout << Json{{"scene", scene_to_json(scene, std::vector<JobBody>(scene.bodies.size()))},
                      {"states", states}};
  } catch (const std::exception& e) {
    return std::cerr << "write-states: " << e.what() << '\n', 2;
  }
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <functional>
#include <numeric>

#include "core/errors.hpp"
#include "effects/effect.hpp"
#include "scene/geometry.hpp"
#include "scene/shared_terms.hpp"
#include "state/left_numbers.hpp"

/// Liquid that leaves: beyond the domain (on_escape = "remove"), or into an [[outflow]] (model 8.14).
namespace tripoint::outflow {
namespace {

using namespace left_numbers;

/// Steps between two looks for what has left [1]: a choice. Lists are made anew where something has.
constexpr double steps_between_looks = 8.0;

class Leaving : public Effect {
 public:
  void load(State&, const InitialState&) override;
  [[nodiscard]] bool wants_change(State&) override;
  void change(State&) override;
  void adopt(State&) override;
  void add_to(const State& state, Ledger& ledger) const override {
    ledger.energy["outflow"] += state.accumulated[account::outflow];
  }

 private:
  [[nodiscard]] bool leaves(const State&, std::size_t row) const;
  std::vector<std::function<bool(const Vec3&)>> inside_;  ///< of each [[outflow]]
};

void Leaving::load(State& state, const InitialState&) {
  inside_.clear();
  for (const Outflow& f : state.scene.outflows) inside_.push_back(inside_region(state.scene, f.shape));
  const auto number = state.particles[field::number];
  std::iota(number.begin(), number.end(), 0);
  state.step_numbers[ever] = static_cast<double>(number.size());
}

/// Liquid that nobody guides and nothing is bonded to, outside the domain or inside an outflow.
bool Leaving::leaves(const State& state, std::size_t row) const {
  const Particles& p = state.particles;
  const Scene& s = state.scene;
  if (p[field::body][row] >= 0 || (p.has(field::driven.name) && p[field::driven][row] != 0)) return false;
  const auto id = static_cast<std::size_t>(p[field::id][row]);
  if (!state.bonds.of(id).empty() || !state.own.of(id).empty()) return false;
  const Vec3 r = p.position(row);
  for (std::size_t a = 0; a < 3; ++a)
    if (s.removes_escaped && !s.periodic[a] && (r[a] < (*s.min)[a] || r[a] > (*s.max)[a])) return true;
  return std::ranges::any_of(inside_, [&](const auto& inside) { return inside(r); });
}

bool Leaving::wants_change(State& state) {
  double& steps = state.step_numbers[waited];
  if (++steps < steps_between_looks) return false;
  steps = 0.0;
  for (std::size_t i = 0; i < state.particles.moving(); ++i)
    if (leaves(state, i)) return true;
  return false;
}

void Leaving::change(State& state) {
  const Particles& p = state.particles;
  StepNumbers& numbers = state.step_numbers;
  for (std::size_t id = 0; id < p.size(); ++id) {
    const std::size_t i = p.row(id);
    if (i >= p.moving() || !leaves(state, i)) continue;
    const double m = p[field::mass][i];
    const Vec3 v = p.velocity(i);
    state.change.leaving.push_back(static_cast<std::uint32_t>(id));
    numbers[left] += 1.0;
    numbers[mass] += m;
    numbers[px] += m * v.x;
    numbers[py] += m * v.y;
    numbers[pz] += m * v.z;
  }
}

/// What flows in has the next numbers.
void Leaving::adopt(State& state) {
  double& next = state.step_numbers[ever];
  for (const std::uint32_t id : state.change.born)
    state.particles[field::number][state.particles.row(id)] = static_cast<int>(next++);
}

}  // namespace

EffectSpec spec(const Scene& scene) {
  if (scene.mode_of(term::pressure) != Mode::paper && !scene.has_brought_form(term::pressure))
    throw InputError(
        "liquid that leaves takes its own energy of compression alone: [model] pressure must be one that "
        "carries its density (adjoint), or paper");
  EffectSpec s{
      "outflow",
      scene.mode,
      {field::number},
      fields::joined({fields::position(), fields::velocity(), {field::id, field::mass, field::body}})};
  s.reads_if_there = {field::driven};
  s.changes = true;
  s.skips_sleeping = true;
  s.accounts = {account::outflow};
  s.step_numbers = {ever, left, mass, px, py, pz, waited};
  s.guarded_entries = {{"outflow", EntryRole::apart}};
  return s;
}

std::unique_ptr<Effect> make(const Scene&) { return std::make_unique<Leaving>(); }

}  // namespace tripoint::outflow

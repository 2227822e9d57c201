// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "effects/effect.hpp"
#include "effects/walls/wall_patches.hpp"
#include "liquids/changes.hpp"
#include "liquids/fields.hpp"

/// Where liquid alone touches walls, they press by the mean density of a patch of their face (model 8.4).
namespace tripoint::walls {
namespace {

class Walls : public Effect {
 public:
  explicit Walls(const Scene& scene)
      : numbers_(liquid::numbers_of(scene)), kernels_(liquid::pair_kernels(scene)) {}
  void densities(State& state, const Rows&) override { patches_.average_density(state, numbers_, kernels_); }
  void after_states(State& state, const Rows&) override { patches_.hand_down_shares(state); }
  void adopt(State& state) override {
    if (liquid::groups_changed(state)) patches_.clear();
  }
  void happen(State&, const Happening&) override { patches_.clear(); }
  void renumber(State&) override { patches_.renumber(); }
  [[nodiscard]] PairWork pair_work(const Scene& scene) const override {
    PairWork work;
    work.awake_around = reach_of_patches * scene.spacing;
    return work;
  }

 private:
  liquid::SceneNumbers numbers_;
  PairKernels kernels_;
  WallPatches patches_;
};

}  // namespace

EffectSpec spec(const Scene&) {
  EffectSpec s{
      "walls",
      Mode::corrected,
      {},
      fields::joined({fields::position(),
                      {field::id, field::mass, field::body, field::source, field::group, field::stick,
                       field::rest_density, field::density, field::volume, field::pressure_share}})};
  s.reads_if_there = fields::image();
  s.skips_sleeping = true;
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Walls>(scene); }

}  // namespace tripoint::walls

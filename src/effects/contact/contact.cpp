// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "effects/contact/contact_bound.hpp"
#include "effects/effect.hpp"
#include "liquids/changes.hpp"
#include "liquids/fields.hpp"

/// Contact of solids: they touch by the pressure of liquids, and here is what their touch asks of the step
/// (model 8.3, 8.10).
namespace tripoint::contact {
namespace {

class Contact : public Effect {
 public:
  explicit Contact(const Scene& scene) : numbers_(liquid::numbers_of(scene)) {}
  void state(State& state, const Rows&) override {
    if (looks_ahead() && state.moved) update_time_to_touch(state, numbers_);
  }
  void adopt(State& state) override {
    if (looks_ahead()) forget_time_to_touch(state);
  }
  void happen(State& state, const Happening&) override { adopt(state); }
  [[nodiscard]] TimeStepBound max_dt(const State& state) const override {
    return contact_bound(state, numbers_, numbers_.courant * state.support(), liquid::greatest_speed(state));
  }

 private:
  [[nodiscard]] bool looks_ahead() const { return numbers_.contact_step > 0.0; }

  liquid::SceneNumbers numbers_;
};

}  // namespace

EffectSpec spec(const Scene& scene) {
  EffectSpec s{"contact",
               Mode::corrected,
               {},
               fields::joined({fields::velocity(),
                               {field::mass, field::group, field::rest_density, field::number_density}})};
  s.skips_sleeping = true;
  if (liquid::numbers_of(scene).contact_step == 0.0) return s;
  s.owns = {field::solid_density_before};
  s.step_numbers = {time_to_touch};
  return s;
}

std::unique_ptr<Effect> make(const Scene& scene) { return std::make_unique<Contact>(scene); }

}  // namespace tripoint::contact

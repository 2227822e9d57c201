// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "validation/references/functions.hpp"
#include "validation/references/rigid_flight.hpp"

namespace tripoint {
namespace {

/// What semi-implicit Euler (v += g dt, then x += v dt) does exactly: after n steps x = x0 + v0 t + g t (t + dt)/2, so that it
/// lags the parabola by g t dt/2. Between its steps the last one is held.
class SemiImplicitFlight : public RigidFlight {
 public:
  SemiImplicitFlight(const Job& job, const InitialState& initial, double dt) : RigidFlight(job, initial), dt_(dt) {
    if (!job.scene.events.empty()) throw InputError("ballistic_semi_implicit holds without events only");
    for (const auto& flight : flights())
      if (!flight.spin.steady()) throw InputError("ballistic_semi_implicit needs a spin of constant axis: the scheme's own tumbling is not exact");
  }

 protected:
  [[nodiscard]] Vec3 fall(const Vec3& velocity, double t) const override {
    return RigidFlight::fall(velocity, t) + (0.5 * t * dt_) * job().scene.gravity;
  }

 private:
  double dt_;
};

std::unique_ptr<Reference> make_ballistic(const ReferenceInput& in) {
  if (!in.job.scene.events.empty()) throw InputError("ballistic holds without events: use merge_in_flight or split_in_flight");
  return std::make_unique<RigidFlight>(in.job, in.initial);
}

std::unique_ptr<Reference> make_semi_implicit(const ReferenceInput& in) {
  auto dt = in.args.number("time_step");
  if (!dt) dt = in.job.resolution.time_step;
  if (!dt) dt = in.job.scene.time_step;
  if (!dt || !(*dt > 0.0)) throw InputError("ballistic_semi_implicit needs a fixed time step: scene.time_step or args.time_step");
  for (const double t : in.job.times) {
    const double steps = t / *dt;
    if (std::abs(steps - std::round(steps)) > 1e-6) throw InputError("ballistic_semi_implicit: every output time must be a whole number of steps");
  }
  return std::make_unique<SemiImplicitFlight>(in.job, in.initial, *dt);
}

}  // namespace

ReferenceEntry ballistic_entry() {
  return {{"ballistic", "analytic", "Newton: r = r0 + v t + g t^2/2 for the centre of mass; free rotation as torque_free",
           "free rigid bodies under gravity, turning freely; prescribed and fixed bodies beside them", {}},
          make_ballistic};
}

ReferenceEntry ballistic_semi_implicit_entry() {
  return {{"ballistic_semi_implicit", "discrete_exact", "sum of the scheme's steps: x lags the parabola by g t dt/2",
           "what semi-implicit Euler does exactly to a body in flight with a spin of constant axis",
           {{"time_step", "s", "step of the scheme; default the run's time step"}}},
          make_semi_implicit};
}

}  // namespace tripoint

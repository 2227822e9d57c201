// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "validation/references/functions.hpp"
#include "validation/references/rigid_flight.hpp"

namespace tripoint {
namespace {

/// Exact flight of semi-implicit Euler (v += g d, then x += v d). Each step of length d falls g d^2/2 further
/// than the parabola. With one step length dt the body lags by g t dt/2. Between two output times the steps
/// are equal, and none is above dt.
class SemiImplicitFlight : public RigidFlight {
 public:
  SemiImplicitFlight(const Job& job, const InitialState& initial, double dt)
      : RigidFlight(job, initial), times_(job.times) {
    if (!job.scene.events.empty()) throw InputError("ballistic_semi_implicit holds without events only");
    for (const auto& flight : flights())
      if (!flight.spin.steady())
        throw InputError(
            "ballistic_semi_implicit needs a spin of constant axis: the scheme's own tumbling is not exact");
    for (std::size_t n = 1; n < times_.size(); ++n) {
      const double interval = times_[n] - times_[n - 1];
      const double steps = std::max(1.0, std::ceil(interval / dt * (1.0 - 1e-9)));
      squares_.push_back(squares_.back() + interval * interval / steps);
    }
  }

 protected:
  [[nodiscard]] Vec3 fall(const Flight& flight, double t) const override {
    return RigidFlight::fall(flight, t) + (0.5 * sum_of_squares(t)) * acceleration(flight);
  }

 private:
  /// Sum of d^2 over the steps up to t [s2], linear between output times.
  [[nodiscard]] double sum_of_squares(double t) const {
    if (t <= times_.front()) return 0.0;
    std::size_t n = 1;
    while (n + 1 < times_.size() && times_[n] < t) ++n;
    const double share = (t - times_[n - 1]) / (times_[n] - times_[n - 1]);
    return squares_[n - 1] + share * (squares_[n] - squares_[n - 1]);
  }

  std::vector<double> times_, squares_{0.0};
};

std::unique_ptr<Reference> make_ballistic(const ReferenceInput& in) {
  if (!in.job.scene.events.empty())
    throw InputError("ballistic holds without events: use merge_in_flight or split_in_flight");
  return std::make_unique<RigidFlight>(in.job, in.initial);
}

std::unique_ptr<Reference> make_semi_implicit(const ReferenceInput& in) {
  auto dt = in.args.number("time_step");
  if (!dt) dt = in.job.resolution.time_step;
  if (!dt) dt = in.job.scene.time_step;
  if (!dt || !(*dt > 0.0))
    throw InputError("ballistic_semi_implicit needs a fixed time step: scene.time_step or args.time_step");
  if (in.job.times.size() < 2) throw InputError("ballistic_semi_implicit needs two output times or more");
  return std::make_unique<SemiImplicitFlight>(in.job, in.initial, *dt);
}

}  // namespace

ReferenceEntry ballistic_entry() {
  return {{"ballistic",
           "analytic",
           "Newton: r = r0 + v t + (g + F/m) t^2/2 for the centre of mass; free rotation as torque_free",
           "free rigid bodies under gravity and constant forces at their centres, turning freely; prescribed "
           "and fixed bodies "
           "beside them",
           {}},
          make_ballistic};
}

ReferenceEntry ballistic_semi_implicit_entry() {
  return {{"ballistic_semi_implicit",
           "discrete_exact",
           "sum of the scheme's steps: x lags the parabola by g t dt/2; equal steps between output times",
           "the exact result of semi-implicit Euler for a body in flight with a spin of constant axis",
           {{"time_step", "s", "step of the scheme; default the run's time step"}}},
          make_semi_implicit};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "tables/nearest.hpp"
#include "validation/references/functions.hpp"
#include "validation/references/rigid_flight.hpp"

namespace tripoint {
namespace {

constexpr const char* landau = "Landau & Lifshitz, Mechanics, section 37 (Jacobi's elliptic functions)";

/// Free flight that also knows when one body flips.
class FlipTime : public RigidFlight {
 public:
  FlipTime(const Job& job, const InitialState& initial, const std::string& name) : RigidFlight(job, initial) {
    const Flight* chosen = nullptr;
    for (const auto& flight : flights())
      if (name.empty() || job.bodies[static_cast<std::size_t>(flight.row)].name == name) {
        chosen = &flight;
        break;
      }
    if (!chosen) throw InputError("flip_time: no free body named `" + printable(name) + "`");
    body_row_ = chosen->row;
    const auto interval = chosen->spin.flip_interval();
    if (!interval) throw InputError("flip_time: the body spins about a constant axis and never flips");
    flips_ = chosen->spin.flips(job.scene.end_time);
    first_ = chosen->spin.flips(job.scene.end_time + *interval).front();
    interval_ = *interval;
  }
  [[nodiscard]] Measuring measuring() const override {
    return {.flip_body = static_cast<std::size_t>(body_row_)};
  }
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override {
    if (quantity == "event_time") return first_;
    if (quantity == "flip_count") return static_cast<double>(flips_.size());
    if (quantity == "flip_interval") return interval_;
    return {};
  }

 private:
  std::vector<double> flips_;
  double first_ = 0.0, interval_ = 0.0;
  int body_row_ = 0;
};

std::unique_ptr<Reference> make_torque_free(const ReferenceInput& in) {
  if (!in.job.scene.events.empty()) throw InputError("torque_free holds without events");
  return std::make_unique<RigidFlight>(in.job, in.initial);
}

std::unique_ptr<Reference> make_flip_time(const ReferenceInput& in) {
  if (!in.job.scene.events.empty()) throw InputError("flip_time holds without events");
  return std::make_unique<FlipTime>(in.job, in.initial, in.args.word("body").value_or(""));
}

std::unique_ptr<Reference> make_keyframes(const ReferenceInput& in) {
  for (const auto& body : in.job.bodies)
    if (body.motion == Motion::prescribed) return std::make_unique<RigidFlight>(in.job, in.initial);
  throw InputError("keyframes needs a body with motion = \"prescribed\"");
}

template <Event::Kind kind>
std::unique_ptr<Reference> make_in_flight(const ReferenceInput& in) {
  for (const auto& event : in.job.scene.events)
    if (event.kind == kind) return std::make_unique<RigidFlight>(in.job, in.initial);
  throw InputError(std::string(kind == Event::Kind::merge ? "merge_in_flight needs a merge event"
                                                          : "split_in_flight needs a split event"));
}

}  // namespace

ReferenceEntry torque_free_entry() {
  return {{"torque_free",
           "analytic",
           landau,
           "orientation and angular velocity of free rigid bodies of any inertia",
           {}},
          make_torque_free};
}

ReferenceEntry flip_time_entry() {
  return {{"flip_time",
           "analytic",
           landau,
           "first time at which the spin about the middle principal axis changes sign, and how often it does",
           {{"body", "", "name of the body; default the first free one", ArgumentType::word}}},
          make_flip_time};
}

ReferenceEntry merge_in_flight_entry() {
  return {{"merge_in_flight",
           "analytic",
           "conservation of mass, momentum and angular momentum at the event; free flight around it",
           "bodies that become one in flight, before and after; number energy_ratio: kinetic energy after "
           "over before",
           {}},
          make_in_flight<Event::Kind::merge>};
}

ReferenceEntry split_in_flight_entry() {
  return {{"split_in_flight",
           "analytic",
           "each part keeps the velocities of its particles; free flight around the event",
           "a body that becomes two in flight, before and after; number energy_ratio: kinetic energy after "
           "over before",
           {}},
          make_in_flight<Event::Kind::split>};
}

ReferenceEntry keyframes_entry() {
  return {{"keyframes",
           "analytic",
           "linear interpolation of position, slerp of rotation (Shoemake 1985), velocity their derivative",
           "bodies moved as the scene prescribes; free ones fly",
           {}},
          make_keyframes};
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>
#include <vector>

#include "core/not_a_number.hpp"
#include "files/job.hpp"
#include "validation/references/reference.hpp"
#include "validation/references/rigid_body.hpp"
#include "validation/references/torque_free.hpp"

namespace tripoint {

/// Rigid bodies in free flight under gravity, with merges and splits by event and prescribed bodies beside
/// them: exact. Between events the centre of mass follows a parabola and the body turns freely about it. At
/// an event the particles of the new body keep mass, momentum and angular momentum. At the very time of an
/// event the state is the one after it.
class RigidFlight : public Reference {
 public:
  /// @throws InputError for bodies that are not rigid, for contact-making or heating events, for joined
  /// bodies
  RigidFlight(const Job&, const InitialState&);
  [[nodiscard]] Snapshot at(double time) const override;
  /// energy_ratio: kinetic energy after the last event over that before the first [1]; event_time: of the
  /// first event [s].
  [[nodiscard]] std::optional<double> number(std::string_view quantity) const override;
  [[nodiscard]] double kinetic_energy_at(double time) const;

 protected:
  struct Flight {  ///< one body from birth (or a change of its members) to the next change
    RigidBody body;
    TorqueFree spin;
    Quaternion orientation;  ///< at birth; (1,0,0,0) for a new row
    int row = 0;
    double birth = 0.0, death = std::numeric_limits<double>::infinity();
  };
  /// Displacement of a free body's centre of mass since its birth [m].
  [[nodiscard]] virtual Vec3 fall(const Flight&, double since_birth) const;
  /// Gravity and the constant forces on its centre of mass over its mass [m/s2].
  [[nodiscard]] Vec3 acceleration(const Flight&) const;
  [[nodiscard]] const std::vector<Flight>& flights() const { return flights_; }
  [[nodiscard]] const Job& job() const { return job_; }

 private:
  void start();
  void merge(const Event&);
  void split(const Event&);
  void launch(const std::vector<std::size_t>& members, const Snapshot& now, int row,
              const Quaternion& orientation);
  [[nodiscard]] Flight& alive(const std::string& name);
  void set_flight(const Flight&, double time, Snapshot&) const;
  void set_prescribed(const JobBody&, double time, Snapshot&) const;

  Job job_;
  InitialState initial_;
  std::vector<Flight> flights_;
  std::vector<std::string> row_names_;
  std::vector<double> row_birth_;
  double energy_ratio_ = not_a_number;
};

}  // namespace tripoint

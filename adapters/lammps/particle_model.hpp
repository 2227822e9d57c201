// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <string>
#include <vector>

#include "adapters/lammps/model.hpp"

namespace tripoint::lammps {

/// Units in which LAMMPS holds a scene. Lengths are in spacings from an origin. Time and mass make its own
/// numbers of order one, because some of its tolerances are absolute.
struct Units {
  double length = 1.0, time = 1.0, mass = 1.0;  ///< [m], [s], [kg]
  Vec3 origin;                                  ///< [m]
  [[nodiscard]] Vec3 place(const Vec3& x) const { return (x - origin) / length; }
  [[nodiscard]] double speed() const { return length / time; }                        ///< [m/s]
  [[nodiscard]] double acceleration() const { return length / (time * time); }        ///< [m/s2]
  [[nodiscard]] double density() const { return mass / (length * length * length); }  ///< [kg/m3]
  [[nodiscard]] double pressure() const { return density() * speed() * speed(); }     ///< [Pa]
  [[nodiscard]] double energy() const { return mass * speed() * speed(); }            ///< [J]
};

/// Velocity of a held or driven body from a time on, until its keyframes change it. [m/s], [s]
struct Drive {
  Vec3 velocity;
  double until;
};
[[nodiscard]] Drive drive_at(const JobBody&, double time, double end);
/// Whether its keyframes or its velocity turn a driven body.
[[nodiscard]] bool is_turned(const JobBody&);

/// Whether one is joined_to the other.
[[nodiscard]] bool are_joined(const Body&, const Body&);

/// Mass of every particle of a body of the case. @throws EngineError where they differ: a LAMMPS type has one
/// mass [kg]
[[nodiscard]] double particle_mass(const InitialState&, int source, const std::string& name);

/// The job's own particles under a style of LAMMPS; id = row + 1.
/// Directions that are not periodic end where the particles end: nothing holds them but the scene's own
/// bodies.
class ParticleModel : public Model {
 public:
  void advance_to(double time) override;
  [[nodiscard]] Readback readback() const override;

 protected:
  /// @param limit greatest step [s]
  ParticleModel(const Job&, const InitialState&, const Units&, double limit);
  /// Everything up to the particles. @param style atom_style with the commands that must stand before the box
  /// @param extra of create_box, e.g. bonds @param margin about the particles at the start [spacings]
  /// @param types of the bodies of the case, 1..n
  void make_particles(const std::string& style, const std::string& extra, double margin,
                      const std::vector<int>& types);
  [[nodiscard]] std::vector<int> type_a_body() const;  ///< 1, 2, 3, ...
  [[nodiscard]] std::vector<int> one_type() const { return std::vector<int>(job_.bodies.size(), 1); }
  /// Gravity on the bodies that are free, measured on them with no pair style: before any other force.
  /// Defines the group `free`.
  void make_gravity();
  /// Makes a group of the bodies that satisfy a condition. @return whether there are any; else there is no
  /// group
  template <class Condition>
  bool make_group(const std::string& name, Condition condition) {
    std::string ids;
    for (std::size_t b = 0; b < job_.bodies.size(); ++b)
      if (condition(job_.bodies[b])) ids += ids_of(b);
    if (!ids.empty()) library_.run("group " + name + " id" + ids);
    return !ids.empty();
  }
  [[nodiscard]] std::string ids_of(std::size_t body) const;  ///< " first:last"
  /// Particles of one body of the case.
  [[nodiscard]] std::vector<std::size_t> members(std::size_t body) const;
  /// Positions, velocities and what follows from them; phases, bodies and materials as at the start; no
  /// bodies' rows.
  [[nodiscard]] Snapshot particles() const;

  Job job_;
  InitialState state_;
  Choice choice_;
  Units units_;
  double limit_;  ///< [s]
  mutable Library library_;
  Clock clock_;
  double time_;        ///< [s]
  bool flat_ = false;  ///< two dimensions: all particles at the z of the first
  Vec3 gravity_;       ///< as LAMMPS holds it [m/s2]
};

}  // namespace tripoint::lammps

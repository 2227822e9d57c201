// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "adapters/bullet/presets.hpp"
#include "core/quaternion.hpp"
#include "core/vec3.hpp"

/// Bullet's world behind plain data; with constraints.cpp all that includes Bullet's headers.
namespace tripoint {
struct Joint;
}

namespace tripoint::bullet {

/// One part of a body, in the body's principal frame.
struct Piece {
  enum class Kind { box, sphere, cylinder, capsule, hull, surface } kind = Kind::box;
  Vec3 centre;          ///< [m]
  Quaternion rotation;  ///< of the part's axes
  /// [m]; a radius is x; of a cylinder or capsule z is half its straight part, along its z axis
  Vec3 half_extents;
  std::vector<Vec3> corners{};  ///< hull, surface: about `centre`, in the part's axes [m]
  std::vector<std::array<std::uint32_t, 3>> triangles{};  ///< surface: counter-clockwise seen from outside
};

/// A body's place and motion; orientation takes principal axes to world axes.
struct RigidMotion {
  Vec3 centre;  ///< of mass [m]
  Quaternion orientation;
  Vec3 velocity;          ///< [m/s]
  Vec3 angular_velocity;  ///< world frame [rad/s]
};

enum class Drive { dynamic, fixed, kinematic };

struct RigidPart {
  double mass = 0.0;       ///< [kg]
  Vec3 principal_inertia;  ///< ascending; 0 stands for a moment that the body does not have [kg m2]
  RigidMotion motion;
  Drive drive = Drive::dynamic;
  std::vector<Piece> pieces;
  int material = 0;  ///< row of the pair laws
};

/// Laws of contact by pairs of materials; a row and a column each.
struct PairLaws {
  std::vector<std::vector<double>> friction, restitution;
};

/// Values that Bullet itself holds of a body.
struct HeldBody {
  double mass = 0.0;  ///< 0 = infinite, as for fixed and driven bodies
  Vec3 centre, principal_inertia;
  double friction = 0.0, restitution = 0.0;  ///< of a pair of such bodies
  double linear_damping = 0.0, angular_damping = 0.0;
};

struct Wrench {
  Vec3 force, torque;  ///< [N], [N m] about the centre of mass
};

class World {
 public:
  World(const Preset&, const Vec3& gravity);
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  /// From now on every pair of bodies has the friction and restitution of its materials.
  void use(PairLaws);
  /// Adds a body and returns its handle. Call in the order of the bodies' rows: the order changes Bullet's
  /// bits.
  [[nodiscard]] int add(const RigidPart&);
  void remove(int handle);
  /// Holds a body to another one; to the world where `other` is -1. They do not touch.
  void join(const Joint&, int one, int other);
  /// Where a kinematic body will be at the end of the next step.
  void drive(int handle, const Vec3& centre, const Quaternion& orientation);
  /// A force [N] in the next step, on a point given from the centre of mass [m], in the world's axes.
  void push(int handle, const Vec3& force, const Vec3& arm);
  /// Exactly one step of dt [s].
  void step(double dt);
  [[nodiscard]] RigidMotion motion(int handle) const;
  [[nodiscard]] HeldBody held(int handle) const;
  [[nodiscard]] Vec3 gravity() const;
  /// Mean contact force and torque over the last step of dt.
  [[nodiscard]] Wrench contact(int handle, double dt) const;
  [[nodiscard]] double contact_points() const;  ///< sum over steps

  [[nodiscard]] static std::string version();
  [[nodiscard]] static std::string library_path();  ///< of the library that is loaded

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tripoint::bullet

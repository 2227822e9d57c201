// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <vector>

#include "adapters/bullet/world.hpp"
#include "adapters/engine/engine.hpp"

namespace tripoint::bullet {

/// Rigid bodies in Bullet, each built from the very particles: their mass, principal moments and axes.
class BulletEngine final : public Engine {
 public:
  [[nodiscard]] EngineInfo info() const override;
  [[nodiscard]] std::string refusal(const Job&) const override;
  void load(const Job&, const InitialState&) override;
  void advance_to(double time) override;
  [[nodiscard]] Snapshot observe() const override;
  [[nodiscard]] Readback readback() const override;
  void account(Result&) const override;

 private:
  /// One row of /particles/bodies.
  struct Row {
    std::string name;
    Motion motion = Motion::free;
    std::vector<Keyframe> keyframes;
    Vec3 start_velocity, start_spin;  ///< of a prescribed body without keyframes
    MassProperties properties;        ///< centre as of time 0 or birth
    /// Principal axes in body axes; body axes are the world's at the start or birth
    Quaternion frame;
    std::vector<int> members;   ///< particle ids, ascending
    std::vector<Vec3> arms;     ///< of the members, in the principal frame [m]
    std::vector<Piece> pieces;  ///< in the principal frame
    int material = 0;           ///< of the scene's
    int handle = -1;            ///< in the world; -1 = dead
  };

  [[nodiscard]] Row start_row(const JobBody&) const;
  [[nodiscard]] std::vector<Piece> start_pieces(const Row&, const JobBody&) const;
  [[nodiscard]] Piece particle_piece() const;
  [[nodiscard]] RigidMotion start_motion(const Row&, const JobBody&) const;
  void set_arms(Row&, const std::vector<Vec3>& positions, const Vec3& centre,
                const Quaternion& principal) const;
  void enter(Row&, const RigidMotion&);
  void integrate_to(double time);
  [[nodiscard]] double first_step() const;
  void drive_bodies(double time);
  void push_bodies();
  void check_finite() const;

  void apply(const Event&);
  void merge(const Event&);
  void split(const Event&);
  void take_out(Row&);
  void launch(Row&, std::vector<int> members, const Snapshot& now, const Quaternion& axes,
              const std::vector<Piece>& world_pieces);
  [[nodiscard]] Row& alive(const std::string& name);
  [[nodiscard]] Quaternion orientation(const Row&) const;
  [[nodiscard]] std::vector<Piece> world_pieces(const std::vector<int>& members, const Snapshot& now,
                                                const Quaternion& lattice) const;

  void show_body(Snapshot&, const Row&) const;

  Job job_;
  InitialState state_;
  std::unique_ptr<World> world_;
  std::vector<Row> rows_;
  std::vector<Event> events_;  ///< in order of time
  std::size_t next_event_ = 0;
  double time_ = 0.0, dt_ = 0.0, last_dt_ = 0.0;
  long steps_ = 0;
};

}  // namespace tripoint::bullet

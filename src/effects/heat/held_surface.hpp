// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "effects/effect.hpp"
#include "effects/heat/surface_law.hpp"

namespace tripoint::heat {

/// Stages of the two-stage scheme.
enum class Stage { first, last };

/// Temperature at which a body's surface is held [K].
[[nodiscard]] std::optional<double> surface_temperature(const Scene&, const Body&);
[[nodiscard]] bool has_held_surfaces(const Scene&);

/// @throws InputError naming a body whose surface cannot exchange heat: one that moves, melts or is as
/// printed
void refuse_held_surfaces(const Scene&);

/// Surfaces of bodies whose temperature is held, or through which sources give heat (model 8.6). The part of
/// a particle's neighbourhood beyond the surface is filled with lattice places. Their temperature is linear
/// along the way through the surface [Gibou, Fedkiw, Cheng, Kang 2002]. So the surface lies where the shape
/// has it, and not half a spacing further in or out.
///
/// The data kept here follow from the particles as they were laid, and a resumed run finds them again.
class HeldSurfaces {
 public:
  /// Finds the places beyond. Where scene.surface_exchange is 0 the outermost particles are held at the
  /// surface's temperature.
  void load(State&, const InitialState&);
  /// Finds the particles that this process has by their new ids (Effect::renumber).
  void renumber(const State&);
  /// Sums of a pass start with the share of the places beyond, not with 0. In the pass of densities these are
  /// Q_i and S_i, in others the flow of heat [W] and the conductance [W/K].
  void start_sums(State&, PassName) const;
  /// Accumulates the heat that a stage takes from held surfaces, on the energy account `walls` and by body.
  /// Call it before the stage.
  /// @param dt length of the step [s]
  void accumulate(State&, Stage, double dt) const;

 private:
  /// A particle with places in its support that lie beyond a surface: beyond a held one, or one with these
  /// sources.
  struct Near {
    std::uint32_t id = 0;
    double temperature = 0.0;         ///< of a held surface [K]
    std::uint32_t sources = 0;        ///< that act at the surface; 0: it is held
    double depth = 0.0;               ///< of the particle below a surface with sources [m]
    std::array<double, 18> moment{};  ///< sums of the places, as HeatMoment adds them
    /// Sum V_i V K e e^T over the share of the way that lies within the body [m]
    std::array<double, 6> exchange{};
  };
  /// Heat that comes from the surface [W], and how it falls with the particle's temperature [W/K].
  struct Flow {
    double heat = 0.0, conductance = 0.0;
  };
  [[nodiscard]] Flow flow(const State&, std::size_t row, const Near&) const;
  Near& alike(const Near&, std::size_t first);
  /// A place beyond in the sums Q_i and S_i, and in the exchange: `within` is the share of the way there that
  /// lies within the body.
  static void add_moment(const State&, const Vec3& away, Near&);
  static void add_exchange(const State&, std::size_t row, const Vec3& away, double within, Near&);
  /// Calls visit(row, heat) for each particle near a surface, with all that comes to it [W].
  template <class Visit>
  void each_particle(const State&, Visit visit) const;

  std::optional<SurfaceSources> sources_;
  std::vector<Near> all_;   ///< of the whole scene, by number, ascending
  std::vector<Near> near_;  ///< of these the ones that this process has, ghosts too, by id, ascending
};

}  // namespace tripoint::heat

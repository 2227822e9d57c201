// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/dimensions.hpp"
#include "core/errors.hpp"
#include "core/quaternion.hpp"
#include "core/vec3.hpp"
#include "scene/term.hpp"

/// The checked scene: the content of a case file, in SI, with every default filled in. It contains no
/// physics.
namespace tripoint {

enum class Phase : int { liquid = 0, elastic = 1, rigid = 2 };
enum class Motion { free, fixed, prescribed };
enum class SolidKind { elastic, rigid };          ///< kind of a material when solid
enum class ViscosityForm { laplacian, central };  ///< of corrected viscosity (model 8.5)
enum class GuardName;                             ///< scene/guard_name.hpp

[[nodiscard]] std::string_view to_string(Phase);
[[nodiscard]] std::string_view to_string(Motion);
[[nodiscard]] std::string_view to_string(Mode);
[[nodiscard]] std::string_view to_string(SolidKind);
/// Inverse of to_string. @throws InputError naming the allowed words
[[nodiscard]] Phase phase_from(std::string_view);
[[nodiscard]] Motion motion_from(std::string_view);
[[nodiscard]] Mode mode_from(std::string_view);

/// Numbers of the case file whose keys an effect brings and that have no member here, in SI, by the key's
/// name.
using EffectValues = std::map<std::string, double, std::less<>>;
/// 0 where the key has no value: of a scene that no reader made.
[[nodiscard]] inline double value_of(const EffectValues& values, std::string_view key) {
  const auto at = values.find(key);
  return at == values.end() ? 0.0 : at->second;
}

struct Material {
  std::string name;
  double density = 0.0;                                ///< rest density [kg/m3]
  double viscosity = 0.0;                              ///< dynamic [Pa s]
  std::optional<double> stiffness;                     ///< k [m2/s2]
  std::optional<double> young_modulus, poisson_ratio;  ///< [Pa], [1]
  std::optional<double> conductivity,
      heat_capacity;  ///< of the liquid, and of the solid too where it has none of its own [W/m/K], [J/kg/K]
  /// Of the solid where they differ; not as printed
  std::optional<double> solid_conductivity, solid_heat_capacity;
  std::optional<double> t_melt, t_solid, latent_heat;  ///< [K], [K], [J/kg]
  SolidKind solid = SolidKind::elastic;
  bool softens = false;
  std::optional<double> elastic_limit, plastic_limit;  ///< strain [1]
  std::optional<double> fracture_stretch;              ///< corrected: |r|/|x| [1]
  std::optional<double> fracture_distance;             ///< paper: [spacings]
  EffectValues values;                                 ///< of keys that effects bring (scene/effect_rule.hpp)
};

/// A region of space. Recursive kinds hold their parts in `of`: union (all), difference (of[0] minus of[1]).
struct Shape {
  enum class Kind { box, sphere, cylinder, half_space, unite, difference, mesh } kind = Kind::box;
  Vec3 min, max;                ///< box [m]
  Vec3 centre;                  ///< sphere [m]
  Vec3 base, axis{0, 0, 1};     ///< cylinder: centre of its foot [m], unit axis
  double length = 0.0;          ///< cylinder [m]
  double radius = 0.0;          ///< sphere, cylinder [m]
  Vec3 point, normal{0, 0, 1};  ///< half_space: inside where (r - point).normal <= 0
  std::vector<Shape> of;
  std::string file;    ///< mesh: absolute path after reading
  double scale = 1.0;  ///< mesh
  /// About the centre of the bounding box of the shape that is not turned; not of a sphere or half space
  Quaternion rotation;
};

/// Temperature as a function of place [K].
struct TemperatureField {
  enum class Kind { constant, cosine, step, expression } kind = Kind::constant;
  double value = 0.0;                               ///< constant
  double mean = 0.0, amplitude = 0.0, phase = 0.0;  ///< cosine: mean + amplitude cos(k.r + phase)
  Vec3 wave_vector;                                 ///< [rad/m]
  Vec3 point, normal{1, 0, 0};                      ///< step: behind where (r - point).normal < 0
  double behind = 0.0, ahead = 0.0;
  std::string expression;  ///< of x, y, z [m]
};

/// Velocity as a function of place [m/s].
struct VelocityField {
  enum class Kind { constant, cosine, linear, taylor_green, expression } kind = Kind::constant;
  Vec3 value;                         ///< constant
  Vec3 mean, amplitude, wave_vector;  ///< cosine
  double phase = 0.0;
  Vec3 centre;                           ///< linear: gradient (r - centre); row i = component i
  std::array<Vec3, 3> gradient{};        ///< [1/s]
  double speed = 0.0, wavelength = 0.0;  ///< taylor_green in x, y
  std::array<std::string, 3> expression;
};

struct Keyframe {
  double time = 0.0;  ///< [s]
  Vec3 position;      ///< of the centre of mass [m]
  Quaternion rotation;
};

struct Body {
  std::string name, material;
  Phase phase = Phase::liquid;
  Shape shape;
  VelocityField velocity;
  Vec3 angular_velocity;  ///< world frame, about the centre of mass [rad/s]
  std::optional<TemperatureField> temperature;
  bool temperature_held = false;
  Motion motion = Motion::free;
  std::vector<Keyframe> keyframes;
  bool free_slip = false;
  bool jitters = true;
  bool joins = false;
  std::vector<std::string> joined_to;
  std::optional<double> mass;   ///< of a rigid body, in place of its particles' [kg]
  std::optional<Vec3> centre;   ///< of mass, the same [m]
  std::optional<Vec3> inertia;  ///< about it: xx, yy, zz [kg m2]
  Vec3 products;                ///< of inertia, beside it: xy, xz, yz [kg m2]
  bool shape_mass = false;      ///< particles weigh what the shape does
  SourcePlace place;
};

struct Event {
  enum class Kind { merge, split, release, heat, hold, grip } kind = Kind::merge;
  double time = 0.0;
  std::string name;
  std::vector<std::string> bodies;
  std::optional<Shape> region;
  std::optional<double> temperature, until;
  std::vector<Keyframe> keyframes;
  SourcePlace place;
};

struct Inflow {
  std::string material;
  Shape shape;
  Vec3 velocity;
  std::optional<double> temperature;
  double start = 0.0, stop = 0.0;
  std::optional<double> rate;  ///< [m3/s]
  std::string profile;         ///< formula of x, y, z: factor on velocity; empty = 1
  double ramp = 0.0;           ///< time in which velocity grows from 0 [s]
};

/// Laws of contact of a pair of materials, [[contact]]. A pair that no table names has neither.
struct ContactLaw {
  std::vector<std::string> materials;  ///< two; the same one twice for bodies of one material
  /// Coulomb's coefficient, ratio of speeds after and before a hit [1]
  std::optional<double> friction, restitution;
  SourcePlace place;
};

/// Where liquid leaves the scene, [[outflow]].
struct Outflow {
  Shape shape;
  SourcePlace place;
};

/// A force or a torque on a rigid body, constant from its start to its stop, [[force]].
struct AppliedForce {
  std::string body;
  Vec3 value;                  ///< in the world frame [N]
  std::optional<Vec3> point;   ///< of the body, where it is at the start; empty = the centre of mass [m]
  Vec3 torque;                 ///< in the world frame [N m]
  double start = 0.0;          ///< [s]
  std::optional<double> stop;  ///< empty = it acts to the end [s]
  SourcePlace place;
  [[nodiscard]] bool is_timed() const { return start > 0.0 || stop; }
  /// Whether its work depends on the way: it has no potential.
  [[nodiscard]] bool has_no_potential() const { return is_timed() || torque != Vec3{}; }
};

/// A spring and a damper between points of two rigid bodies, or of one and the world, [[spring]].
struct Spring {
  std::string body, other = "world";
  Vec3 point, other_point;                ///< where they are at the start [m]
  double stiffness = 0.0, damping = 0.0;  ///< [N/m], [N s/m]
  std::optional<double> length;           ///< at which it has no force; empty = that of the start [m]
  SourcePlace place;
};

/// A spring along the coordinate of a joint.
struct JointSpring {
  double stiffness = 0.0;  ///< [N m/rad] or [N/m]
  double rest = 0.0;       ///< coordinate at which it has no force [rad] or [m]
};

/// A motor along the coordinate of a joint: one of both.
struct JointMotor {
  std::optional<double> effort;  ///< on the first body, its opposite on the second [N m] or [N]
  std::optional<double> speed;   ///< that it keeps, whatever it needs [rad/s] or [m/s]
};

/// What holds two rigid bodies, or one and the world, to each other, [[joint]]. Places and axes are those of
/// the start, and move with their bodies.
struct Joint {
  enum class Kind { hinge, ball, slider, fixed, distance, universal } kind = Kind::hinge;
  std::string name;
  std::vector<std::string> bodies;  ///< two; one of them may be "world"
  Vec3 point;                       ///< of both bodies; of a distance, of the first [m]
  std::optional<Vec3> other_point;  ///< of a distance: point of the second [m]
  std::optional<Vec3> axis;         ///< hinge, slider; of a universal that of the first: unit vector
  std::optional<Vec3> other_axis;   ///< of a universal: that of the second, unit vector
  /// Range of its coordinate: the angle or way of the first body against the second, 0 at the start [rad] or
  /// [m]
  std::optional<std::array<double, 2>> limits;
  double restitution = 0.0;  ///< of its limits: rate after a hit over that before [1]
  double friction = 0.0;     ///< Coulomb's [N m] or [N]
  double damping = 0.0;      ///< [N m s/rad] or [N s/m]
  std::optional<JointSpring> spring;
  std::optional<JointMotor> motor;
  SourcePlace place;
  /// Whether its coordinate is an angle or a length that forces act along.
  [[nodiscard]] bool has_coordinate() const { return kind == Kind::hinge || kind == Kind::slider; }
};

/// Heat from outside, [[source]]: into the volume of matter, or through outer surfaces of fixed bodies.
struct HeatSource {
  std::vector<std::string> bodies;      ///< empty = all
  std::optional<Shape> region;          ///< that matter or surfaces are in; empty = everywhere
  std::optional<double> heat, density;  ///< into the volume [W], [W/m3]
  std::optional<double> flux, transfer_coefficient, emissivity;  ///< through surfaces [W/m2], [W/m2/K], [1]
  std::optional<double> ambient;                                 ///< temperature beyond those surfaces [K]
  double start = 0.0, stop = 0.0;                                ///< [s]
  SourcePlace place;
  [[nodiscard]] bool is_of_surfaces() const { return flux || transfer_coefficient || emissivity; }
};

/// Support radius h/dx where a file says nothing. Where every term is as printed it is that of the paper,
/// about 40 neighbours by volume. Else it is that of the Wendland kernel, about 74; where liquid carries its
/// density about 140, since no lattice of it then resists shear.
inline constexpr double printed_support = 2.12, corrected_support = 2.6, flowing_support = 3.2;
/// Reach over nearest and diagonal neighbours of the lattice [spacings].
inline constexpr double lattice_reach = 1.5;

/// Most steps of one run: years on any machine, and far below what a counter holds.
inline constexpr double most_steps = 1e12;

struct Scene {
  double end_time = 0.0;                     ///< [s]
  Vec3 gravity;                              ///< [m/s2]
  std::uint64_t dimensions = 3;              ///< 2: one layer in the plane y = 0
  bool plane_stress = false;                 ///< in the plane: elastic matter is free to strain along y
  double spacing = 0.0;                      ///< dx [m]
  double support_ratio = corrected_support;  ///< h/dx
  Mode mode = Mode::corrected;
  /// Resolved for every term; a scene that no reader made is corrected where it has none
  TermModes modes;
  TermModes modes_given;  ///< as the case file says, term by term
  TermForms forms;        ///< of corrected terms whose form another effect brings (model.hpp), by its word
  bool support_ratio_given = false;
  std::optional<double> time_step;  ///< empty = auto [s]
  std::uint64_t seed = 1;
  double jitter = 0.0;           ///< [spacings]
  std::optional<Vec3> min, max;  ///< domain; needed where a direction is periodic [m]
  std::array<bool, 3> periodic{};
  double output_interval = 0.0;  ///< [s]
  ViscosityForm viscosity_form = ViscosityForm::central;
  bool transport_velocity = false;
  bool settle = false;                    ///< liquids are let down into equilibrium before time 0
  double merge_distance = lattice_reach;  ///< [spacings]
  bool merge_distance_given = false;
  double contact_viscosity = 0.0;
  bool contact = true;  ///< false: solids pass through each other (contact = "none")
  /// a guard that trips sends the run back to a good state, with half the step
  bool recovers = false;
  bool removes_escaped = false;      ///< liquid that leaves min..max is dropped (on_escape = "remove")
  std::vector<GuardName> unguarded;  ///< guards that are off
  EffectValues values;               ///< of keys that effects bring (scene/effect_rule.hpp)
  std::vector<Material> materials;
  std::vector<Body> bodies;
  std::vector<Event> events;
  std::vector<Inflow> inflows;
  std::vector<Outflow> outflows;
  std::vector<ContactLaw> contact_laws;
  std::vector<AppliedForce> forces;
  std::vector<Spring> springs;
  std::vector<Joint> joints;
  std::vector<HeatSource> sources;

  [[nodiscard]] Dimensions space() const { return static_cast<Dimensions>(dimensions); }
  [[nodiscard]] bool is_planar() const { return space() == Dimensions::two; }
  /// Volume of a particle at rest [m3].
  [[nodiscard]] double cell() const { return cell_volume(spacing, space()); }
  /// A look-up: a loop over particles or bodies asks for its values before it begins. @throws UndeclaredTerm
  [[nodiscard]] Mode mode_of(const Term& t) const {
    const auto at = modes.find(t);
    return at != modes.end() ? at->second : mode_of_unresolved(t);
  }
  /// Whether another effect brings the form of a term: its own effect then leaves the term to that one.
  [[nodiscard]] bool has_brought_form(const Term& t) const {
    return forms.contains(t) && mode_of(t) == Mode::corrected;
  }
  /// Whether it is the form of that word.
  [[nodiscard]] bool takes_form(const Term& t, std::string_view word) const {
    return has_brought_form(t) && forms.at(t) == word;
  }
  /// Whether a body is liquid at the start, or an inflow brings liquid.
  [[nodiscard]] bool has_liquid() const;
  /// Whether pressure (9) below zero counts as zero. The paper prints no clamp: it is a correction.
  [[nodiscard]] bool clamps() const;
  /// Whether every term that has printed equations is as printed.
  [[nodiscard]] bool all_printed() const;
  /// Resolves every term: as the case file says, else by `mode`.
  void resolve_modes();
  /// Every term in one form.
  void set_all_modes(Mode);
  [[nodiscard]] double default_support_ratio() const;
  /// @throws InputError when no material (body) of that name is there
  [[nodiscard]] const Material& material(std::string_view name) const;
  [[nodiscard]] const Body& body(std::string_view name) const;

 private:
  [[nodiscard]] static Mode mode_of_unresolved(const Term&);
};

}  // namespace tripoint

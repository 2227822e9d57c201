// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "files/reference_choice.hpp"
#include "files/trajectory.hpp"
#include "tables/words.hpp"

namespace tripoint {

struct Job;

/// Measured values of a quantity in an experiment, in SI.
struct MeasuredCurve {
  std::vector<double> time, value, uncertainty;  ///< times rise; standard uncertainty of each value
};

/// Particles of which phase a quantity takes; solid: elastic or rigid.
enum class MeasuredPhase { liquid, elastic, rigid, solid };
constexpr WordTable<4> word_table(MeasuredPhase) {
  return {"phase", {"liquid", "elastic", "rigid", "solid"}};
}

/// cos(wave_vector.r + phase), and which way particles swing in it, where that is not along the wave.
struct MeasuredWave {
  Vec3 wave_vector;  ///< [rad/m]
  double phase = 0.0;
  std::optional<Vec3> polarisation = {};  ///< unit vector
};

struct MeasuredBox {
  Vec3 low, high;  ///< [m]
};

/// Place, axis and object of the measurement of a quantity. Empty: the reference does not say.
struct Measuring {
  std::optional<std::size_t> axis = {};       ///< 0, 1, 2 = x, y, z
  std::optional<std::size_t> bar = {};        ///< row in Job::bodies of the body that is measured
  std::optional<std::size_t> other = {};      ///< row in Job::bodies of the second of a pair
  std::optional<std::size_t> flip_body = {};  ///< row in Snapshot::bodies
  std::optional<MeasuredPhase> phase = {};    ///< particles that count; empty = all
  std::optional<MeasuredBox> box = {};
  bool outside = false;                       ///< particles that are not in the box
  bool follows = false;                       ///< the box moves and turns with the metric's body
  std::optional<Vec3> point = {};             ///< of a probe [m]
  std::optional<Vec3> direction = {};         ///< of a deflection, unit vector
  std::optional<bool> free_end_is_high = {};  ///< of a beam
  std::optional<bool> melts = {};             ///< of a front: the phase that it leaves behind is liquid
  std::optional<MeasuredWave> wave = {};
};

/// Truth, as far as it is known: an exact (or exactly discrete) solution for this job's particles and bodies.
class Reference {
 public:
  virtual ~Reference() = default;
  /// The solution at a time: positions and velocities of particles and bodies, temperatures; columns that it
  /// does not know are empty.
  [[nodiscard]] virtual Snapshot at(double time) const = 0;
  /// The truth that this frame is compared with. A solution that is a field of place (a liquid's) takes the
  /// frame's own places, so that a particle is judged where it is. Others know each particle's place, and
  /// this is at(now.time).
  [[nodiscard]] virtual Snapshot truth_for(const Snapshot& now) const { return at(now.time); }
  /// A number it knows by name: decay_rate [1/s], event_time [s], energy_ratio ...; empty when it does not.
  [[nodiscard]] virtual std::optional<double> number(std::string_view quantity) const {
    (void)quantity;
    return {};
  }
  /// Data that are no numbers: directions, bodies, places and switches.
  [[nodiscard]] virtual Measuring measuring() const { return {}; }
  /// Measured values by the name of their column; nullptr when it has none.
  [[nodiscard]] virtual const MeasuredCurve* measured(std::string_view column) const {
    (void)column;
    return nullptr;
  }
  /// Standard uncertainty of its value of a quantity at a time, in SI; empty where its data state none.
  [[nodiscard]] virtual std::optional<double> uncertainty(std::string_view quantity, double time) const {
    (void)quantity;
    (void)time;
    return {};
  }
  /// A number that changes in time: stretch, front_position ...; one that does not is the same at all times.
  [[nodiscard]] virtual std::optional<double> number_at(std::string_view quantity, double time) const {
    (void)time;
    return number(quantity);
  }
};

/// Type of an argument: a number with its unit, three numbers, true or false, x y or z, a word or name, a
/// formula.
enum class ArgumentType { number, vector, flag, axis, word, formula };
constexpr WordTable<6> word_table(ArgumentType) {
  return {"type of argument", {"number", "vector", "flag", "axis", "word", "formula"}};
}

/// One argument of a reference function, for the schema and the reference page.
struct ReferenceArgument {
  std::string name, unit, meaning;  ///< the meaning says the default taken from the scene
  ArgumentType type = ArgumentType::number;
  /// Says where a quantity is read, and nothing of its value: gauges of a job have it
  bool of_place = false;
};
struct ReferenceFunction {
  std::string name, kind, source, meaning;
  std::vector<ReferenceArgument> args;
};
[[nodiscard]] const std::vector<ReferenceFunction>& reference_functions();

/// @throws InputError for an unknown function (with the nearest known one) or a scene that it does not fit
[[nodiscard]] std::unique_ptr<Reference> make_reference(const ReferenceChoice&, const Job&,
                                                        const InitialState&);

}  // namespace tripoint

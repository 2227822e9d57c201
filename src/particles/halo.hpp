// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/field.hpp"
#include "core/vec3.hpp"
#include "particles/pair_lists.hpp"
#include "particles/particles.hpp"

namespace tripoint {

struct PeriodicBox;

/// All particles of a scene and their lists, by number: ids are numbers.
struct WholeScene {
  Particles particles;
  Bonds bonds;
  ExcludedPairs own;
};

/// The other processes, as seen by a simulation that holds a part of its scene (decision 021). Its rows are
/// its own particles, then ghosts of particles of other processes within reach of them. A change of a
/// particle by itself is made by every process that has it, with the same bits. Sums over pairs are complete
/// at the owner only, which sends them to the ghosts. All processes make every call, in the same order.
class Halo {
 public:
  virtual ~Halo() = default;
  /// On entry each process holds the same whole scene, ordered by particle number. It keeps its part, as
  /// migrate() leaves it. The scene may have more particles than before.
  /// @param places positions by particle number, used to split the scene as it was at the last lists [m];
  /// empty: the present positions
  /// @param cost cost of each particle in one step, by number, any unit. If given, the parts are recut so
  /// that each has the same cost. Empty: the parts of space stay
  virtual void share_out(Particles&, Bonds&, ExcludedPairs&, const PeriodicBox&, std::span<const Vec3> places,
                         std::span<const double> cost) = 0;
  /// Gives each process the lists of the particles that it has, own ones and ghosts. On entry they are those
  /// of the whole, by number.
  virtual void share_lists(Bonds&, ExcludedPairs&) = 0;
  /// The scene that is shared out next is another state: where its particles are, and what they hang on, has
  /// nothing to do with the last.
  virtual void begin_anew() {}
  /// The whole scene, for each process, as share_out() takes it again. Parts stay as they are.
  [[nodiscard]] virtual WholeScene gather(const Particles&, const Bonds&, const ExcludedPairs&) = 0;
  /// Particles go to the process that owns their part of space, and each process gets ghosts of particles
  /// within reach of its own. Ids are renumbered 0..size()-1, own particles first. Every column, bond and own
  /// pair goes with its particle (moving_lists.hpp). The bond partners of own particles are always among the
  /// ghosts, at any distance. Nobody may change lists of a shared scene. Each particle is here once, at the
  /// position that its owner has. Across a periodic boundary it is seen as in a run of one process.
  /// @param cost cost of each own particle, by id, as in share_out()
  virtual void migrate(Particles&, Bonds&, ExcludedPairs&, const PeriodicBox&,
                       std::span<const double> cost) = 0;
  /// Number of each particle here, by id, among the particles of all processes.
  /// @pre the scene is shared out
  [[nodiscard]] virtual std::span<const int> numbers() const = 0;
  /// Directions in which the scene is split, some of which may be periodic. None:
  /// this process is the only one.
  [[nodiscard]] virtual std::array<bool, 3> splits() const = 0;
  [[nodiscard]] virtual std::size_t owned() const = 0;  ///< particles of its own: ids 0..owned()-1
  /// Copies take these columns from their owners.
  virtual void refresh(Particles&, std::span<const Field<double>* const> columns) = 0;
  /// The same for numbers by id. @param each how many a particle has, one after the other
  virtual void refresh(std::span<double> by_id, std::size_t each) = 0;
  /// Each number becomes its sum over all processes, with the same bits for all.
  virtual void add(std::span<double> numbers) = 0;
  /// Numbers of all processes, one process after the other, for each of them.
  [[nodiscard]] virtual std::vector<double> all_of(const std::vector<double>& own) = 0;
  /// Numbers for each process, of which there are processes(). @return those that each has for this one, by
  /// process
  [[nodiscard]] virtual std::vector<std::vector<double>> exchange(
      const std::vector<std::vector<double>>& to) = 0;
  [[nodiscard]] virtual std::size_t processes() const = 0;
  [[nodiscard]] virtual std::size_t process() const = 0;  ///< this one, from 0
  /// Up to so many bodies are kept by every process; of more each has an owner (decision 044).
  [[nodiscard]] virtual std::size_t owners_above() const { return 1000; }
  /// A number becomes the least of all processes, and the word the one beside it.
  virtual void take_least(double& number, std::string& word) = 0;
  /// Whether this is the one process that reports values that all hold alike.
  [[nodiscard]] virtual bool is_first() const = 0;
};

/// Start of each record of `width` numbers, in ascending order of the first numbers. A sum in this order has
/// the bits of one process, however particles are shared out. Records of equal first numbers stay in their
/// order.
[[nodiscard]] inline std::vector<const double*> records_in_order(const std::vector<double>& all,
                                                                 std::size_t width) {
  std::vector<const double*> order;
  for (std::size_t k = 0; k < all.size(); k += width) order.push_back(&all[k]);
  std::ranges::stable_sort(order, {}, [](const double* one) { return *one; });
  return order;
}

}  // namespace tripoint

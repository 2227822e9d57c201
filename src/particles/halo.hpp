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
  OwnPairs own;
};

/// What a simulation asks of those that hold the rest of its scene, where this process holds a part of it (decision 021). Its
/// rows are then its own particles and, after them, copies of those of others that are within reach of its own. What a step does
/// to a particle by itself, all do that see it, with the same bits; its sums over pairs are complete at its owner alone, who
/// hands them on. Every call is made by all processes, in the same order.
class Halo {
 public:
  virtual ~Halo() = default;
  /// Each process holds the whole scene, by number, and all hold the same: of it each keeps its part, as migrate() leaves it.
  /// More particles than before are taken in.
  /// @param places by number, to share out by [m], where lists are to be those of before; empty: the places of now
  /// @param cost of each in a step, by number, in a unit of any kind: parts are then made anew so that each costs as much; empty:
  /// parts of space stay as they are
  virtual void share_out(Particles&, Bonds&, OwnPairs&, const PeriodicBox&, std::span<const Vec3> places,
                         std::span<const double> cost) = 0;
  /// The whole scene, for each process: what share_out() takes again. Parts stay as they are.
  [[nodiscard]] virtual WholeScene gather(const Particles&, const Bonds&, const OwnPairs&) = 0;
  /// Who has a part of space now is handed what has moved there, and copies of what is within reach of it. Ids are 0..size()-1
  /// anew, those of own particles first; every column goes with its particle, and so do its bonds and own pairs
  /// (moving_lists.hpp): what one of its own has a bond with is among the copies, however far it is. Nobody may change lists of a
  /// scene that is shared out. Each particle is here once, at the place that its owner has: who sees it across a periodic
  /// boundary does so as one process does.
  /// @param cost of each of its own, by id, as in share_out()
  virtual void migrate(Particles&, Bonds&, OwnPairs&, const PeriodicBox&, std::span<const double> cost) = 0;
  /// Of each id here its number among the particles of all processes.
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
  /// A number becomes the least of all processes, and the word the one beside it.
  virtual void take_least(double& number, std::string& word) = 0;
  /// Whether this is the one process that tells what all hold alike.
  [[nodiscard]] virtual bool is_first() const = 0;
};

/// Where each record of `width` numbers begins, in order of their first numbers: what is summed so has the bits of one process,
/// however particles are shared out. Those of equal first numbers stay in their order.
[[nodiscard]] inline std::vector<const double*> records_in_order(const std::vector<double>& all, std::size_t width) {
  std::vector<const double*> order;
  for (std::size_t k = 0; k < all.size(); k += width) order.push_back(&all[k]);
  std::ranges::stable_sort(order, {}, [](const double* one) { return *one; });
  return order;
}

}  // namespace tripoint

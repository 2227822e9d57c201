// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/aligned.hpp"
#include "core/vec3.hpp"
#include "particles/entry.hpp"
#include "particles/pair_lists.hpp"
#include "particles/particles.hpp"
#include "particles/scan.hpp"

namespace tripoint {

/// The domain where it is periodic.
struct PeriodicBox {
  std::array<bool, 3> periodic{};
  Vec3 min, width;  ///< [m], used in periodic directions only
  [[nodiscard]] bool any() const noexcept { return periodic[0] || periodic[1] || periodic[2]; }
};

/// Clusters of up to `lanes` consecutive rows. Each has one list of the rows that are near to any of its
/// members. A pass works on a cluster as one vector of particles.
struct Clusters {
  int lanes = 1;
  std::vector<std::uint32_t> first;    ///< first row of each cluster, and one past the last row
  std::vector<std::size_t> start;      ///< first entry of each cluster, and one past the last
  std::vector<std::uint32_t> entries;  ///< row and image, as in Entry
  /// Of each entry: bit l where it is near to member l; a particle is not near to itself
  std::vector<std::uint8_t> near;
  /// Of each entry: bit l where it is an excluded pair of member l; empty where there is none
  std::vector<std::uint8_t> own;
  /// One bit for each entry: whether it is within the support of a member now, not only near to it. Each
  /// cluster begins a word, at within_start(). The last finding pass sets them for the present places, as
  /// densities are. Empty where no pass has set them.
  std::vector<std::uint64_t> within;
  /// One bit for each entry, as in `within`: whether it acts on a member at all. Found anew with each list;
  /// empty where all may.
  std::vector<std::uint64_t> acting;
  std::vector<std::uint32_t> listed,  ///< clusters with a list, ascending
      unlisted,                       ///< without, since all they meet is fixed as they are
      /// Of sleeping rows in reach of moving ones, after all others: see Neighbours::list_sleeping()
      on_demand;
  /// All clusters in the order in which passes visit them: strip by strip along y, so that what one layer of
  /// cells has read is still in the cache for the next. Empty where there are few: as they are numbered. No
  /// sum depends on it.
  std::vector<std::uint32_t> visits;
  [[nodiscard]] std::size_t size() const noexcept { return first.empty() ? 0 : first.size() - 1; }
  /// The cluster that a row is a member of.
  [[nodiscard]] std::uint32_t of(std::size_t row) const {
    return static_cast<std::uint32_t>(std::ranges::upper_bound(first, row) - first.begin() - 1);
  }
  /// Calls visit(k) for each cluster, in the order of visits.
  template <class Visit>
  void each(Visit visit) const {
    for (std::uint32_t n = 0; n < size(); ++n) visit(visits.empty() ? n : visits[n]);
  }
};

/// The entries of one row, in list order.
class RowEntries {
 public:
  class iterator {
   public:
    using value_type = Entry;
    using difference_type = std::ptrdiff_t;
    iterator() = default;
    iterator(const Clusters* list, std::size_t at, std::size_t end, unsigned lane)
        : list_(list), at_(at), end_(end), lane_(lane) {
      skip();
    }
    Entry operator*() const {
      const bool own = !list_->own.empty() && (list_->own[at_] >> lane_ & 1u) != 0;
      return {list_->entries[at_] | (own ? Entry::own_bit : 0u)};
    }
    iterator& operator++() {
      ++at_;
      skip();
      return *this;
    }
    iterator operator++(int) {
      const iterator before = *this;
      ++*this;
      return before;
    }
    bool operator==(const iterator& other) const { return at_ == other.at_; }

   private:
    void skip() {
      while (at_ != end_ && (list_->near[at_] >> lane_ & 1u) == 0) ++at_;
    }
    const Clusters* list_ = nullptr;
    std::size_t at_ = 0, end_ = 0;
    unsigned lane_ = 0;
  };
  RowEntries(const Clusters& list, std::size_t row)
      : list_(&list), cluster_(list.of(row)), lane_(static_cast<unsigned>(row - list.first[cluster_])) {}
  [[nodiscard]] iterator begin() const {
    return {list_, list_->start[cluster_], list_->start[cluster_ + 1], lane_};
  }
  [[nodiscard]] iterator end() const {
    return {list_, list_->start[cluster_ + 1], list_->start[cluster_ + 1], lane_};
  }

 private:
  const Clusters* list_;
  std::size_t cluster_;
  unsigned lane_;
};

/// Particles that can sleep: see Particles.
struct Resting {
  /// Of each solid body, 1 where its members stay where they are; empty: nothing sleeps
  std::vector<char> bodies;
  /// Distance within which they are awake around those that something can reach; where less, the reach of a
  /// list [m]
  double around = 0.0;
  /// Of each id, 1 where no step reads of a fixed particle but its place; empty: it reads all
  std::span<const char> unread{};
};

/// Facts about the whole scene that the lists of a part need, so that each has the order that it has in the
/// whole.
struct Whole {
  Vec3 low, high;             ///< corners of all places that are listed [m]
  std::size_t particles = 0;  ///< of the whole
  std::vector<int> numbers;   ///< in the whole, of each id of the part, ghosts too
  std::size_t own = 0;        ///< ids below it are no ghosts
};

/// Full directed lists: every i has all its j within support + skin, ordered by (cell, id) at the last
/// rebuild. A sum over them has the same bits for any number of threads and any earlier order of particles.
/// Periodic images count each; a particle may be its own neighbour through a periodic boundary.
class Neighbours {
 public:
  /// @param support radius beyond which pairs do nothing [m]
  /// @param skin kept around it, so that lists last; 0 for particles that never move [m]
  /// @param lanes particles of a cluster: the lists of each row are the same, and in the same order, whatever
  /// it is
  /// @throws InputError when a periodic direction is narrower than support + skin, or there is no such width
  Neighbours(double support, double skin, const PeriodicBox& box, int threads, int lanes = 1);

  /// Sorts the particles and lists them anew when one has moved by more than skin/2 since the last time.
  /// @throws Diverged when a position is not finite
  /// @param resting asked where lists are made. Sleeping particles are left out of the lists. An awake
  /// particle that can meet only fixed ones has no list. Members of fixed bodies must not have moved since
  /// the rebuild before the last. The first lists are whole: of all particles
  /// @return whether the rows have a new order
  bool update(Particles&, double time, const std::function<Resting()>& resting = {});
  /// Lists the particles anew from the positions of an earlier rebuild, as a restart must to continue the
  /// same bits.
  /// @param build_positions by row of `particles`, as build_positions() gave them
  /// @param rebuilds as counted until then
  void rebuild_from(Particles&, std::span<const Vec3> build_positions, double time, long rebuilds = 1);

  /// Lists like these of another set of particles in another box: none are made yet, and rebuilds are counted
  /// on.
  [[nodiscard]] Neighbours anew(const PeriodicBox&) const;
  /// From the next rebuild on a row has its list, with the same entries, where somebody asks for it by of().
  /// Passes have none.
  void list_when_asked() { asked_.emplace(); }
  /// The same lists of the same rows, which count as made anew: what was found of lists of that number until
  /// now is outdated.
  void renew(long rebuilds) {
    rebuilds_ = rebuilds;
    marked_ = false;
  }

  /// Whether a particle has moved by more than skin/2 since the last lists, or there are none.
  [[nodiscard]] bool outdated(const Particles&) const;
  /// Rows stand for other particles: update() then makes lists whatever has moved.
  /// @param whole what these particles are a part of; none: all that there are
  void drop_lists(std::optional<Whole> whole) {
    built_.clear();
    still_ = {};
    are_made_ = false;
    whole_ = std::move(whole);
  }

  /// Threads from now on. They change neither lists nor their order.
  void use_threads(int threads) { threads_ = threads; }

  /// Marks the entries of excluded pairs; to be called after a rebuild and after a change of these lists.
  void mark_own(const Particles&, const ExcludedPairs&);
  /// Whether that was done since the last rebuild.
  [[nodiscard]] bool marked() const noexcept { return marked_; }

  /// Also lists sleeping particles that something moving can reach, as the last lists would have. This is
  /// done once for each set of lists, and only when values other than their places are asked for.
  void list_sleeping();
  /// Rows 0..rows()-1 are members of clusters, with a list or without.
  [[nodiscard]] std::size_t rows() const noexcept {
    return clusters_.size() > 0 ? clusters_.first.back() : 0;
  }

  /// Makes room for Clusters::within, to be filled by a pass.
  void make_room_within();

  [[nodiscard]] RowEntries of(std::size_t i) const { return {asked_ ? asked_list(i) : clusters_, i}; }
  [[nodiscard]] const Clusters& clusters() const noexcept { return clusters_; }
  [[nodiscard]] Clusters& clusters() noexcept { return clusters_; }
  /// r_j - r_i of an entry is (x_j - x_i) + shift: in this order it is exactly antisymmetric in i and j.
  [[nodiscard]] const Vec3& shift(std::uint32_t image) const noexcept { return shift_[image]; }
  [[nodiscard]] const std::array<Vec3, 27>& shifts() const noexcept { return shift_; }
  [[nodiscard]] double support() const noexcept { return support_; }
  [[nodiscard]] std::size_t entries() const noexcept {
    return pairs_;
  }  ///< directed pairs within support + skin, of sleeping rows too
  /// Lists of all particles that were made until now. Quantities that follow from fixed places alone are to
  /// be found anew with them.
  [[nodiscard]] long whole_lists() const noexcept { return whole_lists_; }
  /// Whether the present lists are whole, and the next need not be. Quantities that follow from fixed places
  /// alone are found now.
  [[nodiscard]] bool may_rest_next() const noexcept { return still_.known && listed_all_; }
  /// Fixed particles by id, in an order that stays; the place of one in it. Only where may_rest_next() or
  /// something sleeps.
  [[nodiscard]] std::span<const std::uint32_t> still_ids() const noexcept { return still_.id; }
  [[nodiscard]] std::uint32_t still_place(std::size_t id) const noexcept { return still_.place[id]; }
  /// First moving row of each block of 1024 rows, and one past the last. Blocks are counted over all rows in
  /// order of (cell, id), as if fixed rows lay among the moving ones.
  [[nodiscard]] std::span<const std::uint32_t> row_blocks() const noexcept { return row_blocks_; }
  /// All rows in order of (cell, id).
  [[nodiscard]] std::vector<std::uint32_t> rows_in_order(const Particles&) const;
  [[nodiscard]] long rebuilds() const noexcept { return rebuilds_; }
  [[nodiscard]] std::span<const Vec3> build_positions() const noexcept { return built_; }

 private:
  struct Grid;
  /// Places to list from.
  struct Places {
    const double *x, *y, *z;  ///< by row [m]
  };
  void wrap(Particles&) const;
  void rebuild(Particles&, double time, const Resting&);
  /// Around all particles; fixed ones are known to be where they were.
  struct Extent {
    Vec3 low, high;
  };
  [[nodiscard]] Extent extent_of(const Particles&) const;
  void sort_and_list(Particles&, const Resting&);
  void sort_all(Particles&, Grid&);
  enum Part : char { moves, read, asleep };  ///< asleep: acts by its place alone
  /// Rows that are awake.
  struct Awake {
    std::vector<std::uint32_t> rows;
    std::vector<Part> part;      ///< of each
    std::vector<char> can_meet;  ///< of each, 1 where something that moves can reach it
  };
  [[nodiscard]] Awake awake_rows(const Particles&, const Grid&, const Resting&) const;
  void sort_awake(Particles&, Grid&, const Resting&);
  void learn_still(const Particles&, const Grid&, const Resting&);
  void find_blocks(const Particles&, const Grid&);
  [[nodiscard]] std::vector<char> within(std::vector<char> marks, double distance) const;
  void count_still_pairs(const Particles&);
  void form_clusters(const Particles&, const Grid&);
  void list_fixed(const Particles&, const Places&, const Grid&);
  void add_clusters(const Grid&, std::size_t from, std::size_t to);
  void order_visits();
  void bring_own_first(const Particles&, std::vector<std::uint32_t>& order);
  /// The row of each place in order of (cell, id); empty: rows are in that order.
  [[nodiscard]] const std::vector<std::uint32_t>& rows_of_places() const {
    return order_.empty() ? own_first_ : order_;
  }
  std::size_t list(const Places&, const Grid&, std::span<const std::uint32_t> clusters,
                   std::vector<std::size_t>& listed_by);
  /// What a scan of one cluster finds, with room for all that it looks at.
  struct Found {
    std::vector<std::uint32_t> entries;
    std::vector<std::uint8_t> near;
    std::vector<CandidateRange> ranges;
  };
  Scanned scan_cluster(const Places&, const Grid&, std::size_t cluster, Found&) const;
  void keep_to_ask(const Particles&, Grid&&);
  [[nodiscard]] const Clusters& asked_list(std::size_t row) const;
  std::optional<std::size_t> list_into(const Places&, const Grid&, std::span<const std::uint32_t> clusters,
                                       std::span<const std::size_t> rooms,
                                       std::vector<std::size_t>& listed_by);

  double support_, skin_;
  PeriodicBox box_;
  int threads_;
  std::optional<Whole> whole_;
  std::array<Vec3, 27> shift_{};
  Clusters clusters_;
  ScanFunction scan_;
  std::array<std::vector<std::size_t>, 3>
      listed_by_;  ///< entries of each thread at the last build, of moving, fixed and sleeping rows
  std::size_t pairs_ = 0;
  std::vector<Vec3> built_;
  /// Fixed particles in stretches along x, each as long as the reach of a list and one cell wide: they are
  /// woken by stretches.
  struct Still {
    bool known = false;
    std::vector<char> bodies;
    Vec3 origin, width, low, high;  ///< of the grid's cells; corners of the particles [m]
    std::array<int, 3> count{};     ///< stretches
    /// First of each stretch, and one past the last; ids in order of (cell, id)
    std::vector<std::uint32_t> first, id;
    /// Of each id its place in `id`; first of each cell, and one past the last
    std::vector<std::uint32_t> place, in_cell;
    std::size_t pairs = 0;  ///< directed ones among fixed particles
    [[nodiscard]] std::size_t index(const std::array<int, 3>& s) const {
      return static_cast<std::size_t>(s[0]) +
             static_cast<std::size_t>(count[0]) *
                 (static_cast<std::size_t>(s[1]) +
                  static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(s[2]));
    }
  } still_;
  /// Lists that are made where somebody asks for them.
  struct Asked {
    AlignedVector<double> x, y, z;                  ///< places to list from, by row [m]
    std::vector<int> id;                            ///< of each row
    ExcludedPairs own;                              ///< to mark
    mutable std::map<std::size_t, Clusters> lists;  ///< one cluster each, by its number
  };
  std::optional<Asked> asked_;
  /// Rows that lists name, in order of (cell, id); empty: all rows are in that order.
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> own_first_;  ///< the row of each place, where there are ghosts; else empty
  /// Of each of these rows, whether something that moves can reach it; empty as above
  std::vector<char> meets_;
  /// Of the last lists, by places in order_; null where that is empty
  std::shared_ptr<const Grid> grid_;
  /// First moving row of each cell, and one past the last; empty as above
  std::vector<std::uint32_t> moving_first_;
  std::vector<std::uint32_t> row_blocks_;
  std::vector<std::uint32_t> strips_;  ///< of each cluster
  std::size_t moving_ = 0;             ///< rows of the last lists, as Particles::moving()
  bool listed_sleeping_ = false;
  long whole_lists_ = 0;
  bool listed_all_ = false;
  long rebuilds_ = 0;
  bool are_made_ = false;  ///< lists, of these particles
  bool marked_ = false;
};

}  // namespace tripoint

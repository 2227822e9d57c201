// SPDX-License-Identifier: BSD-3-Clause
// Lists where fixed particles can sleep: rows of moving particles, of fixed ones that are read, and of
// sleeping ones (decisions 020, 028).
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "core/aligned.hpp"
#include "particles/grid.hpp"
#include "particles/neighbours.hpp"

namespace tripoint {
namespace {

constexpr std::size_t rows_a_block = 1024;

struct Sorted {
  std::vector<std::uint32_t> place;    ///< at each place, which of the rows stands there
  std::vector<std::uint32_t> cell_of;  ///< of each of the rows
};

/// Counting sort of rows by cell, and by id within each. Sets grid.first.
Sorted sort_by_cell(const std::vector<std::uint32_t>& rows, const auto& x, std::span<const int> id,
                    auto& grid, int threads) {
  const std::size_t m = rows.size();
  grid.first.assign(grid.cells() + 2, 0);
  constexpr std::uint32_t nobody = ~std::uint32_t{0};
  std::vector<std::uint32_t> place(m, nobody), cell_of(m);
#pragma omp parallel for schedule(static) num_threads(threads)
  for (std::size_t k = 0; k < m; ++k)
    cell_of[k] = static_cast<std::uint32_t>(grid.index(grid.place(x.at(rows[k]))));
  for (const std::uint32_t c : cell_of) ++grid.first[c + 2];
  for (std::size_t c = 1; c <= grid.cells(); ++c) grid.first[c + 1] += grid.first[c];
  for (std::uint32_t k = 0; k < m; ++k) {
    const std::uint32_t c = cell_of[k];
    // The next place of the cell, in the end the first of the one after it
    std::uint32_t at = grid.first[c + 1]++;
    const auto is_after = [&](std::uint32_t other) {
      return other != nobody && cell_of[other] == c && id[rows[other]] > id[rows[k]];
    };
    for (; at > 0 && is_after(place[at - 1]); --at) place[at] = place[at - 1];  // a cell holds few
    place[at] = k;
  }
  grid.first.pop_back();
  return {std::move(place), std::move(cell_of)};
}

/// A permutation of rows: the content of row from[k] goes to row to[k].
struct Moves {
  std::vector<std::uint32_t> from, to;
};

/// The rows `was` come to the front, in that order. Rows displaced from the front take the places that became
/// free; all other rows stay.
Moves bring_to_front(const std::vector<std::uint32_t>& was, std::size_t all) {
  std::vector<char> taken(all, 0);
  for (const std::uint32_t one : was) taken[one] = 1;
  const auto m = static_cast<std::uint32_t>(was.size());
  Moves moves;
  for (std::uint32_t r = 0; r < m; ++r)
    if (was[r] != r) {
      moves.from.push_back(was[r]);
      moves.to.push_back(r);
    }
  for (std::uint32_t r = 0; r < m; ++r)
    if (!taken[r]) moves.from.push_back(r);
  for (std::uint32_t r = m; moves.to.size() < moves.from.size(); ++r)
    if (taken[r]) moves.to.push_back(r);
  return moves;
}

}  // namespace

/// Which particles can sleep, and in which stretches they lie. All rows are sorted.
void Neighbours::learn_still(const Particles& particles, const Grid& grid, const Resting& resting) {
  const auto x = positions(particles);
  const auto body = particles[field::body], id = particles[field::id];
  still_.id.clear();
  still_.place.assign(particles.size(), ~std::uint32_t{0});
  std::vector<std::array<int, 3>> stretch;
  still_.count = {1, 1, 1};
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (body[i] < 0 || !resting.bodies[static_cast<std::size_t>(body[i])]) continue;
    if (still_.id.empty()) still_.low = still_.high = x.at(i);
    for (std::size_t a = 0; a < 3; ++a) {
      still_.low[a] = std::min(still_.low[a], x.at(i)[a]);
      still_.high[a] = std::max(still_.high[a], x.at(i)[a]);
    }
    still_.place[static_cast<std::size_t>(id[i])] = static_cast<std::uint32_t>(still_.id.size());
    still_.id.push_back(static_cast<std::uint32_t>(id[i]));
    stretch.push_back(Grid::stretch(grid.place(x.at(i))));
    for (std::size_t a = 0; a < 3; ++a) still_.count[a] = std::max(still_.count[a], stretch.back()[a] + 1);
  }
  for (std::size_t a = 0; a < 3; ++a)
    if (box_.periodic[a])
      still_.count[a] = std::max(
          still_.count[a], Grid::stretch({grid.count[0] - 1, grid.count[1] - 1, grid.count[2] - 1})[a] + 1);
  still_.first.assign(static_cast<std::size_t>(still_.count[0]) * still_.count[1] * still_.count[2] + 1, 0);
  for (const auto& s : stretch) ++still_.first[still_.index(s) + 1];
  for (std::size_t s = 0; s + 1 < still_.first.size(); ++s) still_.first[s + 1] += still_.first[s];
  still_.known = !still_.id.empty();
}

/// Marks every stretch of cells within `distance` [m] of a marked one. It may mark some more: it takes a box
/// around each.
std::vector<char> Neighbours::within(std::vector<char> marks, double distance) const {
  const std::array<int, 3>& n = still_.count;
  const std::array<std::size_t, 3> step{1, static_cast<std::size_t>(n[0]),
                                        static_cast<std::size_t>(n[0]) * n[1]};
  for (std::size_t a = 0; a < 3; ++a) {
    const double wide = still_.width[a] * (a == 0 ? Grid::cells_a_stretch : 1);
    const int far = static_cast<int>(std::ceil(distance / wide * (1.0 - Grid::tolerance))) +
                    (box_.periodic[a] ? 1 : 0);  // the last stretch of a period may be short
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    std::vector<char> line(static_cast<std::size_t>(n[a]));
    for (int j = 0; j < n[b]; ++j) {
      for (int k = 0; k < n[c]; ++k) {
        const std::size_t from =
            static_cast<std::size_t>(j) * step[b] + static_cast<std::size_t>(k) * step[c];
        const auto spread = [&](bool forward) {
          int since = far + 1;
          // Twice around, so that marks reach across the boundary
          const int turns = box_.periodic[a] ? 2 : 1;
          for (int turn = 0; turn < turns; ++turn)
            for (int at = 0; at < n[a]; ++at) {
              const int m = forward ? at : n[a] - 1 - at;
              since = marks[from + static_cast<std::size_t>(m) * step[a]] != 0 ? 0 : since + 1;
              if (since <= far) line[static_cast<std::size_t>(m)] = 1;
            }
        };
        std::ranges::fill(line, char{0});
        spread(true);
        spread(false);
        for (int m = 0; m < n[a]; ++m)
          marks[from + static_cast<std::size_t>(m) * step[a]] = line[static_cast<std::size_t>(m)];
      }
    }
  }
  return marks;
}

/// Which rows are awake, and why: all that moves, and of the fixed particles those within reach of it.
Neighbours::Awake Neighbours::awake_rows(const Particles& particles, const Grid& grid,
                                         const Resting& resting) const {
  const std::size_t n = particles.size();
  const auto x = positions(particles);
  const auto body = particles[field::body];
  Awake found;
  std::vector<char> moving(still_.first.size() - 1, 0);
  const auto wake = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      if (body[i] >= 0 && resting.bodies[static_cast<std::size_t>(body[i])]) continue;
      found.rows.push_back(static_cast<std::uint32_t>(i));
      std::array<int, 3> s = Grid::stretch(grid.place(x.at(i)));
      for (std::size_t a = 0; a < 3; ++a) s[a] = std::min(s[a], still_.count[a] - 1);
      moving[still_.index(s)] = 1;
    }
  };
  wake(0, particles.moving());
  if (particles.moving() < n) wake(built_.size(), n);
  const std::vector<char> meets = within(moving, support_ + skin_), near = within(meets, support_ + skin_),
                          awake = resting.around > support_ + skin_ ? within(meets, resting.around) : near;
  found.part.assign(found.rows.size(), moves);
  found.can_meet.assign(found.rows.size(), 1);
  for (std::size_t s = 0; s < awake.size(); ++s) {
    if (!awake[s]) continue;
    for (std::size_t k = still_.first[s]; k < still_.first[s + 1]; ++k) {
      const std::uint32_t one = still_.id[k];
      const bool unread = !resting.unread.empty() && resting.unread[one] != 0;
      if (unread && !near[s]) continue;
      found.rows.push_back(static_cast<std::uint32_t>(particles.row(one)));
      found.part.push_back(unread ? asleep : read);
      found.can_meet.push_back(meets[s]);
    }
  }
  return found;
}

/// Row order: 1. moving particles; 2. fixed particles that a step reads; 3. fixed particles in reach that act
/// only by their position; 4. sleeping particles. The first two groups are sorted by (cell, id). Most
/// sleeping particles keep their row.
void Neighbours::sort_awake(Particles& particles, Grid& grid, const Resting& resting) {
  const std::size_t n = particles.size();
  const auto x = positions(particles);
  const auto id = particles[field::id];
  still_.place.resize(n, ~std::uint32_t{0});  // particles that have flowed in move
  const auto [rows, part, can_meet] = awake_rows(particles, grid, resting);
  const auto [place, cell_of] = sort_by_cell(rows, x, id, grid, threads_);
  if (!grid_ || grid_->count != grid.count) {  // their order stays where there are more cells or fewer
    still_.in_cell.assign(grid.cells() + 1, 0);
    for (const std::uint32_t one : still_.id)
      ++still_.in_cell[grid.index(grid.place(x.at(particles.row(one)))) + 1];
    for (std::size_t c = 0; c < grid.cells(); ++c) still_.in_cell[c + 1] += still_.in_cell[c];
  }

  // The row of each place: a part after the other.
  std::array<std::uint32_t, 3> row{};
  for (const Part one : part)
    if (one < asleep) ++row[one + 1u];
  row[asleep] += row[read];
  const std::size_t first_read = row[read], first_asleep = row[asleep];
  std::vector<std::uint32_t> was(rows.size());
  order_.resize(rows.size());
  meets_.resize(rows.size());
  moving_first_.resize(grid.cells() + 1);
  std::size_t filled = 0;  // cells whose first moving row is known: most of a tank's cells are empty
  for (std::uint32_t at = 0; at < place.size(); ++at) {
    const std::uint32_t k = place[at], cell = cell_of[k];
    for (; filled <= cell; ++filled) moving_first_[filled] = row[moves];
    const std::uint32_t r = row[part[k]]++;
    order_[at] = r;
    was[r] = rows[k];
    meets_[r] = can_meet[k];
  }
  for (; filled < moving_first_.size(); ++filled) moving_first_[filled] = row[moves];
  const auto& [from, to] = bring_to_front(was, n);
  particles.rearrange(from, to, first_read, first_asleep, threads_);
  const auto sorted = positions(particles);
  built_.resize(n);
  for (std::uint32_t r = 0; r < first_read; ++r) built_[r] = sorted.at(r);
  for (const std::uint32_t r : to) built_[r] = sorted.at(r);
  find_blocks(particles, grid);
}

/// Blocks of all rows in order of (cell, id): how many moving rows come before each.
void Neighbours::find_blocks(const Particles& particles, const Grid& grid) {
  const auto id = particles[field::id];
  const auto rows_before = [&](std::size_t cell) {
    return std::size_t{moving_first_[cell]} + still_.in_cell[cell];
  };
  row_blocks_.clear();
  std::size_t c = 0;  // the cell that a block begins in
  for (std::size_t first = 0; first < rows_before(grid.cells()); first += rows_a_block) {
    for (std::size_t past = grid.cells(); past - c > 1;) {
      const std::size_t middle = (c + past) / 2;
      (rows_before(middle) <= first ? c : past) = middle;
    }
    std::uint32_t moving = moving_first_[c], fixed = still_.in_cell[c];
    for (std::size_t at = rows_before(c); at < first; ++at) {
      const bool is_fixed =
          moving == moving_first_[c + 1] ||
          (fixed < still_.in_cell[c + 1] && still_.id[fixed] < static_cast<std::uint32_t>(id[moving]));
      ++(is_fixed ? fixed : moving);
    }
    row_blocks_.push_back(moving);
  }
  row_blocks_.push_back(moving_first_.back());
}

std::vector<std::uint32_t> Neighbours::rows_in_order(const Particles& particles) const {
  std::vector<std::uint32_t> rows(order_.empty() ? particles.size() : 0);
  std::iota(rows.begin(), rows.end(), 0u);
  const auto id = particles[field::id];
  const auto before = [&](std::uint32_t a, std::uint32_t b) { return id[a] < id[b]; };
  for (std::size_t c = 0; c + 1 < moving_first_.size(); ++c) {
    const auto start = static_cast<std::ptrdiff_t>(rows.size());
    for (std::uint32_t row = moving_first_[c]; row < moving_first_[c + 1]; ++row) rows.push_back(row);
    const auto fixed = static_cast<std::ptrdiff_t>(rows.size());
    for (std::uint32_t k = still_.in_cell[c]; k < still_.in_cell[c + 1]; ++k)
      rows.push_back(static_cast<std::uint32_t>(particles.row(still_.id[k])));
    std::inplace_merge(rows.begin() + start, rows.begin() + fixed, rows.end(), before);
  }
  return rows;
}

/// Makes lists of those fixed clusters that stand in a list of a moving cluster: lists of the others would
/// name nothing that moves.
void Neighbours::list_fixed(const Particles& particles, const Places& places, const Grid& grid) {
  Clusters& c = clusters_;
  std::vector<char> is_met(rows(), 0);
  for (std::size_t e = 0; e < c.start.back(); ++e) is_met[Entry{c.entries[e]}.row()] = 1;
  const std::size_t moving = c.listed.size();
  for (auto k = static_cast<std::uint32_t>(moving); k < c.size(); ++k) {
    const bool any = std::find(is_met.begin() + c.first[k], is_met.begin() + c.first[k + 1], 1) !=
                     is_met.begin() + c.first[k + 1];
    (!any ? c.unlisted : c.first[k] < particles.awake() ? c.listed : c.on_demand).push_back(k);
  }
  list(places, grid, std::span(c.listed).subspan(moving), listed_by_[1]);
}

void Neighbours::list_sleeping() {
  if (listed_sleeping_ || clusters_.on_demand.empty()) return;
  listed_sleeping_ = true;
  // Readable a whole vector past the last
  AlignedVector<double> x(rows() + vector_bytes), y(x.size()), z(x.size());
  for (std::size_t i = 0; i < rows(); ++i) {
    x[i] = built_[i].x;
    y[i] = built_[i].y;
    z[i] = built_[i].z;
  }
  list({x.data(), y.data(), z.data()}, *grid_, clusters_.on_demand, listed_by_[2]);
}

/// Pairs without a list are counted too. A pair of a moving and a fixed particle was counted twice, because
/// the lists of fixed particles do not count. The number of pairs among fixed particles is known.
void Neighbours::count_still_pairs(const Particles& particles) {
  if (!listed_all_) pairs_ += still_.pairs;
  if (!may_rest_next()) return;
  const Clusters& c = clusters_;
  const auto id = particles[field::id];
  const auto is_still = [&](std::size_t row) {
    return still_.place[static_cast<std::size_t>(id[row])] != ~std::uint32_t{0};
  };
  std::size_t pairs = 0;
#pragma omp parallel for schedule(static) num_threads(threads_) reduction(+ : pairs)
  for (std::size_t k = 0; k < c.size(); ++k) {
    unsigned still = 0;  // bits of members
    for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i)
      still |= static_cast<unsigned>(is_still(i)) << (i - c.first[k]);
    for (std::size_t e = c.start[k]; e < c.start[k + 1] && still != 0; ++e)
      if (is_still(Entry{c.entries[e]}.row()))
        pairs += static_cast<unsigned>(std::popcount(c.near[e] & still));
  }
  still_.pairs = pairs;
}

}  // namespace tripoint

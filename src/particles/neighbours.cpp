// SPDX-License-Identifier: BSD-3-Clause
#include "particles/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/errors.hpp"
#include "core/machine.hpp"
#include "particles/grid.hpp"

namespace tripoint {
namespace {

const char* const axis_names[] = {"x", "y", "z"};
constexpr std::size_t cells_a_strip = 6;                   ///< of 3 to 12, measured at 200,000 to 2,000,000 particles
constexpr std::size_t clusters_that_have_strips = 10'000;  ///< what a layer of fewer reads stays in the cache as it is
/// @param listed rows that the last lists knew: the fixed ones among them have not moved
void refuse_not_finite(const Particles& particles, double time, std::size_t listed) {
  const auto x = positions(particles);
  const auto refuse_among = [&](std::size_t first, std::size_t past) {
    for (std::size_t i = first; i < past; ++i) {
      if (finite(x.at(i)) && norm(x.at(i)) <= 1e100) continue;
      throw Diverged(particles[field::id][i], particles[field::body][i], "position", "drift", time, "a position is not finite");
    }
  };
  refuse_among(0, particles.moving());
  refuse_among(std::max(particles.moving(), listed), particles.size());
}

/// Resizes without copying: the old values are lost, where none are to be kept. Untouched pages take no memory.
template <class T>
void fit(std::vector<T>& column, std::size_t size, std::size_t kept) {
  if (kept == 0 && column.capacity() < size) {
    std::vector<T>().swap(column);
    column.reserve(size + size / 4);
  }
  column.resize(size);
}

}  // namespace

Neighbours::Neighbours(double support, double skin, const PeriodicBox& box, int threads, int lanes)
    : support_(support), skin_(skin), box_(box), threads_(threads), scan_(scan_of(lanes)) {
  clusters_.lanes = lanes;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!box.periodic[a] || box.width[a] >= support + skin) continue;
    throw InputError(std::string("the periodic direction ") + axis_names[a] + " is " + std::to_string(box.width[a]) +
                     " m wide, less than the support radius with its skin, " + std::to_string(support + skin) +
                     " m: make the domain wider or the spacing smaller");
  }
  for (int k = 0; k < 27; ++k) {
    const int n[] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
    for (std::size_t a = 0; a < 3; ++a) shift_[static_cast<std::size_t>(k)][a] = box.periodic[a] ? n[a] * box.width[a] : 0.0;
  }
}

Neighbours Neighbours::anew(const PeriodicBox& box) const {
  Neighbours lists(support_, skin_, box, threads_, clusters_.lanes);
  lists.rebuilds_ = rebuilds_;
  lists.whole_lists_ = whole_lists_;
  return lists;
}

bool Neighbours::outdated(const Particles& particles) const {
  if (!are_made_ || built_.size() != particles.size() || rebuilds_ == 0) return true;
  const auto x = positions(particles);
  const double limit = 0.25 * skin_ * skin_ * (1.0 - 1e-9);  // beyond rounding: all within the support now was within reach then
  double greatest = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads_) reduction(max : greatest) if (particles.moving() > worth_threads)
  for (std::size_t i = 0; i < particles.moving(); ++i) {
    const Vec3 d = x.at(i) - built_[i];
    const double d2 = dot(d, d);
    greatest = std::max(greatest, std::isfinite(d2) ? d2 : 1e300);
  }
  return greatest > limit;
}

bool Neighbours::update(Particles& particles, double time, const std::function<Resting()>& resting) {
  if (!outdated(particles)) return false;
  rebuild(particles, time, resting ? resting() : Resting{});
  return true;
}

void Neighbours::rebuild_from(Particles& particles, std::span<const Vec3> build_positions, double time, long rebuilds) {
  const auto x = positions(particles);
  std::vector<Vec3> now(particles.size());  // by id, since the rebuild moves rows
  const auto id = particles[field::id];
  for (std::size_t i = 0; i < particles.size(); ++i) {
    now[static_cast<std::size_t>(id[i])] = x.at(i);
    x.set(i, build_positions[i]);
  }
  refuse_not_finite(particles, time, built_.size());
  sort_and_list(particles,
                {});  // not wrapped again: one a rounding error below the box was put on its upper edge, and stays there
  rebuilds_ = rebuilds;
  const auto sorted = positions(particles);
  for (std::size_t k = 0; k < now.size(); ++k) sorted.set(particles.row(k), now[k]);
}

/// Moves particles by whole box widths into the box, and counts them in `image`.
void Neighbours::wrap(Particles& particles) const {
  if (!box_.any()) return;
  const auto x = positions(particles);
  const auto image = images(particles);
  const std::array<std::span<double>, 3> r{x.x, x.y, x.z};
  const std::array<std::span<int>, 3> n{image.x, image.y, image.z};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!box_.periodic[a]) continue;
    for (std::size_t i = 0; i < particles.size(); ++i) {  // sleeping particles are within the box
      const double widths = std::floor((r[a][i] - box_.min[a]) / box_.width[a]);
      if (widths == 0.0) continue;
      r[a][i] -= widths * box_.width[a];
      n[a][i] += static_cast<int>(widths);
    }
  }
}

void Neighbours::rebuild(Particles& particles, double time, const Resting& resting) {
  if (particles.size() > Entry::row_mask) throw InputError("more than 2^26 particles");
  refuse_not_finite(particles, time, built_.size());
  wrap(particles);
  sort_and_list(particles, resting);
  ++rebuilds_;
}

void Neighbours::sort_and_list(Particles& particles, const Resting& resting) {
  const std::size_t n = particles.size(), moving = particles.moving();
  const auto x = positions(particles);
  Vec3 low = n ? x.at(0) : Vec3{}, high = low;
  const auto reach_to = [&](const Vec3& r) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], r[a]);
      high[a] = std::max(high[a], r[a]);
    }
  };
  for (std::size_t i = 0; i < moving; ++i) reach_to(x.at(i));
  if (moving < n) {
    for (std::size_t i = built_.size(); i < n; ++i) reach_to(x.at(i));
    reach_to(still_.low);
    reach_to(still_.high);
  }
  Grid grid = whole_ ? Grid::over(whole_->low, whole_->high, support_ + skin_, box_, whole_->particles)
                     : Grid::over(low, high, support_ + skin_, box_, n);
  if (whole_ && n > 0) grid.keep(low, high, box_);
  const bool same_cells = grid.origin == still_.origin && grid.width == still_.width,
             same_bodies = !resting.bodies.empty() && resting.bodies == still_.bodies;
  listed_all_ = !(still_.known && same_cells && same_bodies);
  if (listed_all_) {
    sort_all(particles, grid);
    still_.known = false;
    if (same_cells && same_bodies) learn_still(particles, grid, resting);
    still_.origin = grid.origin;
    still_.width = grid.width;
    still_.bodies = resting.bodies;
    ++whole_lists_;
  } else {
    sort_awake(particles, grid, resting);
  }
  marked_ = listed_sleeping_ = false;
  are_made_ = true;
  moving_ = particles.moving();
  form_clusters(particles, grid);
  if (asked_) return keep_to_ask(particles, std::move(grid));
  const auto sorted = positions(particles);
  const Places places{sorted.x.data(), sorted.y.data(), sorted.z.data()};
  pairs_ = list(places, grid, clusters_.listed, listed_by_[0]);
  if (!order_.empty()) list_fixed(particles, places, grid);
  count_still_pairs(particles);
  if (!order_.empty()) grid_ = std::make_shared<const Grid>(std::move(grid));
}

/// Counting sort by cell, and by id within each, or by the number in the whole.
void Neighbours::sort_all(Particles& particles, Grid& grid) {
  const std::size_t n = particles.size();
  const auto x = positions(particles);
  grid.first.assign(grid.cells() + 1, 0);
  std::vector<std::uint32_t> order(n), cell_of(n);
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t i = 0; i < n; ++i) cell_of[i] = static_cast<std::uint32_t>(grid.index(grid.place(x.at(i))));
  for (std::size_t i = 0; i < n; ++i) ++grid.first[cell_of[i] + 1];
  for (std::size_t c = 0; c < grid.cells(); ++c) grid.first[c + 1] += grid.first[c];
  std::vector<std::uint32_t> next(grid.first.begin(), grid.first.end() - 1);
  const auto id = particles[field::id];
  const auto number = [&](std::uint32_t row) { return whole_ ? whole_->numbers[static_cast<std::size_t>(id[row])] : id[row]; };
  for (std::uint32_t row = 0; row < n; ++row) {
    const std::uint32_t c = cell_of[row];
    std::uint32_t at = next[c]++;
    for (const int own = number(row); at > grid.first[c] && number(order[at - 1]) > own; --at) order[at] = order[at - 1];
    order[at] = row;  // a cell holds few, and most come in order
  }
  bring_own_first(particles, order);
  // Before columns are held twice.
  std::vector<std::uint32_t>().swap(cell_of);
  std::vector<std::uint32_t>().swap(next);
  particles.permute(order, threads_);
  std::vector<std::uint32_t>().swap(order);
  const auto sorted = positions(particles);
  built_.resize(n);
  for (std::size_t i = 0; i < n; ++i) built_[i] = sorted.at(i);
  order_.clear();
  meets_.clear();
  moving_first_.clear();
  row_blocks_.clear();
  grid_.reset();
}

/// In a shared scene the rows of this process's own particles come before the rows of copies, each in order of (cell, number). A
/// cluster then has members of one kind. Copies need no lists, because their owners form their sums.
/// @param order of each place the row that it was, and then of each row
void Neighbours::bring_own_first(const Particles& particles, std::vector<std::uint32_t>& order) {
  own_first_.clear();
  if (!whole_ || whole_->own == order.size()) return;
  const auto id = particles[field::id];
  auto own = std::uint32_t{0}, copy = static_cast<std::uint32_t>(whole_->own);
  std::vector<std::uint32_t> rows(order.size());
  for (const std::uint32_t was : order) {
    own_first_.push_back(static_cast<std::size_t>(id[was]) < whole_->own ? own++ : copy++);
    rows[own_first_.back()] = was;
  }
  order.swap(rows);
}

/// Clusters of moving particles, then of fixed ones. The first are those that have lists.
void Neighbours::form_clusters(const Particles& particles, const Grid& grid) {
  Clusters& c = clusters_;
  const std::size_t rows = order_.empty() ? particles.size() : order_.size();
  c.first.clear();
  c.listed.clear();
  c.unlisted.clear();
  c.on_demand.clear();
  strips_.clear();
  const std::size_t own = own_first_.empty() ? particles.moving() : whole_->own;
  add_clusters(grid, 0, own);
  add_clusters(grid, own, particles.moving());
  add_clusters(grid, particles.moving(), particles.awake());
  add_clusters(grid, particles.awake(), rows);
  c.first.push_back(static_cast<std::uint32_t>(rows));
  order_visits();
  c.start.assign(c.size() + 1, 0);
  c.own.clear();
  c.within.clear();
  c.acting.clear();
  for (std::uint32_t k = 0; k < c.size() && c.first[k] < own; ++k) c.listed.push_back(k);
}

/// Makes clusters of these rows. A cluster ends with a row of cells, so that its members have their neighbours in the same order.
/// It also ends where rows begin that can meet no moving particle.
void Neighbours::add_clusters(const Grid& grid, std::size_t from, std::size_t to) {
  if (from == to) return;
  Clusters& c = clusters_;
  const auto can_meet = [&](std::uint32_t row) { return meets_.empty() || meets_[row] != 0; };
  const auto along = static_cast<std::size_t>(grid.count[0]);
  for (std::size_t cell = 0; cell < grid.cells(); cell += along) {
    const std::uint32_t end = grid.first[cell + along];
    const auto strip = static_cast<std::uint32_t>(cell / along % static_cast<std::size_t>(grid.count[1]) / cells_a_strip);
    bool any = false;
    for (std::uint32_t place = grid.first[cell]; place < end; ++place) {
      const std::uint32_t row = rows_of_places().empty() ? place : rows_of_places()[place];
      if (row < from || row >= to) continue;
      const bool begins =
          !any || row - c.first.back() == static_cast<std::uint32_t>(c.lanes) || can_meet(row) != can_meet(row - 1);
      if (begins) {
        c.first.push_back(row);
        strips_.push_back(strip);
      }
      any = true;
    }
  }
}

/// Counting sort of clusters by strip.
void Neighbours::order_visits() {
  std::vector<std::uint32_t>& visits = clusters_.visits;
  visits.clear();
  if (strips_.size() < clusters_that_have_strips) return;
  std::vector<std::uint32_t> next(*std::ranges::max_element(strips_) + 2u, 0);
  for (const std::uint32_t strip : strips_) ++next[strip + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  visits.resize(strips_.size());
  for (std::uint32_t k = 0; k < strips_.size(); ++k) visits[next[strips_[k]]++] = k;
}

/// Lists some clusters, ascending, after the entries that there are. Each thread lists a run of clusters into its own buffer, as
/// large as at the last build and a little more. Where a buffer is too small, as at the first build, the lists are made again. So
/// entries are never held twice.
/// @param clusters those after the first have no list yet   @param listed_by entries of each thread, at the last build and here
/// @return directed pairs
std::size_t Neighbours::list(const Places& places, const Grid& grid, std::span<const std::uint32_t> clusters,
                             std::vector<std::size_t>& listed_by) {
  if (clusters.empty()) return 0;
  Clusters& c = clusters_;
  const std::size_t first = clusters.front(), kept = c.start[first];
  std::fill(c.start.begin() + static_cast<std::ptrdiff_t>(first) + 1, c.start.end(), 0);
  listed_by.resize(static_cast<std::size_t>(threads_));
  std::vector<std::size_t> rooms;  // first entry of each, and one past the last
  std::optional<std::size_t> pairs;
  do {
    rooms.assign(1, kept);
    for (const std::size_t entries : listed_by) rooms.push_back(rooms.back() + entries + entries / 32);
    fit(c.entries, rooms.back(), kept);
    fit(c.near, rooms.back(), kept);
  } while (!(pairs = list_into(places, grid, clusters, rooms, listed_by)));
  std::size_t end = kept;
  for (std::size_t part = 0; part < listed_by.size(); ++part) {
    const auto close = [&](auto& column) {
      const auto room = column.begin() + static_cast<std::ptrdiff_t>(rooms[part]);
      std::copy(room, room + static_cast<std::ptrdiff_t>(listed_by[part]), column.begin() + static_cast<std::ptrdiff_t>(end));
    };
    if (rooms[part] != end) {
      close(c.entries);
      close(c.near);
    }
    end += listed_by[part];
  }
  for (std::size_t k = first; k < c.size(); ++k) c.start[k + 1] += c.start[k];
  return *pairs;
}

namespace {

/// Ranges of places become ranges of rows, where each has rows one after the other. @return else false, and nothing changes
bool become_rows(const std::vector<std::uint32_t>& row_of, std::vector<CandidateRange>& ranges) {
  for (const CandidateRange& r : ranges)
    if (r.to > r.from && row_of[r.to - 1] - row_of[r.from] != r.to - 1 - r.from) return false;
  for (CandidateRange& r : ranges) {
    if (r.to == r.from) continue;
    const std::uint32_t first = row_of[r.from];
    r = {first, first + (r.to - r.from), r.image};
  }
  return true;
}

}  // namespace

/// Scans what may be near to a cluster.
Scanned Neighbours::scan_cluster(const Places& places, const Grid& grid, std::size_t cluster, Found& found) const {
  const std::uint32_t first = clusters_.first[cluster], past = clusters_.first[cluster + 1];
  const auto at = [&](std::size_t row) { return Vec3{places.x[row], places.y[row], places.z[row]}; };
  const double reach = support_ + skin_;
  Vec3 low = at(first), high = low;
  for (std::size_t i = first + 1; i < past; ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], at(i)[a]);
      high[a] = std::max(high[a], at(i)[a]);
    }
  }
  grid.candidates(low, high, reach, box_, found.ranges);
  std::size_t candidates = 0;
  for (const CandidateRange& r : found.ranges) candidates += r.to - r.from;
  if (found.entries.size() < candidates) {
    found.entries.resize(candidates);
    found.near.resize(candidates);
  }
  const bool by_rows = !own_first_.empty() && become_rows(own_first_, found.ranges);
  const unsigned members = (1u << (past - first)) - 1u;
  const Scan task{places.x,
                  places.y,
                  places.z,
                  first,
                  members,
                  found.ranges.data(),
                  found.ranges.size(),
                  shift_.data(),
                  reach * reach,
                  by_rows || rows_of_places().empty() ? nullptr : rows_of_places().data(),
                  moving_};
  return scan_(task, found.entries.data(), found.near.data());
}

/// @param rooms first entry of each thread's room, and one past the last   @return directed pairs; none where a thread has more
/// entries than room: they are counted all the same
std::optional<std::size_t> Neighbours::list_into(const Places& places, const Grid& grid, std::span<const std::uint32_t> clusters,
                                                 std::span<const std::size_t> rooms, std::vector<std::size_t>& listed_by) {
  Clusters& c = clusters_;
  const std::size_t parts = listed_by.size();
  const auto past = [&](std::size_t part) { return clusters.size() * part / parts; };
  std::size_t pairs = 0;
  bool fits = true;
#pragma omp parallel for schedule(static, 1) num_threads(threads_) reduction(+ : pairs) reduction(&& : fits)
  for (std::size_t part = 0; part < parts; ++part) {
    Found of_one;
    std::size_t size = 0;
    for (std::size_t n = past(part); n < past(part + 1); ++n) {
      const std::size_t k = clusters[n];
      const Scanned found = scan_cluster(places, grid, k, of_one);
      if (rooms[part] + size + found.entries <= rooms[part + 1]) {
        const auto to = static_cast<std::ptrdiff_t>(rooms[part] + size);
        std::copy_n(of_one.entries.begin(), found.entries, c.entries.begin() + to);
        std::copy_n(of_one.near.begin(), found.entries, c.near.begin() + to);
      }
      c.start[k + 1] = found.entries;
      size += found.entries;
      if (c.first[k] < moving_) pairs += found.pairs;
    }
    listed_by[part] = size;
    fits = fits && rooms[part] + size <= rooms[part + 1];
  }
  return fits ? std::optional(pairs) : std::nullopt;
}

void Neighbours::make_room_within() {
  if (clusters_.size() > 0) clusters_.within.resize(within_start(clusters_.start.back(), clusters_.size()));
}

namespace {

/// Marks the own pairs of one cluster, among its entries. @param id of each row
void mark_cluster(Clusters& c, std::size_t k, std::span<const int> id, const OwnPairs& own) {
  for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i) {
    if (own.of(static_cast<std::size_t>(id[i])).empty()) continue;
    const unsigned lane = i - c.first[k];
    for (std::size_t e = c.start[k]; e < c.start[k + 1]; ++e) {
      if ((c.near[e] >> lane & 1u) == 0) continue;
      const std::size_t j = Entry{c.entries[e]}.row();
      if (are_own(own, static_cast<std::uint32_t>(id[i]), static_cast<std::uint32_t>(id[j])))
        c.own[e] = static_cast<std::uint8_t>(c.own[e] | 1u << lane);
    }
  }
}

}  // namespace

void Neighbours::mark_own(const Particles& particles, const OwnPairs& own) {
  marked_ = true;
  if (asked_) {
    asked_->own = own;
    asked_->lists.clear();
    return;
  }
  Clusters& c = clusters_;
  const auto id = particles[field::id];
  const auto has_own = [&](std::size_t row) { return !own.of(static_cast<std::size_t>(id[row])).empty(); };
  bool any = false;
#pragma omp parallel for schedule(static) num_threads(threads_) reduction(|| : any)
  for (std::size_t i = 0; i < particles.awake(); ++i) any = any || has_own(i);
  c.own.assign(any ? c.start.back() : 0, 0);
  if (!any) return;
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t k = 0; k < c.size(); ++k) mark_cluster(c, k, id, own);
}

void Neighbours::keep_to_ask(const Particles& particles, Grid&& grid) {
  Asked& a = *asked_;
  const auto x = positions(particles);
  const auto copy = [&](std::span<const double> from, AlignedVector<double>& to) {
    to.assign(from.begin(), from.end());
    to.resize(from.size() + vector_bytes);  // readable a whole vector past the last
  };
  copy(x.x, a.x);
  copy(x.y, a.y);
  copy(x.z, a.z);
  const auto id = particles[field::id];
  a.id.assign(id.begin(), id.end());
  a.own = {};
  a.lists.clear();
  pairs_ = 0;
  grid_ = std::make_shared<const Grid>(std::move(grid));
}

const Clusters& Neighbours::asked_list(std::size_t row) const {
  const Asked& a = *asked_;
  const std::size_t k = clusters_.of(row);
  const auto [at, is_new] = a.lists.try_emplace(k);
  Clusters& one = at->second;
  if (!is_new) return one;
  Found found;
  const Scanned size = scan_cluster({a.x.data(), a.y.data(), a.z.data()}, *grid_, k, found);
  one.first = {clusters_.first[k], clusters_.first[k + 1]};
  one.start = {0, size.entries};
  one.entries.assign(found.entries.begin(), found.entries.begin() + static_cast<std::ptrdiff_t>(size.entries));
  one.near.assign(found.near.begin(), found.near.begin() + static_cast<std::ptrdiff_t>(size.entries));
  if (a.own.empty()) return one;
  one.own.assign(size.entries, 0);
  mark_cluster(one, 0, a.id, a.own);
  return one;
}

}  // namespace tripoint

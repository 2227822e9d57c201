// SPDX-License-Identifier: BSD-3-Clause
// Clusters of particles, and the lists of entries that each has.
#include <algorithm>
#include <numeric>

#include "particles/grid.hpp"
#include "particles/neighbours.hpp"

namespace tripoint {
namespace {

constexpr std::size_t cells_a_strip = 6;  ///< of 3 to 12, measured at 200,000 to 2,000,000 particles
/// A layer of fewer clusters stays in the cache as it is
constexpr std::size_t clusters_that_have_strips = 10'000;

/// Resizes without copying: the old values are lost, where none are to be kept. Untouched pages take no
/// memory.
template <class T>
void fit(std::vector<T>& column, std::size_t size, std::size_t kept) {
  if (kept == 0 && column.capacity() < size) {
    std::vector<T>().swap(column);
    column.reserve(size + size / 4);
  }
  column.resize(size);
}

}  // namespace

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

/// Makes clusters of these rows. A cluster ends with a row of cells, so that its members have their
/// neighbours in the same order. It also ends where rows begin that can meet no moving particle.
void Neighbours::add_clusters(const Grid& grid, std::size_t from, std::size_t to) {
  if (from == to) return;
  Clusters& c = clusters_;
  const auto can_meet = [&](std::uint32_t row) { return meets_.empty() || meets_[row] != 0; };
  const auto along = static_cast<std::size_t>(grid.count[0]);
  for (std::size_t cell = 0; cell < grid.cells(); cell += along) {
    const std::uint32_t end = grid.first[cell + along];
    const auto strip =
        static_cast<std::uint32_t>(cell / along % static_cast<std::size_t>(grid.count[1]) / cells_a_strip);
    bool any = false;
    for (std::uint32_t place = grid.first[cell]; place < end; ++place) {
      const std::uint32_t row = rows_of_places().empty() ? place : rows_of_places()[place];
      if (row < from || row >= to) continue;
      const bool begins = !any || row - c.first.back() == static_cast<std::uint32_t>(c.lanes) ||
                          can_meet(row) != can_meet(row - 1);
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

/// Lists some clusters, ascending, after the entries that there are. Each thread lists a run of clusters into
/// its own buffer, as large as at the last build and a little more. Where a buffer is too small, as at the
/// first build, the lists are made again. So entries are never held twice.
/// @param clusters those after the first have no list yet   @param listed_by entries of each thread, at the
/// last build and here
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
      std::copy(room, room + static_cast<std::ptrdiff_t>(listed_by[part]),
                column.begin() + static_cast<std::ptrdiff_t>(end));
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

/// Ranges of places become ranges of rows, where each has rows one after the other. @return else false, and
/// nothing changes
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
Scanned Neighbours::scan_cluster(const Places& places, const Grid& grid, std::size_t cluster,
                                 Found& found) const {
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

/// @param rooms first entry of each thread's room, and one past the last   @return directed pairs; none where
/// a thread has more entries than room: they are counted all the same
std::optional<std::size_t> Neighbours::list_into(const Places& places, const Grid& grid,
                                                 std::span<const std::uint32_t> clusters,
                                                 std::span<const std::size_t> rooms,
                                                 std::vector<std::size_t>& listed_by) {
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

/// Marks the excluded pairs of one cluster, among its entries. @param id of each row
void mark_cluster(Clusters& c, std::size_t k, std::span<const int> id, const ExcludedPairs& own) {
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

void Neighbours::mark_own(const Particles& particles, const ExcludedPairs& own) {
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
  one.entries.assign(found.entries.begin(),
                     found.entries.begin() + static_cast<std::ptrdiff_t>(size.entries));
  one.near.assign(found.near.begin(), found.near.begin() + static_cast<std::ptrdiff_t>(size.entries));
  if (a.own.empty()) return one;
  one.own.assign(size.entries, 0);
  mark_cluster(one, 0, a.id, a.own);
  return one;
}

}  // namespace tripoint

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
constexpr std::size_t rows_a_block = 1024;

/// @param listed rows that the last lists knew: of these, what sleeps is where it was
void refuse_not_finite(const Particles& particles, double time, std::size_t listed) {
  const auto x = positions(particles);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (i == particles.awake() && i < listed) i = listed;
    if (i == particles.size()) return;
    if (finite(x.at(i)) && norm(x.at(i)) <= 1e100) continue;
    throw Diverged(particles[field::id][i], particles[field::body][i], "position", "drift", time, "a position is not finite");
  }
}

/// Resizes without copying: the old values are lost. Untouched pages take no memory.
template <class T>
void fit(std::vector<T>& column, std::size_t size) {
  if (column.capacity() < size) {
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

bool Neighbours::outdated(const Particles& particles) const {
  if (!are_made_ || built_.size() != particles.size() || rebuilds_ == 0) return true;
  const auto x = positions(particles);
  const double limit =
      0.25 * skin_ * skin_ * (1.0 - 1e-9);  // beyond rounding: what is within the support now was within reach then
  double greatest = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads_) reduction(max : greatest) if (particles.awake() > worth_threads)
  for (std::size_t i = 0; i < particles.awake(); ++i) {
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
    for (std::size_t i = 0; i < particles.size(); ++i) {  // what sleeps is within the box
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
  const std::size_t n = particles.size(), sleeping_from = particles.awake() < n ? particles.awake() : n;
  const auto x = positions(particles);
  Vec3 low = n ? x.at(0) : Vec3{}, high = low;
  const auto reach_to = [&](const Vec3& r) {
    for (std::size_t a = 0; a < 3; ++a) low[a] = std::min(low[a], r[a]), high[a] = std::max(high[a], r[a]);
  };
  for (std::size_t i = 0; i < sleeping_from; ++i) reach_to(x.at(i));
  if (sleeping_from < n) {
    for (std::size_t i = built_.size(); i < n; ++i) reach_to(x.at(i));
    reach_to(still_.low), reach_to(still_.high);
  }
  Grid grid = Grid::over(low, high, support_ + skin_, box_, n);
  const bool same_cells = grid.origin == still_.origin && grid.width == still_.width,
             same_bodies = !resting.bodies.empty() && resting.bodies == still_.bodies;
  listed_all_ = !(still_.known && same_cells && same_bodies);
  if (listed_all_) {
    sort_all(particles, grid);
    still_.known = false;
    if (same_cells && same_bodies) learn_still(particles, grid, resting);
    still_.origin = grid.origin, still_.width = grid.width, still_.bodies = resting.bodies;
    ++whole_lists_;
  } else {
    sort_awake(particles, grid, resting);
  }
  marked_ = false, are_made_ = true;
  form_clusters(grid, particles.awake());
  list(particles, grid);
  count_still_pairs(particles);
}

/// Counting sort by cell of the particles in order of id: rows come out ordered by (cell, id).
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
  for (std::size_t id = 0; id < n; ++id) {
    const auto row = static_cast<std::uint32_t>(particles.row(id));
    order[next[cell_of[row]]++] = row;
  }
  std::vector<std::uint32_t>().swap(cell_of), std::vector<std::uint32_t>().swap(next);  // before columns are held twice
  particles.permute(order, threads_);
  std::vector<std::uint32_t>().swap(order);
  const auto sorted = positions(particles);
  built_.resize(n);
  for (std::size_t i = 0; i < n; ++i) built_[i] = sorted.at(i);
  kinds_.clear(), gaps_.clear(), row_blocks_.clear();
  for (std::size_t i = 0; i < n; i += rows_a_block) row_blocks_.push_back(static_cast<std::uint32_t>(i));
  row_blocks_.push_back(static_cast<std::uint32_t>(n));
}

/// Which particles can sleep, and in which stretches they lie. All rows are sorted.
void Neighbours::learn_still(const Particles& particles, const Grid& grid, const Resting& resting) {
  const auto x = positions(particles);
  const auto body = particles[field::body], id = particles[field::id];
  still_.id.clear(), still_.place.assign(particles.size(), ~std::uint32_t{0});
  std::vector<std::array<int, 3>> stretch;
  still_.count = {1, 1, 1};
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (body[i] < 0 || !resting.bodies[static_cast<std::size_t>(body[i])]) continue;
    if (still_.id.empty()) still_.low = still_.high = x.at(i);
    for (std::size_t a = 0; a < 3; ++a)
      still_.low[a] = std::min(still_.low[a], x.at(i)[a]), still_.high[a] = std::max(still_.high[a], x.at(i)[a]);
    still_.place[static_cast<std::size_t>(id[i])] = static_cast<std::uint32_t>(still_.id.size());
    still_.id.push_back(static_cast<std::uint32_t>(id[i]));
    stretch.push_back(Grid::stretch(grid.place(x.at(i))));
    for (std::size_t a = 0; a < 3; ++a) still_.count[a] = std::max(still_.count[a], stretch.back()[a] + 1);
  }
  for (std::size_t a = 0; a < 3; ++a)
    if (box_.periodic[a])
      still_.count[a] =
          std::max(still_.count[a], Grid::stretch({grid.count[0] - 1, grid.count[1] - 1, grid.count[2] - 1})[a] + 1);
  still_.first.assign(static_cast<std::size_t>(still_.count[0]) * still_.count[1] * still_.count[2] + 1, 0);
  for (const auto& s : stretch) ++still_.first[still_.index(s) + 1];
  for (std::size_t s = 0; s + 1 < still_.first.size(); ++s) still_.first[s + 1] += still_.first[s];
  still_.known = !still_.id.empty();
}

/// Of marks on stretches, those that hold what is within a distance of what they hold, and some more: a box around each.
std::vector<char> Neighbours::within(std::vector<char> marks, double distance) const {
  const std::array<int, 3>& n = still_.count;
  const std::array<std::size_t, 3> step{1, static_cast<std::size_t>(n[0]), static_cast<std::size_t>(n[0]) * n[1]};
  for (std::size_t a = 0; a < 3; ++a) {
    const double wide = still_.width[a] * (a == 0 ? Grid::cells_a_stretch : 1);
    const int far = static_cast<int>(std::ceil(distance / wide * (1.0 - Grid::slack))) +
                    (box_.periodic[a] ? 1 : 0);  // the last stretch of a period may be short
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    std::vector<char> line(static_cast<std::size_t>(n[a]));
    for (int j = 0; j < n[b]; ++j) {
      for (int k = 0; k < n[c]; ++k) {
        const std::size_t from = static_cast<std::size_t>(j) * step[b] + static_cast<std::size_t>(k) * step[c];
        const auto spread = [&](bool forward) {
          int since = far + 1;
          const int turns = box_.periodic[a] ? 2 : 1;  // twice around, so that marks reach across the boundary
          for (int at = 0; at < turns * n[a]; ++at) {
            const int m = forward ? at % n[a] : n[a] - 1 - at % n[a];
            since = marks[from + static_cast<std::size_t>(m) * step[a]] != 0 ? 0 : since + 1;
            if (since <= far) line[static_cast<std::size_t>(m)] = 1;
          }
        };
        std::ranges::fill(line, char{0});
        spread(true), spread(false);
        for (int m = 0; m < n[a]; ++m) marks[from + static_cast<std::size_t>(m) * step[a]] = line[static_cast<std::size_t>(m)];
      }
    }
  }
  return marks;
}

/// Rows of what is awake first, ordered by (cell, id) as they would be among all; then what sleeps, most of it where it was.
void Neighbours::sort_awake(Particles& particles, Grid& grid, const Resting& resting) {
  const std::size_t n = particles.size();
  const auto x = positions(particles);
  const auto body = particles[field::body], id = particles[field::id];
  still_.place.resize(n, ~std::uint32_t{0});  // what has flowed in moves
  std::vector<std::uint32_t> rows;
  std::vector<char> moving(still_.first.size() - 1, 0);
  const auto wake = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      if (body[i] >= 0 && resting.bodies[static_cast<std::size_t>(body[i])]) continue;
      rows.push_back(static_cast<std::uint32_t>(i));
      std::array<int, 3> s = Grid::stretch(grid.place(x.at(i)));
      for (std::size_t a = 0; a < 3; ++a) s[a] = std::min(s[a], still_.count[a] - 1);
      moving[still_.index(s)] = 1;
    }
  };
  wake(0, particles.awake());
  if (particles.awake() < n) wake(built_.size(), n);
  const std::vector<char> meets = within(moving, support_ + skin_),
                          awake = within(meets, std::max(resting.around, support_ + skin_));
  std::vector<RowKind> kind(rows.size(), RowKind::moves);
  for (std::size_t s = 0; s < awake.size(); ++s) {
    if (!awake[s]) continue;
    for (std::size_t k = still_.first[s]; k < still_.first[s + 1]; ++k) {
      rows.push_back(static_cast<std::uint32_t>(particles.row(still_.id[k])));
      kind.push_back(meets[s] ? RowKind::still : RowKind::meets_nothing);
    }
  }

  const std::size_t m = rows.size();
  grid.first.assign(grid.cells() + 1, 0);
  std::vector<std::uint32_t> cell_of(m), order(m), place(m);
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t k = 0; k < m; ++k) cell_of[k] = static_cast<std::uint32_t>(grid.index(grid.place(x.at(rows[k]))));
  for (const std::uint32_t c : cell_of) ++grid.first[c + 1];
  for (std::size_t c = 0; c < grid.cells(); ++c) grid.first[c + 1] += grid.first[c];
  std::vector<std::uint32_t> next(grid.first.begin(), grid.first.end() - 1);
  for (std::uint32_t k = 0; k < m; ++k) {
    const std::uint32_t c = cell_of[k];
    std::uint32_t at = next[c]++;
    for (; at > grid.first[c] && id[rows[place[at - 1]]] > id[rows[k]]; --at) place[at] = place[at - 1];  // a cell holds few
    place[at] = k;
  }
  kinds_.resize(m);
  for (std::size_t k = 0; k < m; ++k) order[k] = rows[place[k]], kinds_[k] = kind[place[k]];

  // What falls asleep goes to the rows of what wakes.
  const std::size_t top = std::max(particles.awake() < n ? particles.awake() : n, m);
  std::vector<char> taken(n, 0);
  for (const std::uint32_t row : order) taken[row] = 1;
  std::vector<std::uint32_t> from = order, to(m);
  for (std::uint32_t k = 0; k < m; ++k) to[k] = k;
  for (std::uint32_t row = 0; row < top; ++row)
    if (!taken[row]) from.push_back(row);
  for (std::size_t row = m; row < n && to.size() < from.size(); ++row)
    if (row < top || taken[row]) to.push_back(static_cast<std::uint32_t>(row));
  particles.rearrange(from, to, m, threads_);
  const auto sorted = positions(particles);
  built_.resize(n);
  for (const std::uint32_t row : to) built_[row] = sorted.at(row);
  find_blocks(grid, awake, n);
}

void Neighbours::find_blocks(const Grid& grid, std::span<const char> awake, std::size_t particles) {
  gaps_.clear(), row_blocks_.clear();
  std::size_t asleep = 0, next = 0;  // before the row that is looked at; of all rows, the first of the next block
  const auto pass = [&](std::size_t before) {
    for (; next < before + asleep; next += rows_a_block) row_blocks_.push_back(static_cast<std::uint32_t>(next - asleep));
  };
  std::uint32_t s = 0;
  for (int z = 0; z < still_.count[2]; ++z) {
    for (int y = 0; y < still_.count[1]; ++y) {
      for (int k = 0; k < still_.count[0]; ++k, ++s) {
        const std::uint32_t here = still_.first[s + 1] - still_.first[s];
        if (awake[s] || here == 0) continue;
        const std::uint32_t before = grid.first[grid.index({k * Grid::cells_a_stretch, y, z})];
        pass(before);
        gaps_.push_back({before, s});
        asleep += here;
        for (; next < before + asleep; next += rows_a_block) row_blocks_.push_back(before);
      }
    }
  }
  pass(particles - asleep);
  row_blocks_.push_back(static_cast<std::uint32_t>(particles - asleep));
}

std::vector<std::uint32_t> Neighbours::rows_in_order(const Particles& particles) const {
  std::vector<std::uint32_t> rows;
  std::uint32_t at = 0;
  const auto up_to = [&](std::size_t row) {
    while (at < row) rows.push_back(at++);
  };
  for (const Gap& g : gaps_) {
    up_to(g.before);
    for (std::size_t k = still_.first[g.stretch]; k < still_.first[g.stretch + 1]; ++k)
      rows.push_back(static_cast<std::uint32_t>(particles.row(still_.id[k])));
  }
  up_to(particles.awake());
  return rows;
}

/// Pairs of what has no list are counted all the same: they are between fixed particles, and known.
void Neighbours::count_still_pairs(const Particles& particles) {
  if (listed_all_ && !still_.known) return;
  const Clusters& c = clusters_;
  const auto id = particles[field::id];
  const auto place = [&](std::size_t row) { return still_.place[static_cast<std::size_t>(id[row])]; };
  constexpr std::uint32_t moves = ~std::uint32_t{0};
  if (listed_all_) {
    still_.pairs.assign(still_.id.size(), 0);
#pragma omp parallel for schedule(static) num_threads(threads_)
    for (std::size_t k = 0; k < c.size(); ++k)
      for (std::size_t e = c.start[k]; e < c.start[k + 1]; ++e) {
        if (place(Entry{c.entries[e]}.row()) == moves) continue;
        for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i)
          if (place(i) != moves) still_.pairs[place(i)] += c.near[e] >> (i - c.first[k]) & 1u;
      }
    still_.all_pairs = std::accumulate(still_.pairs.begin(), still_.pairs.end(), std::size_t{0});
    return;
  }
  std::size_t listed = 0;
  for (const std::uint32_t k : c.listed)
    for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i)
      if (place(i) != moves) listed += still_.pairs[place(i)];
  pairs_ += still_.all_pairs - listed;
}

/// Clusters end with a row of cells, so that what is near to their members has the same order for each of them, and where rows
/// begin that need no list.
void Neighbours::form_clusters(const Grid& grid, std::size_t rows) {
  Clusters& c = clusters_;
  c.first.clear();
  const auto has_list = [&](std::size_t row) { return kinds_.empty() || kinds_[row] != RowKind::meets_nothing; };
  const auto along = static_cast<std::size_t>(grid.count[0]);
  for (std::size_t cell = 0; cell < grid.cells(); cell += along) {
    const std::uint32_t end = grid.first[cell + along];
    for (std::uint32_t i = grid.first[cell], from = end; i < end; ++i) {
      const bool begins =
          from == end || i - from == static_cast<std::uint32_t>(c.lanes) || (!kinds_.empty() && has_list(i) != has_list(i - 1));
      if (begins) from = i, c.first.push_back(i);
    }
  }
  c.first.push_back(static_cast<std::uint32_t>(rows));
  c.listed.clear(), c.unlisted.clear();
  for (std::uint32_t k = 0; k < c.size(); ++k) {
    (has_list(c.first[k]) ? c.listed : c.unlisted).push_back(k);
  }
}

/// Each thread lists a run of clusters into a room of its own, as large as at the last build and a little more; where that is too
/// small, as at the first, the lists are made again. So they are never held twice.
void Neighbours::list(const Particles& particles, const Grid& grid) {
  Clusters& c = clusters_;
  c.start.assign(c.size() + 1, 0);
  c.own.clear(), c.within.clear(), c.acting.clear();
  listed_by_.resize(static_cast<std::size_t>(threads_));
  std::vector<std::size_t> rooms;
  do {
    rooms.clear();
    for (const std::size_t entries : listed_by_) rooms.push_back(entries + entries / 32);
    const std::size_t all = std::accumulate(rooms.begin(), rooms.end(), std::size_t{0});
    fit(c.entries, all), fit(c.near, all);
  } while (!list_into(particles, grid, rooms));
  std::size_t end = 0, room = 0;
  for (std::size_t part = 0; part < rooms.size(); ++part) {
    const auto close = [&](auto& column) {
      const auto first = column.begin() + static_cast<std::ptrdiff_t>(room);
      std::copy(first, first + static_cast<std::ptrdiff_t>(listed_by_[part]), column.begin() + static_cast<std::ptrdiff_t>(end));
    };
    if (room != end) close(c.entries), close(c.near);
    end += listed_by_[part], room += rooms[part];
  }
  for (std::size_t k = 0; k < c.size(); ++k) c.start[k + 1] += c.start[k];
}

/// @param rooms entries that each thread has room for, one after the other   @return false where one has more: they are counted
/// all the same
bool Neighbours::list_into(const Particles& particles, const Grid& grid, std::span<const std::size_t> rooms) {
  Clusters& c = clusters_;
  const auto x = positions(particles);
  const double reach = support_ + skin_;
  const auto past = [&](std::size_t part) { return c.listed.size() * part / rooms.size(); };
  std::size_t pairs = 0;
  bool fits = true;
#pragma omp parallel for schedule(static, 1) num_threads(threads_) reduction(+ : pairs) reduction(&& : fits)
  for (std::size_t part = 0; part < rooms.size(); ++part) {
    const std::size_t first = std::accumulate(rooms.begin(), rooms.begin() + static_cast<std::ptrdiff_t>(part), std::size_t{0});
    std::vector<std::uint32_t> entries;  // of one cluster
    std::vector<std::uint8_t> near;
    std::vector<CandidateRange> ranges;
    std::size_t size = 0;
    for (std::size_t n = past(part); n < past(part + 1); ++n) {
      const std::size_t k = c.listed[n];
      Vec3 low = x.at(c.first[k]), high = low;
      for (std::size_t i = c.first[k] + 1; i < c.first[k + 1]; ++i) {
        for (std::size_t a = 0; a < 3; ++a) low[a] = std::min(low[a], x.at(i)[a]), high[a] = std::max(high[a], x.at(i)[a]);
      }
      grid.candidates(low, high, reach, box_, ranges);
      std::size_t candidates = 0;
      for (const CandidateRange& r : ranges) candidates += r.to - r.from;
      if (entries.size() < candidates) entries.resize(candidates), near.resize(candidates);
      const unsigned members = (1u << (c.first[k + 1] - c.first[k])) - 1u;
      const Scan task{x.x.data(),    x.y.data(),    x.z.data(),    c.first[k],   members,
                      ranges.data(), ranges.size(), shift_.data(), reach * reach};
      const Scanned found = scan_(task, entries.data(), near.data());
      if (size + found.entries <= rooms[part]) {
        const auto to = static_cast<std::ptrdiff_t>(first + size);
        std::copy_n(entries.begin(), found.entries, c.entries.begin() + to),
            std::copy_n(near.begin(), found.entries, c.near.begin() + to);
      }
      c.start[k + 1] = found.entries;
      size += found.entries, pairs += found.pairs;
    }
    listed_by_[part] = size;
    fits = fits && size <= rooms[part];
  }
  pairs_ = pairs;
  return fits;
}

void Neighbours::make_room_within() {
  if (clusters_.size() > 0) clusters_.within.resize(within_start(clusters_.start.back(), clusters_.size()));
}

void Neighbours::mark_own(const Particles& particles, const OwnPairs& own) {
  marked_ = true;
  Clusters& c = clusters_;
  const auto id = particles[field::id];
  const auto has_own = [&](std::size_t row) { return !own.of(static_cast<std::size_t>(id[row])).empty(); };
  bool any = false;
#pragma omp parallel for schedule(static) num_threads(threads_) reduction(|| : any)
  for (std::size_t i = 0; i < particles.awake(); ++i) any = any || has_own(i);
  c.own.assign(any ? c.start.back() : 0, 0);
  if (!any) return;
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t k = 0; k < c.size(); ++k) {
    for (std::uint32_t i = c.first[k]; i < c.first[k + 1]; ++i) {
      if (!has_own(i)) continue;
      const unsigned lane = i - c.first[k];
      for (std::size_t e = c.start[k]; e < c.start[k + 1]; ++e) {
        if ((c.near[e] >> lane & 1u) == 0) continue;
        const std::size_t j = Entry{c.entries[e]}.row();
        if (are_own(own, static_cast<std::uint32_t>(id[i]), static_cast<std::uint32_t>(id[j])))
          c.own[e] = static_cast<std::uint8_t>(c.own[e] | 1u << lane);
      }
    }
  }
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "particles/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/defect.hpp"
#include "core/errors.hpp"
#include "core/machine.hpp"

namespace tripoint {
namespace {

const char* const axis_names[] = {"x", "y", "z"};

/// Whether this build drops pairs across a periodic boundary (a defect of the self-test).
bool drops_periodic_pairs() {
  static const bool drops = defect_size("neighbours.seam") > 0.0;
  return drops;
}

void refuse_not_finite(const Particles& particles, double time) {
  const auto x = positions(particles);
  for (std::size_t i = 0; i < particles.size(); ++i) {
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

/// Cells finer than the list's reach, most of all in x, which runs fastest: as measured, so that the particles of a cluster are
/// near to each other and what is near to them is few whole rows of cells.
struct Neighbours::Grid {
  static constexpr std::array<double, 3> cells_a_reach{6.0, 1.5, 1.5};
  static constexpr double slack = 1e-9;  ///< of the reach, far above the rounding of cell numbers

  std::array<int, 3> count{1, 1, 1};
  Vec3 origin, width;
  std::vector<std::uint32_t> first;  // row that starts each cell, one more at the end

  [[nodiscard]] std::size_t index(const std::array<int, 3>& c) const {
    return static_cast<std::size_t>(c[0]) + static_cast<std::size_t>(count[0]) * (static_cast<std::size_t>(c[1]) + static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(c[2]));
  }
  [[nodiscard]] std::size_t cells() const { return static_cast<std::size_t>(count[0]) * count[1] * count[2]; }
  [[nodiscard]] std::array<int, 3> place(const Vec3& r) const {
    std::array<int, 3> c{};
    for (std::size_t a = 0; a < 3; ++a) c[a] = std::clamp(static_cast<int>((r[a] - origin[a]) / width[a]), 0, count[a] - 1);
    return c;
  }

  /// @param low, high corners of all positions   @param reach of a list
  static Grid over(const Vec3& low, const Vec3& high, double reach, const PeriodicBox& box, std::size_t particles) {
    Grid g;
    // A particle far away must not ask for a mountain of empty cells: then all become wider.
    const double most_cells = 16.0 * static_cast<double>(particles) + 1024.0;
    for (double scale = 1.0;; scale *= 2.0) {
      double cells = 1.0;
      for (std::size_t a = 0; a < 3; ++a) {
        const double least = scale * reach / cells_a_reach[a];
        const double extent = box.periodic[a] ? box.width[a] : std::max(high[a] - low[a], 0.0);
        const double n = std::max(1.0, std::floor(extent / least) + (box.periodic[a] ? 0.0 : 1.0));
        g.origin[a] = box.periodic[a] ? box.min[a] : low[a];
        g.width[a] = box.periodic[a] ? extent / n : least;
        g.count[a] = static_cast<int>(std::min(n, 1e9));
        cells *= n;
      }
      if (cells <= most_cells) return g;
    }
  }

  /// Numbers of the cells that [low, high] along an axis touches; beyond 0..count-1 in periodic directions, where they mean images.
  [[nodiscard]] std::array<int, 2> touched(std::size_t a, double low, double high, bool periodic) const {
    const double from = std::floor((low - origin[a]) / width[a]), to = std::floor((high - origin[a]) / width[a]);
    const double least = periodic ? -count[a] : 0.0, most = periodic ? 2.0 * count[a] - 1.0 : count[a] - 1.0;
    return {static_cast<int>(std::clamp(from, least, most)), static_cast<int>(std::clamp(to, least, most))};
  }
  [[nodiscard]] int image(std::size_t a, int cell) const { return cell < 0 ? -1 : cell >= count[a] ? 1 : 0; }
  /// Distance of an interval to a cell along an axis; 0 where they touch.
  [[nodiscard]] double gap(std::size_t a, int cell, double low, double high) const {
    const double begin = origin[a] + cell * width[a], end = begin + width[a];
    return std::max({0.0, begin - high, low - end});
  }

  /// The rows of cells within reach of a box, in the order of cells.
  void candidates(const Vec3& low, const Vec3& high, double reach, const PeriodicBox& box, std::vector<CandidateRange>& ranges) const {
    ranges.clear();
    const double wide = reach * (1.0 + slack);
    const auto zs = touched(2, low.z - wide, high.z + wide, box.periodic[2]), ys = touched(1, low.y - wide, high.y + wide, box.periodic[1]);
    for (int z = zs[0]; z <= zs[1]; ++z) {
      const double dz = gap(2, z, low.z, high.z);
      for (int y = ys[0]; y <= ys[1]; ++y) {
        const double dy = gap(1, y, low.y, high.y), left = wide * wide - dy * dy - dz * dz;
        if (left < 0.0) continue;
        const double along = std::sqrt(left);
        const auto xs = touched(0, low.x - along, high.x + along, box.periodic[0]);
        add_row(xs, y, z, ranges);
      }
    }
  }

 private:
  void add_row(const std::array<int, 2>& xs, int y, int z, std::vector<CandidateRange>& ranges) const {
    const int iy = image(1, y), iz = image(2, z);
    for (int ix = image(0, xs[0]); ix <= image(0, xs[1]); ++ix) {
      const int from = std::max(xs[0] - ix * count[0], 0), to = std::min(xs[1] - ix * count[0], count[0] - 1);
      const std::array<int, 3> start{from, y - iy * count[1], z - iz * count[2]}, end{to, start[1], start[2]};
      const std::uint32_t first_row = first[index(start)], past = first[index(end) + 1];
      if (first_row != past) ranges.push_back({first_row, past, Entry::box_itself + static_cast<std::uint32_t>(ix + 3 * iy + 9 * iz)});
    }
  }
};

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
  if (built_.size() != particles.size() || rebuilds_ == 0) return true;
  const auto x = positions(particles);
  const double limit = 0.25 * skin_ * skin_ * (1.0 - 1e-9);  // beyond rounding: what is within the support now was within reach then
  double greatest = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads_) reduction(max : greatest) if (particles.size() > worth_threads)
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vec3 d = x.at(i) - built_[i];
    const double d2 = dot(d, d);
    greatest = std::max(greatest, std::isfinite(d2) ? d2 : 1e300);
  }
  return greatest > limit;
}

bool Neighbours::update(Particles& particles, double time) {
  if (!outdated(particles)) return false;
  rebuild(particles, time);
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
  refuse_not_finite(particles, time);
  sort_and_list(particles);  // not wrapped again: one a rounding error below the box was put on its upper edge, and stays there
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
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const double widths = std::floor((r[a][i] - box_.min[a]) / box_.width[a]);
      if (widths == 0.0) continue;
      r[a][i] -= widths * box_.width[a];
      n[a][i] += static_cast<int>(widths);
    }
  }
}

void Neighbours::rebuild(Particles& particles, double time) {
  if (particles.size() > Entry::row_mask) throw InputError("more than 2^26 particles");
  refuse_not_finite(particles, time);
  wrap(particles);
  sort_and_list(particles);
  ++rebuilds_;
}

void Neighbours::sort_and_list(Particles& particles) {
  const std::size_t n = particles.size();
  const auto x = positions(particles);
  Vec3 low = n ? x.at(0) : Vec3{}, high = low;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], x.at(i)[a]);
      high[a] = std::max(high[a], x.at(i)[a]);
    }
  }
  Grid grid = Grid::over(low, high, support_ + skin_, box_, n);

  // Counting sort by cell of the particles in order of id: rows come out ordered by (cell, id).
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
  marked_ = false;

  const auto sorted = positions(particles);
  built_.resize(n);
  for (std::size_t i = 0; i < n; ++i) built_[i] = sorted.at(i);
  form_clusters(grid);
  list(particles, grid);
}

/// Clusters end with a row of cells, so that what is near to their members has the same order for each of them.
void Neighbours::form_clusters(const Grid& grid) {
  Clusters& c = clusters_;
  c.first.clear();
  const auto along = static_cast<std::size_t>(grid.count[0]);
  for (std::size_t cell = 0; cell < grid.cells(); cell += along) {
    const std::uint32_t end = grid.first[cell + along];
    for (std::uint32_t i = grid.first[cell]; i < end; i += static_cast<std::uint32_t>(c.lanes)) c.first.push_back(i);
  }
  c.first.push_back(static_cast<std::uint32_t>(built_.size()));
}

/// Each thread lists a run of clusters into a room of its own, as large as at the last build and a little more; where that is too
/// small, as at the first, the lists are made again. So they are never held twice.
void Neighbours::list(const Particles& particles, const Grid& grid) {
  Clusters& c = clusters_;
  c.start.assign(c.size() + 1, 0);
  c.own.clear(), c.within.clear(), c.acting.clear();
  listed_.resize(static_cast<std::size_t>(threads_));
  std::vector<std::size_t> rooms;
  do {
    rooms.clear();
    for (const std::size_t entries : listed_) rooms.push_back(entries + entries / 32);
    const std::size_t all = std::accumulate(rooms.begin(), rooms.end(), std::size_t{0});
    fit(c.entries, all), fit(c.near, all);
  } while (!list_into(particles, grid, rooms));
  std::size_t end = 0, room = 0;
  for (std::size_t part = 0; part < rooms.size(); ++part) {
    const auto close = [&](auto& column) {
      const auto first = column.begin() + static_cast<std::ptrdiff_t>(room);
      std::copy(first, first + static_cast<std::ptrdiff_t>(listed_[part]), column.begin() + static_cast<std::ptrdiff_t>(end));
    };
    if (room != end) close(c.entries), close(c.near);
    end += listed_[part], room += rooms[part];
  }
  for (std::size_t k = 0; k < c.size(); ++k) c.start[k + 1] += c.start[k];
}

/// @param rooms entries that each thread has room for, one after the other   @return false where one has more: they are counted all the same
bool Neighbours::list_into(const Particles& particles, const Grid& grid, std::span<const std::size_t> rooms) {
  Clusters& c = clusters_;
  const auto x = positions(particles);
  const double reach = support_ + skin_;
  const auto past = [&](std::size_t part) { return c.size() * part / rooms.size(); };
  std::size_t pairs = 0;
  bool fits = true;
#pragma omp parallel for schedule(static, 1) num_threads(threads_) reduction(+ : pairs) reduction(&& : fits)
  for (std::size_t part = 0; part < rooms.size(); ++part) {
    const std::size_t first = std::accumulate(rooms.begin(), rooms.begin() + static_cast<std::ptrdiff_t>(part), std::size_t{0});
    std::vector<std::uint32_t> entries;  // of one cluster
    std::vector<std::uint8_t> near;
    std::vector<CandidateRange> ranges;
    std::size_t size = 0;
    for (std::size_t k = past(part); k < past(part + 1); ++k) {
      Vec3 low = x.at(c.first[k]), high = low;
      for (std::size_t i = c.first[k] + 1; i < c.first[k + 1]; ++i) {
        for (std::size_t a = 0; a < 3; ++a) low[a] = std::min(low[a], x.at(i)[a]), high[a] = std::max(high[a], x.at(i)[a]);
      }
      grid.candidates(low, high, reach, box_, ranges);
      if (drops_periodic_pairs()) std::erase_if(ranges, [](const CandidateRange& r) { return r.image != Entry::box_itself; });
      std::size_t candidates = 0;
      for (const CandidateRange& r : ranges) candidates += r.to - r.from;
      if (entries.size() < candidates) entries.resize(candidates), near.resize(candidates);
      const unsigned members = (1u << (c.first[k + 1] - c.first[k])) - 1u;
      const Scan task{x.x.data(), x.y.data(), x.z.data(), c.first[k], members, ranges.data(), ranges.size(), shift_.data(), reach * reach};
      const Scanned found = scan_(task, entries.data(), near.data());
      if (size + found.entries <= rooms[part]) {
        const auto to = static_cast<std::ptrdiff_t>(first + size);
        std::copy_n(entries.begin(), found.entries, c.entries.begin() + to), std::copy_n(near.begin(), found.entries, c.near.begin() + to);
      }
      c.start[k + 1] = found.entries;
      size += found.entries, pairs += found.pairs;
    }
    listed_[part] = size;
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
  for (std::size_t i = 0; i < particles.size(); ++i) any = any || has_own(i);
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
        if (are_own(own, static_cast<std::uint32_t>(id[i]), static_cast<std::uint32_t>(id[j]))) c.own[e] = static_cast<std::uint8_t>(c.own[e] | 1u << lane);
      }
    }
  }
}

}  // namespace tripoint

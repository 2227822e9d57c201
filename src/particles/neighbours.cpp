// SPDX-License-Identifier: BSD-3-Clause
#include "particles/neighbours.hpp"

#include <algorithm>
#include <cmath>

#include "core/defect.hpp"
#include "core/errors.hpp"

namespace tripoint {
namespace {

const char* const axis_names[] = {"x", "y", "z"};

/// Whether this build drops pairs across the seam of a periodic box (a defect of the self-test).
bool drops_seam() {
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

}  // namespace

/// Cells at least as wide as the list's reach, so that neighbours of i are in the 27 cells around it.
struct Neighbours::Grid {
  std::array<int, 3> count{1, 1, 1};
  Vec3 origin, width;
  std::vector<std::uint32_t> cell;   // of each row
  std::vector<std::uint32_t> first;  // row that starts each cell, one more at the end

  [[nodiscard]] std::uint32_t index(const std::array<int, 3>& c) const {
    return static_cast<std::uint32_t>(c[0] + count[0] * (c[1] + count[1] * c[2]));
  }
  [[nodiscard]] std::array<int, 3> place(const Vec3& r) const {
    std::array<int, 3> c{};
    for (std::size_t a = 0; a < 3; ++a) {
      c[a] = std::clamp(static_cast<int>((r[a] - origin[a]) / width[a]), 0, count[a] - 1);
    }
    return c;
  }
  [[nodiscard]] std::array<int, 3> place(std::uint32_t index) const {
    const int i = static_cast<int>(index);
    return {i % count[0], i / count[0] % count[1], i / count[0] / count[1]};
  }

  /// @param low, high corners of all positions   @param reach of a list
  static Grid over(const Vec3& low, const Vec3& high, double reach, const PeriodicBox& box, std::size_t particles) {
    Grid g;
    // A particle far away must not ask for a mountain of empty cells: then all become wider.
    const double most_cells = 8.0 * static_cast<double>(particles) + 64.0;
    for (double least = reach;; least *= 2.0) {
      double cells = 1.0;
      for (std::size_t a = 0; a < 3; ++a) {
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

  /// Calls visit(first row, past the last row, image) for the cells around c, in the order of cells.
  template <class Visit>
  void around(const std::array<int, 3>& c, const PeriodicBox& box, Visit visit) const {
    std::array<int, 3> d{};
    for (d[2] = -1; d[2] <= 1; ++d[2]) {
      for (d[1] = -1; d[1] <= 1; ++d[1]) {
        for (d[0] = -1; d[0] <= 1; ++d[0]) {
          std::array<int, 3> at{}, image{};
          bool there = true;
          for (std::size_t a = 0; a < 3; ++a) {
            at[a] = c[a] + d[a];
            if (at[a] >= 0 && at[a] < count[a]) continue;
            there = there && box.periodic[a];
            image[a] = at[a] < 0 ? -1 : 1;
            at[a] -= image[a] * count[a];
          }
          if (!there) continue;
          const std::uint32_t k = index(at);
          visit(first[k], first[k + 1], static_cast<std::uint32_t>(13 + image[0] + 3 * image[1] + 9 * image[2]));
        }
      }
    }
  }
};

Neighbours::Neighbours(double support, double skin, const PeriodicBox& box, int threads)
    : support_(support), skin_(skin), box_(box), threads_(threads) {
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
  const double limit = 0.25 * skin_ * skin_;
  double greatest = 0.0;
#pragma omp parallel for schedule(static) num_threads(threads_) reduction(max : greatest) if (particles.size() > 4096)
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
  const std::size_t cells = static_cast<std::size_t>(grid.count[0]) * grid.count[1] * grid.count[2];
  grid.first.assign(cells + 1, 0);
  std::vector<std::uint32_t> cell_of(n), order(n);
  for (std::size_t i = 0; i < n; ++i) {
    cell_of[i] = grid.index(grid.place(x.at(i)));
    ++grid.first[cell_of[i] + 1];
  }
  for (std::size_t c = 0; c < cells; ++c) grid.first[c + 1] += grid.first[c];
  std::vector<std::uint32_t> next(grid.first.begin(), grid.first.end() - 1);
  for (std::size_t id = 0; id < n; ++id) {
    const auto row = static_cast<std::uint32_t>(particles.row(id));
    order[next[cell_of[row]]++] = row;
  }
  grid.cell.resize(n);
  for (std::size_t i = 0; i < n; ++i) grid.cell[i] = cell_of[order[i]];
  particles.permute(order);
  marked_ = false;

  const auto sorted = positions(particles);
  built_.resize(n);
  for (std::size_t i = 0; i < n; ++i) built_[i] = sorted.at(i);
  list(particles, grid);
}

/// Two passes, one that counts and one that fills: every row writes only its own part.
void Neighbours::list(const Particles& particles, const Grid& grid) {
  const std::size_t n = particles.size();
  const double reach = support_ + skin_, reach2 = reach * reach;
  const auto x = positions(particles);
  const auto scan = [&](std::size_t i, auto take) {
    const Vec3 r = x.at(i);
    grid.around(grid.place(grid.cell[i]), box_, [&](std::uint32_t from, std::uint32_t to, std::uint32_t image) {
      if (drops_seam() && image != 13) return;
      const Vec3 s = shift_[image];
      for (std::uint32_t j = from; j < to; ++j) {
        const double dx = (x.x[j] - r.x) + s.x, dy = (x.y[j] - r.y) + s.y, dz = (x.z[j] - r.z) + s.z;
        if (dx * dx + dy * dy + dz * dz < reach2 && !(j == i && image == 13)) take(Entry{j | image << Entry::image_shift});
      }
    });
  };
  start_.assign(n + 1, 0);
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t count = 0;
    scan(i, [&](Entry) { ++count; });
    start_[i + 1] = count;
  }
  for (std::size_t i = 0; i < n; ++i) start_[i + 1] += start_[i];
  entries_.resize(start_[n]);
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t i = 0; i < n; ++i) {
    Entry* out = entries_.data() + start_[i];
    scan(i, [&](Entry e) { *out++ = e; });
  }
}

void Neighbours::mark_own(const Particles& particles, const OwnPairs& own) {
  marked_ = true;
  const auto id = particles[field::id];
#pragma omp parallel for schedule(static) num_threads(threads_)
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const bool any = !own.of(static_cast<std::size_t>(id[i])).empty();
    for (std::size_t k = start_[i]; k < start_[i + 1]; ++k) {
      Entry& e = entries_[k];
      e.bits &= ~Entry::own_bit;
      if (any && are_own(own, static_cast<std::uint32_t>(id[i]), static_cast<std::uint32_t>(id[e.row()]))) e.bits |= Entry::own_bit;
    }
  }
}

}  // namespace tripoint

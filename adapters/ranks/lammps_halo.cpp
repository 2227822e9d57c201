// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/lammps_halo.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "core/errors.hpp"

namespace tripoint::ranks {
namespace {

/// Calls visit(values, number of the column) for each column of numbers. @throws EngineError for a column of anything else
template <class P, class Visit>
void each_column(P& particles, Visit visit) {
  int column = 0;
  particles.for_each([&]<class T>(const FieldInfo& field, std::span<T> values) {
    if constexpr (std::is_arithmetic_v<T>)
      visit(values, column++);
    else
      throw EngineError("the column " + std::string(field.name) + " is not made of numbers and cannot go between ranks");
  });
}

int count_columns(const Particles& particles) {
  int count = 0;
  each_column(particles, [&](auto, int) { ++count; });
  return count;
}

}  // namespace

/// At the first migration every rank has all particles, and takes those that LAMMPS has put into its part of the box.
void LammpsHalo::migrate(Particles& particles, Bonds& bonds, OwnPairs& own, const PeriodicBox& box) {
  if (!ranks_) {
    const std::size_t lists = most_list_numbers(bonds, own);
    has_lists_ = lists > 0;
    columns_of_particle_ = count_columns(particles);
    ranks_ = &begin_(columns_of_particle_, lists);
  }
  PeriodicBox split = box;
  for (std::size_t a = 0; a < 3; ++a) split.periodic[a] = box.periodic[a] && splits_[a];
  reach_now_ = reach_of(particles, bonds, box);
  pack(particles, split);
  if (has_lists_) pack_lists(bonds, own);
  ranks_->migrate(reach_now_);
  unpack(particles, split);
  if (has_lists_) unpack_lists(bonds, own);
  if (++migrations_ == 1) own_at_start_ = ranks_->owned(), copies_at_start_ = ranks_->all() - ranks_->owned();
}

/// As far as the longest bond of all ranks reaches now: until the next migration nobody takes copies away, however bonds are
/// stretched.
double LammpsHalo::reach_of(const Particles& particles, const Bonds& bonds, const PeriodicBox& box) {
  if (!has_lists_) return reach_;
  double least = -longest_bond(particles, bonds, migrations_ == 0 ? particles.size() : owned(), box);
  std::string unused;
  take_least(least, unused);
  return std::max(reach_, -least * (1.0 + 1e-9));
}

/// Lists are written down once, with the numbers that ids are at the start: over ranks nobody changes them.
void LammpsHalo::pack_lists(const Bonds& bonds, const OwnPairs& own) {
  if (migrations_ == 0) {
    for (std::size_t atom = 0; atom < ranks_->owned(); ++atom)
      ranks_->lists(atom) = lists_as_numbers(bonds, own, static_cast<std::size_t>(ranks_->id(atom)));
  } else if (known_changes_ != std::array{bonds.changes(), own.changes()}) {
    throw EngineError("bonds or own pairs of a scene that is shared out have changed");
  }
}

void LammpsHalo::unpack_lists(Bonds& bonds, OwnPairs& own) {
  Share share{ranks_->owned(), {}, [this](std::size_t id) { return std::span<const double>(ranks_->lists(id)); }};
  for (std::size_t atom = 0; atom < ranks_->all(); ++atom) share.number.push_back(ranks_->id(atom));
  take_lists(share, bonds, own);
  known_changes_ = {bonds.changes(), own.changes()};
}

void LammpsHalo::pack(Particles& particles, const PeriodicBox& box) {
  const bool first = migrations_ == 0;
  for (std::size_t atom = 0; atom < ranks_->owned(); ++atom) {
    const std::size_t row = particles.row(first ? static_cast<std::size_t>(ranks_->id(atom)) : atom);
    each_column(particles, [&](auto values, int column) { ranks_->numbers(atom)[column] = static_cast<double>(values[row]); });
    const Vec3 r = particles.position(row);
    for (std::size_t a = 0; a < 3; ++a)
      ranks_->position(atom)[a] = box.periodic[a] ? r[a] - std::floor((r[a] - box.min[a]) / box.width[a]) * box.width[a] : r[a];
  }
}

/// Whose place in LAMMPS differs from that in its column is seen across a periodic boundary, or has crossed one.
void LammpsHalo::unpack(Particles& particles, const PeriodicBox& box) {
  const std::vector<FieldInfo> fields = particles.fields();
  const std::size_t count = ranks_->all();
  particles = Particles(count, fields);
  each_column(particles, [&](auto values, int column) {
    using T = typename decltype(values)::value_type;
    for (std::size_t atom = 0; atom < count; ++atom) values[atom] = static_cast<T>(ranks_->numbers(atom)[column]);
  });
  const auto id = particles[field::id];
  for (std::size_t atom = 0; atom < count; ++atom) id[atom] = static_cast<int>(atom);
  if (!box.any()) return;
  const auto r = positions(particles);
  const auto image = images(particles);
  const std::array<std::span<double>, 3> x{r.x, r.y, r.z};
  const std::array<std::span<int>, 3> n{image.x, image.y, image.z};
  for (std::size_t a = 0; a < 3; ++a) {
    if (!box.periodic[a]) continue;
    for (std::size_t atom = 0; atom < count; ++atom) {
      const double widths = std::round((ranks_->position(atom)[a] - x[a][atom]) / box.width[a]);
      if (widths == 0.0) continue;
      x[a][atom] += widths * box.width[a];
      n[a][atom] -= static_cast<int>(widths);
    }
  }
}

void LammpsHalo::refresh(Particles& particles, std::span<const Field<double>* const> columns) {
  rows_.resize(particles.size());
  for (std::size_t id = 0; id < rows_.size(); ++id) rows_[id] = static_cast<std::uint32_t>(particles.row(id));
  columns_.clear();
  for (const Field<double>* f : columns) columns_.push_back(particles[*f].data());
  exchanges_ += 1.0, numbers_a_copy_ += static_cast<double>(columns_.size());
  ranks_->forward({columns_.data(), static_cast<int>(columns_.size()), rows_.data(), 1});
}

void LammpsHalo::refresh(std::span<double> by_id, std::size_t each) {
  columns_.clear();
  for (std::size_t k = 0; k < each; ++k) columns_.push_back(by_id.data() + k);
  exchanges_ += 1.0, numbers_a_copy_ += static_cast<double>(each);
  ranks_->forward({columns_.data(), static_cast<int>(each), nullptr, each});
}

void LammpsHalo::take_least(double& number, std::string& word) {
  if (!ranks_) return;  // all still hold the whole scene, and know the same
  char text[32] = {};
  word.copy(text, sizeof text - 1);
  collectives_ += word.empty() ? 1.0 : 2.0;
  ranks_->take_least(number, text, word.empty() ? 0 : static_cast<int>(sizeof text));
  word = text;
}

}  // namespace tripoint::ranks

// SPDX-License-Identifier: BSD-3-Clause
#include "particles/columns.hpp"

namespace tripoint {
namespace {

/// Rows beyond the last that a vector load may touch
constexpr std::size_t padding = vector_bytes / sizeof(double);

}  // namespace

Columns::Columns(std::size_t rows, Per per, std::span<const FieldInfo> fields) : rows_(rows) {
  for (const FieldInfo& f : fields) {
    if (f.per != per || find(f.key)) continue;
    const std::size_t n = rows + padding;
    switch (f.type) {
      case FieldType::real:
        columns_.push_back({f, AlignedVector<double>(n)});
        break;
      case FieldType::integer:
        columns_.push_back({f, AlignedVector<int>(n)});
        break;
      case FieldType::vector:
        columns_.push_back({f, AlignedVector<Vec3>(n)});
        break;
      case FieldType::quaternion:
        columns_.push_back({f, AlignedVector<Quaternion>(n)});
        break;
    }
    enter(f.key);
  }
}

/// The last column by its key.
void Columns::enter(std::uint64_t key) {
  assert(columns_.size() < places_of_keys / 2);
  std::size_t s = key % places_of_keys;
  while (number_[s] != 0) s = (s + 1) % places_of_keys;
  number_[s] = static_cast<std::uint8_t>(columns_.size());
}

std::vector<FieldInfo> Columns::fields() const {
  std::vector<FieldInfo> list;
  for (const Column& c : columns_) list.push_back(c.info);
  return list;
}

void Columns::permute(std::span<const std::uint32_t> order, int threads) {
  assert(order.size() == rows_);
  for (Column& c : columns_) {
    std::visit(
        [&]<class T>(AlignedVector<T>& values) {
          auto& moved = std::get<AlignedVector<T>>(moved_);
          moved.resize(values.size());
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
          for (std::size_t n = 0; n < rows_; ++n) moved[n] = values[order[n]];
          values.swap(moved);
        },
        c.values);
  }
}

void Columns::rearrange(std::span<const std::uint32_t> from, std::span<const std::uint32_t> to, int threads) {
  assert(from.size() == to.size());
  for (Column& c : columns_) {
    std::visit(
        [&]<class T>(AlignedVector<T>& values) {
          auto& moved = std::get<AlignedVector<T>>(moved_);
          if (moved.size() < from.size()) moved.resize(from.size());
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
          for (std::size_t k = 0; k < from.size(); ++k) moved[k] = values[from[k]];
#pragma omp parallel for schedule(static) num_threads(threads) if (threads > 1)
          for (std::size_t k = 0; k < to.size(); ++k) values[to[k]] = moved[k];
        },
        c.values);
  }
}

void Columns::copy(const Columns& from, std::span<const std::uint32_t> rows) {
  assert(rows.size() == rows_ && from.columns_.size() == columns_.size());
  for (std::size_t n = 0; n < columns_.size(); ++n) {
    std::visit(
        [&]<class T>(AlignedVector<T>& values) {
          const auto& others = std::get<AlignedVector<T>>(from.columns_[n].values);
          for (std::size_t k = 0; k < rows.size(); ++k) values[k] = others[rows[k]];
        },
        columns_[n].values);
  }
}

/// Rows that stay in their places are not touched: of a share of many ranks these are nearly all.
void Columns::gather(std::span<const std::uint32_t> from) {
  std::vector<std::uint32_t> of, to;  // of the rows that do not stay in their places
  for (std::uint32_t n = 0; n < from.size(); ++n) {
    if (from[n] == none || from[n] == n) continue;
    of.push_back(from[n]);
    to.push_back(n);
  }
  rows_ = from.size();
  const std::size_t needed = rows_ + padding;
  for (Column& c : columns_) {
    std::visit(
        [&]<class T>(AlignedVector<T>& values) {
          auto& moved = std::get<AlignedVector<T>>(moved_);
          if (moved.size() < of.size()) moved.resize(of.size());
          for (std::size_t k = 0; k < of.size(); ++k) moved[k] = values[of[k]];
          if (values.capacity() < needed) values.reserve(needed + needed / 32);
          values.resize(needed);
          for (std::size_t k = 0; k < to.size(); ++k) values[to[k]] = moved[k];
        },
        c.values);
  }
}

void Columns::append_row() {
  ++rows_;
  for (Column& c : columns_) {
    std::visit(
        [&](auto& values) {
          values.resize(rows_ + padding);
          values[rows_ - 1] = {};  // it was padding, where earlier rows may have left values
        },
        c.values);
  }
}

}  // namespace tripoint

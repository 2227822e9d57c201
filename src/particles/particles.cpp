// SPDX-License-Identifier: BSD-3-Clause
#include "particles/particles.hpp"

#include <numeric>

namespace tripoint {

Particles::Particles(std::size_t count, std::span<const FieldInfo> fields)
    : Columns(count, Per::particle, fields) {
  number();
}

void Particles::number() {
  row_of_id_.resize(size());
  moving_ = awake_ = size();
  std::iota(row_of_id_.begin(), row_of_id_.end(), 0u);
  const auto id = (*this)[field::id];
  std::iota(id.begin(), id.end(), 0);
}

std::size_t Particles::append() {
  const std::size_t row = size();
  append_row();
  (*this)[field::id][row] = static_cast<int>(row);
  row_of_id_.push_back(static_cast<std::uint32_t>(row));
  // Where some sleep, it is awake from the next lists on.
  if (moving_ == row) {
    ++moving_;
    ++awake_;
  }
  return row;
}

void Particles::permute(std::span<const std::uint32_t> order, int threads) {
  Columns::permute(order, threads);
  const auto id = (*this)[field::id];
  for (std::uint32_t n = 0; n < size(); ++n) row_of_id_[static_cast<std::size_t>(id[n])] = n;
  moving_ = awake_ = size();
}

void Particles::rearrange(std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
                          std::size_t moving, std::size_t awake, int threads) {
  Columns::rearrange(from, to, threads);
  const auto id = (*this)[field::id];
  for (const std::uint32_t row : to) row_of_id_[static_cast<std::size_t>(id[row])] = row;
  moving_ = moving;
  awake_ = awake;
}

std::vector<FieldInfo> common_fields(bool periodic) {
  std::vector<FieldInfo> list{field::id,       field::body,   field::phase,
                              field::material, field::source, field::mass};
  const auto add = [&](const auto& columns) {
    for (const auto* f : columns) list.emplace_back(*f);
  };
  add(columns_of(field::position));
  add(columns_of(field::velocity));
  if (periodic) add(columns_of(field::image));
  return list;
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "particles/columns.hpp"

#include <algorithm>

namespace tripoint {
namespace {

constexpr std::size_t padding = vector_bytes / sizeof(double);  ///< rows beyond the last that a vector load may touch

}  // namespace

Columns::Columns(std::size_t rows, Per per, std::span<const FieldInfo> fields) : rows_(rows), per_(per) {
  for (const FieldInfo& f : fields) {
    if (f.per != per || has(f.name)) continue;
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
  }
}

std::vector<FieldInfo> Columns::fields() const {
  std::vector<FieldInfo> list;
  for (const Column& c : columns_) list.push_back(c.info);
  return list;
}

const Columns::Column* Columns::find(std::string_view name) const noexcept {
  const auto place = std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.info.name == name; });
  return place == columns_.end() ? nullptr : &*place;
}

void Columns::permute(std::span<const std::uint32_t> order) {
  assert(order.size() == rows_);
  for (Column& c : columns_) {
    std::visit(
        [&](auto& values) {
          auto moved = values;
          for (std::size_t n = 0; n < rows_; ++n) moved[n] = values[order[n]];
          values.swap(moved);
        },
        c.values);
  }
}

void Columns::append_row() {
  ++rows_;
  for (Column& c : columns_) {
    std::visit([&](auto& values) { values.resize(rows_ + padding); }, c.values);
  }
}

}  // namespace tripoint

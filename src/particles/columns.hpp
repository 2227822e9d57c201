// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "core/aligned.hpp"
#include "core/field.hpp"

namespace tripoint {

/// The fields that an effect has declared, in its `owns` and `reads`.
struct DeclaredFields {
  std::string who;                  ///< the effect
  std::vector<std::uint64_t> keys;  ///< ascending
  [[nodiscard]] bool has(std::uint64_t key) const { return std::ranges::binary_search(keys, key); }
};

/// An effect asked for a column that it has not declared: a fault of the program, so it says both by name.
class UndeclaredField : public std::logic_error {
 public:
  UndeclaredField(std::string_view who, std::string_view field)
      : std::logic_error("the effect " + std::string(who) + " asks for the field " + std::string(field) +
                         ", which its `owns` and `reads` do not name") {}
};

/// Structure of arrays: one column a field, rows common to all. Columns are 64-byte aligned and padded by one
/// vector.
class Columns {
 public:
  Columns() = default;
  /// @param per only the fields of this carrier become columns
  Columns(std::size_t rows, Per per, std::span<const FieldInfo> fields);

  [[nodiscard]] std::size_t size() const noexcept { return rows_; }
  [[nodiscard]] bool has(std::string_view name) const noexcept { return find(key_of(name)) != nullptr; }
  template <class T>
  [[nodiscard]] bool has(const VectorField<T>& key) const noexcept {
    return has(key.x);
  }
  [[nodiscard]] bool has(const SymmetricField& key) const noexcept { return has(key.xx); }
  template <class T>
  [[nodiscard]] bool has(const Field<T>& key) const noexcept {
    return find(key.key) != nullptr;
  }
  [[nodiscard]] std::vector<FieldInfo> fields() const;

  /// Only these columns are given out until it is called anew; null: all. The test build alone checks this,
  /// where a column is fetched, not at each value. The users' build pays nothing for it.
  void show_only(const DeclaredFields* declared) const noexcept { declared_ = declared; }

  /// @throws MissingField by name when no effect of this scene owns it   @throws UndeclaredField where
  /// show_only() hides it
  template <class T>
  [[nodiscard]] std::span<T> operator[](const Field<T>& key) {
    return {values<T>(*this, key).data(), rows_};
  }
  template <class T>
  [[nodiscard]] std::span<const T> operator[](const Field<T>& key) const {
    return {values<T>(*this, key).data(), rows_};
  }

  /// Calls visit(FieldInfo, span of values) for every column, in the order of the fields.
  template <class Visit>
  void for_each(Visit visit) {
    for (Column& c : columns_)
      std::visit([&](auto& values) { visit(c.info, std::span(values.data(), rows_)); }, c.values);
  }
  template <class Visit>
  void for_each(Visit visit) const {
    for (const Column& c : columns_)
      std::visit([&](const auto& values) { visit(c.info, std::span(values.data(), rows_)); }, c.values);
  }

  /// Row n takes the values of row rows[n] of columns of the same fields, in every column.
  void copy(const Columns& from, std::span<const std::uint32_t> rows);
  /// Row n takes the values of the old row order[n], in every column; spans taken before are no longer valid.
  /// @param order a permutation of 0..size()-1
  void permute(std::span<const std::uint32_t> order, int threads = 1);
  /// Row to[k] takes the values of the old row from[k], in every column, for each k; other rows stay. @param
  /// from,to the same rows, each once
  void rearrange(std::span<const std::uint32_t> from, std::span<const std::uint32_t> to, int threads = 1);
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  /// Resizes every column to from.size() rows. Row n takes the values of the old row from[n]. Where from[n]
  /// is `none` the row is uninitialised, and the caller must write it.
  void gather(std::span<const std::uint32_t> from);
  /// Adds a row of zeros to every column; spans taken before are no longer valid.
  void append_row();

 private:
  using Values =
      std::variant<AlignedVector<double>, AlignedVector<int>, AlignedVector<Vec3>, AlignedVector<Quaternion>>;
  struct Column {
    FieldInfo info;
    Values values;
  };
  [[nodiscard]] const Column* find(std::uint64_t key) const noexcept {
    for (std::size_t s = key % places_of_keys;; s = (s + 1) % places_of_keys) {
      if (number_[s] == 0) return nullptr;
      if (const Column& c = columns_[number_[s] - 1u]; c.info.key == key) return &c;
    }
  }
  void enter(std::uint64_t key);

  template <class T, class Self>
  static auto& values(Self& self, const Field<T>& key) {
    auto* column =
        const_cast<std::conditional_t<std::is_const_v<Self>, const Column, Column>*>(self.find(key.key));
    if (!column) throw MissingField(key.name, key.per);
#ifdef TRIPOINT_DEFECTS
    if (self.declared_ && !self.declared_->has(key.key)) throw UndeclaredField(self.declared_->who, key.name);
#endif
    return std::get<AlignedVector<T>>(column->values);
  }

  mutable const DeclaredFields* declared_ = nullptr;
  std::size_t rows_ = 0;
  std::vector<Column> columns_;
  /// More than twice as many as there are fields: few keys share a place
  static constexpr std::size_t places_of_keys = 512;
  /// Open addressing: 1 + the column whose key has, or shares, this place
  std::array<std::uint8_t, places_of_keys> number_{};
  std::tuple<AlignedVector<double>, AlignedVector<int>, AlignedVector<Vec3>, AlignedVector<Quaternion>>
      moved_;  ///< memory of permute()
};

}  // namespace tripoint

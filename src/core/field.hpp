// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/quaternion.hpp"
#include "core/vec3.hpp"

/// Fields are typed keys: a name, a unit, and what carries a value. A column of that field exists only where
/// an effect of the scene owns it.
namespace tripoint {

enum class Per { particle, bond, body };

[[nodiscard]] constexpr std::string_view to_string(Per per) noexcept {
  return per == Per::particle ? "particle" : per == Per::bond ? "bond" : "body";
}

/// Key of a column: FNV-1a of its name, at compile time where the name is a constant.
[[nodiscard]] constexpr std::uint64_t key_of(std::string_view name) noexcept {
  std::uint64_t key = 14695981039346656037u;
  for (const char c : name) key = (key ^ static_cast<unsigned char>(c)) * 1099511628211u;
  return key;
}

template <class T>
struct Field {
  std::string_view name, unit;
  Per per = Per::particle;
  std::uint64_t key = key_of(name);
};

/// The three columns of a vector, the six of a symmetric matrix and the nine of a matrix, as one key.
template <class T>
struct VectorField {
  const Field<T>&x, &y, &z;
};
struct SymmetricField {
  const Field<double>&xx, &yy, &zz, &yz, &xz, &xy;
};
struct MatrixField {
  const Field<double>&xx, &xy, &xz, &yx, &yy, &yz, &zx, &zy, &zz;
};
template <class T>
[[nodiscard]] constexpr std::array<const Field<T>*, 1> columns_of(const Field<T>& f) noexcept {
  return {&f};
}
template <class T>
[[nodiscard]] constexpr std::array<const Field<T>*, 3> columns_of(const VectorField<T>& f) noexcept {
  return {&f.x, &f.y, &f.z};
}
[[nodiscard]] constexpr std::array<const Field<double>*, 6> columns_of(const SymmetricField& f) noexcept {
  return {&f.xx, &f.yy, &f.zz, &f.yz, &f.xz, &f.xy};
}
[[nodiscard]] constexpr std::array<const Field<double>*, 9> columns_of(const MatrixField& f) noexcept {
  return {&f.xx, &f.xy, &f.xz, &f.yx, &f.yy, &f.yz, &f.zx, &f.zy, &f.zz};
}

/// Columns of several keys, one after the other.
[[nodiscard]] inline std::vector<const Field<double>*> columns_of_all(const auto&... keys) {
  std::vector<const Field<double>*> all;
  const auto take = [&](const auto& columns) { all.insert(all.end(), columns.begin(), columns.end()); };
  (take(columns_of(keys)), ...);
  return all;
}

enum class FieldType { real, integer, vector, quaternion };

/// A field without its C++ type, for lists of fields.
struct FieldInfo {
  std::string_view name, unit;
  Per per = Per::particle;
  FieldType type = FieldType::real;
  std::size_t bytes = 0;  ///< of one value
  std::uint64_t key = 0;

  FieldInfo() = default;
  template <class T>
  constexpr FieldInfo(const Field<T>& f) noexcept
      : name(f.name), unit(f.unit), per(f.per), type(type_of<T>()), bytes(sizeof(T)), key(f.key) {}
  bool operator==(const FieldInfo& other) const noexcept { return name == other.name && per == other.per; }

 private:
  template <class T>
  static constexpr FieldType type_of() noexcept {
    static_assert(std::is_same_v<T, double> || std::is_same_v<T, int> || std::is_same_v<T, Vec3> ||
                  std::is_same_v<T, Quaternion>);
    if constexpr (std::is_same_v<T, double>)
      return FieldType::real;
    else if constexpr (std::is_same_v<T, int>)
      return FieldType::integer;
    else if constexpr (std::is_same_v<T, Vec3>)
      return FieldType::vector;
    else
      return FieldType::quaternion;
  }
};

/// A column was asked for that no effect of this scene owns: a fault of the program, so it says the field by
/// name.
class MissingField : public std::logic_error {
 public:
  MissingField(std::string_view name, Per per)
      : std::logic_error("no effect of this scene owns the field " + std::string(name) + " (per " +
                         std::string(to_string(per)) + ")"),
        field_(name) {}
  [[nodiscard]] const std::string& field() const noexcept { return field_; }

 private:
  std::string field_;
};

}  // namespace tripoint

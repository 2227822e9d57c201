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

namespace detail {

/// The names of the columns of a key, "NAME.PART", kept beside it.
template <std::size_t parts>
class PartNames {
 public:
  constexpr PartNames(std::string_view name, const std::array<std::string_view, parts>& of_parts) {
    for (std::size_t k = 0; k < parts; ++k)
      for (const std::string_view piece : {name, std::string_view("."), of_parts[k]})
        for (const char c : piece) text_[k].at(size_[k]++) = c;
  }
  constexpr PartNames(const PartNames&) = delete;  // fields refer to the text
  PartNames& operator=(const PartNames&) = delete;
  [[nodiscard]] constexpr std::string_view operator[](std::size_t k) const {
    return {text_[k].data(), size_[k]};
  }

 private:
  static constexpr std::size_t longest = 32;
  std::array<std::array<char, longest>, parts> text_{};
  std::array<std::size_t, parts> size_{};
};

}  // namespace detail

/// The three columns of a vector, the six of a symmetric matrix and the nine of a matrix, as one key. A key
/// is a constant of the program: its fields refer to names that it holds.
template <class T>
class VectorField {
  detail::PartNames<3> names_;

 public:
  Field<T> x, y, z;
  constexpr VectorField(std::string_view name, std::string_view unit)
      : names_(name, {"x", "y", "z"}), x{names_[0], unit}, y{names_[1], unit}, z{names_[2], unit} {}
};
class SymmetricField {
  detail::PartNames<6> names_;

 public:
  Field<double> xx, yy, zz, yz, xz, xy;
  constexpr SymmetricField(std::string_view name, std::string_view unit)
      : names_(name, {"xx", "yy", "zz", "yz", "xz", "xy"}),
        xx{names_[0], unit},
        yy{names_[1], unit},
        zz{names_[2], unit},
        yz{names_[3], unit},
        xz{names_[4], unit},
        xy{names_[5], unit} {}
};
class MatrixField {
  detail::PartNames<9> names_;

 public:
  Field<double> xx, xy, xz, yx, yy, yz, zx, zy, zz;
  constexpr MatrixField(std::string_view name, std::string_view unit)
      : names_(name, {"xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"}),
        xx{names_[0], unit},
        xy{names_[1], unit},
        xz{names_[2], unit},
        yx{names_[3], unit},
        yy{names_[4], unit},
        yz{names_[5], unit},
        zx{names_[6], unit},
        zy{names_[7], unit},
        zz{names_[8], unit} {}
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

/// The columns of a key as a list.
[[nodiscard]] inline std::vector<const Field<double>*> columns_of_all(const auto& key) {
  const auto columns = columns_of(key);
  return {columns.begin(), columns.end()};
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

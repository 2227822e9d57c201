// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scene/readers.hpp"
#include "tables/record.hpp"

/// Reads the values of a record, each by the type of its member.
namespace tripoint {

/// A rotation (w, x, y, z), normalised. @throws InputError where it has not four numbers, or its length is
/// not 1 within 1e-3
[[nodiscard]] Quaternion unit_quaternion(const TableReader&, std::string_view key,
                                         const std::vector<double>& q);

/// Reads a key of a table into what keeps it. A key that is not given, and whose fallback is a rule ("="),
/// leaves the value as it is and no decision. @throws InputError as TableReader does, and where the value is
/// none of its type
/// @return whether there is no value: a rule is to say it, or nothing is
class ValueReader {
 public:
  ValueReader(TableReader& in, Reading& reading) : in_(in), reading_(reading) {}

  bool operator()(const Key&, double&);
  bool operator()(const Key&, std::optional<double>&);
  bool operator()(const Key&, std::uint64_t&);
  bool operator()(const Key&, bool&, std::string_view yes = {});
  bool operator()(const Key&, std::string&);
  bool operator()(const Key&, Vec3&);
  bool operator()(const Key&, std::optional<Vec3>&);
  bool operator()(const Key&, Quaternion&);
  bool operator()(const Key&, std::vector<std::string>&);
  bool operator()(const Key&, Settings&);
  bool operator()(const Key&, std::array<bool, 3>&);         ///< words x y z
  bool operator()(const Key&, std::array<std::string, 3>&);  ///< expressions
  bool operator()(const Key&, std::array<Vec3, 3>&);         ///< rows
  bool operator()(const Key&, Shape&);
  bool operator()(const Key&, std::optional<Shape>&);
  bool operator()(const Key&, std::optional<TemperatureField>&);
  bool operator()(const Key&, VelocityField&);
  bool operator()(const Key&, std::vector<Keyframe>&);
  bool operator()(const Key&, std::optional<std::array<double, 2>>&);
  bool operator()(const Key&, std::optional<JointSpring>&);
  bool operator()(const Key&, std::optional<JointMotor>&);
  /// One of the row's words, in the order of the enumeration.
  template <class E>
  requires std::is_enum_v<E>
  bool operator()(const Key& key, E& value) {
    const auto place = word_number(key);
    if (place) value = static_cast<E>(*place);
    return !place;
  }
  /// Some of the row's words, in the order of the enumeration.
  template <class E>
  requires std::is_enum_v<E>
  bool operator()(const Key& key, std::vector<E>& value) {
    value.clear();
    for (const std::size_t place : word_numbers(key)) value.push_back(static_cast<E>(place));
    return false;
  }

 private:
  /// A table of its own rows, named by the words of the key.
  template <class T>
  bool sub_table(const Key&, std::optional<T>&);
  [[nodiscard]] std::optional<std::size_t> word_number(const Key&);
  [[nodiscard]] std::vector<std::size_t> word_numbers(const Key&);
  [[nodiscard]] std::string path_of(const Key& key) const { return in_.path() + "." + std::string(key.name); }

  TableReader& in_;
  Reading& reading_;
};

/// The keys of an Owner, read in the order that its rules need.
template <class Owner>
class RecordReader {
 public:
  RecordReader(TableReader& in, Owner& owner, Reading& reading) : owner_(owner), value_(in, reading) {}

  /// Reads one key. @return whether there is no value   @pre a member keeps the key
  bool operator()(std::string_view name) {
    bool absent = false;
    each_kept_of(owner_, [&](const auto& entry) {
      if (entry.key.name == name) absent = read(entry);
    });
    return absent;
  }

  /// Reads some keys, in this order.
  void each(std::initializer_list<std::string_view> names) {
    for (const std::string_view name : names) static_cast<void>((*this)(name));
  }

  /// Reads all keys; absent(name) is called for each that has no value.
  template <class Absent>
  void all(Absent absent) {
    each_kept_of(owner_, [&](const auto& entry) {
      if (read(entry)) absent(entry.key.name);
    });
  }
  void all() {
    all([](std::string_view) {});
  }
  /// Reads all keys that have not been read, but for those whose fallback is a rule.
  void rest() {
    each_kept_of(owner_, [&](const auto& entry) {
      if (entry.key.fallback != "=" && std::find(done_.begin(), done_.end(), entry.key.name) == done_.end())
        read(entry);
    });
  }

 private:
  template <class T>
  bool read(const Kept<Owner, T>& entry) {
    done_.push_back(entry.key.name);
    if constexpr (std::is_same_v<T, bool>)
      return value_(entry.key, owner_.*entry.member, entry.yes);
    else
      return value_(entry.key, owner_.*entry.member);
  }

  Owner& owner_;
  ValueReader value_;
  std::vector<std::string_view> done_;
};

}  // namespace tripoint

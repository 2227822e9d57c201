// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string_view>
#include <tuple>
#include <type_traits>

#include "tables/key_table.hpp"

/// A key of a scene and the member that keeps its value, written once. The reader of case files, both
/// directions of a job's JSON, the schema and the reference page go by it (decision 025). The lists stand in
/// scene_records.hpp and place_records.hpp.
namespace tripoint {

template <class Owner, class T>
struct Kept {
  Key key;
  T Owner::*member;
  std::string_view yes;     ///< of a flag that is written as one of two words: the one that is true
  std::string_view in_job;  ///< its name in a job
  bool later;               ///< came after the first jobs: where one lacks it, the member stays as it is
};

/// Properties of a key beside its row.
struct As {
  std::string_view yes{}, in_job{};
  bool later = false;
};

template <class Owner, class T>
[[nodiscard]] constexpr Kept<Owner, T> kept(T Owner::*member, const Key& key, const As& as = {}) {
  return {key, member, as.yes, as.in_job.empty() ? key.name : as.in_job, as.later};
}

template <class T>
inline constexpr bool is_kept = false;
template <class Owner, class T>
inline constexpr bool is_kept<Kept<Owner, T>> = true;

/// The record of a table: its keys in the order of the reference page. A plain Key has no member; its reader
/// has a rule.
template <class Owner>
inline constexpr auto record = std::make_tuple();

/// One kind of a shape or a field: its word, and the keys that it has.
template <class Kind, class Record>
struct KindRecord {
  Kind kind;
  std::string_view word;
  Record record;
};
template <class Kind, class... Keys>
[[nodiscard]] constexpr auto kind_record(Kind kind, std::string_view word, const Keys&... keys) {
  return KindRecord<Kind, std::tuple<Keys...>>{kind, word, std::make_tuple(keys...)};
}
/// The kinds of an Owner that has a member `kind`, in the order of its enumeration.
template <class Owner>
inline constexpr auto kinds = std::make_tuple();

/// Calls visit(kept) for each key of a record that a member keeps.
template <class Record, class Visit>
constexpr void each_kept(const Record& list, Visit visit) {
  const auto one = [&]<class Entry>(const Entry& entry) {
    if constexpr (is_kept<Entry>) visit(entry);
  };
  std::apply([&](const auto&... entries) { (one(entries), ...); }, list);
}

/// The same for the keys that this Owner has: those of its kind where it has kinds.
template <class Owner, class Visit>
constexpr void each_kept_of(const Owner& owner, Visit visit) {
  if constexpr (requires { owner.kind; } &&
                std::tuple_size_v < std::remove_cvref_t < decltype(kinds<Owner>) >>> 0) {
    const auto one = [&](const auto& of) {
      if (of.kind == owner.kind) each_kept(of.record, visit);
    };
    std::apply([&](const auto&... all) { (one(all), ...); }, kinds<Owner>);
  } else {
    each_kept(record<Owner>, visit);
  }
}

/// The row of an entry of a record.
[[nodiscard]] constexpr const Key& row_of(const Key& key) { return key; }
template <class Owner, class T>
[[nodiscard]] constexpr const Key& row_of(const Kept<Owner, T>& entry) {
  return entry.key;
}

}  // namespace tripoint

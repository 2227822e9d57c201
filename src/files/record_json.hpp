// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <concepts>

#include <nlohmann/json_fwd.hpp>  // whoever uses it includes json.hpp first

#include "core/whole_number.hpp"
#include "files/scene_json.hpp"
#include "scene/geometry.hpp"
#include "tables/record.hpp"

/// A record goes into JSON and comes back by the list of its keys (tables/record.hpp).
namespace tripoint::record_json {

using json = nlohmann::ordered_json;

template <class Owner>
void put_record(const Owner&, json& out);
template <class Owner>
void take_record(const JsonObject&, Owner&);
json kind_json(const auto& owner);
template <class Owner>
Owner from_kind_json(const JsonObject&);

// --- one value
// --------------------------------------------------------------------------------------------------------

/// Whether it is a list of words of one enumeration.
template <class T>
inline constexpr bool is_word_list = false;
template <class E>
inline constexpr bool is_word_list<std::vector<E>> = std::is_enum_v<E>;

/// How a value of a member's type is written. `key` and `yes` are those of its row.
template <class T>
json put(const Key& key, std::string_view yes, const T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    if (yes.empty()) return value;
    const auto words = split_words(key.words);
    return *std::ranges::find_if(words, [&](const std::string& word) { return (word == yes) == value; });
  } else if constexpr (std::is_enum_v<T>) {
    return split_words(key.words).at(static_cast<std::size_t>(value));
  } else if constexpr (is_word_list<T>) {
    json list = json::array();
    for (const auto one : value) list.push_back(split_words(key.words).at(static_cast<std::size_t>(one)));
    return list;
  } else if constexpr (std::is_same_v<T, Vec3> || std::is_same_v<T, Quaternion> ||
                       std::is_same_v<T, Settings>) {
    return to_json(value);
  } else if constexpr (std::is_same_v<T, Shape> || std::is_same_v<T, TemperatureField> ||
                       std::is_same_v<T, VelocityField>) {
    return kind_json(value);
  } else if constexpr (std::is_same_v<T, std::array<bool, 3>>) {
    json list = json::array();
    for (std::size_t k = 0; k < 3; ++k)
      if (value[k]) list.push_back(split_words(key.words).at(k));
    return list;
  } else if constexpr (std::is_same_v<T, std::array<Vec3, 3>>) {
    return json::array({to_json(value[0]), to_json(value[1]), to_json(value[2])});
  } else if constexpr (std::is_same_v<T, std::vector<Keyframe>>) {
    json list = json::array();
    for (const Keyframe& k : value) put_record(k, list.emplace_back(json::object()));
    return list;
  } else if constexpr (requires { value.has_value(); }) {
    return value ? put(key, yes, *value) : json(nullptr);
  } else {
    return value;
  }
}

/// The number of a word in a list; @throws InputError where it is none of them
inline std::size_t place_of(const JsonObject& o, const std::string& name, const std::string& word,
                            const std::vector<std::string>& words) {
  const auto at = std::ranges::find(words, word);
  if (at == words.end()) throw InputError(o.path() + "." + name + ": \"" + word + "\" is unknown");
  return static_cast<std::size_t>(at - words.begin());
}

/// Reads a member. Flags, lists, texts that have a default and what may be unknown stay as they are where a
/// job lacks them.
/// @param later whether any value does so
template <class T>
void take(const JsonObject& o, const std::string& name, const Key& key, std::string_view yes, bool later,
          T& value) {
  if constexpr (std::is_same_v<T, double>) {
    value = later ? o.number_or(name, value) : o.number(name);
  } else if constexpr (std::is_same_v<T, bool>) {
    if (yes.empty())
      value = o.flag_or(name, value);
    else if (o.has(name))
      value = split_words(key.words)[place_of(o, name, o.text(name), split_words(key.words))] == yes;
  } else if constexpr (std::is_same_v<T, std::string>) {
    value = later || !key.required() ? o.text_or(name, value) : o.text(name);
  } else if constexpr (std::integral<T>) {
    value = later ? whole_number<T>(o.number_or(name, static_cast<double>(value)))
                  : static_cast<T>(o.integer(name));
  } else if constexpr (std::is_same_v<T, Settings>) {
    value = o.settings(name);
  } else if constexpr (std::is_same_v<T, std::vector<double>>) {
    value = o.numbers(name);
  } else if constexpr (std::is_enum_v<T>) {
    if (!later || o.has(name))
      value = static_cast<T>(place_of(o, name, o.text(name), split_words(key.words)));
  } else if constexpr (std::is_same_v<T, Vec3>) {
    if (!later || o.has(name)) value = o.vector(name);
  } else if constexpr (std::is_same_v<T, Quaternion>) {
    if (!later || o.has(name)) value = o.quaternion(name);
  } else if constexpr (std::is_same_v<T, Shape>) {
    if (o.has(name) || key.table != "body") value = from_kind_json<T>(o.object(name));
  } else if constexpr (std::is_same_v<T, TemperatureField> || std::is_same_v<T, VelocityField>) {
    if (o.has(name)) value = from_kind_json<T>(o.object(name));
  } else if constexpr (std::is_same_v<T, std::vector<std::string>>) {
    value = o.texts(name);
  } else if constexpr (is_word_list<T>) {
    value.clear();
    for (const std::string& word : o.texts(name))
      value.push_back(static_cast<typename T::value_type>(place_of(o, name, word, split_words(key.words))));
  } else if constexpr (std::is_same_v<T, std::array<std::string, 3>>) {
    const std::vector<std::string> parts = o.texts(name);
    if (parts.size() != 3) throw InputError(o.path() + "." + name + ": expected 3 expressions");
    std::ranges::copy(parts, value.begin());
  } else if constexpr (std::is_same_v<T, std::array<bool, 3>>) {
    const auto words = split_words(key.words);
    for (const std::string& word : o.texts(name))
      value[std::min<std::size_t>(std::ranges::find(words, word) - words.begin(), 2)] = true;
  } else if constexpr (std::is_same_v<T, std::array<Vec3, 3>>) {
    value = o.rows(name);
  } else if constexpr (std::is_same_v<T, std::vector<Keyframe>>) {
    for (const JsonObject& k : o.objects(name)) take_record(k, value.emplace_back());
  } else {  // values that may be unknown
    value.reset();
    if (o.has(name)) take(o, name, key, yes, false, value.emplace());
  }
}

// --- a record
// ---------------------------------------------------------------------------------------------------------

/// Members by a record that is named. A key without a member has its place, and its owner fills it.
template <class Owner, class Record>
void put_by(const Record& list, const Owner& owner, json& out) {
  const auto one = [&]<class Entry>(const Entry& entry) {
    if constexpr (is_kept<Entry>)
      out[std::string(entry.in_job)] = put(entry.key, entry.yes, owner.*entry.member);
    else
      out[std::string(entry.name)] = nullptr;
  };
  std::apply([&](const auto&... entries) { (one(entries), ...); }, list);
}

template <class Owner, class Record>
void take_by(const Record& list, const JsonObject& o, Owner& owner) {
  each_kept(list, [&](const auto& entry) {
    take(o, std::string(entry.in_job), entry.key, entry.yes, entry.later, owner.*entry.member);
  });
}

template <class Owner>
void put_record(const Owner& owner, json& out) {
  each_kept_of(owner, [&](const auto& entry) {
    const auto& value = owner.*entry.member;
    out[std::string(entry.in_job)] = put(entry.key, entry.yes, value);
  });
}

template <class Owner>
void take_record(const JsonObject& o, Owner& owner) {
  each_kept_of(owner, [&](const auto& entry) {
    take(o, std::string(entry.in_job), entry.key, entry.yes, entry.later, owner.*entry.member);
  });
}

// --- shapes, and fields of the start
// ----------------------------------------------------------------------------------

template <class Owner>
std::vector<std::string> kind_words() {
  return std::apply([](const auto&... all) { return std::vector<std::string>{std::string(all.word)...}; },
                    kinds<Owner>);
}

/// A shape or a field: its kind, and the keys of that.
json kind_json(const auto& owner) {
  using Owner = std::remove_cvref_t<decltype(owner)>;
  json out{{"kind", kind_words<Owner>().at(static_cast<std::size_t>(owner.kind))}};
  put_record(owner, out);
  if constexpr (std::is_same_v<Owner, Shape>) {
    if (is_turned(owner))
      out["rotation_centre"] = to_json(turning_centre(owner));
    else
      out.erase("rotation");
    if (owner.kind != Shape::Kind::unite && owner.kind != Shape::Kind::difference) return out;
    out["of"] = json::array();
    for (const Shape& part : owner.of) out["of"].push_back(kind_json(part));
  } else if (owner.kind == Owner::Kind::constant) {
    out["value"] = put(Key{}, "", owner.value);
  }
  return out;
}

template <class Owner>
Owner from_kind_json(const JsonObject& o) {
  Owner owner;
  owner.kind = static_cast<typename Owner::Kind>(place_of(o, "kind", o.text("kind"), kind_words<Owner>()));
  take_record(o, owner);
  if constexpr (std::is_same_v<Owner, Shape>) {
    if (owner.kind == Shape::Kind::unite || owner.kind == Shape::Kind::difference)
      for (const JsonObject& part : o.objects("of")) owner.of.push_back(from_kind_json<Shape>(part));
  } else if (owner.kind == Owner::Kind::constant) {
    take(o, "value", Key{}, "", false, owner.value);
  }
  return owner;
}

}  // namespace tripoint::record_json

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

/// Whether it is a list of words of one enumeration.
template <class T>
inline constexpr bool is_word_list = false;
template <class E>
inline constexpr bool is_word_list<std::vector<E>> = std::is_enum_v<E>;

/// A word of the key's row, by its number.
inline std::string word_of(const Key& key, std::size_t number) { return split_words(key.words).at(number); }

/// How a value of a member's type is written. `key` and `yes` are those of its row.
template <class T>
json put(const Key&, std::string_view, const T& value) {
  return value;
}
inline json put(const Key& key, std::string_view yes, bool value) {
  if (yes.empty()) return value;
  const auto words = split_words(key.words);
  return *std::ranges::find_if(words, [&](const std::string& word) { return (word == yes) == value; });
}
template <class E>
requires std::is_enum_v<E> json put(const Key& key, std::string_view, const E& value) {
  return word_of(key, static_cast<std::size_t>(value));
}
template <class E>
requires std::is_enum_v<E> json put(const Key& key, std::string_view, const std::vector<E>& value) {
  json list = json::array();
  for (const E one : value) list.push_back(word_of(key, static_cast<std::size_t>(one)));
  return list;
}
inline json put(const Key&, std::string_view, const Vec3& value) { return to_json(value); }
inline json put(const Key&, std::string_view, const Quaternion& value) { return to_json(value); }
inline json put(const Key&, std::string_view, const Settings& value) { return to_json(value); }
inline json put(const Key&, std::string_view, const Shape& value) { return kind_json(value); }
inline json put(const Key&, std::string_view, const TemperatureField& value) { return kind_json(value); }
inline json put(const Key&, std::string_view, const VelocityField& value) { return kind_json(value); }
inline json put(const Key& key, std::string_view, const std::array<bool, 3>& value) {
  json list = json::array();
  for (std::size_t k = 0; k < 3; ++k)
    if (value[k]) list.push_back(word_of(key, k));
  return list;
}
inline json put(const Key&, std::string_view, const std::array<Vec3, 3>& value) {
  return json::array({to_json(value[0]), to_json(value[1]), to_json(value[2])});
}
inline json put(const Key&, std::string_view, const std::vector<Keyframe>& value) {
  json list = json::array();
  for (const Keyframe& k : value) put_record(k, list.emplace_back(json::object()));
  return list;
}
template <class T>
requires std::is_same_v<T, JointSpring> || std::is_same_v<T, JointMotor> json put(const Key&,
                                                                                  std::string_view,
                                                                                  const T& value) {
  json out = json::object();
  put_record(value, out);
  return out;
}
template <class T>
json put(const Key& key, std::string_view yes, const std::optional<T>& value) {
  return value ? put(key, yes, *value) : json(nullptr);
}

/// The number of a word in a list; @throws InputError where it is none of them
inline std::size_t place_of(const JsonObject& o, const std::string& name, const std::string& word,
                            const std::vector<std::string>& words) {
  const auto at = std::ranges::find(words, word);
  if (at == words.end()) throw InputError(o.path() + "." + name + ": \"" + word + "\" is unknown");
  return static_cast<std::size_t>(at - words.begin());
}

/// The place of a member in a job, with the row of its key.
struct Member {
  const JsonObject& o;
  const std::string& name;
  const Key& key;
  std::string_view yes;
  bool later;  ///< whether any value stays as it is where a job lacks it

  [[nodiscard]] bool stays() const { return later && !o.has(name); }
  [[nodiscard]] std::size_t place(const std::string& word) const {
    return place_of(o, name, word, split_words(key.words));
  }
};

/// Reads a member. Flags, lists, texts that have a default and what may be unknown stay as they are where a
/// job lacks them.
inline void take(const Member& m, double& value) {
  value = m.later ? m.o.number_or(m.name, value) : m.o.number(m.name);
}
inline void take(const Member& m, bool& value) {
  if (m.yes.empty())
    value = m.o.flag_or(m.name, value);
  else if (m.o.has(m.name))
    value = word_of(m.key, m.place(m.o.text(m.name))) == m.yes;
}
inline void take(const Member& m, std::string& value) {
  value = m.later || !m.key.required() ? m.o.text_or(m.name, value) : m.o.text(m.name);
}
template <std::integral T>
void take(const Member& m, T& value) {
  value = m.later ? whole_number<T>(m.o.number_or(m.name, static_cast<double>(value)))
                  : static_cast<T>(m.o.integer(m.name));
}
inline void take(const Member& m, Settings& value) { value = m.o.settings(m.name); }
inline void take(const Member& m, std::vector<double>& value) { value = m.o.numbers(m.name); }
template <class E>
requires std::is_enum_v<E>
void take(const Member& m, E& value) {
  if (!m.stays()) value = static_cast<E>(m.place(m.o.text(m.name)));
}
inline void take(const Member& m, Vec3& value) {
  if (!m.stays()) value = m.o.vector(m.name);
}
inline void take(const Member& m, Quaternion& value) {
  if (!m.stays()) value = m.o.quaternion(m.name);
}
inline void take(const Member& m, Shape& value) {
  if (m.o.has(m.name) || m.key.table != "body") value = from_kind_json<Shape>(m.o.object(m.name));
}
template <class Start>
requires std::is_same_v<Start, TemperatureField> || std::is_same_v<Start, VelocityField>
void take(const Member& m, Start& value) {
  if (m.o.has(m.name)) value = from_kind_json<Start>(m.o.object(m.name));
}
template <class T>
requires std::is_same_v<T, JointSpring> || std::is_same_v<T, JointMotor>
void take(const Member& m, T& value) { take_record(m.o.object(m.name), value); }
inline void take(const Member& m, std::array<double, 2>& value) {
  const std::vector<double> pair = m.o.numbers(m.name);
  if (pair.size() != 2) throw InputError(m.o.path() + "." + m.name + ": expected 2 numbers");
  std::ranges::copy(pair, value.begin());
}
inline void take(const Member& m, std::vector<std::string>& value) { value = m.o.texts(m.name); }
template <class E>
requires std::is_enum_v<E>
void take(const Member& m, std::vector<E>& value) {
  value.clear();
  for (const std::string& word : m.o.texts(m.name)) value.push_back(static_cast<E>(m.place(word)));
}
inline void take(const Member& m, std::array<std::string, 3>& value) {
  const std::vector<std::string> parts = m.o.texts(m.name);
  if (parts.size() != 3) throw InputError(m.o.path() + "." + m.name + ": expected 3 expressions");
  std::ranges::copy(parts, value.begin());
}
inline void take(const Member& m, std::array<bool, 3>& value) {
  const auto words = split_words(m.key.words);
  for (const std::string& word : m.o.texts(m.name))
    value[std::min<std::size_t>(std::ranges::find(words, word) - words.begin(), 2)] = true;
}
inline void take(const Member& m, std::array<Vec3, 3>& value) { value = m.o.rows(m.name); }
inline void take(const Member& m, std::vector<Keyframe>& value) {
  for (const JsonObject& k : m.o.objects(m.name)) take_record(k, value.emplace_back());
}
template <class T>
void take(const Member& m, std::optional<T>& value) {
  value.reset();
  if (m.o.has(m.name)) take({m.o, m.name, m.key, m.yes, false}, value.emplace());
}

// --- a record

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
    const std::string name(entry.in_job);
    take({o, name, entry.key, entry.yes, entry.later}, owner.*entry.member);
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
    const std::string name(entry.in_job);
    take({o, name, entry.key, entry.yes, entry.later}, owner.*entry.member);
  });
}

// --- shapes, and fields of the start

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
    const std::string name = "value";
    take({o, name, Key{}, "", false}, owner.value);
  }
  return owner;
}

}  // namespace tripoint::record_json

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

#include "tables/record.hpp"

/// A record of results.json or of a baseline is a list of entries, as a table of the case file is
/// (tables/record.hpp): a key with its unit and meaning, and the member that keeps it. Reader, writer, schema
/// and page are visitors of this list, in which the keys have the order of the file.
///
///   held(&R::x, "key", "meaning", "unit")   both directions; an absent key leaves the member's default
///   reached("key", get, ...)                the same of get(record): a member of a member, or a Form
///   replaced(&R::x, "key", form, ...)       written is form(record), read is the member
///   formed("key", form, ...)                written only: the judge forms it anew
///   part("key", is_there, list, ...)        an object of further entries, left out unless is_there(record)
///   unless(&R::x, "key", known, ...)        left out where it is known(record)
///   block(is_there, list)                   further entries of the same object
///   ended()                                 status and reason; a row without a status counts as an error
namespace tripoint {

// Forms of a member. Each has a deduction guide: clang 16 deduces no argument of an aggregate without one.

/// A number that may be none: null, and read as NaN where there is no number.
template <class T>
struct NumberOrNull {
  T& value;
};
template <class T>
NumberOrNull(T&) -> NumberOrNull<T>;
/// The same with "finite": false beside it, so that nobody takes a null for a missing key.
template <class T>
struct Judged {
  T& value;
};
template <class T>
Judged(T&) -> Judged<T>;
/// A number that may not be stated: an absent one leaves the default, null is NaN.
template <class T>
struct Stated {
  T& value;
};
template <class T>
Stated(T&) -> Stated<T>;
/// null where the number is not above zero, or the text is empty.
template <class T>
struct OrNull {
  T& value;
};
template <class T>
OrNull(T&) -> OrNull<T>;
/// Left out where it is empty.
template <class T>
struct IfAny {
  T& value;
};
template <class T>
IfAny(T&) -> IfAny<T>;

/// Entries that are no Kept.
template <class Get>
struct Reached {
  Key key;
  Get get;
};
template <class Owner, class T, class Form>
struct Replaced {
  Key key;
  T Owner::*member;
  Form form;
};
template <class Form>
struct Formed {
  Key key;
  Form form;
};
template <class There, class List>
struct Part {
  Key key;
  There is_there;
  List list;
};
template <class Owner, class T, class Known>
struct Unless {
  Key key;
  T Owner::*member;
  Known known;
};
template <class There, class List>
struct Block {
  There is_there;
  List list;
};
struct Ended {
  Key status, reason;
};

[[nodiscard]] constexpr Key named(std::string_view name, std::string_view meaning = "",
                                  std::string_view unit = "") {
  return {"", name, ValueType::settings, unit, Range::any, "", "", "", meaning};
}

template <class Owner, class T>
[[nodiscard]] constexpr auto held(T Owner::*member, std::string_view name, std::string_view meaning = "",
                                  std::string_view unit = "") {
  return kept(member, named(name, meaning, unit));
}
template <class Get>
[[nodiscard]] constexpr auto reached(std::string_view name, Get get, std::string_view meaning = "",
                                     std::string_view unit = "") {
  return Reached<Get>{named(name, meaning, unit), get};
}
template <class Owner, class T, class Form>
[[nodiscard]] constexpr auto replaced(T Owner::*member, std::string_view name, Form form,
                                      std::string_view meaning = "", std::string_view unit = "") {
  return Replaced<Owner, T, Form>{named(name, meaning, unit), member, form};
}
template <class Form>
[[nodiscard]] constexpr auto formed(std::string_view name, Form form, std::string_view meaning = "",
                                    std::string_view unit = "") {
  return Formed<Form>{named(name, meaning, unit), form};
}
template <class There, class... Entries>
[[nodiscard]] constexpr auto part(std::string_view name, There is_there, const std::tuple<Entries...>& list,
                                  std::string_view meaning = "") {
  return Part<There, std::tuple<Entries...>>{named(name, meaning), is_there, list};
}
template <class Owner, class T, class Known>
[[nodiscard]] constexpr auto unless(T Owner::*member, std::string_view name, Known known,
                                    std::string_view meaning = "", std::string_view unit = "") {
  return Unless<Owner, T, Known>{named(name, meaning, unit), member, known};
}
template <class There, class... Entries>
[[nodiscard]] constexpr auto block(There is_there, const std::tuple<Entries...>& list) {
  return Block<There, std::tuple<Entries...>>{is_there, list};
}
[[nodiscard]] constexpr Ended ended(std::string_view status, std::string_view reason) {
  return {named("status", status), named("reason", reason)};
}

/// The entries of an Owner: its record, but where the case file has another one of the same structure.
template <class Owner>
inline constexpr const auto& entries_of = record<Owner>;

template <class T>
concept Described = std::tuple_size_v<std::remove_cvref_t<decltype(entries_of<std::remove_const_t<T>>)>> >
0;

template <class V, class R, class List>
void visit_entries(V& v, R& r, const List& list);

template <class V, class R, class Owner, class T>
void visit_entry(V& v, R& r, const Kept<Owner, T>& e) {
  v(e.key, r.*e.member);
}
template <class V, class R, class Get>
void visit_entry(V& v, R& r, const Reached<Get>& e) {
  v(e.key, e.get(r));
}
template <class V, class R, class Owner, class T, class Form>
void visit_entry(V& v, R& r, const Replaced<Owner, T, Form>& e) {
  v(e.key, r.*e.member, e.form(r));
}
template <class V, class R, class Form>
void visit_entry(V& v, R& r, const Formed<Form>& e) {
  v.written(e.key, [&]() -> decltype(auto) { return e.form(std::as_const(r)); });
}
template <class V, class R, class There, class List>
void visit_entry(V& v, R& r, const Part<There, List>& e) {
  v.part(e.key, e.is_there(std::as_const(r)), [&](auto& inner) { visit_entries(inner, r, e.list); });
}
template <class V, class R, class Owner, class T, class Known>
void visit_entry(V& v, R& r, const Unless<Owner, T, Known>& e) {
  v.unless(e.known(std::as_const(r)), e.key, r.*e.member);
}
template <class V, class R, class There, class List>
void visit_entry(V& v, R& r, const Block<There, List>& e) {
  v.block(e.is_there(std::as_const(r)), [&](auto& inner) { visit_entries(inner, r, e.list); });
}
template <class V, class R>
void visit_entry(V& v, R& r, const Ended& e) {
  v.end(e.status, r.status, e.reason, r.reason);
}

template <class V, class R, class List>
void visit_entries(V& v, R& r, const List& list) {
  std::apply([&](const auto&... entries) { (visit_entry(v, r, entries), ...); }, list);
}

/// Shows a visitor every entry of a record, in the order of the file.
template <class V, Described R>
void fields(V& v, R& r) {
  visit_entries(v, r, entries_of<std::remove_const_t<R>>);
}

}  // namespace tripoint

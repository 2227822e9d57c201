// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <type_traits>

/// A record of results.json or of a baseline is described once, as its fields in the order in which they are
/// written. The description serves both directions: a visitor takes a key and a member, and either writes the
/// member or reads it.
///
///   v("key", member)             both directions; what is absent from a file leaves the member's default, a
///   text empty v("key", member, value)      written is `value`, which says more than the member; read is the
///   member v.written("key", value)      written only: the judge forms it anew v.part("key", is_there, f) an
///   object of further fields, left out where `is_there` is false v.end(status, reason)        how a row
///   ended; a row without a status counts as an error
namespace tripoint {

// Each has a deduction guide: clang 16 deduces no template argument of an aggregate without one.

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

template <class V, class R>
concept Fields = requires(V& v, R& r) {
  fields(v, r);
};

/// A record, or a record that is not changed.
template <class R, class Plain>
concept RecordOf = std::is_same_v<std::remove_const_t<R>, Plain>;

}  // namespace tripoint

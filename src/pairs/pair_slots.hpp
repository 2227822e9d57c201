// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>

#include "pairs/pass.hpp"

/// The table of compiled passes. An effect with pair terms has a header effects/NAME/pair_slots.hpp with a
/// type
///   struct PairSlots : NoPairTerms { using density = OneOf<...>; ... };
/// which says its forms in each pass. The table of a pass has each form of each effect with each form of
/// every other.
namespace tripoint {

/// Forms, each Terms<...>, of which a scene takes one at most.
template <class... Forms>
struct OneOf {
  static constexpr std::size_t size = sizeof...(Forms);
};
/// Forms of one term.
template <class... T>
using OneTermOf = OneOf<Terms<T>...>;

/// What an effect leaves out of its PairSlots.
struct NoPairTerms {
  using density = OneOf<>;  ///< forms in the pass of density
  using rates = OneOf<>;    ///< forms in the pass of rates
  using alone = OneOf<>;    ///< each has a pass of its own
  using timed = Terms<>;    ///< rates by which the fastest width is found
};

template <class... A, class... B>
consteval Terms<A..., B...> operator+(Terms<A...>, Terms<B...>) {
  return {};
}
template <class... A, class... B>
consteval OneOf<A..., B...> operator|(OneOf<A...>, OneOf<B...>) {
  return {};
}
/// Each form of one with each of the other.
template <class... A, class B>
consteval auto operator*(OneOf<A...>, B other) {
  const auto with_each = []<class Form, class... Others>(Form, OneOf<Others...>) {
    return OneOf<decltype(Form{} + Others{})...>{};
  };
  return (OneOf<>{} | ... | with_each(A{}, other));
}

namespace detail {

/// PairSlots of an effect; of one that has no header it is never defined.
template <class Effect>
struct SlotsOf : NoPairTerms {};
template <class Effect>
requires requires { typename Effect::density; }
struct SlotsOf<Effect> : Effect {};

template <class... Forms>
consteval auto or_none(OneOf<Forms...>) {
  return OneOf<Terms<>, Forms...>{};
}

/// Whether each has another name, but for those that are one type.
template <class... T>
consteval bool names_differ(Terms<T...>) {
  const std::array<const PairTerm*, sizeof...(T)> terms{&pair_term<T>...};
  for (const PairTerm* a : terms)
    for (const PairTerm* b : terms)
      if (a != b && *a == *b) return false;
  return true;
}
/// Whether no term is twice in a form.
template <class... T>
consteval bool each_once(Terms<T...>) {
  std::size_t equal = 0;
  for (const PairTerm& a : Terms<T...>::list)
    for (const PairTerm& b : Terms<T...>::list) equal += a == b ? 1 : 0;
  return equal == sizeof...(T);
}

template <int L, class ForUnit, bool finds, class... Forms>
consteval std::array<PassFunction, sizeof...(Forms)> table_of(OneOf<Forms...>) {
  static_assert(sizeof...(Forms) <= 81, "more combinations than the build bears");
  static_assert((each_once(Forms{}) && ...), "two effects bring one pair term");
  static_assert(names_differ((Terms<>{} + ... + Forms{})), "two pair terms have one name");
  return {pass_of<L, ForUnit, finds>(Forms{})...};
}

}  // namespace detail

/// The tables of these effects, in their order, for clusters of L particles and a vector unit.
template <int L, class ForUnit, class... Effects>
struct PassesOf {
  static constexpr auto density = detail::table_of<L, ForUnit, true>(
      (OneOf<Terms<>>{} * ... * detail::or_none(typename detail::SlotsOf<Effects>::density{})));
  static constexpr auto rates = detail::table_of<L, ForUnit, false>(
      (OneOf<Terms<>>{} * ... * detail::or_none(typename detail::SlotsOf<Effects>::rates{})));
  static constexpr auto alone =
      detail::table_of<L, ForUnit, false>((OneOf<>{} | ... | typename detail::SlotsOf<Effects>::alone{}));
  static constexpr PassFunction timed =
      pass_of<L, ForUnit, false>((Terms<>{} + ... + typename detail::SlotsOf<Effects>::timed{}));
};

}  // namespace tripoint

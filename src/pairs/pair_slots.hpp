// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <type_traits>

#include "pairs/pass.hpp"

/// The slots of the fused passes, put together from those of each effect. An effect with pair terms has a header
/// effects/NAME/pair_slots.hpp with a type NAME::PairSlots. The type has any of these aliases:
///   using density = SlotList<Slot<...>...>;  terms that the pass of density sums
///   using rates = SlotList<Slot<...>...>;    terms that the pass of rates sums
///   using alone = Together<...>;             terms that have a pass each
///   using timed = Together<...>;             the form of rates by which the fastest width is found
/// An effect without pair terms has no such header: NAME::PairSlots is then never defined. All functions here are for their types
/// alone.
namespace tripoint {

template <class... Slots>
struct SlotList {};

namespace detail {

template <class Form, class... Forms>
inline constexpr bool is_one_of = (std::is_same_v<Form, Forms> || ...);

/// The forms of two slots, each once.
template <class... A>
constexpr auto united(Slot<A...> a, Slot<>) {
  return a;
}
template <class... A, class First, class... More>
constexpr auto united(Slot<A...> a, Slot<First, More...>) {
  if constexpr (is_one_of<First, A...>)
    return united(a, Slot<More...>{});
  else
    return united(Slot<A..., First>{}, Slot<More...>{});
}

template <class... A, class... B>
constexpr bool share_a_form(Slot<A...>, Slot<B...>) {
  return (is_one_of<B, A...> || ...);
}

/// A list with one more slot. Slots that share a form are one, since no scene has two of their forms on.
template <class... Before, class New>
constexpr auto with_slot(SlotList<Before...>, SlotList<>, New) {
  return SlotList<Before..., New>{};
}
template <class... Before, class First, class... Rest, class New>
constexpr auto with_slot(SlotList<Before...>, SlotList<First, Rest...>, New) {
  if constexpr (share_a_form(First{}, New{}))
    return SlotList<Before..., decltype(united(First{}, New{})), Rest...>{};
  else
    return with_slot(SlotList<Before..., First>{}, SlotList<Rest...>{}, New{});
}

template <class List>
constexpr auto joined(List list, SlotList<>) {
  return list;
}
template <class List, class First, class... More>
constexpr auto joined(List list, SlotList<First, More...>) {
  return joined(with_slot(SlotList<>{}, list, First{}), SlotList<More...>{});
}
template <class... A, class... B>
constexpr auto joined(Together<A...>, Together<B...>) {
  return Together<A..., B...>{};
}

/// A list that an effect's PairSlots do not define is empty.
template <class Effect>
constexpr auto density_of() {
  if constexpr (requires { typename Effect::density; })
    return typename Effect::density{};
  else
    return SlotList<>{};
}
template <class Effect>
constexpr auto rates_of() {
  if constexpr (requires { typename Effect::rates; })
    return typename Effect::rates{};
  else
    return SlotList<>{};
}
template <class Effect>
constexpr auto alone_of() {
  if constexpr (requires { typename Effect::alone; })
    return typename Effect::alone{};
  else
    return Together<>{};
}
template <class Effect>
constexpr auto timed_of() {
  if constexpr (requires { typename Effect::timed; })
    return typename Effect::timed{};
  else
    return Together<>{};
}

template <class All>
constexpr auto joined_all(All all) {
  return all;
}
template <class All, class First, class... More>
constexpr auto joined_all(All all, First first, More... more) {
  return joined_all(joined(all, first), more...);
}

template <bool finds, class... Slots>
AnyPass<finds, Slots...> pass_of(SlotList<Slots...>);

/// The terms of a form, of a slot and of a pass.
template <class Term>
constexpr auto terms_of(std::type_identity<Term>) {
  return Together<Term>{};
}
template <class... Terms>
constexpr auto terms_of(std::type_identity<Together<Terms...>>) {
  return Together<Terms...>{};
}
template <class... Forms>
constexpr auto terms_of(std::type_identity<Slot<Forms...>>) {
  return joined_all(Together<>{}, terms_of(std::type_identity<Forms>{})...);
}
template <bool finds, class... Slots>
constexpr auto terms_of(std::type_identity<AnyPass<finds, Slots...>>) {
  return joined_all(Together<>{}, terms_of(std::type_identity<Slots>{})...);
}
template <class... Terms>
constexpr std::array<PairTerm, sizeof...(Terms)> list_of(Together<Terms...>) {
  return {pair_term<Terms>...};
}

/// The pass of one term, by its key.
template <int L, class ForUnit, class... Terms>
PassFunction alone(Together<Terms...>, const PairTerm& wanted) {
  PassFunction f = {};
  static_cast<void>(
      ((pair_term<Terms>.key == wanted.key && (f = Pick<L, ForUnit, false, Together<Terms>>::get(nullptr), true)) || ...));
  return f;
}

}  // namespace detail

/// The passes of a list of effects, in its order.
template <class... Effects>
struct PassesOf {
  using Density = decltype(detail::pass_of<true>(detail::joined_all(SlotList<>{}, detail::density_of<Effects>()...)));
  using Rates = decltype(detail::pass_of<false>(detail::joined_all(SlotList<>{}, detail::rates_of<Effects>()...)));
  using Alone = decltype(detail::joined_all(Together<>{}, detail::alone_of<Effects>()...));
  using Timed = decltype(detail::joined_all(Together<>{}, detail::timed_of<Effects>()...));
  /// All that are compiled, each as often as a form has it.
  static constexpr auto terms = detail::list_of(detail::joined_all(detail::terms_of(std::type_identity<Density>{}),
                                                                   detail::terms_of(std::type_identity<Rates>{}), Alone{}));

  /// Null where there is no such term.
  template <int L, class ForUnit>
  [[nodiscard]] static PassFunction alone(const PairTerm& term) {
    return detail::alone<L, ForUnit>(Alone{}, term);
  }
  template <int L, class ForUnit>
  [[nodiscard]] static PassFunction timed() {
    return detail::Pick<L, ForUnit, false, Timed>::get(nullptr);
  }
};

}  // namespace tripoint

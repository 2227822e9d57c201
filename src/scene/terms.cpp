// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "scene/effect_rule.hpp"
#include "scene/shared_terms.hpp"
#include "tables/nearest.hpp"

/// Every term of two forms, as those to whom they belong declare them.
namespace tripoint {
namespace {

/// Terms of no effect: each sum over neighbours has a kernel, and each step a scheme.
std::vector<DeclaredTerm> terms_of_no_effect() {
  return {{term::kernel, {{"wendland", "one kernel for all, with its lattice sums (8.1)"}}, TermKind::kernel},
          {term::time, {{"kick-drift-kick", "kick, drift, kick"}}, TermKind::time}};
}

std::vector<DeclaredTerm> all_terms() {
  std::vector<DeclaredTerm> list;
  const auto add = [&](const DeclaredTerm& one) {
    if (std::ranges::find(list, one.term, &DeclaredTerm::term) != list.end())
      throw std::logic_error("the term " + std::string(one.term.name) + " is declared twice");
    list.push_back(one);
  };
  for (const EffectRule& rule : effect_rules()) std::ranges::for_each(rule.terms, add);
  std::ranges::for_each(terms_of_no_effect(), add);
  std::ranges::stable_sort(list, {}, &DeclaredTerm::kind);
  return list;
}

bool has(const std::vector<DeclaredTerm>& list, const Term& t) {
  return std::ranges::find(list, t, &DeclaredTerm::term) != list.end();
}

}  // namespace

std::span<const DeclaredTerm> declared_terms() {
  static const std::vector<DeclaredTerm> all = all_terms();
  return all;
}

Term term_from(std::string_view word) {
  std::vector<std::string> words;
  for (const DeclaredTerm& one : declared_terms()) {
    if (one.term.name == word) return one.term;
    words.emplace_back(one.term.name);
  }
  throw InputError("`" + printable(word) + "` is no term of the model" + suggestion(word, words));
}

std::vector<Term> acting_terms(const Scene& s) {
  std::vector<Term> list;
  std::vector<DeclaredTerm> called;
  for (const EffectRule& rule : effect_rules())
    if (calls_for(s, rule.name)) called.insert(called.end(), rule.terms.begin(), rule.terms.end());
  if (called.empty()) return list;
  for (const DeclaredTerm& one : declared_terms())
    if (acts_everywhere(one.term) || has(called, one.term)) list.push_back(one.term);
  return list;
}

bool acts_everywhere(const Term& t) { return t == term::time; }

bool reads_term(const EffectRule& rule, const Term& t) {
  return has(rule.terms, t) || std::ranges::find(rule.terms_shared, t) != rule.terms_shared.end();
}

Mode Scene::mode_of_unresolved(const Term& t) {
  if (std::ranges::find(declared_terms(), t, &DeclaredTerm::term) == declared_terms().end())
    throw UndeclaredTerm(t.name);
  return Mode::corrected;
}

bool Scene::has_liquid() const {
  return !inflows.empty() ||
         std::ranges::any_of(bodies, [](const Body& b) { return b.phase == Phase::liquid; });
}

bool Scene::clamps() const { return mode_of(term::clamp) == Mode::corrected; }

bool Scene::all_printed() const {
  return std::ranges::all_of(declared_terms(), [&](const DeclaredTerm& one) {
    return !one.has_equation || mode_of(one.term) == Mode::paper;
  });
}

double Scene::default_support_ratio() const {
  if (all_printed()) return printed_support;
  return has_brought_form(term::pressure) ? flowing_support : corrected_support;
}

void Scene::resolve_modes() {
  modes.clear();
  for (const DeclaredTerm& one : declared_terms()) {
    const auto given = modes_given.find(one.term);
    modes[one.term] = given != modes_given.end() ? given->second : mode;
  }
}

void Scene::set_all_modes(Mode m) {
  for (const DeclaredTerm& one : declared_terms()) modes[one.term] = m;
}

}  // namespace tripoint

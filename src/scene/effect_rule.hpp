// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "scene/scene.hpp"
#include "tables/key_table.hpp"

/// Facts about an effect for code that reads scenes and runs nothing. Each effect's rule stands in its
/// folder, in rule.cpp; a build without the effect has its rule all the same.
namespace tripoint {

class TableReader;

/// An effect that a scene calls for, and why.
struct CalledEffect {
  std::string name;  ///< of its rule
  std::string why;
};
[[nodiscard]] std::vector<CalledEffect> called_effects(const Scene&);
/// The effects that a scene does without, and the proof that each can never act.
[[nodiscard]] std::vector<CalledEffect> idle_effects(const Scene&);

/// Effects that a scene has called for so far.
class Called {
 public:
  explicit Called(const std::vector<CalledEffect>& list) : list_(list) {}
  [[nodiscard]] bool operator()(std::string_view effect) const {
    for (const CalledEffect& e : list_)
      if (e.name == effect) return true;
    return false;
  }

 private:
  const std::vector<CalledEffect>& list_;
};

/// A key of the case file that an effect brings: its row, and the member that keeps the value. Without a
/// member it is a number of Scene::values or Material::values, by the key's name; where no reader made them,
/// it has the row's fallback.
struct EffectKey {
  /// The effect's settle_material() reads it.
  struct ByRule {};
  Key row;
  std::variant<std::monostate, ByRule, double Scene::*, bool Scene::*, ViscosityForm Scene::*,
               double Material::*, bool Material::*, std::optional<double> Material::*>
      kept_in{};
  /// Why a value in this scene changes nothing although the effect is on; "" = it acts. None: it acts
  /// wherever the effect is on.
  std::string (*idle)(const Scene&) = nullptr;
  /// Of [[material]]: matter beyond it yields or breaks; `tripoint check` tells where nothing ever can
  bool limit = false;
};

/// The row of a number of [scene] that old files have: a word of [model] says it now, or nothing does.
[[nodiscard]] constexpr Key old_key(std::string_view name, Range range, std::string_view fallback,
                                    std::string_view meaning) {
  return {"scene", name, ValueType::number, "", range, fallback, "", "", meaning, true};
}

/// A key of [scene] that stands with those of no effect (scene_records.hpp), and acts where its effect is on.
struct SceneKey {
  std::string_view name;
  bool (*serves)(const Scene&) = nullptr;  ///< whether something that is no effect reads it in this scene
};

/// A key of a material that says nothing to any run of a case, and what to write instead.
struct WrongKey {
  std::string_view key;
  std::string why;
};

/// Kinds of terms with two forms, in the order in which jobs and pages list terms.
enum class TermKind { kernel, law, time };

/// A form of a term: a word of the table [model] (model.hpp).
struct ModelForm {
  std::string_view word, meaning;
  /// Keys of [scene] that it sets, each with its value: a flag's 0 or 1, the place of a word among those of
  /// its key.
  std::vector<std::pair<std::string_view, double>> values{};
};

/// A term with a printed form, as its owner declares it. Its last form is always "paper".
struct DeclaredTerm {
  Term term;
  std::vector<ModelForm> forms;  ///< corrected ones, the default first
  TermKind kind = TermKind::law;
  bool has_equation = true;  ///< that the paper prints: else no default waits for its printed form
  std::string_view name{};   ///< in [model], where the term's own is no noun
  DeclaredTerm(const Term& t,
               std::vector<ModelForm> corrected = {{"corrected", "the corrected form"}}) noexcept
      : term(t), forms(std::move(corrected)) {}
  DeclaredTerm(const Term& t, std::vector<ModelForm> corrected, TermKind k, bool printed = true) noexcept
      : term(t), forms(std::move(corrected)), kind(k), has_equation(printed) {}
};

/// A term that the paper does not have. Its last form leaves it out.
struct ModelChoice {
  std::string_view name;
  std::vector<ModelForm> forms;
  std::string_view why;  ///< reason of its default
};

/// A form that an effect brings to a term of another effect.
struct BroughtForm {
  Term term;
  ModelForm form;
  bool leads = false;  ///< taken where the file names no form of the term and the effect would act
};

/// An entry of the ledger of energy, and what it holds: a row of docs/case-file.md.
struct LedgerEntry {
  std::string_view name;
  std::string_view holds{};  ///< empty where another effect that tells it too says so
};

struct EffectRule {
  std::string_view name;
  /// The body or other item that calls for the effect, and why: "body a: elastic, and not held in place". ""
  /// = none does.
  std::string (*called_for)(const Scene&) = nullptr;
  /// The proof that it can never act, asked where nobody calls for it. Both empty: it only serves others.
  std::string (*left_out)(const Scene&) = nullptr;
  /// The need that effects called for, or needed before this one, have of it; "" = none. Asked where nobody
  /// calls for it.
  std::string (*needed_for)(const Scene&, const Called&) = nullptr;
  /// Terms with a printed form that act where the effect is on: a key of [model] and rows of `tripoint
  /// ablate` each.
  std::vector<DeclaredTerm> terms{};
  std::vector<Term> terms_shared{};    ///< of others that its forms read too
  std::vector<ModelChoice> choices{};  ///< terms that the paper does not have: the same as `terms`
  std::vector<BroughtForm> forms{};    ///< of terms of others
  std::vector<EffectKey> keys{};       ///< of [scene] and [[material]]
  std::vector<SceneKey> scene_keys{};
  std::vector<std::string_view> scene_keys_shared{};  ///< keys of others that it reads too
  /// Checks keys of a material against each other, once all are read: refuses impossible values, and sets
  /// those that a rule gives.
  void (*settle_material)(TableReader&, Material&) = nullptr;
  /// Keys of a material that fit no run of a case, asked where the effect is on in one. @param runs the scene
  /// in each mode
  std::vector<WrongKey> (*wrong_keys)(const Material&, std::span<const Scene> runs) = nullptr;
  std::vector<LedgerEntry> ledger_entries{};  ///< that it tells, or that take the work of its forces
  /// Of these those that every scene with forces tells, 0 where the effect is off: reports put scenes side by
  /// side.
  std::vector<std::string_view> (*always_reported)(const Scene&) = nullptr;
  bool over_processes = false;  ///< it also runs where several processes share a scene (State::halo)

  // What the rest of the program must know of a scene that calls for it; calls_for(scene, &EffectRule::...)
  // asks.
  bool has_pairs = false;             ///< particles act on each other by it, so that the scene has neighbours
  bool has_pressure = false;          ///< it needs a stiffness, and presses apart what overlaps
  bool has_bonds = false;             ///< solids are held together by bonds, or get and lose some by it
  bool makes_bodies = false;          ///< there can be solid bodies later where there is none at the start
  bool deforms_bodies = false;        ///< the particles of a solid body can move by themselves
  bool frees_particles = false;       ///< what is fixed at the start can move later
  bool changes_temperatures = false;  ///< temperatures change by it even where all are equal
};

/// Rules of every effect, in the order in which effects run.
[[nodiscard]] std::span<const EffectRule> effect_rules();

/// Entries that the ledger can have, each once: those of all effects, and those of every scene.
[[nodiscard]] std::vector<LedgerEntry> ledger_entries();

/// Every term of two forms, in the order of jobs and pages: those that effects declare, the kernel, and the
/// scheme of steps.
/// @throws std::logic_error where two effects declare one term
[[nodiscard]] std::span<const DeclaredTerm> declared_terms();
/// The term of a word of [modes]. @throws InputError naming the nearest word, or all
[[nodiscard]] Term term_from(std::string_view word);
/// Terms with two forms that act in a scene: those of the effects that it calls for and, if any, of the step
/// scheme.
[[nodiscard]] std::vector<Term> acting_terms(const Scene&);
/// Whether a term acts in every scene, whatever it calls for.
[[nodiscard]] bool acts_everywhere(const Term&);
/// Whether a term acts wherever the effect of this rule is on: its own, or one that its forms read.
[[nodiscard]] bool reads_term(const EffectRule&, const Term&);

/// The number of a key without a member: as it is kept, else the row's fallback, 0 where it has none.
[[nodiscard]] double kept_number(const EffectValues&, const Key&);

/// The number of a key of [scene] that an effect brings, 0 where the key changes nothing in this scene
/// (EffectKey::idle). Whether the scene calls for the effect is not asked. @pre an effect brings the key, and
/// it is a number
[[nodiscard]] double acting_number(const Scene&, std::string_view key);

/// Reach of the first bonds of elastic bodies, and support of the kernel (17) [spacings]: scene.bond_reach.
[[nodiscard]] double bond_reach(const Scene&);

/// Whether a scene calls for that one effect.
[[nodiscard]] bool calls_for(const Scene&, std::string_view effect);
/// Whether it calls for an effect that says this of itself.
[[nodiscard]] bool calls_for(const Scene&, bool EffectRule::*says);
/// Effects that a scene calls for, and those that these in turn need.
[[nodiscard]] std::vector<CalledEffect> needed_effects(const Scene&);

// --- what rules ask

/// "WHO: why", "" where nobody.
[[nodiscard]] std::string because(const std::string& who, std::string_view why);

/// Names of the bodies that a test picks: "body a", "bodies a, b"; "" when it picks none.
using BodyTest = bool (*)(const Scene&, const Body&, const Material&);
[[nodiscard]] std::string bodies_where(const Scene&, BodyTest);
[[nodiscard]] bool any_body(const Scene&, BodyTest);
[[nodiscard]] bool any_material(const Scene&, bool (*test)(const Material&));
/// A body that is held for good needs no equations of motion.
[[nodiscard]] bool moves(const Scene&, const Body&);
/// "density is as printed", of the first of these terms that is; "" where all are corrected.
[[nodiscard]] std::string printed_among(const Scene&, std::initializer_list<Term>);

/// The body or material that melts or freezes: the scene's temperatures pass t_melt or t_solid of the
/// material. "" = none.
[[nodiscard]] std::string who_changes_phase(const Scene&);
/// The body or material that is elastic once it has frozen, of a material that passes the test.
[[nodiscard]] std::string who_freezes_elastic(const Scene&, bool (*limited)(const Material&));
/// For a limit of elastic matter, as of yield or fracture. It gives the body that has it or freezes with it,
/// and what it `can` do then. `limit` names it with its article.
[[nodiscard]] std::string limit_called_for(const Scene&, bool (*limited)(const Material&),
                                           std::string_view limit, std::string_view can);
/// Why that limit never acts.
[[nodiscard]] std::string limit_left_out(const Scene&, bool (*limited)(const Material&),
                                         std::string_view limit);

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "scene/scene.hpp"
#include "tables/nearest.hpp"

/// Words of the case file for the enumerations of the scene, and look-up by name.
namespace tripoint {
namespace {

constexpr std::array phase_words{"liquid", "elastic", "rigid"};
constexpr std::array motion_words{"free", "fixed", "prescribed"};
constexpr std::array mode_words{"corrected", "paper"};
constexpr std::array solid_words{"elastic", "rigid"};

template <class E, std::size_t n>
E from_word(std::string_view word, const std::array<const char*, n>& words, const char* what) {
  for (std::size_t i = 0; i < n; ++i)
    if (word == words[i]) return static_cast<E>(i);
  throw InputError("`" + printable(word) + "` is no " + what +
                   suggestion(word, {words.begin(), words.end()}));
}

template <class T>
const T& by_name(const std::vector<T>& list, std::string_view name, const char* what) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const T& t) { return t.name == name; });
  if (found != list.end()) return *found;
  std::vector<std::string> names;
  names.reserve(list.size());
  for (const auto& t : list) names.push_back(t.name);
  throw InputError(std::string("no ") + what + " is named `" + printable(name) + "`" +
                   suggestion(name, names));
}

}  // namespace

std::string_view to_string(Phase p) { return phase_words[static_cast<std::size_t>(p)]; }
std::string_view to_string(Motion m) { return motion_words[static_cast<std::size_t>(m)]; }
std::string_view to_string(Mode m) { return mode_words[static_cast<std::size_t>(m)]; }
std::string_view to_string(SolidKind s) { return solid_words[static_cast<std::size_t>(s)]; }
Phase phase_from(std::string_view word) { return from_word<Phase>(word, phase_words, "phase"); }
Motion motion_from(std::string_view word) { return from_word<Motion>(word, motion_words, "motion"); }
Mode mode_from(std::string_view word) { return from_word<Mode>(word, mode_words, "mode"); }

const Material& Scene::material(std::string_view name) const { return by_name(materials, name, "material"); }
const Body& Scene::body(std::string_view name) const { return by_name(bodies, name, "body"); }

}  // namespace tripoint

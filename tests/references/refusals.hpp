// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include <functional>

#include "references/melting.hpp"
#include "references/solids.hpp"
#include "validation/references/reference.hpp"

/// Changes of a scene that an exact solution holds for, and the words in which it refuses each.
namespace tripoint::test {

using Change = std::function<void(Prepared&, Settings&)>;

/// The words of the refusal, or none.
inline std::string refusal(Prepared s, const std::string& name, Settings args, const Change& change) {
  change(s, args);
  try {
    (void)make_reference(function(name, args), s.job, s.initial);
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

struct Fault {
  const char* words;
  Change change;
};

inline void hold(const std::string& function, const Prepared& s, const Settings& args,
                 const std::vector<Fault>& rows) {
  for (const auto& row : rows) {
    const auto said = refusal(s, function, args, row.change);
    if (*row.words)
      EXPECT_NE(said.find(row.words), std::string::npos) << function << ": " << row.words << " / " << said;
    else
      EXPECT_EQ(said, "") << function;
  }
}

inline const Fault as_it_is{"", [](Prepared&, Settings&) {}};
inline const Fault no_gravity{"gravity", [](Prepared& s, Settings&) { s.job.scene.gravity = {}; }};

}  // namespace tripoint::test

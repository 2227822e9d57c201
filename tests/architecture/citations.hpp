// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "architecture/rules.hpp"

/// Citations in comments and messages: of an equation of the paper, of a section of docs/model.md, of a decision, of a source.
namespace tripoint::architecture {

/// Text that a reader reads: a block of comment lines, or a literal.
struct Prose {
  std::size_t line = 0;  ///< of its first line, from 1
  std::string text;      ///< lines of a comment without their slashes, with '\n' between
};
/// Comments and literals of a C++ source, in order; what follows a # in Python and TOML; a Markdown page as it is.
[[nodiscard]] std::vector<Prose> prose_of(const Source& source);

struct Citation {
  std::string path;
  std::size_t line = 0;
  std::string target;  ///< "eq-7", "8-4", "7", "fig-5", "decision-6" or "source Wendland 1995"
};
[[nodiscard]] std::vector<Citation> citations_of(const Source& source);

/// What citations may lead to.
struct Targets {
  std::set<std::string> anchors;  ///< of docs/model.md: "eq-7", "8-4-walls"
  std::set<int> decisions;        ///< numbers of the files in docs/decisions
  std::set<std::string> sources;  ///< first cells of the table of REFERENCES.md
};
/// Ids of `<a id="...">`.
[[nodiscard]] std::set<std::string> anchors_of(std::string_view page);
[[nodiscard]] std::set<std::string> sources_of(std::string_view references);
/// A section may be cited by its number alone: "8-4" for the anchor "8-4-walls".
[[nodiscard]] bool resolves(const Citation&, const Targets&);

/// A link of a Markdown page: "guards.md", "#eq-7", "../REFERENCES.md".
struct Link {
  std::size_t line = 0;
  std::string file, anchor;
};
/// Links to files and anchors of the project.
[[nodiscard]] std::vector<Link> links_of(std::string_view page);
/// Ids of `<a id="...">` and of the headings, as GitHub forms them.
[[nodiscard]] std::set<std::string> link_targets_of(std::string_view page);

/// Words in single back-quotes, outside code blocks.
[[nodiscard]] std::vector<std::string> quoted_words(std::string_view page);

}  // namespace tripoint::architecture

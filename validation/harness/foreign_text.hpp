// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>

/// Text that others wrote (names and reasons of engines, cases, metrics, files), made harmless for the place that it is written
/// to.
namespace tripoint {

/// For a line of a terminal or a log: line breaks become spaces; other control characters, marks that turn the direction of
/// writing and bytes that are no UTF-8 become '?'. So no name begins a line of its own, colours it or hides it.
[[nodiscard]] std::string one_line(std::string_view);

/// For Markdown, cells of tables included: one line, in which markup, tags, links, mentions and references to issues are text.
[[nodiscard]] std::string markdown(std::string_view);

/// For XML and SVG, as text or in quotes: one line, in which markup is text.
[[nodiscard]] std::string xml(std::string_view);

/// For the path of a URL: what is no letter, digit or one of -._~/ is written %XX.
[[nodiscard]] std::string url_path(std::string_view);

/// For a workflow command of GitHub: what would end its line, and in a property also what would end the property; control
/// characters and commands of the old form are text.
[[nodiscard]] std::string command_text(std::string_view, bool property);

/// For the log of a runner, line by line: no line begins a workflow command (`::error::`, also behind spaces) and none holds one
/// of the old form (`##[error]`).
[[nodiscard]] std::string without_commands(const std::string& lines);

}  // namespace tripoint

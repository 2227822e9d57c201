// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>

/// Text that others wrote (names and reasons of engines, cases, metrics, files), made harmless for the place
/// that it is written to.
namespace tripoint {

/// Text for a line of a terminal or a log. Line breaks become spaces. Other control characters, marks that
/// turn the direction of writing and bytes that are no UTF-8 become '?'. So no name begins a line of its own,
/// colours it or hides it.
[[nodiscard]] std::string one_line(std::string_view);

/// For Markdown, cells of tables included: one line, in which markup, tags, links, mentions and references to
/// issues are text.
[[nodiscard]] std::string markdown(std::string_view);

/// For XML and SVG, as text or in quotes: one line, in which markup is text.
[[nodiscard]] std::string xml(std::string_view);

/// Text for the path of a URL: a byte that is no letter, digit or one of -._~/ is written %XX.
[[nodiscard]] std::string url_path(std::string_view);

/// Text for a workflow command of GitHub. Characters that would end its line, or in a property the property,
/// are escaped. Control characters and commands of the old form become text.
[[nodiscard]] std::string command_text(std::string_view, bool property);

/// Text for the log of a runner, line by line. No line begins a workflow command (`::error::`, also behind
/// spaces), and none holds one of the old form (`##[error]`).
[[nodiscard]] std::string without_commands(const std::string& lines);

}  // namespace tripoint

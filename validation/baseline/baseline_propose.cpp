// SPDX-License-Identifier: BSD-3-Clause
#include "validation/baseline/baseline_propose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "validation/results/escaped_text.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t context = 3;  // lines of a hunk that stay as they are, on either side

struct Line {
  char sign;  ///< ' ', '-' or '+'
  std::string text;
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Both texts as one list, by their longest common subsequence.
std::vector<Line> aligned(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  std::vector<std::vector<std::size_t>> common(a.size() + 1, std::vector<std::size_t>(b.size() + 1, 0));
  for (std::size_t i = a.size(); i-- > 0;)
    for (std::size_t j = b.size(); j-- > 0;)
      common[i][j] = a[i] == b[j] ? common[i + 1][j + 1] + 1 : std::max(common[i + 1][j], common[i][j + 1]);
  std::vector<Line> list;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    if (i < a.size() && j < b.size() && a[i] == b[j]) {
      list.push_back({' ', a[i]});
      ++i;
      ++j;
    } else if (i < a.size() && (j == b.size() || common[i + 1][j] >= common[i][j + 1]))
      list.push_back({'-', a[i++]});
    else
      list.push_back({'+', b[j++]});
  }
  return list;
}

std::string range(std::size_t first, std::size_t count) {
  return fmt::format("{},{}", count == 0 ? first : first + 1, count);
}

std::string hunk(const std::vector<Line>& list, std::size_t from, std::size_t to) {
  const auto count = [&](std::size_t begin, std::size_t end, char other) {
    return static_cast<std::size_t>(std::count_if(list.begin() + static_cast<long>(begin),
                                                  list.begin() + static_cast<long>(end),
                                                  [&](const Line& l) { return l.sign != other; }));
  };
  std::string text = fmt::format("@@ -{} +{} @@\n", range(count(0, from, '+'), count(from, to, '+')),
                                 range(count(0, from, '-'), count(from, to, '-')));
  for (std::size_t k = from; k < to; ++k) text += list[k].sign + list[k].text + "\n";
  return text;
}

std::string file_patch(const Proposal& p, const std::string& root) {
  const auto path = fs::path(p.file).lexically_relative(root).generic_string();
  const std::string from = p.before.empty() ? "/dev/null" : "a/" + path;
  return fmt::format("diff --git a/{0} b/{0}\n{1}--- {2}\n+++ b/{0}\n{3}", path,
                     p.before.empty() ? "new file mode 100644\n" : "", from, unified_diff(p.before, p.after));
}

/// A word of a shell's command line.
std::string word(const std::string& text) {
  const bool plain =
      !text.empty() &&
      text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./") ==
          std::string::npos;
  if (plain) return text;
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

/// Behind a mark, so that no line of it is taken for a part of the patch.
std::string commented(const std::string& text) {
  std::string out;
  for (const auto& line : lines_of(text)) out += "# " + one_line(line) + "\n";
  return out;
}

}  // namespace

std::string unified_diff(const std::string& before, const std::string& after) {
  const auto list = aligned(lines_of(before), lines_of(after));
  std::string text;
  for (std::size_t k = 0; k < list.size();) {
    if (list[k].sign == ' ') {
      ++k;
      continue;
    }
    std::size_t last = k;  // the last changed line that is less than two contexts behind the one before
    for (std::size_t n = k; n < list.size() && n <= last + 2 * context; ++n)
      if (list[n].sign != ' ') last = n;
    const std::size_t to = std::min(list.size(), last + 1 + context);
    text += hunk(list, k > context ? k - context : 0, to);
    k = to;
  }
  return text;
}

std::string patch_root(const std::string& baseline) {
  const auto file = fs::weakly_canonical(baseline);
  for (auto folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
    if (fs::exists(folder / ".git")) return folder.string();
  for (auto folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path())
    if (folder.filename() == "baselines") return folder.parent_path().string();
  return file.parent_path().string();
}

std::string patch_text(const std::vector<Proposal>& list, const std::string& results_file,
                       const std::string& root, bool undecided) {
  std::string ids, changes, patch;
  int count = 0;
  for (const auto& p : list) {
    if (p.before == p.after || (p.changes.empty() && p.removed.empty()))
      continue;  // accepted as it stands: only the reason would be new
    ++count;
    ids += " " + word(p.id);
    changes += p.changes + p.removed;
    patch += file_patch(p, root);
  }
  if (count == 0) return "# No baseline would change: nothing is proposed.\n";
  std::string text = fmt::format(
      "Proposed by tripoint gate propose: {} baseline{}. This file accepts nothing{}\nTo accept, decide and "
      "call:\ntripoint gate "
      "accept --reason 'who decided what, and why' {}{}\n",
      count, count == 1 ? "" : "s",
      undecided ? ", and applied as it comes it is red: its reason says that nobody has decided."
                : "; whoever applies and commits it does.",
      word(results_file), ids);
  return commented(text + changes) + patch;
}

}  // namespace tripoint

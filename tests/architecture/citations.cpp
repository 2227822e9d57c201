// SPDX-License-Identifier: BSD-3-Clause
#include "architecture/citations.hpp"

#include <algorithm>
#include <cctype>
#include <regex>

namespace tripoint::architecture {
namespace {

std::size_t line_at(std::string_view text, std::size_t at) {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

/// Reads a C++ source from its start to its end and keeps what is prose.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {}
  std::vector<Prose> read() {
    while (at_ < text_.size()) {
      if (starts("//"))
        line_comment();
      else if (starts("/*"))
        block_comment();
      else if (starts("R\""))
        raw_literal();
      else if (text_[at_] == '"')
        literal();
      else if (text_[at_] == '\'')
        skip_character();
      else
        ++at_;
    }
    return std::move(found_);
  }

 private:
  [[nodiscard]] bool starts(std::string_view word) const { return text_.substr(at_).starts_with(word); }
  void keep(std::size_t from, std::string_view text) { found_.push_back({line_at(text_, from), std::string(text)}); }

  /// Lines of comment that follow each other are one text: a citation may be broken between them.
  void line_comment() {
    const std::size_t from = at_, end = std::min(text_.find('\n', at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    line.remove_prefix(std::min(line.find_first_not_of("/!<"), line.size()));
    at_ = end;
    const std::size_t before = text_.find_last_not_of(" \t", from == 0 ? 0 : from - 1);
    const bool alone = from == 0 || before == std::string_view::npos || text_[before] == '\n';
    if (alone && !found_.empty() && comment_ends_ == line_at(text_, from) - 1)
      found_.back().text.append("\n").append(line);
    else
      keep(from, line);
    comment_ends_ = line_at(text_, from);
  }
  void block_comment() {
    const std::size_t from = at_, end = std::min(text_.find("*/", at_ + 2), text_.size());
    keep(from, text_.substr(from + 2, end - from - 2));
    at_ = std::min(end + 2, text_.size());
  }
  void raw_literal() {
    const std::size_t open = std::min(text_.find('(', at_), text_.size());
    const std::string close = ")" + std::string(text_.substr(at_ + 2, open - at_ - 2)) + "\"";
    at_ = std::min(text_.find(close, open) + close.size(), text_.size());
  }
  void literal() {
    const std::size_t from = at_++;
    while (at_ < text_.size() && text_[at_] != '"' && text_[at_] != '\n') at_ += text_[at_] == '\\' ? 2 : 1;
    keep(from, text_.substr(from + 1, at_ - from - 1));
    ++at_;
  }
  /// A digit separator is no quote.
  void skip_character() {
    const bool separator = at_ > 0 && std::isalnum(static_cast<unsigned char>(text_[at_ - 1])) != 0;
    if (separator) return static_cast<void>(++at_);
    at_ += at_ + 1 < text_.size() && text_[at_ + 1] == '\\' ? 2 : 1;
    at_ = std::min(text_.find('\'', at_ + 1), text_.size() - 1) + 1;
  }

  std::string_view text_;
  std::size_t at_ = 0, comment_ends_ = 0;
  std::vector<Prose> found_;
};

std::vector<Prose> hashed_comments(std::string_view text) {
  std::vector<Prose> found;
  std::size_t number = 0;
  for (const auto line : lines_of(text)) {
    ++number;
    const auto hash = line.find('#');
    if (hash != std::string_view::npos) found.push_back({number, std::string(line.substr(hash + 1))});
  }
  return found;
}

template <class Found>
void each_match(const std::string& text, const std::regex& pattern, Found found) {
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) found(*at);
}

/// Takes the citations out of one text.
class Finder {
 public:
  Finder(const Source& source, const Prose& prose, std::vector<Citation>& list)
      : path_(source.path), line_(prose.line), text_(prose.text), list_(list) {}
  void run() {
    sources();
    sections();
    equations();
    const auto number = [](const std::smatch& m) { return std::to_string(std::stoi(m[1])); };
    static const std::regex decision("\\bdecisions?\\s+(\\d+)\\b"), figure("\\bFig\\.\\s+(\\d+)");
    each_match(text_, decision, [&](const std::smatch& m) { add(m, "decision-" + number(m)); });
    each_match(text_, figure, [&](const std::smatch& m) { add(m, "fig-" + number(m)); });
  }

 private:
  void add(const std::smatch& m, std::string target) {
    const auto at = static_cast<std::size_t>(m.position(0));
    list_.push_back(
        {path_,
         line_ + static_cast<std::size_t>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at), '\n')),
         std::move(target)});
  }
  /// [Author year, detail]. The numbers in it are those of that source, so it is blanked out.
  void sources() {
    static const std::regex pattern("\\[([A-Z][^\\[\\]]*?\\s(?:1[89]|20)\\d\\d)((?:,|;)[^\\[\\]]*)?\\]");
    std::string rest = text_;
    each_match(text_, pattern, [&](const std::smatch& m) {
      add(m, "source " + std::regex_replace(m[1].str(), std::regex("\\s+"), " "));
      std::fill_n(rest.begin() + m.position(0), m.length(0), ' ');
    });
    text_ = rest;
    if (!path_.starts_with("cases/")) loose_sources();  // data of cases carry their sources in the file
  }
  /// Author year, without brackets: in messages and on pages.
  void loose_sources() {
    static const std::regex pattern(
        "(?:^|[^\\w'])([A-Z][a-z'][A-Za-z']*(?:(?:, | & | and )[A-Z][A-Za-z']+)*(?: et al\\.)?) ((?:1[89]|20)\\d\\d)(?![\\d-])"),
        month("Jan|Feb|Mar|Apr|May|June?|July?|Aug|Sep|Oct|Nov|Dec");
    each_match(text_, pattern, [&](const std::smatch& m) {
      if (std::regex_match(m[1].str(), month)) return;
      add(m, "source " + std::regex_replace(m[1].str(), std::regex(" and "), " & ") + " " + m[2].str());
    });
  }
  /// "model 8.4", "model 2, 8.7", "model 8.1-8.5"; "(8.6)" alone beside one of these.
  void sections() {
    static const std::regex pattern("\\bmodel\\s+(\\d+(?:\\.\\d+)?)((?:(?:,\\s*|-|\\s+and\\s+)\\d+\\.\\d+)*)"),
        one("\\d+(\\.\\d+)?"), alone("(?:^|[^\\w])\\((8\\.\\d+)\\)");
    const auto cite = [&](const std::smatch& where, std::string number) {
      std::ranges::replace(number, '.', '-');
      add(where, number);
    };
    each_match(text_, pattern, [&](const std::smatch& m) {
      const std::string whole = m[1].str() + m[2].str();
      each_match(whole, one, [&](const std::smatch& section) { cite(m, section[0]); });
    });
    each_match(text_, alone, [&](const std::smatch& m) { cite(m, m[1]); });
  }
  /// "(7)" where nothing is called with 7; of "(10)-(17)" all between.
  void equations() {
    static const std::regex pattern("(?:^|[^\\w\\)\\]>])\\((\\d{1,2})\\)(?:\\s*(?:-|to)\\s*\\((\\d{1,2})\\))?");
    each_match(text_, pattern, [&](const std::smatch& m) {
      const int first = std::stoi(m[1]), last = m[2].matched ? std::stoi(m[2]) : first;
      for (int n = first; n <= last; ++n) add(m, "eq-" + std::to_string(n));
    });
  }

  const std::string& path_;
  std::size_t line_;
  std::string text_;
  std::vector<Citation>& list_;
};

/// As GitHub forms it: lower case, spaces to hyphens, nothing but letters, digits, hyphens and underlines.
std::string heading_id(std::string_view heading) {
  std::string id;
  for (const char c : heading) {
    if (c == ' ')
      id += '-';
    else if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || static_cast<unsigned char>(c) >= 0x80)
      id += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return id;
}

/// A page without its code blocks; lines keep their numbers.
std::string without_blocks(std::string_view page) {
  std::string kept;
  bool inside = false;
  for (const auto line : lines_of(page)) {
    const bool fence = line.starts_with("```");
    if (fence) inside = !inside;
    if (!inside && !fence && !line.starts_with("    ")) kept.append(line);
    kept += '\n';
  }
  return kept;
}

}  // namespace

std::vector<Prose> prose_of(const Source& source) {
  const auto is = [&](std::string_view ending) { return source.path.ends_with(ending); };
  if (is(".md")) return {{1, source.text}};
  return is(".py") || is(".toml") ? hashed_comments(source.text) : Reader(source.text).read();
}

std::vector<Citation> citations_of(const Source& source) {
  std::vector<Citation> list;
  for (const Prose& prose : prose_of(source)) Finder(source, prose, list).run();
  return list;
}

std::set<std::string> anchors_of(std::string_view page) {
  const std::string text(page);
  std::set<std::string> ids;
  each_match(text, std::regex("<a id=\"([^\"]+)\">"), [&](const std::smatch& m) { ids.insert(m[1]); });
  return ids;
}

std::set<std::string> sources_of(std::string_view references) {
  std::set<std::string> names;
  for (const auto line : lines_of(references)) {
    if (!line.starts_with("| ")) continue;
    const auto end = line.find(" |", 2);
    if (end != std::string_view::npos) names.emplace(line.substr(2, end - 2));
  }
  return names;
}

bool resolves(const Citation& citation, const Targets& targets) {
  constexpr std::string_view source = "source ", decision = "decision-";
  const std::string& target = citation.target;
  if (target.starts_with(source)) return targets.sources.contains(target.substr(source.size()));
  if (target.starts_with(decision)) return targets.decisions.contains(std::stoi(target.substr(decision.size())));
  return std::ranges::any_of(targets.anchors, [&](const std::string& anchor) {
    if (anchor == target) return true;
    const bool goes_on = anchor.starts_with(target + "-");
    return goes_on && std::isalpha(static_cast<unsigned char>(anchor[target.size() + 1])) != 0;  // "8-1-mass" is 8.1 and not 8
  });
}

std::vector<Link> links_of(std::string_view page) {
  const std::string text = without_blocks(page);
  std::vector<Link> links;
  each_match(text, std::regex("\\]\\(([^)\\s#]*)(#([^)\\s]+))?\\)"), [&](const std::smatch& m) {
    if (m[1].str().find(':') == std::string::npos)
      links.push_back({line_at(text, static_cast<std::size_t>(m.position(0))), m[1], m[3]});
  });
  return links;
}

std::set<std::string> link_targets_of(std::string_view page) {
  std::set<std::string> ids = anchors_of(page);
  const std::string text = without_blocks(page);
  for (const auto line : lines_of(text)) {
    const auto level = line.find_first_not_of('#');
    if (level > 0 && level != std::string_view::npos && line[level] == ' ') ids.insert(heading_id(line.substr(level + 1)));
  }
  return ids;
}

std::vector<std::string> quoted_words(std::string_view page) {
  const std::string text = without_blocks(page);
  std::vector<std::string> words;
  each_match(text, std::regex("`([^`\\n]+)`"), [&](const std::smatch& m) { words.push_back(m[1]); });
  return words;
}

}  // namespace tripoint::architecture

// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <CLI/CLI.hpp>

#include "program/cli/common.hpp"
#include "validation/results/verdict.hpp"

namespace tripoint {

std::string first_sentence(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.substr(0, std::min({text.find(". "), text.find(": "), text.find("; "), text.find("  ")}));
}

std::vector<std::string> EngineList::words() const {
  auto words = split(list);
  if (words.empty() && !joining.empty()) words.emplace_back(all_engines);
  for (auto& word : files_as_paths(joining)) words.push_back(std::move(word));
  return words;
}

void add_engines_option(CLI::App& command, EngineList& choice) {
  command.add_option("--engines", choice.list,
                     "A,B: only these; all,A: those of each case and A; names, or paths of executables");
  command
      .add_option_function<std::vector<std::string>>(
          "--engine",
          [&choice](const std::vector<std::string>& words) {
            choice.joining = words;
            note_earlier("--engine X", choice.list.empty() ? "--engines all,X" : "a word of --engines");
          },
          "")
      ->take_all()
      ->allow_extra_args(false)
      ->group("");
}

void note_earlier(const std::string& spelling, const std::string& now) {
  say(fmt::format("tripoint: note: {} is now {}", spelling, now));
}

void add_earlier_flag(CLI::App& command, const std::string& flag, const std::string& now,
                      const std::function<void()>& set) {
  command
      .add_flag_callback(flag,
                         [flag, now, set] {
                           note_earlier(flag, now);
                           set();
                         })
      ->group("");
}

std::string commands_of(const CLI::App& group) {
  std::string text;
  for (const auto* command : group.get_subcommands([](const CLI::App* c) { return !c->get_group().empty(); }))
    text += fmt::format("{} {}  {}\n", group.get_name(), command->get_name(),
                        first_sentence(command->get_description()));
  return text;
}

void list_when_alone(CLI::App& group, int& exit_code) {
  group.require_subcommand(0, 1);
  group.callback([&group, &exit_code] {
    if (!group.get_subcommands().empty()) return;
    say(fmt::format("tripoint: {}: name one of its commands:\n{}", group.get_name(), commands_of(group)));
    exit_code = exit_bad_input;
  });
}

std::vector<EngineEntry> engines_asked_for(const std::vector<std::string>& asked_words,
                                           Selection& selection) {
  auto words = sort_engine_words(asked_words);
  auto& wanted = std::erase(words.names, all_engines) > 0 ? selection.extra : selection.engines;
  wanted = words.names;
  for (const auto& path : words.paths) wanted.push_back(ask_engine(path).name);
  auto engines = discover_selected(selection, words.paths);
  auto& asked = selection.asked;
  for (const auto* list : {&selection.engines, &selection.extra})
    asked.insert(asked.end(), list->begin(), list->end());
  std::sort(asked.begin(), asked.end());
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  for (const auto& name : asked)
    if (!find_engine(engines, name)) say("tripoint: " + no_such_engine(name, discover_engines(words.paths)));
  return engines;
}

}  // namespace tripoint

// SPDX-License-Identifier: GPL-2.0-only
#include "adapters/ranks/last_words.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

namespace tripoint::ranks {

std::string words_file(const std::string& output, int rank) {
  return fmt::format("{}/rank-{}.log", output, rank);
}

void write_words(const std::string& file, const std::string& how_far) {
  const std::string next = file + ".part";
  std::ofstream(next) << fmt::format("{} process\n{}\n", ::getpid(), how_far);
  std::error_code ignored;  // words are a help; a full disk is told where frames are written
  std::filesystem::rename(next, file, ignored);
}

void note_end(const std::string& output, int rank, int status) {
  if (!WIFSIGNALED(status)) return;
  const std::string file = words_file(output, rank);
  std::error_code none;
  const bool has_words = std::filesystem::exists(file, none);
  std::ofstream out(file, std::ios::app);
  if (!has_words) out << "no process\n\n";
  out << fmt::format("was ended by signal {} ({})\n", WTERMSIG(status), ::strsignal(WTERMSIG(status)));
}

LastWords last_words(const std::string& output, int rank) {
  LastWords words;
  std::ifstream in(words_file(output, rank));
  std::string process;
  std::getline(in, process);
  std::getline(in, words.how_far);
  std::getline(in, words.end);
  return words;
}

}  // namespace tripoint::ranks

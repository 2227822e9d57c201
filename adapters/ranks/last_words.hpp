// SPDX-License-Identifier: GPL-2.0-only
#pragma once
#include <string>

/// What a rank leaves behind that ends without a word: how far it was, and how it ended. Each has a file for
/// that.
namespace tripoint::ranks {

/// Lines: the rank's process, how far it is, and after its end how it ended.
std::string words_file(const std::string& output, int rank);

/// Says how far this rank is. By a rename, so that the words of a rank that is killed here are those of
/// before, not half a line.
void write_words(const std::string& file, const std::string& how_far);

/// Adds the signal that ended the rank; one that ended by itself has said why elsewhere. Called by the
/// process that waited for it.
/// @param status as wait() gives it
void note_end(const std::string& output, int rank, int status);

struct LastWords {
  std::string how_far;  ///< empty: it had not begun to step
  std::string end;      ///< "was ended by signal 9 (Killed)"; empty: no signal did, or nobody saw it
};
LastWords last_words(const std::string& output, int rank);

}  // namespace tripoint::ranks

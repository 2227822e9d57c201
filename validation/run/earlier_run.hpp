// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <filesystem>
#include <string>

namespace tripoint {

/// Folder within that of a run, where the run that was there before lies meanwhile.
inline constexpr const char* earlier_run_folder = ".earlier-run";

/// The run that a folder holds, kept until a new run has begun in its place. A run that does not begin,
/// because its engine is missing, refuses it or fails at the start, leaves the folder as it was.
class EarlierRun {
 public:
  /// Sets the files aside, within the folder. A call that was killed before its run had begun is made good
  /// first.
  /// @param keeps_frames the new run goes on from a checkpoint of this folder: frames and checkpoints stay in
  /// place too
  EarlierRun(const std::string& folder, bool keeps_frames);
  ~EarlierRun();  ///< puts them back, unless they were let go
  EarlierRun(const EarlierRun&) = delete;
  EarlierRun& operator=(const EarlierRun&) = delete;
  [[nodiscard]] bool is_replaced() const;  ///< whether a new run has left frames in the folder
  void let_go() noexcept;                  ///< the new run stands in their place: removes them

 private:
  void put_back() const;
  std::filesystem::path folder_, aside_;
  bool kept_ = true;
};

}  // namespace tripoint

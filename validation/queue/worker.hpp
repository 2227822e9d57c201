// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

/// A worker: its name, the sign that it lives, and the jobs that it takes.
namespace tripoint {

/// Content of workers/NAME.json, and the conclusions from it.
struct WorkerSign {
  std::string name, host;
  std::string machine;  ///< boot and process namespace: where it is ours, the process can be asked for
  long pid = 0;
  /// Of the process, in ticks of its machine: a number that is used again is another worker
  std::string started;
  double age = 0.0;  ///< since the file was touched [s]
};

/// Seconds after which a worker of another machine that gave no sign counts as lost; it gives one every sixth
/// of that.
inline constexpr double lost_after = 60.0;

/// @param now_file a time of the same clock that stamps the workers' files [s]
[[nodiscard]] WorkerSign read_sign(const std::string& dir, const std::string& worker, double now_file);
/// A worker of this machine: whether the process is there. A worker of another: whether it gave a sign within
/// lost_after.
[[nodiscard]] bool is_alive(const WorkerSign&);
/// Whether the worker is of this machine, and its process is gone: nothing of it will be written again.
[[nodiscard]] bool is_gone(const WorkerSign&);
/// Time of the file system of DIR, by a file that is written there; our own clock where nothing can be
/// written [s].
[[nodiscard]] double file_clock(const std::string& dir);

class Worker {
 public:
  /// Puts its sign into DIR/workers and keeps it fresh until it is destroyed. @param number tells workers of
  /// one process apart
  Worker(std::string dir, int number);
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }
  /// Folder that nobody else writes to; runs are made there.
  [[nodiscard]] std::string workshop() const;

  /// Takes a job that waits. @return false where another was faster, or it does not wait
  [[nodiscard]] bool claim(const std::string& id) const;
  /// Takes a job from a worker that is lost, and leaves a note of it. @return false where another was faster
  [[nodiscard]] bool take_over(const std::string& id, const std::string& from) const;
  /// Gives a job back that it has not finished.
  void release(const std::string& id) const;
  /// Notes how a job ended; its run is published already. @param note one line
  void finish(const std::string& id, const std::string& note, bool failed) const;
  /// Notes that a job which it made has another's result.
  void note_double(const std::string& id, const std::string& note) const;

 private:
  void beat();
  std::string dir_, name_;
  std::mutex mutex_;
  std::condition_variable leaving_;
  bool leaves_ = false;
  std::thread heart_;
};

}  // namespace tripoint

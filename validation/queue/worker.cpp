// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/worker.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/errors.hpp"
#include "validation/queue/queue.hpp"
#include "validation/results/json_text.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

std::string text_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string host_name() {
  std::array<char, 256> name{};
  ::gethostname(name.data(), name.size() - 1);
  std::string host = name.data();
  for (auto& c : host)
    if (c == '/' || static_cast<unsigned char>(c) <= ' ') c = '-';
  return host.empty() ? "host" : host;
}

/// Process numbers mean something within one boot and one namespace of processes.
std::string this_machine() {
  std::error_code none;
  std::string boot = text_of("/proc/sys/kernel/random/boot_id");
  boot.erase(std::min(boot.find('\n'), boot.size()));
  return boot + " " + fs::read_symlink("/proc/self/ns/pid", none).string();
}

/// Field 22 of proc(5); empty where there is no such process, or it is dead and not yet buried.
std::string start_of(long pid) {
  const std::string line = text_of(fmt::format("/proc/{}/stat", pid));
  const auto name_end = line.rfind(')');
  if (name_end == std::string::npos) return {};
  std::istringstream fields(line.substr(name_end + 1));
  std::string field;
  for (int n = 3; n <= 22 && fields >> field; ++n)
    if (n == 3 && (field == "Z" || field == "X")) return {};
  return fields ? field : "";
}

/// Seconds since 1970 of a file's last change; negative where it is not there.
double changed_at(const std::string& file) {
  struct stat s {};
  return ::stat(file.c_str(), &s) == 0
             ? static_cast<double>(s.st_mtim.tv_sec) + 1e-9 * static_cast<double>(s.st_mtim.tv_nsec)
             : -1.0;
}

std::string sign_file(const std::string& dir, const std::string& worker) {
  return place(dir, state::workers, worker + ".json");
}

std::string claim_file(const std::string& dir, const std::string& id, const std::string& worker) {
  return place(dir, state::running, id + "." + worker);
}

bool renamed(const std::string& from, const std::string& to) {
  return std::rename(from.c_str(), to.c_str()) == 0;
}

void set_time_to_now(const std::string& file) { ::utimensat(AT_FDCWD, file.c_str(), nullptr, 0); }

}  // namespace

double file_clock(const std::string& dir) {
  const auto file = (fs::path(dir) / fmt::format(".clock.{}.{}", host_name(), ::getpid())).string();
  { std::ofstream out(file); }
  const double now = changed_at(file);
  ::unlink(file.c_str());
  if (now > 0.0) return now;
  return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
}

WorkerSign read_sign(const std::string& dir, const std::string& worker, double now_file) {
  WorkerSign sign;
  sign.name = worker;
  const auto file = sign_file(dir, worker);
  const double changed = changed_at(file);
  sign.age = changed < 0.0 ? std::numeric_limits<double>::infinity() : std::max(0.0, now_file - changed);
  const auto document = nlohmann::json::parse(text_of(file), nullptr, false);
  if (!document.is_object()) return sign;
  sign.host = document.value("host", "");
  sign.machine = document.value("machine", "");
  sign.pid = document.value("pid", 0L);
  sign.started = document.value("started", "");
  return sign;
}

bool is_gone(const WorkerSign& sign) {
  return sign.pid > 0 && sign.machine == this_machine() &&
         (sign.started.empty() || start_of(sign.pid) != sign.started);
}

bool is_alive(const WorkerSign& sign) {
  if (sign.pid > 0 && sign.machine == this_machine()) return !is_gone(sign);
  return sign.age < lost_after;
}

Worker::Worker(std::string dir, int number) : dir_(std::move(dir)) {
  const std::string started = start_of(::getpid());
  name_ = fmt::format("{}.{}.{}.{}", host_name(), ::getpid(), started, number);
  const nlohmann::ordered_json sign{
      {"host", host_name()}, {"machine", this_machine()}, {"pid", ::getpid()}, {"started", started}};
  write_by_rename(sign_file(dir_, name_), json_text(sign, -1), name_);
  heart_ = std::thread([this] { beat(); });
}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    leaves_ = true;
  }
  leaving_.notify_all();
  heart_.join();
  std::error_code none;
  fs::remove_all(workshop(), none);
  fs::remove(sign_file(dir_, name_), none);
}

void Worker::beat() {
  std::unique_lock lock(mutex_);
  while (
      !leaving_.wait_for(lock, std::chrono::duration<double>(lost_after / 6.0), [this] { return leaves_; }))
    set_time_to_now(sign_file(dir_, name_));
}

std::string Worker::workshop() const { return place(dir_, state::workers, name_); }

bool Worker::claim(const std::string& id) const {
  const auto mine = claim_file(dir_, id, name_);
  if (!renamed(place(dir_, state::todo, id), mine)) return false;
  set_time_to_now(mine);  // says since when it runs
  return true;
}

bool Worker::take_over(const std::string& id, const std::string& from) const {
  const auto mine = claim_file(dir_, id, name_);
  if (!renamed(claim_file(dir_, id, from), mine)) return false;
  set_time_to_now(mine);
  write_by_rename(place(dir_, state::lost, id + "." + from), "", name_);
  return true;
}

void Worker::release(const std::string& id) const {
  static_cast<void>(renamed(claim_file(dir_, id, name_), place(dir_, state::todo, id)));
}

void Worker::finish(const std::string& id, const std::string& note, bool failed) const {
  write_by_rename(place(dir_, failed ? state::failed : state::done, id), note + "\n", name_);
  ::unlink(claim_file(dir_, id, name_).c_str());
}

void Worker::note_double(const std::string& id, const std::string& note) const {
  write_by_rename(place(dir_, state::doubled, id + "." + name_), note + "\n", name_);
}

}  // namespace tripoint

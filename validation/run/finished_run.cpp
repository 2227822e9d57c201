// SPDX-License-Identifier: BSD-3-Clause
#include "validation/run/finished_run.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>

#include "core/durable_file.hpp"
#include "core/whole_number.hpp"
#include "files/foreign_file.hpp"
#include "files/job.hpp"
#include "files/trajectory.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr std::uintmax_t greatest_record = 1u << 20;

/// Beside the particles, which an engine only reads: a record is ours alone.
std::string record_file(const RunRequest& request) {
  const fs::path folder(request.folder), engine = folder.parent_path().filename(), run = folder.filename();
  return (fs::path(request.particles).parent_path() /
          ("outcome-" + engine.string() + "-" + run.string() + ".json"))
      .string();
}

/// Hash of the files that were left beside the record: the judged files must be those that the run wrote.
std::string hash_of_files(const RunRequest& request) {
  const fs::path folder(request.folder);
  std::string all;
  for (const char* name : {"job.json", "result.json", "trajectory.h5", "trajectory.csv", "gauges.csv"})
    all += file_hash((folder / name).string()) + '\0';
  return text_hash(all);
}

/// Fills a part from a file, but for the last one. @return bytes, 0 at the end, -1 where it cannot be read
ssize_t read_fully(int file, std::string& part) {
  std::size_t got = 0;
  while (got < part.size()) {
    const ssize_t n = ::read(file, part.data() + got, part.size() - got);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return n;
    if (n == 0) break;
    got += static_cast<std::size_t>(n);
  }
  return static_cast<ssize_t>(got);
}

}  // namespace

std::string file_hash(const std::string& file) {
  const int in = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);  // a pipe would keep us waiting
  struct stat is {};
  if (in < 0 || ::fstat(in, &is) != 0 || !S_ISREG(is.st_mode)) {
    if (in >= 0) ::close(in);
    return {};
  }
  // a trajectory may be larger than memory: the hash is of the hashes of its parts
  std::string part(1u << 20, '\0'), all;
  for (ssize_t n = 0; (n = read_fully(in, part)) > 0;)
    all += text_hash(part.substr(0, static_cast<std::size_t>(n)));
  ::close(in);
  return text_hash(all);
}

std::string program_hash(const std::string& executable) {
  static std::map<std::string, std::string> known;
  static std::mutex one;
  const std::lock_guard lock(one);
  const auto [at, is_new] = known.try_emplace(executable);
  if (is_new) at->second = file_hash(executable);
  return at->second;
}

std::string run_hash(const RunRequest& request, const std::string& job) {
  const EngineEntry& e = *request.engine;
  std::string all = job + '\0' + state_hash(*request.initial);
  for (const auto& part :
       {e.name, e.version, e.build, e.library_path, e.library_hash, program_hash(e.executable)})
    all += '\0' + part;
  for (const auto& [name, value] : request.environment) all += '\0' + name + '=' + value;
  return text_hash(all);
}

void record_finished(const RunRequest& request, const std::string& hash, const ProcessEnd& end,
                     const Outcome& outcome) {
  if (outcome.status != Status::ok && outcome.status != Status::diverged) return;
  const nlohmann::ordered_json record{{"run", hash},
                                      {"files", hash_of_files(request)},
                                      {"status", outcome.status},
                                      {"code", end.code},
                                      {"cpu_s", end.cpu_s},
                                      {"wall_s", end.wall_s},
                                      {"peak_bytes", end.peak_bytes},
                                      {"instructions", outcome.cost.instructions},
                                      {"counted_by", outcome.cost.counted_by}};
  try {
    write_durably(record_file(request), record.dump(1));
  } catch (const std::exception&) {  // without a record the run is made again, no more
  }
}

std::optional<Outcome> finished_run(const RunRequest& request, const std::string& hash) {
  try {
    const auto record = nlohmann::json::parse(text_of_regular_file(record_file(request), greatest_record));
    if (record.at("run") != hash || record.at("files") != hash_of_files(request)) return {};
    ProcessEnd end;
    end.how = ProcessEnd::How::exited;
    end.code = whole_number<int>(record.at("code").get<double>());
    end.cpu_s = record.at("cpu_s");
    end.wall_s = record.at("wall_s");
    end.peak_bytes = record.at("peak_bytes");
    Outcome outcome = read_back(request, end);
    if (to_string(outcome.status) != record.at("status").get<std::string>()) return {};
    outcome.cost.instructions = record.at("instructions");
    outcome.cost.counted_by = record.at("counted_by");
    outcome.kept = true;
    return outcome;
  } catch (const std::exception&) {
    return {};
  }
}

void forget_finished(const RunRequest& request) { fs::remove(record_file(request)); }

/// Names of the files that tell where the bodies of a run went.
static bool tells_motion(const std::string& name) {
  return name.starts_with("trajectory.") || name == "gauges.csv" ||
         (name.starts_with("checkpoint-") && name.ends_with(".h5"));
}

std::size_t remove_answers(const std::string& folder, const std::set<std::string>& kept_engines) {
  std::vector<fs::path> found;
  std::error_code none;
  for (fs::recursive_directory_iterator at(folder, none), end; !none && at != end; at.increment(none)) {
    const fs::path run = at->path().parent_path();
    if (tells_motion(at->path().filename().string()) &&
        !kept_engines.contains(run.parent_path().filename().string()))
      found.push_back(at->path());
  }
  return static_cast<std::size_t>(
      std::ranges::count_if(found, [&](const fs::path& file) { return fs::remove(file, none); }));
}

std::vector<std::string> checkpoints_in(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("checkpoint-") && name.ends_with(".h5")) found.push_back(entry.path().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace tripoint

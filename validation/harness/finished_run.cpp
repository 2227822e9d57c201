// SPDX-License-Identifier: BSD-3-Clause
#include "validation/harness/finished_run.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>

#include "core/durable_file.hpp"
#include "io/trajectory.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

fs::path record_file(const RunRequest& request) { return fs::path(request.folder) / "outcome.json"; }
/// Hash of the files that were left beside the record: what is judged is what the run wrote.
std::string hash_of_files(const RunRequest& request) {
  const fs::path folder(request.folder);
  std::string all;
  for (const char* name : {"job.json", "result.json", "trajectory.h5", "trajectory.csv", "gauges.csv"})
    all += file_hash((folder / name).string()) + '\0';
  return text_hash(all);
}

}  // namespace

std::string file_hash(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return {};
  std::string part(1u << 20, '\0'), all;  // a trajectory may be larger than memory: the hash is of the hashes of its parts
  while (in.read(part.data(), static_cast<std::streamsize>(part.size())) || in.gcount() > 0)
    all += text_hash(part.substr(0, static_cast<std::size_t>(in.gcount())));
  return text_hash(all);
}

/// Hash of an engine's program, read once a call: what it does may change though it calls itself the same.
static std::string program_hash(const std::string& executable) {
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
  for (const auto& part : {e.name, e.version, e.build, e.library_path, e.library_hash, program_hash(e.executable)})
    all += '\0' + part;
  for (const auto& [name, value] : request.environment) all += '\0' + name + '=' + value;
  return text_hash(all);
}

void record_finished(const RunRequest& request, const std::string& hash, const ProcessEnd& end, const Outcome& outcome) {
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
    write_durably(record_file(request).string(), record.dump(1));
  } catch (const std::exception&) {  // without a record the run is made again, no more
  }
}

std::optional<Outcome> finished_run(const RunRequest& request, const std::string& hash) {
  try {
    const auto record = nlohmann::json::parse(text_of(record_file(request)));
    if (record.at("run") != hash || record.at("files") != hash_of_files(request)) return {};
    ProcessEnd end;
    end.how = ProcessEnd::How::exited;
    end.code = record.at("code");
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

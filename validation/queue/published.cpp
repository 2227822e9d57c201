// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/published.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/durable_file.hpp"
#include "validation/results/json_text.hpp"

namespace tripoint {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
namespace {

fs::path row_file(const std::string& dir, const QueuedJob& job) {
  return fs::path(dir) / run_folder(job) / "row.json";
}

Json document_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return in ? Json::parse(in, nullptr, false) : Json();
}

std::string id_in(const Json& document) {
  return document.is_object() && document.contains("id") && document["id"].is_string()
             ? document["id"].get<std::string>()
             : "";
}

}  // namespace

std::string published_id(const std::string& dir, const QueuedJob& job) {
  return id_in(document_of(row_file(dir, job)));
}

MadeRun published_run(const std::string& dir, const QueuedJob& job) {
  const auto file = row_file(dir, job);
  const auto document = document_of(file);
  if (id_in(document) != job.id || !document.contains("row"))
    throw InputError(
        fmt::format("{}: holds no result of job {} ({}): tripoint suite make, then work, makes it again",
                    file.string(), job.id, name_of(job)));
  MadeRun made{read_run_row(document["row"].dump(), file.string()), {}};
  if (document.contains("ledger"))
    for (const auto& [term, energy] : document["ledger"].items())
      made.ledger[term] = energy.is_number() ? energy.get<double>() : not_a_number;
  return made;
}

bool publish(const std::string& dir, const QueuedJob& job, const MadeRun& made, const std::string& folder,
             const std::string& worker) {
  const fs::path target = fs::path(dir) / run_folder(job);
  fs::create_directories(target.parent_path());
  fs::create_directories(folder);
  Json document{
      {"format", 1}, {"id", job.id}, {"worker", worker}, {"row", Json::parse(run_row_text(made.row))}};
  for (const auto& [term, energy] : made.ledger) document["ledger"][term] = json_number(energy);
  write_durably((fs::path(folder) / "row.json").string(), json_text(document));
  for (int n = 0; n < 100; ++n) {  // each turn takes one older folder out of the way
    if (std::rename(folder.c_str(), target.c_str()) == 0) return true;
    if (errno != ENOTEMPTY && errno != EEXIST) break;
    if (published_id(dir, job) == job.id) return false;
    std::error_code none;
    const fs::path aside = fs::path(folder).parent_path() / fmt::format("older-{}", n);
    fs::rename(target, aside, none);
    fs::remove_all(aside, none);
  }
  throw EngineError(
      fmt::format("{}: the run cannot be moved there: {}", target.string(), std::strerror(errno)));
}

void publish_particles(const std::string& dir, const std::string& file, const std::string& workshop) {
  const fs::path target = fs::path(dir) / fs::path(file).lexically_relative(workshop);
  if (fs::exists(target)) return;
  fs::create_directories(target.parent_path());
  fs::rename(file, target);
}

void withdraw(const std::string& dir, const QueuedJob& job) { fs::remove(row_file(dir, job)); }

bool same_outcome(RunRow a, RunRow b) {
  a.cost = b.cost = Cost{};
  return run_row_text(a) == run_row_text(b);
}

}  // namespace tripoint

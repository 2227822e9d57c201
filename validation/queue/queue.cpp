// SPDX-License-Identifier: BSD-3-Clause
#include "validation/queue/queue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "tables/toml_node.hpp"
#include "validation/case/case.hpp"
#include "validation/case/engine_names.hpp"
#include "validation/results/json_text.hpp"

namespace tripoint {
namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
namespace {

Queue queue_from(const Json& document) {
  Queue q;
  q.folder = document.at("folder");
  q.command = document.at("command");
  q.filter.what = document.at("what");
  q.filter.profile = document.at("profile");
  q.filter.tag = document.at("tag");
  q.filter.substring = document.at("substring");
  q.selection.engines = document.at("only_engines");
  q.selection.extra = document.at("extra");
  q.selection.asked = document.at("asked");
  if (!document.at("seed").is_null()) q.selection.seed = document.at("seed").get<std::uint64_t>();
  q.engine_words = document.at("engine_words");
  q.threads = document.at("threads");
  q.wall_limit = document.at("wall_limit");
  for (const auto& c : document.at("cases")) q.cases.push_back({c.at("id"), c.at("file")});
  q.jobs.reserve(document.at("jobs").size());
  for (const auto& j : document.at("jobs"))
    q.jobs.push_back({j.at("id"), j.at("case"), j.at("engine"), j.at("preset"), j.at("run"), j.at("cost_s")});
  return q;
}

}  // namespace

std::string name_of(const QueuedJob& job) {
  return fmt::format("{} {} {}", job.case_id, label_of(job.engine, job.preset), job.label);
}

std::string place(const std::string& dir, const char* state_name, const std::string& name) {
  return (fs::path(dir) / state_name / name).string();
}

std::string run_folder(const QueuedJob& job) {
  return (fs::path("runs") / job.case_id / job.engine / run_folder_name(job.preset, job.label)).string();
}

std::string queue_text(const Queue& q) {
  Json cases = Json::array(), jobs = Json::array();
  for (const auto& c : q.cases) cases.push_back({{"id", c.id}, {"file", c.file}});
  for (const auto& j : q.jobs)
    jobs.push_back({{"id", j.id},
                    {"case", j.case_id},
                    {"engine", j.engine},
                    {"preset", j.preset},
                    {"run", j.label},
                    {"cost_s", j.cost}});
  Json document{{"format", 1},
                {"folder", q.folder},
                {"command", q.command},
                {"what", q.filter.what},
                {"profile", q.filter.profile},
                {"tag", q.filter.tag},
                {"substring", q.filter.substring},
                {"only_engines", q.selection.engines},
                {"extra", q.selection.extra},
                {"asked", q.selection.asked},
                {"seed", nullptr},
                {"engine_words", q.engine_words},
                {"threads", q.threads},
                {"wall_limit", q.wall_limit},
                {"cases", cases},
                {"jobs", jobs}};
  if (q.selection.seed) document["seed"] = *q.selection.seed;
  return json_text(document, 0);
}

Queue read_queue(const std::string& dir) {
  const auto file = fs::path(dir) / "suite.json";
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw InputError(fmt::format(
        "{}: is no folder of a suite, it has no suite.json (tripoint suite make {} makes one)", dir, dir));
  try {
    const auto document = Json::parse(in);
    if (document.at("format") != 1) throw InputError(file.string() + ": has not \"format\": 1");
    return queue_from(document);
  } catch (const Json::exception& e) {
    throw InputError(fmt::format("{}: cannot be read: {}", file.string(), e.what()));
  }
}

Case case_of(const Queue& queue, const std::string& id) {
  const auto at =
      std::find_if(queue.cases.begin(), queue.cases.end(), [&](const QueuedCase& c) { return c.id == id; });
  if (at == queue.cases.end()) throw InputError(id + ": is no case of the suite");
  CaseFilter file;
  file.what = {at->file};
  auto cases = select_cases(file);
  if (cases.size() != 1 || cases.front().id != id)
    throw InputError(fmt::format("{}: is no longer the case {}: make the suite again, what is done is kept",
                                 at->file, id));
  return std::move(cases.front());
}

void try_cases(const Queue& queue, const std::set<std::string>& ids) {
  std::vector<std::string> files;
  for (const auto& c : queue.cases)
    if (ids.count(c.id) > 0) files.push_back(c.file);
  try_toml_files(files);
}

std::vector<Case> cases_of(const Queue& queue) {
  std::set<std::string> ids;
  for (const auto& c : queue.cases) ids.insert(c.id);
  try_cases(queue, ids);
  std::vector<Case> cases;
  for (const auto& c : queue.cases) cases.push_back(case_of(queue, c.id));
  return cases;
}

SuiteOptions options_of(const Queue& queue) {
  SuiteOptions options;
  options.selection = queue.selection;
  options.threads = queue.threads;
  options.wall_limit = queue.wall_limit;
  return options;
}

void write_by_rename(const std::string& path, const std::string& text, const std::string& own_name) {
  const std::string part = fmt::format("{}.{}.part", path, own_name);
  {
    std::ofstream out(part, std::ios::binary | std::ios::trunc);
    out << text;
    if (!out.flush()) throw EngineError(path + ": cannot be written");
  }
  if (std::rename(part.c_str(), path.c_str()) != 0) throw EngineError(path + ": cannot be written");
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "validation/baseline/history.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "validation/results/json_text.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

std::string line(const Json& document) { return json_text(document, -1); }

Json gates_of(const CaseResult& c) {
  Json list = Json::array();
  for (const auto& e : c.engines)
    for (const auto& g : e.gates) {
      if (g.expect) continue;  // a class has no size
      list.push_back({{"engine", e.name},
                      {"preset", e.preset},
                      {"mode", g.mode},
                      {"metric", g.metric},
                      {"level", g.level ? Json(*g.level) : Json(nullptr)},
                      {"value", json_number(g.value)},
                      {"uncertainty", json_number(g.uncertainty)},
                      {"used", json_number(g.used)},
                      {"verdict", g.verdict}});
    }
  return list;
}

Json costs_of(const CaseResult& c) {
  Json list = Json::array();
  for (const auto& e : c.engines)
    for (const auto& r : e.runs)
      if (r.status == Status::ok)
        list.push_back(
            {{"engine", e.name},
             {"run", r.group},
             {"seed", r.knobs.seed},
             {"pairs", r.cost.pairs},
             {"steps", r.cost.steps},
             {"instructions", r.cost.instructions > 0.0 ? Json(r.cost.instructions) : Json(nullptr)},
             {"cpu_s", r.cost.cpu_s}});
  return list;
}

}  // namespace

std::string history_lines(const Results& r) {
  std::string text;
  for (const auto& c : r.cases) {
    Json versions = Json::object();
    for (const auto& e : c.engines) versions[e.name] = e.version;
    text += line({{"format", 1},
                  {"case", c.id},
                  {"date", r.date},
                  {"commit", r.tool.commit},
                  {"compiler", r.tool.compiler},
                  {"flags", r.tool.flags},
                  {"cpu", r.tool.cpu},
                  {"cores", r.tool.cores},
                  {"profile", r.profile},
                  {"seed", r.seed},
                  {"verdict", c.verdict},
                  {"engines", versions},
                  {"gates", gates_of(c)},
                  {"cost", costs_of(c)}});
  }
  return text;
}

std::string acceptance_lines(const Results& r, const std::vector<std::string>& ids, const Acceptance& a) {
  std::string text;
  for (const auto& c : r.cases)
    if (ids.empty() || std::find(ids.begin(), ids.end(), c.id) != ids.end())
      text += line(
          {{"format", 1}, {"case", c.id}, {"date", r.date}, {"commit", a.commit}, {"accepted", a.reason}});
  return text;
}

void append_history(const std::string& file, const std::string& lines) {
  if (const auto folder = fs::path(file).parent_path(); !folder.empty()) fs::create_directories(folder);
  // No link is followed and no pipe waited for: anyone who could write in the folder may have left one.
  const int fd =
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644);
  const bool good = fd >= 0 && ::write(fd, lines.data(), lines.size()) == static_cast<ssize_t>(lines.size());
  const int error = errno;
  if (fd >= 0) ::close(fd);
  if (!good) throw EngineError(file + ": the history could not be written: " + std::strerror(error));
}

std::string history_file(const Results& results, const std::string& results_file) {
  if (results.history.empty()) return {};
  return (fs::path(results_file).parent_path() / results.history).lexically_normal().string();
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "files/job.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/durable_file.hpp"
#include "core/foreign_json.hpp"
#include "core/not_a_number.hpp"
#include "files/foreign_file.hpp"
#include "files/job_records.hpp"
#include "files/record_json.hpp"
#include "files/scene_json.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;
using namespace record_json;
constexpr std::uintmax_t greatest_file = 64u << 20;  // a job or result of more than 64 MiB is no job
constexpr std::size_t most_letters = 4096;           // of a text in a result, which reports show

json parse(const std::string& path) {
  const std::string text = text_of_regular_file(path, greatest_file);
  if (const std::string why = unfit_json(text); !why.empty())
    throw InputError(fmt::format("{}: {}; refused", path, why));
  json value = json::parse(text, nullptr, false);
  if (value.is_discarded()) throw InputError(path + ": is no JSON");
  return value;
}

json reference_json(const ReferenceChoice& r) {
  return {{"kind", r.kind},     {"function", r.function},  {"file", r.file},
          {"source", r.source}, {"args", to_json(r.args)}, {"uncertainty", r.uncertainty}};
}

ReferenceChoice reference_from(const JsonObject& o) {
  const auto kind = o.text_or("kind", "analytic");
  if (!find_word<ReferenceKind>(kind))
    throw InputError(o.path() + ".kind: `" + printable(kind) + "` is no kind of reference");
  return {from_word<ReferenceKind>(kind), o.text_or("function", ""), o.text_or("file", ""),
          o.text_or("source", ""),        o.settings("args"),        o.number_or("uncertainty", 0.0)};
}

std::string below(const std::string& folder, const std::string& path) {
  return path.empty() || std::filesystem::path(path).is_absolute()
             ? path
             : (std::filesystem::path(folder) / path).string();
}

template <class Owner, class Record>
json object_by(const Record& list, const Owner& owner) {
  json out = json::object();
  put_by(list, owner, out);
  return out;
}

Readback readback_from(const JsonObject& o) {
  Readback r;
  take_by(records::of_readback, o, r);
  for (const JsonObject& b : o.objects("bodies")) {
    ReadbackBody& body = r.bodies.emplace_back();
    body.friction = body.restitution = not_a_number;
    take_by(records::of_readback_body, b, body);
  }
  if (o.has("joints"))
    for (const JsonObject& j : o.objects("joints"))
      take_by(records::of_readback_joint, j, r.joints.emplace_back());
  return r;
}

json readback_json(const Readback& r) {
  json out = object_by(records::of_readback, r);
  out["bodies"] = json::array();
  for (const ReadbackBody& b : r.bodies) out["bodies"].push_back(object_by(records::of_readback_body, b));
  out["joints"] = json::array();
  for (const ReadbackJoint& j : r.joints) out["joints"].push_back(object_by(records::of_readback_joint, j));
  return out;
}

}  // namespace

Job read_job(const std::string& path) {
  const json value = parse(path);
  const JsonObject o(value, "job");
  if (!o.has("contract") || o.integer("contract") != 1) throw InputError(path + ": expected \"contract\": 1");
  Job job;
  (void)o.object("scene");
  scene_from_json(value["scene"], job.scene, job.bodies);
  take_by(records::of_job, o, job);
  take_by(records::of_resolution, o.object("resolution"), job.resolution);
  if (o.has("reference")) job.reference = reference_from(o.object("reference"));
  for (const JsonObject& g : o.objects("gauges")) take_by(records::of_gauge, g, job.gauges.emplace_back());
  if (job.times.empty()) throw InputError(path + ": times is empty");
  for (std::size_t k = 1; k < job.times.size(); ++k)
    if (!(job.times[k] > job.times[k - 1])) throw InputError(path + ": times must rise");
  const std::string folder = std::filesystem::path(path).parent_path().string();
  job.particles = below(folder, job.particles);
  job.output = below(folder, job.output);
  job.resume = below(folder, o.text_or("resume", ""));
  return job;
}

std::string job_text(const Job& job) {
  json value = object_by(records::of_job, job);
  value["contract"] = 1;
  value["scene"] = scene_to_json(job.scene, job.bodies);
  value["resolution"] = object_by(records::of_resolution, job.resolution);
  value["reference"] = reference_json(job.reference);
  value["gauges"] = json::array();
  for (const JobGauge& g : job.gauges) value["gauges"].push_back(object_by(records::of_gauge, g));
  if (!job.resume.empty()) value["resume"] = job.resume;
  return value.dump(1);
}

std::string text_hash(const std::string& text) {
  std::uint64_t hash = 1469598103934665603ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return fmt::format("{:016x}", hash);
}

void write_job(const std::string& path, const Job& job) { write_durably(path, job_text(job)); }

namespace {

/// Status that an engine may give of its own run; the other ends are not its own to tell.
Status status_from(const JsonObject& o, const std::string& path) {
  const auto word = o.text("status");
  for (const auto status : {Status::ok, Status::refused, Status::diverged, Status::error})
    if (to_string(status) == word) return status;
  throw InputError(path + ": status: `" + printable(word) +
                   "` is none that an engine may give (ok, refused, diverged, error)");
}

}  // namespace

Result read_result(const std::string& path) {
  const json value = parse(path);
  const JsonObject o(value, "result");
  if (o.has("contract") && o.integer("contract") != 1) throw InputError(path + ": is not of contract 1");
  Result r;
  r.status = status_from(o, path);
  take_by(records::of_result, o, r);
  for (std::string* words : {&r.message, &r.state_hash, &r.time_step_bound})
    *words = words->substr(0, most_letters);
  if (o.has("counters")) take_by(records::of_counters, o.object("counters"), r);
  if (o.has("seconds")) take_by(records::of_seconds, o.object("seconds"), r);
  if (o.has("readback")) r.readback = readback_from(o.object("readback"));
  if (o.has("divergence")) take_by(records::of_divergence, o.object("divergence"), r.divergence.emplace());
  for (const auto& [key, v] : o.settings("extra"))
    if (const double* number = std::get_if<double>(&v)) r.extra[key] = *number;
  return r;
}

void write_result(const std::string& path, const Result& r) {
  json value = object_by(records::of_result, r);
  value["contract"] = 1;
  value["status"] = r.status;
  value["counters"] = object_by(records::of_counters, r);
  value["seconds"] = object_by(records::of_seconds, r);
  value["readback"] = readback_json(r.readback);
  if (r.divergence) value["divergence"] = object_by(records::of_divergence, *r.divergence);
  value["extra"] = r.extra;
  write_durably(path, value.dump(1));
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "job/job.hpp"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/durable_file.hpp"
#include "core/foreign_json.hpp"
#include "core/whole_number.hpp"
#include "io/foreign_file.hpp"
#include "job/scene_json.hpp"

namespace tripoint {
namespace {

using json = nlohmann::ordered_json;
constexpr std::uintmax_t greatest_file = 64u << 20;  // a job or result of more than 64 MiB is no job
constexpr std::size_t most_letters = 4096;           // of a text in a result, which reports show

json parse(const std::string& path) {
  const std::string text = text_of_regular_file(path, greatest_file);
  if (const std::string why = unfit_json(text); !why.empty()) throw InputError(fmt::format("{}: {}; refused", path, why));
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
  if (!find_word<ReferenceKind>(kind)) throw InputError(o.path() + ".kind: `" + printable(kind) + "` is no kind of reference");
  return {from_word<ReferenceKind>(kind), o.text_or("function", ""), o.text_or("file", ""),
          o.text_or("source", ""),        o.settings("args"),        o.number_or("uncertainty", 0.0)};
}

json gauges_json(const std::vector<JobGauge>& gauges) {
  json list = json::array();
  for (const JobGauge& g : gauges)
    list.push_back({{"metric", g.metric}, {"quantity", g.quantity}, {"body", g.body}, {"where", to_json(g.where)}});
  return list;
}

template <class T>
json maybe(const std::optional<T>& v) {
  return v ? json(*v) : json(nullptr);
}

std::string below(const std::string& folder, const std::string& path) {
  return path.empty() || std::filesystem::path(path).is_absolute() ? path : (std::filesystem::path(folder) / path).string();
}

Divergence divergence_from(const JsonObject& o) {
  return {whole_number<long>(o.number_or("particle", -1)),
          whole_number<long>(o.number_or("body", -1)),
          o.text_or("field", ""),
          o.text_or("stage", ""),
          o.number_or("time", 0.0),
          o.text_or("guard", ""),
          o.text_or("file", ""),
          o.text_or("checkpoint", "")};
}

Readback readback_from(const JsonObject& o) {
  Readback r;
  if (o.has("gravity")) r.gravity = o.vector("gravity");
  r.time_step = o.number_or("time_step", 0.0);
  r.precision = o.text_or("precision", "double");
  for (const JsonObject& b : o.objects("bodies"))
    r.bodies.push_back({b.text("name"), b.number("mass"), b.vector("centre"), b.vector("principal_inertia"),
                        b.number_or("friction", not_a_number), b.number_or("restitution", not_a_number),
                        b.number_or("linear_damping", 0.0), b.number_or("angular_damping", 0.0)});
  return r;
}

json to_json(const Readback& r) {
  json bodies = json::array();
  for (const ReadbackBody& b : r.bodies)
    bodies.push_back({{"name", b.name},
                      {"mass", b.mass},
                      {"centre", tripoint::to_json(b.centre)},
                      {"principal_inertia", tripoint::to_json(b.principal_inertia)},
                      {"friction", b.friction},
                      {"restitution", b.restitution},
                      {"linear_damping", b.linear_damping},
                      {"angular_damping", b.angular_damping}});
  return {{"gravity", tripoint::to_json(r.gravity)}, {"time_step", r.time_step}, {"precision", r.precision}, {"bodies", bodies}};
}

}  // namespace

Job read_job(const std::string& path) {
  const json value = parse(path);
  const JsonObject o(value, "job");
  if (!o.has("contract") || o.integer("contract") != 1) throw InputError(path + ": expected \"contract\": 1");
  Job job;
  job.case_id = o.text("case");
  (void)o.object("scene");
  scene_from_json(value["scene"], job.scene, job.bodies);
  const std::string folder = std::filesystem::path(path).parent_path().string();
  job.particles = below(folder, o.text("particles"));
  const JsonObject r = o.object("resolution");
  job.resolution = {r.number("spacing"), r.number("support_ratio"), r.maybe_number("time_step"), r.maybe_number("walkers"),
                    r.maybe_number("iterations")};
  job.preset = o.text_or("preset", "default");
  job.settings = o.settings("settings");
  if (o.has("reference")) job.reference = reference_from(o.object("reference"));
  job.seed = static_cast<std::uint64_t>(o.integer("seed"));
  job.threads = whole_number<int>(o.number_or("threads", 1));
  job.ranks = whole_number<int>(o.number_or("ranks", 1));
  if (o.has("gauges"))
    for (const JsonObject& g : o.objects("gauges"))
      job.gauges.push_back({g.text("metric"), g.text("quantity"), g.text_or("body", ""), g.settings("where")});
  job.times = o.numbers("times");
  if (job.times.empty()) throw InputError(path + ": times is empty");
  for (std::size_t k = 1; k < job.times.size(); ++k)
    if (!(job.times[k] > job.times[k - 1])) throw InputError(path + ": times must rise");
  job.output = below(folder, o.text("output"));
  job.resume = below(folder, o.text_or("resume", ""));
  return job;
}

std::string job_text(const Job& job) {
  const json value{{"contract", 1},
                   {"case", job.case_id},
                   {"scene", scene_to_json(job.scene, job.bodies)},
                   {"particles", job.particles},
                   {"resolution",
                    {{"spacing", job.resolution.spacing},
                     {"support_ratio", job.resolution.support_ratio},
                     {"time_step", maybe(job.resolution.time_step)},
                     {"walkers", maybe(job.resolution.walkers)},
                     {"iterations", maybe(job.resolution.iterations)}}},
                   {"preset", job.preset},
                   {"settings", to_json(job.settings)},
                   {"reference", reference_json(job.reference)},
                   {"seed", job.seed},
                   {"threads", job.threads},
                   {"ranks", job.ranks},
                   {"gauges", gauges_json(job.gauges)},
                   {"times", job.times},
                   {"output", job.output},
                   {"resume", job.resume.empty() ? json(nullptr) : json(job.resume)}};
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
  throw InputError(path + ": status: `" + printable(word) + "` is none that an engine may give (ok, refused, diverged, error)");
}

}  // namespace

Result read_result(const std::string& path) {
  const json value = parse(path);
  const JsonObject o(value, "result");
  const auto words = [&](const char* key) { return o.text_or(key, "").substr(0, most_letters); };
  if (o.has("contract") && o.integer("contract") != 1) throw InputError(path + ": is not of contract 1");
  Result r;
  r.status = status_from(o, path);
  r.message = words("message");
  r.time_reached = o.number_or("time_reached", 0.0);
  r.steps = whole_number<long>(o.number_or("steps", 0.0));
  if (o.has("counters")) {
    r.pairs = o.object("counters").number_or("pairs", 0.0);
    r.iterations = o.object("counters").number_or("iterations", 0.0);
  }
  if (o.has("seconds")) {
    const JsonObject s = o.object("seconds");
    r.setup_wall = s.number_or("setup_wall", 0.0);
    r.setup_cpu = s.number_or("setup_cpu", 0.0);
    r.stepping_wall = s.number_or("stepping_wall", 0.0);
    r.stepping_cpu = s.number_or("stepping_cpu", 0.0);
  }
  r.state_hash = words("state_hash");
  r.time_step_bound = words("time_step_bound");
  if (o.has("readback")) r.readback = readback_from(o.object("readback"));
  if (o.has("divergence")) r.divergence = divergence_from(o.object("divergence"));
  for (const auto& [key, v] : o.settings("extra"))
    if (const double* number = std::get_if<double>(&v)) r.extra[key] = *number;
  return r;
}

void write_result(const std::string& path, const Result& r) {
  json value{{"contract", 1},
             {"status", r.status},
             {"message", r.message},
             {"time_reached", r.time_reached},
             {"steps", r.steps},
             {"counters", {{"pairs", r.pairs}, {"iterations", r.iterations}}},
             {"seconds",
              {{"setup_wall", r.setup_wall},
               {"setup_cpu", r.setup_cpu},
               {"stepping_wall", r.stepping_wall},
               {"stepping_cpu", r.stepping_cpu}}},
             {"state_hash", r.state_hash},
             {"time_step_bound", r.time_step_bound},
             {"readback", to_json(r.readback)},
             {"divergence", nullptr},
             {"extra", r.extra}};
  if (r.divergence)
    value["divergence"] = {{"particle", r.divergence->particle}, {"body", r.divergence->body},
                           {"field", r.divergence->field},       {"stage", r.divergence->stage},
                           {"time", r.divergence->time},         {"guard", r.divergence->guard},
                           {"file", r.divergence->file},         {"checkpoint", r.divergence->checkpoint}};
  write_durably(path, value.dump(1));
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
// engine-@NAME@: an engine of tripoint in one file, one process a run. Put its folder on TRIPOINT_ENGINE_PATH
// and ask `tripoint engine check PATH`. Everything in JOB.json is SI; the particles are in the job's
// particles.h5 (H5MD). Build: cmake -S . -B build && cmake --build build   (Debian: nlohmann-json3-dev); the
// program lands beside this file
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using json = nlohmann::json;
using Vector = std::array<double, 3>;

const json info{{"contract", 1},
                {"name", "@NAME@"},
                {"version", "1"},
                {"build", "C++20"},
                {"library", {{"path", ""}, {"hash", ""}}},
                {"capabilities", {"rigid-free-flight", "gravity", "contact"}},
                {"presets", {"default"}},
                {"settings",
                 {{"friction", "of every pair of bodies; a central hit has none"},
                  {"restitution", "of every pair of bodies; default 0"}}},
                {"deterministic", true}};

struct JobFile {
  json job;
  std::filesystem::path folder;  ///< of the output
};

JobFile read_job(const std::string& path) {
  std::ifstream in(path);
  JobFile file{json::parse(in), {}};
  const auto times = file.job.at("times").get<std::vector<double>>();
  if (file.job.at("contract") != 1 || times.empty() || !std::is_sorted(times.begin(), times.end()))
    throw std::invalid_argument("contract 1 and rising times are needed");
  file.folder = std::filesystem::path(path).parent_path() / file.job.at("output").get<std::string>();
  return file;
}

bool is_fixed(const json& body) { return body.at("motion") == "fixed"; }

/// Height of the top of a fixed body, by its shape; none for other shapes.
std::optional<double> floor_of(const json& shape) {
  if (shape.at("kind") == "box") return shape.at("max").at(2).get<double>();
  if (shape.at("kind") != "half_space") return {};
  const auto normal = shape.at("normal").get<Vector>();
  return normal[0] == 0.0 && normal[1] == 0.0 && normal[2] > 0.0
             ? std::optional(shape.at("point").at(2).get<double>())
             : std::nullopt;
}

/// Whether a body is a ball that falls straight down on the floor: the one contact that is solved here.
bool falls_straight(const json& body, const json& floor, const Vector& g) {
  const auto v = body.at("velocity").get<Vector>(), x = body.at("centre").get<Vector>();
  bool over = true;
  if (floor.at("kind") == "box")
    for (std::size_t k = 0; k < 2; ++k)
      over = over && floor.at("min").at(k) <= x[k] && x[k] <= floor.at("max").at(k);
  return over && body.at("shape").at("kind") == "sphere" && v[0] == 0.0 && v[1] == 0.0 && g[0] == 0.0 &&
         g[1] == 0.0 && g[2] < 0.0 && body.at("angular_velocity").get<Vector>() == Vector{};
}

/// Why this engine cannot run the job honestly; "" if it can. A refusal is a row of the report, not an error.
std::string refusal(const json& job) {
  const auto& scene = job.at("scene");
  if (!scene.at("events").empty()) return "no events";
  const json* floor = nullptr;
  for (const auto& body : scene.at("bodies")) {
    if (body.at("phase") != "rigid" || (body.at("motion") != "free" && !is_fixed(body)) ||
        !body.at("temperature").is_null())
      return "only free rigid bodies and a fixed floor, without heat";
    const auto I = body.at("principal_inertia").get<Vector>();  // ascending
    if (body.at("angular_velocity").get<Vector>() != Vector{} && I[2] > (1.0 + 1e-9) * I[0])
      return "spin of bodies with equal moments only";
    if (is_fixed(body)) floor = &body.at("shape");
  }
  if (!floor) return {};
  for (const auto& body : scene.at("bodies"))
    if (scene.at("bodies").size() != 2 || !floor_of(*floor) ||
        (!is_fixed(body) && !falls_straight(body, *floor, scene.at("gravity").get<Vector>())))
      return "contact of one ball alone that falls straight down on a level floor";
  return {};
}

/// Height above the floor and speed of a ball: parabolas between hits, each of which gives back a share of
/// the speed.
struct Bounces {
  double z, v, g, restitution, begun = 0.0;
  void advance_to(double t) {
    for (;;) {
      const double lasts = g < 0.0 ? (v + std::sqrt(std::max(0.0, v * v - 2.0 * g * z))) / -g : t - begun;
      if (!(lasts < t - begun)) return;
      begun += lasts;
      v = -restitution * (v + g * lasts);
      z = 0.0;
      if (v < 1e-9) v = g = 0.0;  // it rests
    }
  }
  double height(double t) const { return z + v * (t - begun) + 0.5 * g * (t - begun) * (t - begun); }
  double speed(double t) const { return v + g * (t - begun); }
};

/// Writes trajectory.csv: one row a body and output time. Here a body follows its parabola, turns at a
/// constant rate and bounces: put your engine in its place.
void solve(const json& job, std::ostream& out) {
  out.precision(17);
  // Of particles: time,id,x,y,z,vx,vy,vz[,temperature]
  out << "time,body,x,y,z,vx,vy,vz,qw,qx,qy,qz,wx,wy,wz\n";
  const auto& bodies = job.at("scene").at("bodies");
  const auto floor = std::find_if(bodies.begin(), bodies.end(), is_fixed);
  for (const auto& body : bodies) {
    const auto g = is_fixed(body) ? Vector{} : job.at("scene").at("gravity").get<Vector>();
    const auto x0 = body.at("centre").get<Vector>(), v0 = body.at("velocity").get<Vector>(),
               w = body.at("angular_velocity").get<Vector>();
    const double rate = std::hypot(w[0], w[1], w[2]);
    const bool bounces = floor != bodies.end() && !is_fixed(body);
    const double lowest =
        bounces ? *floor_of(floor->at("shape")) + body.at("shape").at("radius").get<double>() : 0.0;
    Bounces ball{x0[2] - lowest, v0[2], g[2], job.at("settings").value("restitution", 0.0)};
    for (const double t : job.at("times")) {
      Vector x, v;
      for (std::size_t k = 0; k < 3; ++k) x[k] = x0[k] + v0[k] * t + 0.5 * g[k] * t * t;
      for (std::size_t k = 0; k < 3; ++k) v[k] = v0[k] + g[k] * t;
      if (bounces) {
        ball.advance_to(t);
        x[2] = lowest + ball.height(t);
        v[2] = ball.speed(t);
      }
      out << t << ',' << body.at("index").get<int>();
      for (const auto& three : {x, v})
        for (const double number : three) out << ',' << number;
      out << ',' << std::cos(0.5 * rate * t);  // orientation (w, x, y, z), (1, 0, 0, 0) at the start
      for (std::size_t k = 0; k < 3; ++k)
        out << ',' << (rate > 0.0 ? std::sin(0.5 * rate * t) * w[k] / rate : 0.0);
      for (std::size_t k = 0; k < 3; ++k) out << ',' << w[k];
      out << '\n';
    }
  }
}

/// Bodies as the engine itself holds them: the harness compares them with the job.
json held_bodies(const json& job) {
  json list = json::array();
  for (const auto& body : job.at("scene").at("bodies")) {
    json held;
    for (const char* key : {"name", "mass", "centre", "principal_inertia"}) held[key] = body.at(key);
    for (const char* key : {"friction", "restitution"}) held[key] = job.at("settings").value(key, json());
    list.push_back(held);
  }
  return list;
}

int run(const std::string& path) {
  const auto [job, folder] = read_job(path);
  const std::string reason = refusal(job);
  if (reason.empty()) {
    std::ofstream trajectory(folder / "trajectory.csv");
    solve(job, trajectory);
    if (!trajectory.flush()) throw std::runtime_error("trajectory.csv cannot be written");
  }
  const json held{{"gravity", job.at("scene").at("gravity")},
                  {"time_step", 0.0},
                  {"precision", "double"},
                  {"bodies", held_bodies(job)}};
  const json result{{"contract", 1},
                    {"status", reason.empty() ? "ok" : "refused"},
                    {"message", reason},
                    {"time_reached", reason.empty() ? job.at("times").back().get<double>() : 0.0},
                    {"steps", 0},
                    {"seconds", {{"stepping_cpu", static_cast<double>(std::clock()) / CLOCKS_PER_SEC}}},
                    {"readback", held}};
  std::ofstream(folder / "result.json.part") << result.dump(1);
  std::filesystem::rename(folder / "result.json.part", folder / "result.json");  // the last act
  return reason.empty() ? 0 : 4;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string verb = argc > 1 ? argv[1] : "", path = argc > 2 ? argv[2] : "";
  try {
    if (verb == "--run") return run(path);
    if (verb == "--info")
      std::cout << info.dump() << '\n';
    else if (verb == "--check") {
      const std::string reason = refusal(read_job(path).job);
      std::cout << json{{"can", reason.empty()}, {"reason", reason}}.dump() << '\n';
    } else
      throw std::invalid_argument("--info, --check JOB.json or --run JOB.json");
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bad job: " << error.what() << '\n';
    return 2;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// engine-@NAME@: an engine of tripoint in one file, one process a run. Put its folder on TRIPOINT_ENGINE_PATH and ask
// `tripoint engine check PATH`. Everything in JOB.json is SI; the particles are in the job's particles.h5 (H5MD).
// Build: cmake -S . -B build && cmake --build build   (Debian: nlohmann-json3-dev); the program lands beside this file
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
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
                {"capabilities", {"rigid-free-flight", "gravity"}},
                {"presets", {"default"}},
                {"settings", json::object()},
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

/// Why this engine cannot run the job honestly; "" if it can. A refusal is a row of the report, not an error.
std::string refusal(const json& job) {
  if (!job.at("scene").at("events").empty()) return "no events";
  for (const auto& body : job.at("scene").at("bodies")) {
    if (body.at("phase") != "rigid" || body.at("motion") != "free" || !body.at("temperature").is_null())
      return "only free rigid bodies, without heat";
    const auto I = body.at("principal_inertia").get<Vector>();  // ascending
    if (body.at("angular_velocity").get<Vector>() != Vector{} && I[2] > (1.0 + 1e-9) * I[0])
      return "spin of bodies with equal moments only";
  }
  return {};
}

/// Writes trajectory.csv: one row a body and output time. Here a body follows its parabola and turns at a constant
/// rate: put your engine in its place.
void solve(const json& job, std::ostream& out) {
  out.precision(17);
  out << "time,body,x,y,z,vx,vy,vz,qw,qx,qy,qz,wx,wy,wz\n";  // of particles: time,id,x,y,z,vx,vy,vz[,temperature]
  const auto g = job.at("scene").at("gravity").get<Vector>();
  for (const auto& body : job.at("scene").at("bodies")) {
    const auto x0 = body.at("centre").get<Vector>(), v0 = body.at("velocity").get<Vector>(),
               w = body.at("angular_velocity").get<Vector>();
    const double rate = std::hypot(w[0], w[1], w[2]);
    for (const double t : job.at("times")) {
      out << t << ',' << body.at("index").get<int>();
      for (std::size_t k = 0; k < 3; ++k) out << ',' << x0[k] + v0[k] * t + 0.5 * g[k] * t * t;
      for (std::size_t k = 0; k < 3; ++k) out << ',' << v0[k] + g[k] * t;
      out << ',' << std::cos(0.5 * rate * t);  // orientation (w, x, y, z), (1, 0, 0, 0) at the start
      for (std::size_t k = 0; k < 3; ++k) out << ',' << (rate > 0.0 ? std::sin(0.5 * rate * t) * w[k] / rate : 0.0);
      for (std::size_t k = 0; k < 3; ++k) out << ',' << w[k];
      out << '\n';
    }
  }
}

int run(const std::string& path) {
  const auto [job, folder] = read_job(path);
  const std::string reason = refusal(job);
  if (reason.empty()) {
    std::ofstream trajectory(folder / "trajectory.csv");
    solve(job, trajectory);
    if (!trajectory.flush()) throw std::runtime_error("trajectory.csv cannot be written");
  }
  // Gravity, step and bodies as the engine itself holds them: the harness compares them with the job.
  const json held{
      {"gravity", job.at("scene").at("gravity")}, {"time_step", 0.0}, {"precision", "double"}, {"bodies", json::array()}};
  const json result{{"contract", 1},     {"status", reason.empty() ? "ok" : "refused"},
                    {"message", reason}, {"time_reached", reason.empty() ? job.at("times").back().get<double>() : 0.0},
                    {"steps", 0},        {"seconds", {{"stepping_cpu", static_cast<double>(std::clock()) / CLOCKS_PER_SEC}}},
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

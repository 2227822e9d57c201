// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "adapters/scenes.hpp"
#include "files/job.hpp"
#include "files/result.hpp"
#include "files/trajectory.hpp"

/// Engines as the harness runs them: a process, a folder, an exit code.
namespace tripoint::test {

/// A folder of its own that goes with the object.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "tripoint-engine-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string at(const std::string& name) const {
    return (std::filesystem::path(path_) / name).string();
  }

 private:
  std::string path_;
};

inline std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Runs a shell command; @return its exit code, or 128 + signal.
inline int shell(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

struct Outcome {
  int exit_code = 0;
  Result result;
  Trajectory trajectory;
  std::string log;  ///< LAMMPS's own
};

/// What a frame says of the whole is the sum over its particles.
inline void expect_sums(const Snapshot& frame, const InitialState& initial) {
  double mass = 0.0, size = 0.0;
  Vec3 momentum;
  // More than at first where liquid flows in
  const std::size_t count = frame.mass.empty() ? initial.size() : frame.mass.size();
  for (std::size_t i = 0; i < count && i < frame.velocity.size(); ++i) {
    const double m = i < frame.mass.size() ? frame.mass[i] : initial.mass[i];
    if (std::isnan(m)) continue;  // not there yet
    mass += m;
    momentum += m * frame.velocity[i];
    size += m * norm(frame.velocity[i]);
  }
  EXPECT_NEAR(frame.total_mass, mass, 1e-12 * mass) << "at t = " << frame.time;
  EXPECT_NEAR(norm(frame.momentum - momentum), 0.0, 1e-12 * mass + 1e-9 * size) << "at t = " << frame.time;
}

/// A solid body of a frame is where its particles are, and moves as they do.
inline void expect_bodies(const Snapshot& frame, const InitialState& initial) {
  for (std::size_t b = 0; b < frame.bodies.size(); ++b) {
    double mass = 0.0;
    Vec3 moment, momentum;
    for (std::size_t i = 0; i < initial.size() && i < frame.body.size(); ++i) {
      if (frame.body[i] != static_cast<int>(b)) continue;
      mass += initial.mass[i];
      moment += initial.mass[i] * frame.position[i];
      momentum += initial.mass[i] * frame.velocity[i];
    }
    if (mass == 0.0) continue;
    EXPECT_NEAR(frame.bodies[b].mass, mass, 1e-9 * mass) << "body " << b << " at t = " << frame.time;
    EXPECT_NEAR(norm(frame.bodies[b].position - moment / mass), 0.0, 1e-9)
        << "body " << b << " at t = " << frame.time;
    EXPECT_NEAR(norm(frame.bodies[b].velocity - momentum / mass), 0.0, 1e-9)
        << "body " << b << " at t = " << frame.time;
  }
}

/// @param prefix e.g. an environment variable
inline Outcome run(const std::string& engine, const Prepared& p, const std::string& prefix = "") {
  const Folder folder;
  write_particles(folder.at("particles.h5"), p.initial);
  write_job(folder.at("job.json"), p.job);
  Outcome out;
  out.exit_code = shell(prefix + " '" + engine + "' --run '" + folder.at("job.json") + "' 2> '" +
                        folder.at("stderr") + "'");
  out.result = read_result(folder.at("result.json"));
  out.log = text_of(folder.at("log.lammps"));
  if (std::filesystem::exists(folder.at("trajectory.h5")))
    out.trajectory = read_trajectory(folder.at("trajectory.h5"));
  if (std::filesystem::exists(folder.at("trajectory.csv")))
    out.trajectory = read_trajectory_csv(folder.at("trajectory.csv"), p.initial, p.job.bodies.size());
  std::vector<std::string> gauges;
  for (const JobGauge& gauge : p.job.gauges) gauges.push_back(gauge.metric);
  if (std::filesystem::exists(folder.at("gauges.csv")))
    read_gauges_csv(folder.at("gauges.csv"), gauges, out.trajectory);
  if (out.exit_code == 0 && std::filesystem::exists(folder.at("trajectory.h5")))
    for (const Snapshot& frame : out.trajectory.frames) {
      expect_sums(frame, p.initial);
      expect_bodies(frame, p.initial);
    }
  return out;
}

/// LAMMPS is given the commands of the settings: here one that it does not know.
inline void expect_commands_reach(const std::string& engine, Prepared p) {
  p.job.settings["commands"] = std::string("pair_style nosuch");
  const Outcome out = run(engine, p);
  EXPECT_EQ(out.exit_code, 1);
  EXPECT_NE(out.result.message.find("nosuch"), std::string::npos) << out.result.message;
}

inline std::string info(const std::string& engine, const std::string& prefix = "") {
  const Folder folder;
  return shell(prefix + " '" + engine + "' --info > '" + folder.at("info") + "'") == 0
             ? text_of(folder.at("info"))
             : "";
}

/// Exit code of a run on a job that is no job.
inline int run_broken_job(const std::string& engine, const std::string& prefix = "") {
  const Folder folder;
  std::ofstream(folder.at("job.json")) << "{\"contract\": 1, \"case\":";
  return shell(prefix + " '" + engine + "' --run '" + folder.at("job.json") + "' 2> '" + folder.at("stderr") +
               "'");
}

}  // namespace tripoint::test

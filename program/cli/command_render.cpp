// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include "core/errors.hpp"
#include "program/cli/commands.hpp"
#include "program/cli/common.hpp"
#include "program/cli/options.hpp"
#include "program/cli/shown_frame.hpp"
#include "surface/surface_mesh.hpp"
#include "validation/results/interrupt.hpp"
#include "validation/results/verdict.hpp"
#include "validation/run/process.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

constexpr const char* render_description =
    "Draws frames of a run that has ended: the surface of each body and liquid, equations (22) to (26) of\n"
    "the paper, ray-traced.\n"
    "  tripoint render runs/paper/fig-12/tripoint                   six frames, a contact sheet, "
    "and a film where ffmpeg is installed\n"
    "  tripoint render paper/fig-12 --frames -1 --colour temperature the last frame of the run that "
    "tripoint run left in runs/\n"
    "  tripoint render paper/fig-12 --frames 0:-1:1 --particles     every frame, as balls: a quick look\n"
    "  tripoint render paper/fig-12 --frames 5 --mesh shell.ply     also the closed mesh, with "
    "temperature, phase and body\n"
    "  tripoint render paper/fig-12 --zb05                          without the factor f of (25), "
    "to see its effect\n"
    "Up is against gravity. Fixed bodies are walls; parts of them before the rest are cut away (--walls).\n"
    "A run in a periodic box is drawn as it lies in the box. docs/surface.md has the method, its error\n"
    "and its cost. OUT then holds frame-NNNN.png, sheet.png and film.mp4. stdout says the files, one a\n"
    "line.";

constexpr int sheet_width = 320;   // of one frame on the contact sheet [pixels]
constexpr int natural_frames = 6;  // that are drawn where nobody names some

struct RenderOptions {
  std::string run, frames, out, size = "640x480", colour, mesh, walls = "cut", range;
  std::optional<int> frame;
  bool particles = false, surface = false, zb05 = false, whole = false;
  double azimuth = 30.0, elevation = 20.0, influence = 0.0, distance = 0.0, voxel = 0.5, rate = 10.0;
  int threads = 0;
};

/// "A:B:S", each part a number; -1 is the last frame.
std::vector<std::size_t> frames_of(const RenderOptions& o, std::size_t count) {
  const auto row = [&](int n, const char* option) {
    const int at = n < 0 ? n + static_cast<int>(count) : n;
    if (at < 0 || at >= static_cast<int>(count))
      throw InputError(
          fmt::format("{} {}: the run has frames 0 to {}; -1 is the last", option, n, count - 1));
    return static_cast<std::size_t>(at);
  };
  if (o.frame) return {row(*o.frame, "--frame")};
  std::vector<std::size_t> chosen;
  if (o.frames.empty()) {
    const std::size_t wanted = std::min<std::size_t>(natural_frames, count);
    for (std::size_t n = 0; n < wanted; ++n)
      chosen.push_back(wanted == 1 ? count - 1 : (n * (count - 1) + (wanted - 1) / 2) / (wanted - 1));
    return chosen;
  }
  const auto words = split(o.frames, ':');
  std::vector<int> numbers;
  for (const auto& word : words) {
    char* end = nullptr;
    numbers.push_back(static_cast<int>(std::strtol(word.c_str(), &end, 10)));
    if (*end != '\0') numbers.clear();
    if (*end != '\0') break;
  }
  if (numbers.size() == 1 && words.size() == 1) return {row(numbers[0], "--frames")};
  if (numbers.size() < 2 || numbers.size() > 3 || words.size() != numbers.size() ||
      (numbers.size() == 3 && numbers[2] < 1))
    throw InputError(
        fmt::format("--frames {}: write N, FIRST:LAST or FIRST:LAST:STEP, for example 0:-1:5", o.frames));
  const std::size_t last = row(numbers[1], "--frames");
  for (std::size_t n = row(numbers[0], "--frames"); n <= last;
       n += static_cast<std::size_t>(numbers.size() == 3 ? numbers[2] : 1))
    chosen.push_back(n);
  if (chosen.empty())
    throw InputError(fmt::format("--frames {}: the first frame lies behind the last", o.frames));
  return chosen;
}

/// Two positive numbers with one character between.
std::pair<double, double> two_numbers(const std::string& text, char between, const std::string& option,
                                      const std::string& instead) {
  char* end = nullptr;
  const double a = std::strtod(text.c_str(), &end);
  const bool first = end != text.c_str() && *end == between;
  const char* rest = first ? end + 1 : end;
  const double b = std::strtod(rest, &end);
  if (!first || end == rest || *end != '\0' || !std::isfinite(a) || !std::isfinite(b))
    throw InputError(fmt::format("{} {}: write {}", option, text, instead));
  return {a, b};
}

Colouring colouring_of(const RenderOptions& o, const ShownRun& run, const std::vector<std::size_t>& frames) {
  if (o.colour.empty()) return natural_colouring(run, frames);
  if (o.colour == "phase") return Colouring::phase;
  if (o.colour == "body") return Colouring::body;
  if (!temperatures_of(run, frames))
    throw InputError(run.folder + ": the run has no temperatures: --colour phase or --colour body");
  return Colouring::temperature;
}

Showing showing_of(const RenderOptions& o, const ShownRun& run, const std::vector<std::size_t>& frames) {
  Showing s;
  const auto size = two_numbers(o.size, 'x', "--size", "WIDTHxHEIGHT, for example 640x480");
  if (!(size.first >= 16.0 && size.second >= 16.0 && size.first <= 8192.0 && size.second <= 8192.0))
    throw InputError(fmt::format("--size {}: from 16x16 to 8192x8192", o.size));
  s.width = static_cast<int>(size.first);
  s.height = static_cast<int>(size.second);
  s.colouring = colouring_of(o, run, frames);
  s.walls = o.walls == "show" ? WallsDrawn::show : o.walls == "hide" ? WallsDrawn::hide : WallsDrawn::cut;
  s.particles = o.particles;
  s.whole = o.whole;
  s.view = {o.azimuth, o.elevation};
  s.surface = SurfaceOptions::for_spacing(run.spacing);
  if (o.influence > 0.0) {
    s.surface.influence_radius = o.influence * run.spacing;
    s.surface.distance = SurfaceOptions::distance_per_influence_radius * s.surface.influence_radius;
  }
  if (o.distance > 0.0) s.surface.distance = o.distance * run.spacing;
  s.surface.detector = !o.zb05;
  s.room = room_for(run, frames);
  s.looked_at = looked_at(run, frames, s);
  s.threads = o.threads > 0 ? o.threads : omp_get_max_threads();
  if (!o.range.empty())
    std::tie(s.cold, s.hot) = two_numbers(o.range, ':', "--range", "COLD:HOT in kelvin, for example 250:450");
  else if (const auto T = temperatures_of(run, frames))
    std::tie(s.cold, s.hot) = *T;
  return s;
}

std::string frame_name(std::size_t n) { return fmt::format("frame-{:04}.png", n); }

/// The program of this name that the shell would find; empty where there is none.
std::string in_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  for (const auto& folder : split(path != nullptr ? path : "", ':')) {
    const auto file = fs::path(folder) / name;
    std::error_code none;
    if (const auto status = fs::status(file, none);
        fs::is_regular_file(status) && (status.permissions() & fs::perms::owner_exec) != fs::perms::none)
      return file.string();
  }
  return {};
}

void make_film(const fs::path& out, const std::vector<std::size_t>& frames, double rate) {
  const auto program = in_path("ffmpeg");
  if (program.empty()) {
    say("no film: ffmpeg is not installed (apt-get install ffmpeg); the frames are there");
    return;
  }
  std::ofstream list(out / "film.txt");
  for (const std::size_t n : frames)
    list << "file '" << frame_name(n) << "'\nduration " << 1.0 / rate << "\n";
  list.close();
  ProcessSpec spec;
  spec.argv = {program,    "-y",      "-loglevel", "error", "-f",
               "concat",   "-i",      "film.txt",  "-vf",   "pad=ceil(iw/2)*2:ceil(ih/2)*2",
               "-pix_fmt", "yuv420p", "film.mp4"};
  spec.folder = fs::absolute(out).string();
  const auto end = run_process(spec);
  fs::remove(out / "film.txt");
  if (end.how == ProcessEnd::How::exited && end.code == 0)
    print_line((out / "film.mp4").string());
  else
    say(fmt::format("no film: ffmpeg {}: {}", describe(end), end.log_tail));
}

/// FILE.ply, or FILE-0007.ply where several frames are asked for.
std::string mesh_name(const std::string& file, std::size_t frame, bool several) {
  const fs::path path(file);
  return several ? (path.parent_path() /
                    fmt::format("{}-{:04}{}", path.stem().string(), frame, path.extension().string()))
                       .string()
                 : file;
}

void write_meshes(const ShownRun& run, std::size_t frame, const Showing& s, const RenderOptions& o,
                  const std::string& file) {
  const auto parts = meshes_of(run, run.trajectory.frames[frame], s, o.voxel * run.spacing);
  if (fs::path(file).extension() == ".obj")
    write_obj(file, parts);
  else
    write_ply(file, parts);
  print_line(file);
  for (const SurfacePart& p : parts) {
    const MeshMeasures m = measures_of(p.mesh);
    print_line(fmt::format("  {:24} {} triangles, {} {}, volume {:.6g} m3, area {:.6g} m2{}", p.name,
                           p.mesh.triangles.size(), m.pieces, m.pieces == 1 ? "piece" : "pieces",
                           volume(p.mesh), m.area,
                           m.open_edges > 0 ? fmt::format(", {} edges open", m.open_edges) : ", closed"));
  }
}

void check_words(const RenderOptions& o) {
  if (o.frame && !o.frames.empty())
    throw InputError("--frame names one frame, --frames several: give one of them");
  if (o.particles && o.surface)
    throw InputError("--particles draws balls, --surface surfaces: give one of them");
  const auto ending = fs::path(o.mesh).extension();
  if (!o.mesh.empty() && ending != ".ply" && ending != ".obj")
    throw InputError(fmt::format(
        "--mesh {}: a mesh is a .ply file (with temperature, phase and body) or a .obj file", o.mesh));
}

std::string legend_of(const Showing& s) {
  if (s.colouring == Colouring::temperature)
    return fmt::format("colours: {:.4g} K dark to {:.4g} K light", s.cold, s.hot);
  if (s.colouring == Colouring::phase)
    return "colours: liquid blue, another liquid light blue, elastic green, rigid orange";
  return "colours: each solid body has its own, liquid is blue";
}

int render(const RenderOptions& o) {
  check_words(o);
  catch_interrupts();
  const ShownRun run = read_shown_run(o.run);
  const auto frames = frames_of(o, run.trajectory.frames.size());
  const Showing s = showing_of(o, run, frames);
  const fs::path out = o.out.empty() ? fs::path(run.folder) / "pictures" : fs::path(o.out);
  make_folder(out.string());
  say(legend_of(s));
  std::vector<Picture> small;
  for (const std::size_t n : frames) {
    const Snapshot& f = run.trajectory.frames[n];
    if (!o.mesh.empty()) write_meshes(run, n, s, o, mesh_name(o.mesh, n, frames.size() > 1));
    const Picture picture = picture_of(run, f, s);
    const auto file = (out / frame_name(n)).string();
    write_png(file, picture);
    print_line(fmt::format("{}  t = {:.6g} s", file, f.time));
    small.push_back(shrunk(picture, std::min(sheet_width, picture.width)));
    if (interrupted()) return exit_interrupted;
  }
  if (frames.size() < 2) return exit_pass;
  write_png(
      (out / "sheet.png").string(),
      contact_sheet(small, static_cast<int>(std::ceil(std::sqrt(1.5 * static_cast<double>(small.size()))))));
  print_line((out / "sheet.png").string());
  make_film(out, frames, o.rate);
  return exit_pass;
}

}  // namespace

void add_render(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("render", render_description);
  auto o = std::make_shared<RenderOptions>();
  command
      ->add_option("RUN", o->run,
                   "folder of a run, its trajectory.h5, or the id of a case that has a run in runs/")
      ->required();
  command
      ->add_option(
          "--frames", o->frames,
          "one frame or several, the last included; counted from 0, -1 is the last; six where none are named")
      ->type_name("N|FIRST:LAST:STEP");
  command
      ->add_option_function<int>("--frame",
                                 [o](int frame) {
                                   note_earlier("--frame N", "--frames N");
                                   o->frame = frame;
                                 })
      ->group("");
  command->add_option("--out", o->out, "folder of the pictures (default: pictures in the run's folder)");
  command->add_option("--size", o->size, "of a picture in pixels")
      ->type_name("WIDTHxHEIGHT")
      ->capture_default_str();
  command
      ->add_option("--colour", o->colour,
                   "temperature, phase or body; the first of them that tells something where none is named")
      ->check(CLI::IsMember({"temperature", "phase", "body"}));
  command
      ->add_option("--range", o->range,
                   "temperatures at the dark and the light end, in kelvin (default: those of the frames)")
      ->type_name("COLD:HOT");
  add_earlier_flag(*command, "--surface", "the default", [o] { o->surface = true; });
  command->add_flag("--particles", o->particles, "particles as balls: quicker");
  command->add_flag("--whole", o->whole,
                    "one surface about everything but walls, instead of one a body and one a liquid");
  command->add_flag("--zb05", o->zb05,
                    "f = 1 everywhere: the surface of Zhu and Bridson 2005, equation (22)");
  command->add_option("--walls", o->walls, "fixed bodies: cut away before the rest, all of them, or none")
      ->check(CLI::IsMember({"cut", "show", "hide"}))
      ->capture_default_str();
  command->add_option("--azimuth", o->azimuth, "direction of view, to the right of the front [degrees]")
      ->capture_default_str();
  command->add_option("--elevation", o->elevation, "direction of view, above the horizon [degrees]")
      ->check(CLI::Range(-89.0, 89.0))
      ->capture_default_str();
  command
      ->add_option("--influence-radius", o->influence,
                   "ir of (24) in spacings; the larger, the smoother (default: 2.4)")
      ->check(CLI::Range(1.2, 10.0));
  command->add_option("--distance", o->distance, "R of (22) and (23) in spacings (default: 0.28 ir)")
      ->check(CLI::Range(0.05, 5.0));
  command
      ->add_option("--mesh", o->mesh,
                   "also writes the closed mesh: .ply with temperature, phase and body, or .obj")
      ->type_name("FILE");
  command->add_option("--voxel", o->voxel, "of the mesh, in spacings")
      ->check(CLI::Range(0.05, 5.0))
      ->capture_default_str();
  command->add_option("--rate", o->rate, "frames a second of the film")
      ->check(CLI::Range(0.1, 240.0))
      ->capture_default_str();
  command->add_option("--threads", o->threads, "they do not change a bit of the pictures (default: all)")
      ->check(CLI::Range(1, 1024));
  command->callback([o, &exit_code] { exit_code = guarded([&] { return render(*o); }); });
}

}  // namespace tripoint

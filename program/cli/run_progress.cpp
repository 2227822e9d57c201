// SPDX-License-Identifier: BSD-3-Clause
#include "program/cli/run_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/errors.hpp"
#include "validation/results/escaped_text.hpp"
#include "validation/results/json_text.hpp"

namespace tripoint {
namespace {

std::optional<double> number_in(const nlohmann::json& object, const char* key) {
  const auto at = object.find(key);
  if (at == object.end() || !at->is_number() || !std::isfinite(at->get<double>())) return {};
  return at->get<double>();
}

std::string wall_time(double seconds) {
  const auto s = static_cast<long>(std::lround(std::min(seconds, 1e9)));
  if (s < 100) return fmt::format("{} s", s);
  return s < 6000 ? fmt::format("{} min {:02} s", s / 60, s % 60)
                  : fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
}

/// Shown to a reader, if any: a terminal that has closed takes no words, and the run must end as it should
/// all the same.
void report(const std::string& words) { std::fwrite(words.data(), 1, words.size(), stderr); }

}  // namespace

std::optional<RunStatus> status_from(const std::string& text) {
  const auto object = nlohmann::json::parse(text, nullptr, false);
  if (!object.is_object()) return {};
  const auto time = number_in(object, "time"), end = number_in(object, "end"),
             step = number_in(object, "step");
  if (!time || !end) return {};
  RunStatus s;
  s.time = *time;
  s.end = *end;
  s.step = step && std::abs(*step) < 1e15 ? static_cast<long>(*step) : 0;
  s.time_step = number_in(object, "time_step");
  s.ledger_residual = number_in(object, "ledger_residual");
  s.ledger_exchanged = number_in(object, "ledger_exchanged");
  if (const auto bound = object.find("bound"); bound != object.end() && bound->is_string())
    s.bound = one_line(bound->get<std::string>().substr(0, 40));
  return s;
}

std::string status_line(const RunStatus& s, double done, std::optional<double> seconds_left) {
  std::string line = fmt::format("{:3.0f} %  t = {:.4g} s", 100.0 * done, s.time);
  if (s.step > 0) line += fmt::format("  step {}", s.step);
  if (s.time_step) line += fmt::format("  dt = {:.3g} s", *s.time_step);
  if (!s.bound.empty()) line += fmt::format(" ({})", s.bound);
  if (s.ledger_residual && s.ledger_exchanged && *s.ledger_exchanged > 0.0)
    line += fmt::format("  energy {:+.1g} of what was exchanged", *s.ledger_residual / *s.ledger_exchanged);
  if (seconds_left) line += fmt::format("  {} left", wall_time(*seconds_left));
  return line;
}

ProgressForm progress_form(const std::string& word, bool quiet, bool is_terminal) {
  if (quiet || word == "none") return ProgressForm::none;
  if (word == "auto") return is_terminal ? ProgressForm::terminal : ProgressForm::none;
  if (word == "lines") return ProgressForm::lines;
  if (word == "json") return ProgressForm::json;
  throw InputError("--progress " + word + ": write auto, lines, json or none");
}

std::string RunProgress::interval() const {
  if (form_ == ProgressForm::none) return "";
  return form_ == ProgressForm::terminal ? "0.5" : form_ == ProgressForm::json ? "1" : "5";
}

void RunProgress::at(double done) {
  if (!begun_) begun_ = {done, Clock::now()};
  if (form_ == ProgressForm::terminal && !last_) show(done);  // an engine that tells no more
}

void RunProgress::at(const std::string& text) {
  last_ = status_from(text);
  if (!last_) return;
  const double done = last_->end > 0.0 ? std::clamp(last_->time / last_->end, 0.0, 1.0) : 0.0;
  if (!begun_) begun_ = {done, Clock::now()};
  show(done);
}

void RunProgress::show(double done) {
  const auto left = seconds_left(done);
  if (form_ == ProgressForm::json) {
    nlohmann::ordered_json line{
        {"done", done}, {"time", last_->time}, {"end", last_->end}, {"step", last_->step}};
    if (last_->time_step) line["time_step"] = *last_->time_step;
    if (!last_->bound.empty()) line["bound"] = last_->bound;
    if (last_->ledger_residual) line["ledger_residual"] = *last_->ledger_residual;
    if (last_->ledger_exchanged) line["ledger_exchanged"] = *last_->ledger_exchanged;
    line["seconds_left"] = left ? nlohmann::ordered_json(*left) : nlohmann::ordered_json();
    report(json_text(line, -1));
    return;
  }
  const std::string line = last_ ? status_line(*last_, done, left) : fmt::format("{:3.0f} %", 100.0 * done);
  if (form_ == ProgressForm::terminal) report("\r\033[K" + line);
  if (form_ == ProgressForm::lines) report(line + "\n");
  std::fflush(stderr);
}

std::optional<double> RunProgress::seconds_left(double done) {
  const double gone = done - begun_->first,
               seconds = std::chrono::duration<double>(Clock::now() - begun_->second).count();
  if (gone <= 0.0 || seconds < 0.5) return {};
  return seconds * (1.0 - done) / gone;
}

void RunProgress::end() {
  if (form_ == ProgressForm::terminal && begun_) report("\r\033[K");
}

}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
// The record of a run that has ended, as a folder of somebody else's may hold it. In the input, the word
// FILES stands for the hash of the files that are there.
#include <sys/stat.h>

#include <cmath>

#include "files/job.hpp"
#include "fuzz/input.hpp"
#include "validation/run/finished_run.hpp"

using namespace tripoint;

namespace {

constexpr const char* this_run = "0123456789abcdef";
constexpr const char* another_run = "fedcba9876543210";

std::string bytes_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A run that diverged, which has no frames to read, and its record.
class EndedRun {
 public:
  EndedRun() {
    ::mkdir((folder_ / "engine").c_str(), 0777);
    ::mkdir((folder_ / "engine/run").c_str(), 0777);
    engine_.executable = "/usr/bin/false";  // of others: what it left is read as a third party's
    request.engine = &engine_;
    request.folder = folder_ / "engine/run";
    request.particles = folder_ / "particles.h5";
    Result left;
    left.status = Status::diverged;
    left.message = "too fast";
    write_result(request.folder + "/result.json", left);
    ProcessEnd end;
    end.how = ProcessEnd::How::exited;
    end.code = 7;
    Outcome outcome;
    outcome.status = Status::diverged;
    record_finished(request, this_run, end, outcome);
    const std::string own = bytes_of(folder_ / record), key = "\"files\": \"";
    const std::size_t from = own.find(key) + key.size();
    hash = own.substr(from, own.find('"', from) - from);
    fuzz::expect(!hash.empty(), "a run that diverged leaves a record");
  }
  void write_record(const std::string& text) const { folder_.write(record, text); }

  RunRequest request;
  std::string hash;  ///< of the files that were left

 private:
  static constexpr const char* record = "outcome-engine-run.json";
  fuzz::Folder folder_;
  EngineEntry engine_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const EndedRun run;
  std::string text = fuzz::text_of(data, size);
  constexpr const char* word = "FILES";
  if (const std::size_t at = text.find(word); at != std::string::npos)
    text.replace(at, std::strlen(word), run.hash);
  run.write_record(text);

  if (const auto kept = finished_run(run.request, this_run)) {
    fuzz::expect(kept->kept, "what was not run again says so");
    fuzz::expect(kept->status == Status::diverged,
                 "a record makes no other status than the result that was left");
    fuzz::expect(!kept->reason.empty(), "a run that did not end well has a reason");
    fuzz::expect(!std::isnan(kept->cost.cpu_s) && !std::isnan(kept->cost.wall_s), "a cost is a number");
    fuzz::expect(text.find(this_run) != std::string::npos || text.find('\\') != std::string::npos,
                 "only its own record is a run's");
  }
  fuzz::expect(text.find(another_run) != std::string::npos || text.find('\\') != std::string::npos ||
                   !finished_run(run.request, another_run),
               "the record of a run is not another's");
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
// JOB.json: what is read is written as a text that reads as the same job.
#include "files/job.hpp"
#include "core/errors.hpp"
#include "fuzz/input.hpp"

using namespace tripoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  std::string once;
  try {
    once = job_text(read_job(folder.write("job.json", fuzz::text_of(data, size))));
  } catch (const InputError&) {
    return 0;
  }
  try {
    fuzz::expect(job_text(read_job(folder.write("again.json", once))) == once,
                 "a job that was read is written and read as the same");
  } catch (const InputError&) {  // a number that is not finite is written as null, which no reader takes
    fuzz::expect(once.find("null") != std::string::npos,
                 "a job that was read and is all numbers can be read again");
  }
  return 0;
}

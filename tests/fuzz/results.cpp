// SPDX-License-Identifier: BSD-3-Clause
// results.json of somebody else, as `tripoint gate` takes it: read, judged, remarked on, written.
#include <cmath>

#include "core/errors.hpp"
#include "fuzz/input.hpp"
#include "validation/judge/headroom.hpp"
#include "validation/judge/judge.hpp"
#include "validation/judge/remarks.hpp"

using namespace tripoint;

namespace {

bool has_number_for_each_pass(const CaseResult& c) {
  for (const auto& engine : c.engines)
    for (const auto& row : engine.gates)
      if (row.verdict == Verdict::pass && !row.expect && !std::isfinite(row.value) &&
          row.fit_class != FitClass::roundoff)
        return false;
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  try {
    Results results = read_results(folder.write("results.json", fuzz::text_of(data, size)));
    judge(results);
    fuzz::expect((results.verdict == CaseVerdict::pass) <= (results.exit_code == 0), "PASS ends with 0");
    for (const auto& c : results.cases)
      fuzz::expect(has_number_for_each_pass(c), "no gate passes a number that is not there");
    static_cast<void>(annotations_text(verdict_remarks(results)));
    static_cast<void>(headroom_remarks(results));
    static_cast<void>(results_text(results));
  } catch (const InputError&) {
  }
  return 0;
}

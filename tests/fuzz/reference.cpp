// SPDX-License-Identifier: BSD-3-Clause
// Measured data and tables beside a case, CASE.ref.csv of anybody. The lowest bit of the first byte chooses
// which of the two; the second puts the right hash below the data, without which nothing behind it would be
// reached.
#include <cmath>

#include "core/errors.hpp"
#include "fuzz/input.hpp"
#include "validation/references/experiment.hpp"

using namespace tripoint;

namespace {

std::string with_hash(const std::string& text, const std::string& hash) {
  return text + "# hash: " + hash + "\n";
}

void expect_whole(const ExperimentFile& file) {
  fuzz::expect(!file.source.empty(), "data that are read say where they come from");
  fuzz::expect(!file.curves.empty(), "data that are read hold a curve");
  for (const auto& [name, curve] : file.curves) {
    fuzz::expect(!curve.time.empty(), "a curve holds a value");
    fuzz::expect(curve.value.size() == curve.time.size() && curve.uncertainty.size() == curve.time.size(),
                 "columns are of one length");
    fuzz::expect(file.uncertainty.count(name) == 1, "a curve says how well it is known");
    for (std::size_t k = 0; k < curve.time.size(); ++k) {
      fuzz::expect(!std::isnan(curve.value[k]) && !std::isnan(curve.time[k]),
                   "what was measured is a number");
      fuzz::expect(curve.uncertainty[k] >= 0.0, "an uncertainty is not below 0");
      fuzz::expect(k == 0 || curve.time[k - 1] <= curve.time[k], "the first column rises");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  if (size == 0) return 0;
  const auto read = (data[0] & 1) != 0 ? read_table : read_experiment;
  std::string text = fuzz::text_of(data + 1, size - 1);
  if (!text.empty() && text.back() != '\n') text += '\n';
  const std::string hash = experiment_hash(text);
  const bool is_sealed = (data[0] & 2) != 0;
  try {
    expect_whole(read(folder.write("case.ref.csv", is_sealed ? with_hash(text, hash) : text)));
  } catch (const InputError&) {
    return 0;
  }
  if (!is_sealed) return 0;
  try {
    static_cast<void>(read(folder.write("changed.ref.csv", with_hash(text + "# another word\n", hash))));
  } catch (const InputError&) {
    return 0;
  }
  fuzz::expect(false, "data that changed since they were hashed are refused");
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
// A baseline: what is read is written as a text that reads as the same, sealed.
#include "validation/baseline/baseline.hpp"
#include "core/errors.hpp"
#include "fuzz/input.hpp"

using namespace tripoint;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  if (fuzz::parser_has_no_child() && !fuzz::is_ascii(data, size)) return 0;
  try {
    const std::string once =
        baseline_text(read_baseline(folder.write("once.toml", fuzz::text_of(data, size))));
    const Baseline again = read_baseline(folder.write("again.toml", once));
    fuzz::expect(again.sealed, "a baseline that was written is sealed");
    fuzz::expect(baseline_text(again) == once, "a baseline that was read is written and read as the same");
  } catch (const InputError&) {
  }
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
// What an engine prints or leaves: the first byte chooses --info, --check or result.json.
#include <algorithm>
#include <cctype>

#include "core/errors.hpp"
#include "files/job.hpp"
#include "files/result.hpp"
#include "fuzz/input.hpp"
#include "validation/run/replies.hpp"

using namespace tripoint;

namespace {

bool is_plain(const std::string& name) {
  return !name.empty() && name.size() <= 64 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '-' || c == '_' || c == '.';
  });
}

void read_info(const std::string& text) {
  EngineEntry entry;
  entry.name = "stranger";
  entry.executable = "engine-stranger";
  entry = with_info(entry, text);
  fuzz::expect(is_plain(entry.name), "an engine's name is plain, whatever it calls itself");
  fuzz::expect(!entry.available || std::all_of(entry.presets.begin(), entry.presets.end(), is_plain),
               "presets of an engine that is available are plain");
  fuzz::expect(entry.available || !entry.reason.empty(), "an engine that is not available has a reason");
  static_cast<void>(engines_json({entry}));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder folder;
  if (size == 0) return 0;
  const std::string text = fuzz::text_of(data + 1, size - 1);
  switch (data[0] % 3) {
    case 0:
      read_info(text);
      break;
    case 1:
      static_cast<void>(refusal_in(text));
      break;
    default:
      try {
        write_result(folder / "again.json", read_result(folder.write("result.json", text)));
      } catch (const InputError&) {
      }
  }
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <link.h>

#include <string>

namespace tripoint {

/// Path of the shared library whose file name starts with `stem`, as the loader took it into this process; ""
/// if none.
inline std::string loaded_library(const std::string& stem) {
  struct Search {
    std::string stem, found;
  } search{"/" + stem, ""};
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* data) {
        auto& s = *static_cast<Search*>(data);
        const std::string path = info->dlpi_name;
        if (path.find(s.stem) == std::string::npos) return 0;
        s.found = path;
        return 1;
      },
      &search);
  return search.found;
}

}  // namespace tripoint

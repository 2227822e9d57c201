// SPDX-License-Identifier: BSD-3-Clause
#include "validation/campaign/case_names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "core/errors.hpp"
#include "tables/library.hpp"
#include "tables/nearest.hpp"

namespace tripoint {
namespace fs = std::filesystem;
namespace {

fs::path shipped() { return fs::path(share_folder()) / "cases"; }

/// People also type the last part of an id, or a path below cases/ without its ending.
std::string nearest_case(std::string what) {
  if (what.ends_with(".toml")) what.erase(what.size() - 5);
  if (const auto at = what.rfind("cases/"); at != std::string::npos) what.erase(0, at + 6);
  const auto ids = shipped_ids();
  for (const auto& id : ids)
    if (id.ends_with("/" + what)) return id;
  std::vector<std::string> names = ids;
  for (const auto& id : ids)
    if (const auto subject = id.substr(0, id.find('/')); names.back() != subject) names.push_back(subject);
  if (const auto near = nearest(what, names); !near.empty()) return near;
  std::vector<std::string> last;
  for (const auto& id : ids) last.push_back(id.substr(id.rfind('/') + 1));
  const auto near = nearest(what.substr(what.rfind('/') + 1), last);
  const auto at = std::find(last.begin(), last.end(), near);
  return near.empty() ? "" : ids[static_cast<std::size_t>(at - last.begin())];
}

}  // namespace

std::vector<std::string> shipped_ids() {
  std::vector<std::string> ids;
  std::error_code none;
  for (fs::recursive_directory_iterator at(shipped(), fs::directory_options::follow_directory_symlink, none),
       end;
       at != end; at.increment(none)) {
    const auto id = fs::path(at->path()).replace_extension().lexically_relative(shipped()).string();
    if (at->path().extension() == ".toml" && id.find(".ref") == std::string::npos &&
        !id.starts_with("materials/"))
      ids.push_back(id);
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

std::string case_file(const std::string& path_or_id) {
  std::error_code none;
  if (fs::exists(path_or_id, none) && !fs::is_directory(path_or_id, none)) return path_or_id;
  const auto by_id = shipped() / (path_or_id + ".toml");
  if (fs::is_regular_file(by_id, none)) return by_id.string();
  if (fs::is_regular_file(path_or_id + ".toml", none)) return path_or_id + ".toml";
  if (fs::is_directory(path_or_id, none) || !subject_folder(path_or_id).empty())
    throw InputError(path_or_id +
                     ": is a folder of cases, and one case is wanted (tripoint list prints the ids)");
  throw InputError(no_such_case(path_or_id));
}

std::string subject_folder(const std::string& subject) {
  std::error_code none;
  const bool plain = !subject.empty() && subject.front() != '/' && subject.find("..") == std::string::npos &&
                     subject != "materials";
  const auto folder = shipped() / subject;
  return plain && fs::is_directory(folder, none) ? folder.string() : "";
}

std::string no_such_case(const std::string& what) {
  const auto near = nearest_case(what);
  return fmt::format("{}: is no case file, no folder and no case id ({})", printable(what, 200),
                     near.empty() ? "tripoint list prints the ids" : "did you mean `" + near + "`?");
}

}  // namespace tripoint

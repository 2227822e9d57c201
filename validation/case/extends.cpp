// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "tables/library.hpp"
#include "tables/nearest.hpp"
#include "validation/case/case_document.hpp"
#include "validation/case/case_keys.hpp"

/// The file that a case extends, and the chain of such files.
namespace tripoint {
namespace fs = std::filesystem;
namespace {

using Kind = TomlNode::Kind;

constexpr std::size_t most_files = 8;  ///< of a chain, the case itself counted

[[noreturn]] void refuse(const TomlNode& extends, const std::string& what) {
  const std::string given = extends.kind == Kind::text ? "\"" + printable(extends.text, 120) + "\""
                                                       : std::string(kind_name(extends.kind));
  throw InputError(extends.place, fmt::format("`extends` = {}: {}", given, what));
}

/// The nearest folder named `cases` around a file; empty where there is none.
fs::path cases_around(const fs::path& file) {
  for (fs::path at = file.parent_path(); at.has_relative_path(); at = at.parent_path())
    if (at.filename() == "cases") return at;
  return {};
}

bool is_below(const fs::path& file, const fs::path& folder) {
  if (folder.empty()) return false;
  const auto relative = file.lexically_relative(folder);
  return !relative.empty() && *relative.begin() != "..";
}

fs::path real(const fs::path& path) {
  std::error_code error;
  const auto found = fs::canonical(path, error);
  return error ? fs::path() : found;
}

/// Accepts tables of a case with a scene, or with a base. Any other file is left unread, so that no message
/// can quote it.
void check_is_case(const TomlNode& document, const TomlNode& extends) {
  const auto known = case_keys().names("");
  const bool knows_all = std::all_of(document.members.begin(), document.members.end(), [&](const auto& m) {
    return std::find(known.begin(), known.end(), m.first) != known.end();
  });
  if (!knows_all || !(document.find("scene") || document.find("extends")))
    refuse(extends,
           "that file is no case: give the path of a case file, or see what `tripoint check` says of it");
}

TomlNode read_extended(const std::string& file, const TomlNode& extends) {
  TomlNode document;
  try {
    document = read_toml(file);
  } catch (const InputError& e) {
    throw InputError(e.place(), fmt::format("cannot be read as TOML, and {} extends it: give the path of a "
                                            "case file, or see what `tripoint check` says of it",
                                            to_string(extends.place)));
  }
  check_is_case(document, extends);
  return document;
}

/// Data and meshes that the base names lie beside the base; the case, which may lie in another folder, finds
/// them there.
void move_files(TomlNode& node, const fs::path& from, const fs::path& to) {
  for (auto& [key, value] : node.members) {
    if (key == "args" || key == "settings") continue;  // free keys
    std::error_code error;
    if (key == "file" && value.kind == Kind::text && fs::is_regular_file(from / value.text, error))
      value.text = (from / value.text).lexically_relative(to).string();
    move_files(value, from, to);
  }
  for (auto& item : node.items) move_files(item, from, to);
}

/// Erases the keys that belong to a file and are not handed on; gives back the value of one.
std::optional<TomlNode> take(TomlNode& table, std::string_view key) {
  const auto at =
      std::find_if(table.members.begin(), table.members.end(), [&](const auto& m) { return m.first == key; });
  if (at == table.members.end()) return {};
  TomlNode value = std::move(at->second);
  table.members.erase(at);
  return value;
}

TomlNode resolve(TomlNode document, const std::string& file, std::vector<std::string> chain) {
  write_out_gates(document);
  const auto extends = take(document, "extends");
  const auto remove = take(document, "remove");
  if (!extends) {
    if (remove)
      throw InputError(
          remove->key_place,
          "`remove` takes keys out of what a case extends, and this one extends nothing: remove the key");
    return document;
  }
  const std::string base_file = extended_file(*extends, file);
  chain.push_back(real(file).string());
  if (std::find(chain.begin(), chain.end(), real(base_file).string()) != chain.end()) {
    std::string circle;
    for (const auto& link : chain) circle += fs::path(link).filename().string() + " -> ";
    refuse(*extends, fmt::format("the files extend each other in a circle: {}{}; remove one of these links",
                                 circle, fs::path(base_file).filename().string()));
  }
  if (chain.size() >= most_files)
    refuse(*extends,
           fmt::format("a chain of more than {} files: extend one nearer to the start", most_files));
  TomlNode base = resolve(read_extended(base_file, *extends), base_file, chain);
  const auto from = real(base_file).parent_path(), to = real(file).parent_path();
  if (from != to) move_files(base, from, to);
  if (auto* head = base.find("case")) static_cast<void>(take(*head, "id"));  // a name belongs to one file
  if (remove) remove_keys(base, *remove);
  merge_case(base, std::move(document));
  return base;
}

}  // namespace

std::string extended_file(const TomlNode& extends, const std::string& file) {
  if (extends.kind != Kind::text || extends.text.empty())
    refuse(extends, "write the path of a case file, \"other.toml\", or a case's name, \"rigid/ballistic\"");
  const fs::path given = extends.text;
  const fs::path here = real(file), around = cases_around(here),
                 shipped = real(fs::path(share_folder()) / "cases");
  std::vector<fs::path> places;
  if (given.extension() == ".toml") {
    places = {fs::path(file).parent_path() / given};
  } else {
    for (const auto& folder : {around, shipped})
      if (!folder.empty()) places.push_back(folder / (given.string() + ".toml"));
  }
  for (const auto& place : places) {
    std::error_code error;
    const fs::path found = real(place);
    if (given.is_absolute() || found.empty() || found.extension() != ".toml" ||
        !fs::is_regular_file(found, error))
      continue;
    if (found.parent_path() == here.parent_path() || is_below(found, around) || is_below(found, shipped))
      return place.lexically_normal().string();
  }
  refuse(extends,
         "no case file of that name in the folder of this file, nor below a folder `cases` around it, nor "
         "among the shipped "
         "cases: give one of these");
}

TomlNode read_case_document(const std::string& file) {
  TomlNode document = resolve(read_toml(file), file, {});
  write_out_invariants(document);
  return document;
}

}  // namespace tripoint

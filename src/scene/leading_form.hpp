// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <map>
#include <string>
#include <string_view>

#include "scene/readers.hpp"
#include "scene/value_reader.hpp"

namespace tripoint {

/// Takes the form of a term that leads, where the file names none, its effect would act, and no given key is
/// one of the term's own form. @param top the case file   @param in its table [scene]
/// @pre all of the scene but its modes is read   @return why each of those terms has its form
std::map<std::string_view, std::string> take_leading_forms(TableReader& top, const TableReader& in, Scene&);

}  // namespace tripoint

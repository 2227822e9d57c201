// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "references/liquids.hpp"
#include "references/measured.hpp"
#include "scene/case_file.hpp"
#include "validation/references/reference.hpp"

namespace tripoint {
namespace {

using test::DataFile;
using test::sealed;

std::unique_ptr<Reference> made(const std::string& name, const Settings& args, const std::string& file = "") {
  static const auto scene = test::block({}, 1.0, 4);
  auto choice = test::function(name, args);
  choice.file = file;
  return make_reference(choice, scene.job, scene.initial);
}

std::string refused(const std::string& name, const Settings& args, const std::string& file = "") {
  try {
    (void)made(name, args, file);
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

Snapshot two_places(double time) {
  Snapshot s;
  s.time = time;
  s.position = {{1.0, 2.0, 3.0}, {0.5, 0.0, 0.0}};
  return s;
}

bool is_read(const std::string& argument, const std::string& text) {
  const std::string file =
      "[scene]\nend_time = 1\nspacing = 0.1\n[[material]]\nname = 'brick'\ndensity = 1000\n[[body]]\nname = "
      "'cube'\nmaterial = "
      "'brick'\nphase = 'rigid'\nshape = {kind = 'box', min = [0,0,0], max = [1,1,1]}\n[reference]\nkind = "
      "'analytic'\nfunction "
      "= "
      "'expression'\nargs = {" +
      argument + " = '" + text + "'}\n";
  try {
    static_cast<void>(test::read_text(file));
  } catch (const InputError&) {
    return false;
  }
  return true;
}

/// The reader of cases, which knows no reference, tells words from formulas by a list of its own.
TEST(ExpressionReference, HasFormulasThatAreCheckedWhereTheCaseIsRead) {
  const auto function = std::ranges::find(reference_functions(), "expression", &ReferenceFunction::name);
  ASSERT_NE(function, reference_functions().end());
  for (const ReferenceArgument& a : function->args) {
    if (a.type != ArgumentType::formula && a.type != ArgumentType::word && a.type != ArgumentType::axis)
      continue;
    EXPECT_TRUE(is_read(a.name, "t")) << a.name;
    EXPECT_EQ(is_read(a.name, "no formula ("), a.type != ArgumentType::formula) << a.name;
  }
}

TEST(ExpressionReference, IsAFieldOfPlaceAndTime) {
  const auto truth = made(
      "expression", {{"temperature", std::string("300 + x + 10*t")}, {"velocity_y", std::string("z*t")}});
  const auto here = truth->truth_for(two_places(2.0));
  EXPECT_EQ(here.temperature, (std::vector<double>{321.0, 320.5}));
  EXPECT_EQ(here.velocity[0], (Vec3{0.0, 6.0, 0.0}));
  EXPECT_TRUE(here.pressure.empty());
  EXPECT_FALSE(truth->number_at("value", 1.0));
}

TEST(ExpressionReference, IsANumberInTimeOrTheFieldAtItsProbe) {
  const auto curve = made("expression", {{"value", std::string("3*t^2")}, {"axis", std::string("z")}});
  EXPECT_EQ(*curve->number_at("value", 2.0), 12.0);
  EXPECT_EQ(*curve->measuring().axis, 2U);
  const auto probe = made("expression", {{"temperature", std::string("x*t")},
                                         {"velocity_x", std::string("z")},
                                         {"axis", std::string("x")},
                                         {"point", std::vector<double>{4.0, 0.0, 7.0}}});
  EXPECT_EQ(*probe->number_at("temperature_at", 2.0), 8.0);
  EXPECT_EQ(*probe->number_at("velocity_at", 2.0), 7.0);
  EXPECT_FALSE(probe->number_at("pressure_at", 2.0));
}

TEST(ExpressionReference, RefusesWhatIsNoFormula) {
  EXPECT_NE(refused("expression", {{"value", std::string("3*tt")}})
                .find("argument `value` of reference function expression, column 3"),
            std::string::npos);
  EXPECT_NE(refused("expression", {{"axis", std::string("z")}}).find("needs a formula"), std::string::npos);
  EXPECT_NE(refused("expression", {{"temprature", std::string("300")}}).find("did you mean `temperature`"),
            std::string::npos);
  EXPECT_NE(refused("expression", {{"value", 3.0}}).find("must be a text"), std::string::npos);
  EXPECT_NE(refused("expression", {{"value", std::string("1")}, {"axis", std::string("w")}})
                .find("argument `axis` of reference function expression"),
            std::string::npos);
  EXPECT_NE(refused("stated", {{"min", std::vector<double>{0, 0, 0}}}).find("needs both `min` and `max`"),
            std::string::npos);
  EXPECT_NE(refused("stated", {{"frequency", -1.0}}).find("must be greater than 0"), std::string::npos);
}

const std::string in_time =
    "# source: a page\n# unit time: 1 s\n# unit height: 0.01 m\n# uncertainty height: 2\n# unit width: 1 "
    "m\n# uncertainty width: "
    "1 %\ntime,height,width\n0,100,5\n2,300,7\n";
const std::string in_place =
    "# source: a page\n# unit z: 0.001 m\n# unit temperature: 1 K\n# uncertainty temperature: "
    "0.5\nz,temperature\n0,300\n10,400\n20,350\n";

TEST(TableReference, IsANumberInTimeWithTheUncertaintyOfItsFile) {
  const DataFile file(sealed(in_time));
  const auto truth =
      made("table", {{"column", std::string("height")}, {"axis", std::string("x")}}, file.path());
  EXPECT_DOUBLE_EQ(*truth->number_at("value", 0.5), 1.5);
  EXPECT_DOUBLE_EQ(*truth->number_at("value", 2.0), 3.0);
  EXPECT_FALSE(truth->number_at("value", 2.1));  // beyond the table nothing is known
  EXPECT_DOUBLE_EQ(*truth->uncertainty("centre", 1.0), 0.02);
  EXPECT_EQ(*truth->measuring().axis, 0U);
}

TEST(TableReference, IsAFieldAlongAnAxis) {
  const DataFile file(sealed(in_place));
  const auto truth = made("table", {{"point", std::vector<double>{0, 0, 0.015}}}, file.path());
  Snapshot s;
  s.position = {{0, 0, 0.005}, {9, 9, 0.02}, {0, 0, 0.03}};
  const auto here = truth->truth_for(s);
  EXPECT_DOUBLE_EQ(here.temperature[0], 350.0);
  EXPECT_DOUBLE_EQ(here.temperature[1], 350.0);
  EXPECT_TRUE(std::isnan(here.temperature[2]));
  EXPECT_DOUBLE_EQ(*truth->number_at("temperature_at", 0.0), 375.0);
  EXPECT_DOUBLE_EQ(*truth->uncertainty("temperature", 0.0), 0.5);
  EXPECT_DOUBLE_EQ(*truth->uncertainty("pressure_at", 0.0), 0.0);
}

TEST(TableReference, RefusesWhatItCannotUse) {
  const DataFile curves(sealed(in_time)), field(sealed(in_place)), changed(sealed(in_time) + "3,1,1\n");
  EXPECT_NE(refused("table", {}).find("needs the key `file`"), std::string::npos);
  EXPECT_NE(refused("table", {}, curves.path()).find("several columns"), std::string::npos);
  EXPECT_NE(refused("table", {{"column", std::string("hight")}}, curves.path()).find("did you mean `height`"),
            std::string::npos);
  EXPECT_NE(
      refused("table", {{"column", std::string("temperature")}}, field.path()).find("is of a table in time"),
      std::string::npos);
  EXPECT_NE(refused("table", {{"column", std::string("height")}}, changed.path())
                .find("they changed since they were entered"),
            std::string::npos);
  std::string other = in_place;
  for (std::size_t at = other.find("temperature"); at != other.npos; at = other.find("temperature", at + 7))
    other.replace(at, 11, "warmth");
  const DataFile unknown(sealed(other));
  EXPECT_NE(refused("table", {}, unknown.path()).find("no field is named `warmth`"), std::string::npos);
}

}  // namespace
}  // namespace tripoint

// SPDX-License-Identifier: BSD-3-Clause
#include "particles/columns.hpp"

#include <gtest/gtest.h>

#include <cstdint>

#include "particles/particles.hpp"

namespace tripoint {
namespace {

std::vector<FieldInfo> some_fields() {
  auto fields = common_fields(false);
  fields.emplace_back(field::temperature);
  fields.emplace_back(field::body_centre);
  return fields;
}

TEST(Columns, ThrowTheNameOfAFieldThatNobodyOwns) {
  const Particles particles(3, common_fields(false));
  try {
    (void)particles[field::temperature];
    FAIL() << "a column without an owner was handed out";
  } catch (const MissingField& e) {
    EXPECT_EQ(e.field(), "temperature");
  }
}

TEST(Columns, HoldOnlyTheirOwnCarriersFields) {
  const Columns bodies(2, Per::body, some_fields());
  EXPECT_TRUE(bodies.has("body.centre"));
  EXPECT_FALSE(bodies.has("temperature"));
  EXPECT_THROW((void)bodies[field::temperature], MissingField);
}

TEST(Columns, StartAtAVectorAndAreReadableOneVectorBeyondTheEnd) {
  Particles particles(5, some_fields());
  for (const auto* f : {&field::mass, &field::temperature, &field::position.z}) {
    const auto column = particles[*f];
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(column.data()) % vector_bytes, 0u);
    for (std::size_t n = column.size(); n < column.size() + vector_bytes / sizeof(double); ++n)
      EXPECT_EQ(column.data()[n], 0.0);
  }
}

TEST(Columns, MoveEveryFieldAlikeWhenPermuted) {
  Particles particles(4, some_fields());
  for (std::size_t i = 0; i < 4; ++i) {
    particles[field::temperature][i] = 300.0 + static_cast<double>(i);
    particles[field::body][i] = 10 + static_cast<int>(i);
  }
  const std::vector<std::uint32_t> order{2, 0, 3, 1};
  particles.permute(order);
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(particles[field::id][n], static_cast<int>(order[n]));
    EXPECT_EQ(particles[field::temperature][n], 300.0 + order[n]);
    EXPECT_EQ(particles[field::body][n], 10 + static_cast<int>(order[n]));
    EXPECT_EQ(particles.row(order[n]), n);
  }
}

/// Rows that stay, change places, come twice, go and are new, in fewer rows, as many and more.
TEST(Columns, TakeTheRowsThatAreNamed) {
  constexpr std::uint32_t none = Particles::none;
  for (const std::vector<std::uint32_t>& rows : std::vector<std::vector<std::uint32_t>>{
           {0, 1, 2, 3}, {0, 3, 2, 1}, {3, 1}, {}, {1, 1, 2, none}, {0, none, 2, 3, none, 1, 2}}) {
    Particles particles(4, some_fields());
    for (std::size_t i = 0; i < 4; ++i) {
      particles[field::temperature][i] = 300.0 + static_cast<double>(i);
      particles[field::body][i] = 10 + static_cast<int>(i);
    }
    particles.make_of(rows);
    ASSERT_EQ(particles.size(), rows.size());
    for (std::size_t n = 0; n < rows.size(); ++n) {
      if (rows[n] == none) continue;
      EXPECT_EQ(particles[field::temperature][n], 300.0 + rows[n]);
      EXPECT_EQ(particles[field::body][n], 10 + static_cast<int>(rows[n]));
    }
  }
}

TEST(Columns, KeepTheirRowsWhenOneIsAdded) {
  Columns bodies(0, Per::body, some_fields());
  bodies.append_row();
  bodies[field::body_centre][0] = {1.0, 2.0, 3.0};
  bodies.append_row();
  EXPECT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[field::body_centre][0], (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(bodies[field::body_centre][1], Vec3{});
}

}  // namespace
}  // namespace tripoint

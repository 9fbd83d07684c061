#include "pbr/brdf/lambert.hpp"

#include <gtest/gtest.h>

#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

TEST(Lambert, ReturnsEverything) {
    EXPECT_NEAR(reflection_albedo([](const Reflection<double>&) { return f_lambert<double>(); }, .3), 1,
                1e-12);
    static_assert(f_lambert<float>() == 0.318309886f);
}

}  // namespace
}  // namespace pbr

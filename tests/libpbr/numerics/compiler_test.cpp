// What libpbr takes for granted of the compiler.

#include <gtest/gtest.h>

#include "pbr/numerics/vector.hpp"

namespace pbr {
namespace {

[[gnu::noinline]] Vec3<double> through_float(const Vec3<double>& v) {
    return {static_cast<double>(static_cast<float>(v.x)), static_cast<double>(static_cast<float>(v.y)),
            static_cast<double>(static_cast<float>(v.z))};
}

TEST(Compiler, RoundsToFloatWhereTheSourceSaysSo) {
    // 1 + 2^-30 has no float: it becomes 1. GCC 12.2 at -O2 keeps it in two of three neighbours, unless told
    // not to vectorise them.
    const double fine = 1 + 0x1p-30;
    const Vec3<double> rounded = through_float({fine, fine, fine});
    EXPECT_EQ(rounded.x, 1);
    EXPECT_EQ(rounded.y, 1);
    EXPECT_EQ(rounded.z, 1);
}

}  // namespace
}  // namespace pbr

#include "pbr/brdf/reflection.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/property.hpp"
#include "tests/libpbr/support/reflections.hpp"

namespace pbr {
namespace {

RC_GTEST_PROP(Reflection, AnglesAreThoseOfTheHalfVector, ()) {
    const Vec3<double> wo = *direction_above(), wi = *direction_above();
    const Reflection<double> r = reflection(wo, wi);
    RC_PRE(glm::length(wo + wi) > 1e-3);
    RC_ASSERT(std::abs(glm::length(r.wm) - 1) < 1e-14);
    RC_ASSERT(std::abs(glm::dot(r.wm, wo) - r.LoH) < 1e-12);
    RC_ASSERT(std::abs(glm::dot(r.wm, wi) - r.LoH) < 1e-12);
    RC_ASSERT(r.NoL == wi.z && r.NoV == wo.z && r.NoH == r.wm.z);
    RC_ASSERT(std::abs(r.sin2 + r.NoH * r.NoH - 1) < 1e-14);
}

TEST(Reflection, HasNoHalfVectorToDivideByAtGrazingOpposites) {
    const Reflection<double> r = reflection(Vec3<double>(1, 0, 0), Vec3<double>(-1, 0, 0));
    EXPECT_EQ(r.NoH, 1);
    EXPECT_EQ(r.LoH, 0);
    EXPECT_EQ(r.sin2, 0);
}

TEST(Reflection, FloatIsWithinTheUlpStated) {
    for (int i = 0; i < 50'000; ++i) {
        const Reflection<float> r = as_float(sample_reflection(i));
        const Reflection<double> d = reflection(Vec3<double>(r.wo), Vec3<double>(r.wi));
        if (d.LoH < .05) continue;
        EXPECT_LT(ulp_error_of(1, r.NoH, d.NoH), 4);
        EXPECT_LT(ulp_error_of(1, r.LoH, d.LoH), 4);
        EXPECT_LT(ulp_error_of(1, r.LoV, d.LoV), 4);
        EXPECT_LT(ulp_error_of(1, r.sin2, d.sin2), 4);
    }
}

}  // namespace
}  // namespace pbr

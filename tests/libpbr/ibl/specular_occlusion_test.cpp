#include "pbr/ibl/specular_occlusion.hpp"

#include <gtest/gtest.h>

#include "pbr/reference/reflected_radiance.hpp"
#include "tests/libpbr/reference/lobes.hpp"
#include "tests/libpbr/support/float_error.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

TEST(SpecularOcclusion, IsWhatTheListingSays) {
    // Exponents 1/2 at alpha 0 and 1/4 at 1/16.
    EXPECT_NEAR(specular_occlusion_frostbite(.25, .5, 0.0), std::sqrt(.75) - .5, 1e-15);
    EXPECT_NEAR(specular_occlusion_frostbite(.25, .5, .0625), std::sqrt(std::sqrt(.75)) - .5, 1e-15);
    for (const double NoV : {0.0, .3, 1.0})
        for (const double alpha : {0.0, .2, 1.0}) {
            EXPECT_EQ(specular_occlusion_frostbite(NoV, 1.0, alpha), 1);
            EXPECT_EQ(specular_occlusion_frostbite(NoV, 0.0, alpha), 0);
        }
    for (double AO = .3; AO <= 1; AO += .1) EXPECT_NEAR(specular_occlusion_frostbite(.0, AO, 1.0), AO, 1e-5);
}

RC_GTEST_PROP(SpecularOcclusion, StaysInRangeAndRises, ()) {
    const double NoV = *unit_interval(), AO = *unit_interval(), alpha = *unit_interval();
    const double value = specular_occlusion_frostbite(NoV, AO, alpha);
    RC_ASSERT(value >= 0 && value <= 1);
    RC_ASSERT(specular_occlusion_frostbite(std::min(1.0, NoV + .01), AO, alpha) >= value - 1e-15);
    RC_ASSERT(specular_occlusion_frostbite(NoV, std::min(1.0, AO + .01), alpha) >= value - 1e-15);
    const float n = static_cast<float>(NoV), v = static_cast<float>(AO), a = static_cast<float>(alpha);
    RC_ASSERT(ulp_error_of(1, specular_occlusion_frostbite(n, v, a),
                           specular_occlusion_frostbite<double>(n, v, a)) <= 8);
}

TEST(SpecularOcclusion, ErrsAsStatedUnderAnOpenCone) {
    // Directions within a cone about the normal whose share of the cosine-weighted hemisphere is AO: sin^2 =
    // AO.
    double worst = 0;
    for (const double alpha : {.1, .25, .5, 1.0})
        for (const double NoV : {.1, .3, .5, .7, .9})
            for (const double AO : {.2, .5, .8}) {
                const Vec3<double> wo = view(NoV);
                const Peak peak{Vec3<double>(-wo.x, -wo.y, wo.z), alpha};
                const QuadratureTolerance tolerance{1e-4};
                const double open =
                    reflected_radiance_from_cap(Ggx{alpha}, wo, {{0, 0, 1}, std::asin(std::sqrt(AO))}, one,
                                                tolerance, std::span(&peak, 1))
                        .value;
                const double whole =
                    reflected_radiance_half_vector(Ggx{alpha}, wo, one, alpha, tolerance).value;
                worst =
                    std::max(worst, std::abs(specular_occlusion_frostbite(NoV, AO, alpha) - open / whole));
            }
    EXPECT_NEAR(worst, .546, 2e-3);
}

}  // namespace
}  // namespace pbr

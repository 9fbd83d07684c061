#include "pbr/reference/reflected_texels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/dfg.hpp"
#include "pbr/reference/flat_light.hpp"
#include "pbr/reference/reflected_radiance.hpp"
#include "tests/libpbr/reference/lobes.hpp"

namespace pbr {
namespace {

const Vec3<double> kView(0.8, 0, 0.6);

TEST(ReflectedTexels, OfAConstantPictureIsTheAlbedo) {
    const std::vector<float> rgb(64 * 32 * 3, 2.f);
    const PatchBlocks map(EquirectView{rgb.data(), 64, 32, glm::dmat3(1)}), cube(CubeView{rgb.data(), 16});
    for (const PatchBlocks* source : {&map, &cube}) {
        const ColourEstimate e = reflected_radiance_from_texels(lambert, kView, *source, glm::dmat3(1), 1e-5);
        EXPECT_NEAR(e.value.x, 2, 4e-5);
        EXPECT_EQ(e.value.x, e.value.z);
        const double albedo = dfg_ggx(kView.z, 0.2, DfgMethod::quadrature(1e-8)).E;
        EXPECT_NEAR(reflected_radiance_from_texels(Ggx{0.2}, kView, *source, glm::dmat3(1), 1e-5).value.y,
                    2 * albedo, 1e-4);
    }
}

TEST(ReflectedTexels, NarrowLobesSeeWithinATexel) {
    const std::vector<float> rgb(32 * 16 * 3, 1.f);
    const PatchBlocks map(EquirectView{rgb.data(), 32, 16, glm::dmat3(1)});
    const ColourEstimate e = reflected_radiance_from_texels(Ggx{0.01}, kView, map, glm::dmat3(1), 1e-5);
    EXPECT_NEAR(e.value.x, dfg_ggx(kView.z, 0.01, DfgMethod::quadrature(1e-8)).E, 1e-4);
}

TEST(ReflectedTexels, IsWhatDirectionsGiveForTheSamePicture) {
    // One cube texel lit: its image is a known region of directions.
    constexpr int kSize = 4;
    std::vector<float> rgb(6 * kSize * kSize * 3, 0.f);
    const CubeTexel lit{4, 1, 2};  // on +Z
    rgb[((lit.face * kSize + lit.y) * kSize + lit.x) * 3 + 2] = 5.f;
    const PatchBlocks source(CubeView{rgb.data(), kSize});
    const Ggx brdf{0.3};
    const ColourEstimate e = reflected_radiance_from_texels(brdf, kView, source, glm::dmat3(1), 1e-6);
    EXPECT_EQ(e.value.x, 0);
    // The texel is a rectangle on the plane z = 1: an area light whose radiance is 5.
    const double s = cube_coordinate(lit.x, kSize), t = cube_coordinate(lit.y, kSize);
    const FlatLight rectangle{cube_vector(lit.face, s, t), {0, 1.0 / kSize, 0}, {1.0 / kSize, 0, 0}};
    const Estimate exact = reflected_radiance_from_parallelogram(brdf, kView, rectangle,
                                                                 [](const Vec3<double>&) { return 5.0; });
    EXPECT_NEAR(e.value.z, exact.value, 1e-6 * exact.value);
    EXPECT_TRUE(e.converged);
}

TEST(ReflectedTexels, TurnsTheWorldIntoTheSurfacesFrame) {
    constexpr int kSize = 4;
    std::vector<float> rgb(6 * kSize * kSize * 3, 0.f);
    for (int i = 0; i < kSize * kSize; ++i) rgb[(2 * kSize * kSize + i) * 3] = 1.f;  // the face +Y shines
    const PatchBlocks source(CubeView{rgb.data(), kSize});
    const glm::dmat3 y_to_z(0, 1, 0, 0, 0, 1, 1, 0, 0);  // x to y, y to z, z to x
    const double up = reflected_radiance_from_texels(lambert, kView, source, y_to_z, 1e-6).value.x;
    const FlatLight ceiling{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
    EXPECT_NEAR(
        up,
        reflected_radiance_from_parallelogram(lambert, kView, ceiling, [](const auto&) { return 1.0; }).value,
        1e-6);
    const glm::dmat3 y_to_minus_z(1, 0, 0, 0, 0, -1, 0, 1, 0);
    EXPECT_EQ(reflected_radiance_from_texels(lambert, kView, source, y_to_minus_z, 1e-6).value.x, 0);
}

}  // namespace
}  // namespace pbr

#include "pbr/ibl/cubemap.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "pbr/numerics/sequence.hpp"
#include "pbr/numerics/sum.hpp"

namespace pbr {
namespace {

TEST(Cubemap, FacesPointWhereOpenGLSaysTheyDo) {
    const glm::dvec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int face = 0; face < 6; ++face) EXPECT_EQ(cube_vector(face, 0, 0), axes[face]) << face;
    // s and t of OpenGL 4.6, table 8.19: +X has sc = -rz, tc = -ry, and so on.
    EXPECT_EQ(cube_vector(0, 1, 0), glm::dvec3(1, 0, -1));
    EXPECT_EQ(cube_vector(1, 1, 0), glm::dvec3(-1, 0, 1));
    EXPECT_EQ(cube_vector(2, 0, 1), glm::dvec3(0, 1, 1));
    EXPECT_EQ(cube_vector(3, 0, 1), glm::dvec3(0, -1, -1));
    EXPECT_EQ(cube_vector(4, 0, 1), glm::dvec3(0, -1, 1));
    EXPECT_EQ(cube_vector(5, 1, 0), glm::dvec3(-1, 0, -1));
}

TEST(Cubemap, DirectionAndTexelAreInverse) {
    for (const int size : {1, 2, 3, 8, 17, 256})
        for (int face = 0; face < 6; ++face)
            for (int k = 0; k < 64; ++k) {
                const CubeTexel texel{face, static_cast<int>(random_bits(1, k) % size),
                                      static_cast<int>(random_bits(2, k) % size)};
                EXPECT_EQ(cubemap_texel(cubemap_texel_direction(texel, size), size), texel);
            }
}

TEST(Cubemap, SolidAnglesSumToTheSphere) {
    for (const int size : {1, 2, 3, 7, 64, 333, 1024}) {
        CompensatedSum face;
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) face += cubemap_texel_solid_angle(size, x, y);
        EXPECT_NEAR(6 * face.value(), 4 * std::numbers::pi, 1e-12) << size;
    }
}

TEST(Cubemap, SolidAngleAgreesWithTheAntiderivative) {
    // A second witness: the integral of (1 + s^2 + t^2)^-3/2 is atan(s t / sqrt(1 + s^2 + t^2)), in long
    // double.
    const auto corner = [](long double s, long double t) {
        return std::atan2(s * t, std::sqrt(1 + s * s + t * t));
    };
    for (const int size : {1, 4, 15, 128})
        for (int k = 0; k < 50; ++k) {
            const int x = static_cast<int>(random_bits(3, k) % size),
                      y = static_cast<int>(random_bits(4, k) % size);
            const long double s0 = 2.0L * x / size - 1, s1 = 2.0L * (x + 1) / size - 1,
                              t0 = 2.0L * y / size - 1, t1 = 2.0L * (y + 1) / size - 1;
            const long double exact = corner(s1, t1) - corner(s0, t1) - corner(s1, t0) + corner(s0, t0);
            EXPECT_NEAR(static_cast<double>(cubemap_texel_solid_angle(size, x, y) / exact), 1, 1e-13);
        }
}

TEST(Cubemap, NeighboursLieAcrossTheEdgeAndAreMutual) {
    for (const int size : {1, 2, 5, 16})
        for (int face = 0; face < 6; ++face)
            for (int i = 0; i < size; ++i)
                for (const auto& [x, y] : {std::pair{i, -1}, {i, size}, {-1, i}, {size, i}}) {
                    const CubeTexel across = cubemap_neighbour(face, x, y, size);
                    ASSERT_NE(across.face, face);
                    const CubeTexel own{face, std::clamp(x, 0, size - 1), std::clamp(y, 0, size - 1)};
                    // The two share an edge: their centres are as far apart as neighbours can be.
                    const double apart = glm::length(cubemap_texel_direction(across, size) -
                                                     cubemap_texel_direction(own, size));
                    EXPECT_LT(apart, size == 1 ? 1.5 : 2.9 / size);
                    bool mutual = false;
                    for (const auto& [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
                        const int bx = across.x + dx, by = across.y + dy;
                        if (bx < 0 || by < 0 || bx >= size || by >= size)
                            mutual |= cubemap_neighbour(across.face, bx, by, size) == own;
                    }
                    EXPECT_TRUE(mutual);
                }
}

}  // namespace
}  // namespace pbr

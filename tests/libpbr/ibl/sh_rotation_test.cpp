#include "pbr/ibl/sh_rotation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

/// Rotation by an angle about a unit axis (Rodrigues), as GLM stores it: columns.
template <class T>
glm::mat<3, 3, T> rotation(const Vec3<double>& axis, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    glm::dmat3 m(1);
    for (int column = 0; column < 3; ++column) {
        glm::dvec3 e(0);
        e[column] = 1;
        m[column] = e * c + glm::cross(axis, e) * s + axis * (glm::dot(axis, e) * (1 - c));
    }
    return glm::mat<3, 3, T>(m);
}

RC_GTEST_PROP(ShRotation, CommutesWithEvaluation, ()) {
    constexpr int kBands = 16;
    const Vec3<double> axis = *direction(), d = *direction();
    const auto R = rotation<double>(axis, *uniform(-std::numbers::pi, std::numbers::pi));
    const ShRotation<double> M(kBands, R);
    std::vector<double> before(sh_count(kBands)), after(sh_count(kBands)), rotated(sh_count(kBands));
    sh_evaluate<double>(kBands, d, before);
    sh_evaluate<double>(kBands, R * d, after);
    M.apply<double>(before, rotated);
    for (int i = 0; i < sh_count(kBands); ++i) RC_ASSERT(std::abs(after[i] - rotated[i]) < 1e-13);
}

RC_GTEST_PROP(ShRotation, IsOrthogonal, ()) {
    constexpr int kBands = 16;
    const Vec3<double> axis = *direction();
    const double angle = *uniform(-std::numbers::pi, std::numbers::pi);
    const ShRotation<double> M(kBands, rotation<double>(axis, angle));
    const ShRotation<float> single(kBands, rotation<float>(axis, angle));
    for (const int l : {1, 2, 3, 15})
        for (int m = -l; m <= l; ++m)
            for (int n = -l; n <= l; ++n) {
                double sum = 0, single_sum = 0;
                for (int k = -l; k <= l; ++k) {
                    sum += M.at(l, m, k) * M.at(l, n, k);
                    single_sum += static_cast<double>(single.at(l, m, k)) * single.at(l, n, k);
                }
                RC_ASSERT(std::abs(sum - (m == n)) < 2e-14);
                RC_ASSERT(std::abs(single_sum - (m == n)) < 2e-5);
            }
}

TEST(ShRotation, OfTheIdentityIsTheIdentity) {
    const ShRotation<double> M(8, glm::dmat3(1));
    for (int l = 0; l < 8; ++l)
        for (int m = -l; m <= l; ++m)
            for (int n = -l; n <= l; ++n) EXPECT_NEAR(M.at(l, m, n), m == n, 1e-15);
}

TEST(ShRotation, TurnsAFunctionWithItsFrame) {
    // f(d) = d.x d.y + d.z, rotated: f(R^-1 d). Coefficients are GLM vectors here.
    const auto R = rotation<double>(glm::normalize(glm::dvec3(1, 2, -1)), 0.7);
    std::vector<glm::dvec3> c(9, glm::dvec3(0)), rotated(9);
    const double pi = std::numbers::pi;
    c[sh_index(2, -2)] = glm::dvec3(std::sqrt(4 * pi / 15));
    c[sh_index(1, 0)] = glm::dvec3(std::sqrt(4 * pi / 3));
    ShRotation<double>(3, R).apply<glm::dvec3>(c, rotated);
    for (const glm::dvec3 d : {glm::dvec3(1, 0, 0), glm::dvec3(0, 0.6, 0.8), glm::dvec3(-0.6, 0, -0.8)}) {
        const glm::dvec3 back = glm::transpose(R) * d;
        const glm::dvec3 value = sh_reconstruct<double, glm::dvec3>(3, rotated, d);
        EXPECT_NEAR(value.x, back.x * back.y + back.z, 1e-14);
    }
}

TEST(ShRotation, ComposesLikeRotations) {
    const auto A = rotation<double>(glm::normalize(glm::dvec3(1, 1, 0)), 1.1),
               B = rotation<double>(glm::dvec3(0, 0, 1), -2.0);
    const ShRotation<double> MA(6, A), MB(6, B), MAB(6, A * B);
    for (int m = -5; m <= 5; ++m)
        for (int n = -5; n <= 5; ++n) {
            double sum = 0;
            for (int k = -5; k <= 5; ++k) sum += MA.at(5, m, k) * MB.at(5, k, n);
            EXPECT_NEAR(sum, MAB.at(5, m, n), 1e-13);
        }
}

}  // namespace
}  // namespace pbr

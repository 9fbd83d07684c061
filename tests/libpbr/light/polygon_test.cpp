#include "pbr/light/polygon.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/libpbr/light/area_reference.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

using std::numbers::pi;

double polygon(const std::vector<Vec>& vertices, const Vec& p, const Vec& n) {
    return projected_solid_angle_polygon<double>(vertices, p, n);
}

std::vector<Vec> regular(int count, const Vec& centre, const Vec& x, const Vec& y) {
    std::vector<Vec> vertices;
    for (int i = 0; i < count; ++i) {
        const double phi = 2 * pi * i / count;
        vertices.push_back(centre + std::cos(phi) * x + std::sin(phi) * y);
    }
    return vertices;
}

TEST(SolidAngleTriangle, OfAnOctantIsHalfPi) {
    // Counterclockwise seen from outside is clockwise from the origin.
    EXPECT_NEAR(solid_angle_triangle(Vec(1, 0, 0), Vec(0, 1, 0), Vec(0, 0, 1), Vec(0)), -pi / 2, 1e-15);
    EXPECT_NEAR(solid_angle_triangle(Vec(1, 0, 0), Vec(0, 0, 1), Vec(0, 1, 0), Vec(0)), pi / 2, 1e-15);
}

TEST(SolidAngleTriangle, OfATetrahedronsFaceSeenFromItsCentreIsPi) {
    EXPECT_NEAR(std::abs(solid_angle_triangle(Vec(1, 1, 1), Vec(1, -1, -1), Vec(-1, 1, -1), Vec(0))), pi,
                1e-14);
}

RC_GTEST_PROP(SolidAngleTriangle, OfSmallTrianglesIsAreaOverDistanceSquared, ()) {
    const double size = *log_uniform(1e-6, 1e-3);
    const Vec towards = *direction();
    const auto [x, y] = plane_of(towards);
    const double omega = solid_angle_triangle(towards, towards + size * x, towards + size * y, Vec(0));
    RC_ASSERT(std::abs(std::abs(omega) / (0.5 * size * size) - 1) < 2 * size + 50 * 2.3e-16 / size);
}

TEST(SolidAngleTriangle, IsZeroInItsPlaneAndForNoArea) {
    EXPECT_EQ(solid_angle_triangle(Vec(1, 0, 0), Vec(0, 1, 0), Vec(2, 2, 0), Vec(0)), 0);
    EXPECT_EQ(solid_angle_triangle(Vec(1, 0, 0), Vec(-1, 1, 0), Vec(-1, -1, 0), Vec(0)), 0);
    EXPECT_EQ(solid_angle_triangle(Vec(1, 0, 1), Vec(1, 0, 1), Vec(2, 2, 1), Vec(0)), 0);
    EXPECT_EQ(solid_angle_triangle(Vec(0), Vec(1, 0, 1), Vec(2, 2, 1), Vec(0)), 0);  // p at a vertex
}

TEST(Polygon, MatchesPublishedViewFactors) {
    // Howell's catalogue B-3 and B-4 times pi: a patch under the corner of an a x b rectangle at distance 1,
    // parallel to it, and perpendicular with the side b starting in the patch's plane.
    for (const auto& [a, b] : {std::pair{1.0, 1.0}, {0.5, 2.0}, {5.0, 0.3}}) {
        const double A = std::hypot(1, a), B = std::hypot(1, b);
        const double parallel = 0.5 * (a / A * std::atan(b / A) + b / B * std::atan(a / B));
        EXPECT_NEAR(polygon({{0, 0, 1}, {0, b, 1}, {a, b, 1}, {a, 0, 1}}, Vec(0), Vec(0, 0, 1)), parallel,
                    1e-14);
        const double perpendicular = 0.5 * (std::atan(b) - 1 / A * std::atan(b / A));
        EXPECT_NEAR(polygon({{0, 0, 1}, {0, b, 1}, {a, b, 1}, {a, 0, 1}}, Vec(0), Vec(1, 0, 0)),
                    perpendicular, 1e-14);
    }
}

TEST(Polygon, IsClippedToTheHorizon) {
    // A wall from far below to far above the horizon: the part below must not count.
    const std::vector<Vec> whole{{1, 1, -1}, {1, -1, -1}, {1, -1, 1}, {1, 1, 1}};
    const std::vector<Vec> upper{{1, 1, 0}, {1, -1, 0}, {1, -1, 1}, {1, 1, 1}};
    EXPECT_NEAR(std::abs(polygon(whole, Vec(0), Vec(0, 0, 1))),
                std::abs(polygon(upper, Vec(0), Vec(0, 0, 1))), 1e-15);
    EXPECT_GT(std::abs(polygon(whole, Vec(0), Vec(0, 0, 1))), 0.3);
    EXPECT_EQ(polygon({{1, 1, -1}, {1, -1, -1}, {1, 0, -0.5}}, Vec(0), Vec(0, 0, 1)), 0);
}

TEST(Polygon, MayBeConcave) {
    // An L as a whole and as two rectangles, upright, so that the horizon clips it twice.
    const Vec n = glm::normalize(Vec(0.3, 1, 0.2));
    const auto at = [](double x, double y) { return Vec(x, y, 1.5); };
    const double whole = polygon({at(0, -1), at(2, -1), at(2, 0), at(1, 0), at(1, 2), at(0, 2)}, Vec(0), n);
    const double parts = polygon({at(0, -1), at(2, -1), at(2, 0), at(0, 0)}, Vec(0), n) +
                         polygon({at(0, 0), at(1, 0), at(1, 2), at(0, 2)}, Vec(0), n);
    EXPECT_NEAR(whole, parts, 1e-15);
    const Vec down = glm::normalize(Vec(-1, -0.2, 0.9));  // cuts both arms
    EXPECT_NEAR(polygon({at(0, -1), at(2, -1), at(2, 0), at(1, 0), at(1, 2), at(0, 2)}, Vec(0), down),
                polygon({at(0, -1), at(2, -1), at(2, 0), at(0, 0)}, Vec(0), down) +
                    polygon({at(0, 0), at(1, 0), at(1, 2), at(0, 2)}, Vec(0), down),
                1e-15);
}

RC_GTEST_PROP(Polygon, IsBoundedReversibleAndIndependentOfTheFirstVertex, ()) {
    const Vec centre = *log_uniform(0.2, 5) * *direction(), n = *direction(), axis = *direction();
    const auto [x, y] = plane_of(axis);
    std::vector<Vec> vertices = regular(3 + *rc::gen::inRange(0, 6), centre, x, *log_uniform(0.01, 1) * y);
    // On the polygon itself nothing is promised.
    RC_PRE(std::abs(glm::dot(axis, centre)) > 1e-3);
    const double E = polygon(vertices, Vec(0), n), same = 1e-12;
    RC_ASSERT(std::abs(E) <= pi + 1e-13);
    RC_ASSERT(E * glm::dot(axis, centre) <= 1e-13);  // counterclockwise about the axis: seen from its side
    std::rotate(vertices.begin(), vertices.begin() + 1, vertices.end());
    RC_ASSERT(std::abs(polygon(vertices, Vec(0), n) - E) < same);
    std::reverse(vertices.begin(), vertices.end());
    RC_ASSERT(std::abs(polygon(vertices, Vec(0), n) + E) < same);
}

RC_GTEST_PROP(Polygon, RuleAndSumMeetAtTheSwitch, ()) {
    // Two sizes next to each other on either side of the switch: their difference is the cubature's error.
    const Vec towards = *direction(), axis = *direction();
    const double cosine = *uniform(0.05, 1);
    const auto [a, b] = plane_of(towards);
    const Vec n = cosine * towards + std::sqrt(1 - cosine * cosine) * a;
    const auto [x, y] = plane_of(axis);
    double below = 0.005, above = 0.1;
    const auto square = [&, x = x, y = y](double h) {
        return std::vector<Vec>{towards - h * x - h * y, towards + h * x - h * y, towards + h * x + h * y,
                                towards - h * x + h * y};
    };
    const auto is_small = [&](double h) {
        const std::vector<Vec> v = square(h);
        double nearest = 10;
        for (const Vec& w : v) nearest = std::min(nearest, glm::length(w));
        return std::sqrt(8.0) * h < kSmallPolygonExtent * nearest;
    };
    while (above - below > 1e-12) (is_small((above + below) / 2) ? below : above) = (above + below) / 2;
    const double small = polygon(square(below), Vec(0), n), large = polygon(square(above), Vec(0), n);
    RC_ASSERT(std::abs(small - large) < 2e-9 * below * below * 4);
}

RC_GTEST_PROP(Polygon, FloatIsWithinItsBoundWhateverTheSize, ()) {
    const double size = *log_uniform(1e-6, 3);
    const Vec towards = *direction(), n = *direction(), axis = *direction();
    const auto [x, y] = plane_of(axis);
    std::vector<Vec3<float>> rounded;
    std::vector<Vec> same;
    for (const Vec& v : regular(5, Vec(0), size * x, size * y)) {
        rounded.push_back(Vec3<float>(towards + v));
        same.push_back(Vec(rounded.back()));
    }
    const Vec3<float> normal(n);
    const double exact = polygon(same, Vec(0), Vec(normal));
    const double largest = std::min(pi, 10 * size * size);
    const double got = projected_solid_angle_polygon<float>(rounded, Vec3<float>(0), normal);
    RC_ASSERT(std::isfinite(got));
    if (std::abs(glm::dot(axis, towards)) > 0.1 || size < 0.5)
        RC_ASSERT(std::abs(got - exact) < 2e-5 * largest);
}

TEST(Polygon, DegenerateOnesShineNowhere) {
    EXPECT_EQ(polygon({}, Vec(0), Vec(0, 0, 1)), 0);
    EXPECT_EQ(polygon({{1, 0, 1}, {0, 1, 1}}, Vec(0), Vec(0, 0, 1)), 0);
    EXPECT_NEAR(polygon({{1, 0, 1}, {0, 0, 1}, {-1, 0, 1}}, Vec(0), Vec(0, 0, 1)), 0, 1e-16);  // no area
    EXPECT_EQ(polygon({{1, 0, 1}, {1, 0, 1}, {1, 0, 1}}, Vec(0), Vec(0, 0, 1)), 0);
    EXPECT_NEAR(polygon({{1, 0, 1}, {2, 0, 1}, {1, 0, 2}}, Vec(0), Vec(0, 0, 1)), 0, 1e-16);  // seen edge on
    EXPECT_EQ(polygon({{1, 0, 0}, {2, 0, 0}, {1, 2, 0}}, Vec(0), Vec(0, 0, 1)),
              0);  // in the receiver's plane
}

TEST(Polygon, OppositeEdgeVectorsStayFinite) {
    // p on an edge: the vectors to its ends are opposite.
    const double E = polygon({{-1, 0, 0}, {1, 0, 0}, {1, 0, 1}, {-1, 0, 1}}, Vec(0), Vec(0, 1, 0));
    EXPECT_TRUE(std::isfinite(E));
    EXPECT_EQ(lambert_edge(Vec(1, 0, 0), Vec(-1, 0, 0), Vec(0, 1, 0)), 0);
    EXPECT_EQ(lambert_edge(Vec(0), Vec(1, 0, 0), Vec(0, 1, 0)), 0);
}

}  // namespace
}  // namespace pbr

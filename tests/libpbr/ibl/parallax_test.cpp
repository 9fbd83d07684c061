#include "pbr/ibl/parallax.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

/// A box turned about y by 30 degrees and about x by 50.
template <class T = double>
OrientedBox<T> turned_box() {
    const double a = std::numbers::pi / 6, b = 50 * std::numbers::pi / 180;
    const glm::dmat3 yaw(std::cos(a), 0, -std::sin(a), 0, 1, 0, std::sin(a), 0, std::cos(a));
    const glm::dmat3 pitch(1, 0, 0, 0, std::cos(b), std::sin(b), 0, -std::sin(b), std::cos(b));
    return {Vec3<T>(1, 2, -3), glm::mat<3, 3, T>(yaw * pitch), Vec3<T>(2, 1, 3)};
}

Vec3<double> point_in(const OrientedBox<double>& box, double scale) {
    const Vec3<double> local(*uniform(-1, 1), *uniform(-1, 1), *uniform(-1, 1));
    return box.centre + box.axes * (scale * local * box.half_extent);
}

RC_GTEST_PROP(ParallaxBox, RaysFromInsideEndOnAWall, ()) {
    const OrientedBox<double> box = turned_box();
    const Vec3<double> origin = point_in(box, 1), d = *direction();
    const std::optional<double> distance = exit_distance(box, origin, d);
    RC_ASSERT(distance.has_value());
    RC_ASSERT(*distance >= 0);
    const Vec3<double> local = box.to_local(origin + *distance * d);
    double nearest = 1e9;
    for (int axis = 0; axis < 3; ++axis) {
        RC_ASSERT(std::abs(local[axis]) <= box.half_extent[axis] + 1e-13);
        nearest = std::min(nearest, box.half_extent[axis] - std::abs(local[axis]));
    }
    RC_ASSERT(std::abs(nearest) < 1e-13);
}

RC_GTEST_PROP(ParallaxBox, RaysFromOutsideAreMetOrMissedAsMarchingFinds, ()) {
    const OrientedBox<double> box = turned_box();
    const Vec3<double> origin = point_in(box, 3), d = *direction();
    const std::optional<double> distance = exit_distance(box, origin, d);
    const auto is_inside = [&](double t, double slack) {
        const Vec3<double> local = glm::abs(box.to_local(origin + t * d));
        return local.x < box.half_extent.x + slack && local.y < box.half_extent.y + slack &&
               local.z < box.half_extent.z + slack;
    };
    double last = -1;
    for (int i = 0; i <= 4000; ++i)
        if (is_inside(i * 5e-3, 0)) last = i * 5e-3;
    if (last >= 0) {
        RC_ASSERT(distance.has_value());
        RC_ASSERT(*distance >= last - 1e-12);
        RC_ASSERT(*distance <= last + 5e-3 + 1e-12);
    } else if (distance) {
        RC_ASSERT(is_inside(*distance, 1e-12));  // a corner between two steps
    }
}

TEST(ParallaxBox, AxisParallelRaysAndPointsOnWalls) {
    const OrientedBox<double> box{};  // the cube of half side 1
    EXPECT_EQ(exit_distance(box, Vec3<double>(1, 0, 0), Vec3<double>(0, 1, 0)),
              1);  // along a wall: 0/0 avoided
    EXPECT_EQ(exit_distance(box, Vec3<double>(1, 0, 0), Vec3<double>(1, 0, 0)), 0);
    EXPECT_EQ(exit_distance(box, Vec3<double>(1, 0, 0), Vec3<double>(-1, 0, 0)), 2);
    EXPECT_EQ(exit_distance(box, Vec3<double>(1.5, 0, 0), Vec3<double>(0, 1, 0)), std::nullopt);
    EXPECT_EQ(exit_distance(box, Vec3<double>(1.5, 0, 0), Vec3<double>(1, 0, 0)), std::nullopt);  // behind it
    EXPECT_EQ(exit_distance(box, Vec3<double>(-3, 0, 0), Vec3<double>(1, 0, 0)), 4);  // the far wall
}

RC_GTEST_PROP(ParallaxSphere, RaysEndOnTheSphere, ()) {
    const ProxySphere<double> sphere{{3, -1, 2}, 2.5};
    const Vec3<double> d = *direction(), o = sphere.centre + *direction() * *uniform(0, 6);
    const std::optional<double> distance = exit_distance(sphere, o, d);
    const Vec3<double> away = o - sphere.centre;
    if (glm::length(away) < 2.5) RC_ASSERT(distance.has_value());
    if (!distance) {
        // Misses: the closest approach is outside, or the ball lies behind.
        const double towards = glm::dot(away, d);
        RC_ASSERT(towards > 0 || glm::length(away - towards * d) > 2.5);
        return;
    }
    RC_ASSERT(std::abs(glm::length(o + *distance * d - sphere.centre) - 2.5) < 1e-12);
    RC_ASSERT(glm::dot(o + *distance * d - sphere.centre, d) > -1e-12);  // leaving, not entering
}

template <class Proxy>
void ends_at_the_same_place(const Proxy& proxy, const Vec3<double>& capture, const Vec3<double>& point,
                            const Vec3<double>& d) {
    const ParallaxLookup<double> lookup = parallax_corrected(proxy, capture, point, d);
    RC_ASSERT(lookup.hit);
    RC_ASSERT(std::abs(glm::length(lookup.direction) - 1) < 1e-14);
    // Geometry: looking from the capture point along the answer finds the very place that the shaded point
    // sees.
    const Vec3<double> seen = point + lookup.distance_to_point * d;
    RC_ASSERT(glm::length(capture + lookup.distance_to_capture * lookup.direction - seen) < 1e-12);
    const std::optional<double> back = exit_distance(proxy, capture, lookup.direction);
    RC_ASSERT(std::abs(*back - lookup.distance_to_capture) < 1e-9);
}

RC_GTEST_PROP(Parallax, LooksWhereTheRayEnds, ()) {
    const OrientedBox<double> box = turned_box();
    ends_at_the_same_place(box, point_in(box, 0.5), point_in(box, 0.99), *direction());
    const ProxySphere<double> sphere{{0, 1, 0}, 2};
    ends_at_the_same_place(sphere, sphere.centre + 0.5 * *direction(), sphere.centre + 1.9 * *direction(),
                           *direction());
}

RC_GTEST_PROP(Parallax, FromTheCapturePointChangesNothing, ()) {
    const OrientedBox<double> box = turned_box();
    const Vec3<double> at = point_in(box, 0.9), d = *direction();
    RC_ASSERT(glm::length(parallax_corrected(box, at, at, d).direction - d) < 1e-13);
}

TEST(Parallax, WithoutAHitTheDirectionStays) {
    const ProxySphere<double> sphere{{0, 0, 0}, 1};
    const Vec3<double> d(0, 0, 1);
    const auto lookup = parallax_corrected(sphere, sphere.centre, Vec3<double>(5, 0, 0), d);
    EXPECT_FALSE(lookup.hit);
    EXPECT_EQ(lookup.direction, d);
    EXPECT_TRUE(std::isinf(lookup.distance_to_point));
    // A capture point on the proxy, looked at: no direction leads there.
    const auto on_wall = parallax_corrected(sphere, Vec3<double>(0, 0, 1), Vec3<double>(0, 0, 0), d);
    EXPECT_EQ(on_wall.direction, d);
    EXPECT_EQ(on_wall.distance_to_capture, 0);
}

RC_GTEST_PROP(Parallax, FloatFollowsDouble, ()) {
    const OrientedBox<double> box = turned_box();
    const Vec3<double> capture = point_in(box, 0.5), point = point_in(box, 0.9), d = *direction();
    const auto exact = parallax_corrected(box, capture, point, d);
    const auto single =
        parallax_corrected(turned_box<float>(), Vec3<float>(capture), Vec3<float>(point), Vec3<float>(d));
    RC_ASSERT(single.hit);
    RC_ASSERT(glm::length(Vec3<double>(single.direction) - exact.direction) < 2e-5);
}

TEST(ParallaxSoftening, GoesFromCorrectedToGiven) {
    const Vec3<double> corrected(1, 0, 0), given(0, 0, 1);
    EXPECT_EQ(parallax_softened(corrected, given, 0.0), corrected);
    EXPECT_EQ(parallax_softened(corrected, given, 1.0), given);
    EXPECT_NEAR(glm::length(parallax_softened(corrected, given, 0.3)), 1, 1e-15);
    EXPECT_EQ(parallax_softened(-given, given, 0.5), given);
}

}  // namespace
}  // namespace pbr

#include "pbr/light/disk_light.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "pbr/light/polygon.hpp"
#include "pbr/reference/flat_light.hpp"
#include "tests/libpbr/light/area_reference.hpp"
#include "tests/libpbr/support/chi_square.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

using std::numbers::pi;

const DiskLight<double> kDisk{Vec(0), {0, 0, 1}, 0.5, Emission::one_sided};

DiskLight<double> random_disk() {
    return {*log_uniform(0.2, 10) * *direction(), *direction(), *log_uniform(0.01, 3), Emission::two_sided};
}

/// The disk's projected solid angle as a regular polygon of the same area: error about 1/count^2.
double as_polygon(const DiskLight<double>& light, const Vec& n) {
    constexpr int kCount = 2000;
    const auto [x, y] = plane_of(light.normal);
    const double r = light.radius * std::sqrt(2 * pi / kCount / std::sin(2 * pi / kCount));
    std::vector<Vec> vertices;
    for (int i = 0; i < kCount; ++i) {
        const double phi = 2 * pi * i / kCount;
        vertices.push_back(light.centre + r * (std::cos(phi) * x + std::sin(phi) * y));
    }
    return std::abs(projected_solid_angle_polygon<double>(vertices, Vec(0), n));
}

TEST(DiskLight, AgreesWithTheIntegralOverItsSurface) {
    const DiskLight<double> lights[] = {
        {{0.5, 0.2, 1}, glm::normalize(Vec(-0.3, 0.1, -1)), 0.6},  // all above
        {{1, 0.2, 0.1}, glm::normalize(Vec(-1, 0.1, 0.4)), 0.6},   // across the horizon
        {{0.5, 0.2, 0.3}, {0, 0, -1}, 0.9}};                       // p below it
    for (const DiskLight<double>& light : lights) {
        EXPECT_NEAR(projected_solid_angle(light, Vec(0), Vec(0, 0, 1)),
                    reference_projected_solid_angle(light, Vec(0), Vec(0, 0, 1)), 1e-6);
        EXPECT_NEAR(solid_angle(light, Vec(0)), reference_solid_angle(light, Vec(0)), 1e-9);
    }
}

TEST(DiskLight, FacingTheReceiverOnItsAxisIsSineSquared) {
    for (const double h : {1e-4, 0.3, 1.0, 1e3}) {
        const double expected = pi * 0.25 / (0.25 + h * h);
        EXPECT_NEAR(projected_solid_angle(kDisk, Vec(0, 0, h), Vec(0, 0, -1)) / expected, 1, 1e-14);
    }
}

TEST(DiskLight, IsContinuousOnItsAxis) {
    // Beside the axis the light is seen turned by as little: linear, whatever the offset's size.
    const DiskLight<double> light{{0, 0, 1}, {0, 0, -1}, 0.5};
    const Vec n = glm::normalize(Vec(.99, .1, .3));
    const auto at = [&](double offset) { return projected_solid_angle(light, Vec(offset, 0, 0), n); };
    const double slope = (at(1e-5) - at(-1e-5)) / 2e-5;
    ASSERT_GT(std::abs(slope), .1);
    for (double offset = 1e-17; offset < 1e-7; offset *= 1.7)
        for (const double side : {-offset, offset})
            EXPECT_NEAR(at(side), at(0) + slope * side, 1e-14 + offset * offset + 1e-9 * offset) << side;
}

TEST(DiskLight, SolidAngleOnAxisIsThatOfACone) {
    for (const double h : {1e-6, 0.3, 1.0, 4.9, 5.1, 1e3}) {
        const double rim = std::hypot(h, 0.5);  // 1 - h/rim without cancellation
        EXPECT_NEAR(solid_angle_disk(h, 0, 0.5) / (2 * pi * 0.25 / (rim * (rim + h))), 1, 1e-12) << h;
    }
}

TEST(DiskLight, SolidAngleIsContinuousAboveTheRimAndAtTheSwitchOfSeries) {
    for (const double h : {1e-6, 1e-2, 1.0}) {
        const double at_rim = solid_angle_disk(h, 1, 1);
        EXPECT_NEAR(solid_angle_disk(h, 1 - 1e-9 * h, 1), at_rim, 1e-8) << h;
        EXPECT_NEAR(solid_angle_disk(h, 1 + 1e-9 * h, 1), at_rim, 1e-8) << h;
    }
    for (const double angle : {0.0, 45.0, 80.0, 89.9}) {
        const double h = 10 * std::cos(radians(angle)), o = 10 * std::sin(radians(angle));
        EXPECT_NEAR(solid_angle_disk(h, o, 1 - 1e-13) / solid_angle_disk(h, o, 1 + 1e-13), 1, 2e-11) << angle;
    }
}

TEST(DiskLight, SolidAngleStaysSaneBesideTheRimsPlane) {
    for (const double offset : {0.0, 0.5, 1 - 1e-12, 1.0, 1 + 1e-12, 2.0, 100.0})
        for (const double h : {1e-300, 1e-12, 1e-3}) {
            const double omega = solid_angle_disk(h, offset, 1);
            EXPECT_TRUE(omega >= 0 && omega <= 2 * pi) << offset << ' ' << h << ' ' << omega;
        }
    EXPECT_NEAR(solid_angle_disk(1e-12, 0.5, 1), 2 * pi, 1e-11);
    EXPECT_NEAR(solid_angle_disk(1e-12, 1, 1), pi, 1e-10);
    EXPECT_NEAR(solid_angle_disk(1e-12, 2, 1), 0, 1e-11);
    EXPECT_EQ(solid_angle_disk(0, 0.5, 1), 0);
    EXPECT_EQ(solid_angle_disk(-1, 0.5, 1), 0);
    EXPECT_EQ(solid_angle_disk(1, 0.5, 0), 0);
}

RC_GTEST_PROP(DiskLight, EqualsAPolygonOfManySides, ()) {
    const DiskLight<double> light = random_disk();
    RC_PRE(std::abs(glm::dot(light.centre, light.normal)) > 0.02 * light.radius);
    const Vec n = *direction();
    const double omega = solid_angle(light, Vec(0)), E = projected_solid_angle(light, Vec(0), n);
    RC_ASSERT(E >= 0 && E <= std::min(omega, pi) + 1e-12);
    RC_ASSERT(std::abs(E - as_polygon(light, n)) < 1e-4 * omega + 1e-12);
}

RC_GTEST_PROP(DiskLight, IsContinuousWhereItTouchesTheHorizon, ()) {
    const DiskLight<double> light = random_disk();
    RC_PRE(std::abs(glm::dot(light.centre, light.normal)) > 1e-3 * light.radius);
    // Turn n until the disk's lowest (or highest) point comes to the horizon.
    const Vec a = glm::normalize(light.centre), b = plane_of(a).first;
    const auto turned = [&](double w) { return std::cos(w) * a + std::sin(w) * b; };
    const auto margin = [&](double w) {
        const Vec n = turned(w), flat = n - glm::dot(n, light.normal) * light.normal;
        return glm::dot(n, light.centre) - light.radius * glm::length(flat);
    };
    double low = 0, high = pi / 2;
    RC_PRE(margin(low) > 0 && margin(high) < 0);
    for (int i = 0; i < 50; ++i) (margin((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
    const double step = 1e-7;
    const double above = projected_solid_angle(light, Vec(0), turned(low - step));
    const double below = projected_solid_angle(light, Vec(0), turned(low + step));
    RC_ASSERT(std::abs(above - below) < 4 * step * solid_angle(light, Vec(0)) + 1e-13);
}

TEST(DiskLight, ShinesFromItsFrontOrBothAndNotInItsPlane) {
    DiskLight<double> light = kDisk;
    const Vec behind(0.1, 0, -1), up(0, 0, 1);
    for (const double E :
         {projected_solid_angle(light, behind, up), projected_solid_angle_frostbite(light, behind, up),
          projected_solid_angle_mrp(light, behind, up), solid_angle(light, behind)})
        EXPECT_EQ(E, 0);
    light.emission = Emission::two_sided;
    const Vec front(0.1, 0, 1);
    EXPECT_EQ(projected_solid_angle(light, behind, up), projected_solid_angle(light, front, -up));
    EXPECT_EQ(projected_solid_angle_frostbite(light, behind, up),
              projected_solid_angle_frostbite(light, front, -up));
    EXPECT_EQ(projected_solid_angle_mrp(light, behind, up), projected_solid_angle_mrp(light, front, -up));
    for (const Vec& p : {Vec(0), Vec(0.5, 0, 0), Vec(0.2, 0, 0), Vec(2, 0, 0)})
        for (const Vec& n : {Vec(0, 0, 1), Vec(1, 0, 0)}) {
            EXPECT_EQ(projected_solid_angle(light, p, n), 0);
            EXPECT_EQ(projected_solid_angle_frostbite(light, p, n), 0);
            EXPECT_EQ(projected_solid_angle_mrp(light, p, n), 0);
            EXPECT_EQ(solid_angle(light, p), 0);
        }
    light.radius = 0;
    EXPECT_EQ(projected_solid_angle(light, front, -up), 0);
    EXPECT_EQ(solid_angle(light, front), 0);
}

TEST(DiskLight, FarAwayIsAPoint) {
    const Vec away = Vec(0.6, 0, 0.8), n = -(0.6 * away + 0.8 * Vec(0.8, 0, -0.6));
    const double point = pi * 0.25 * 0.8 * 0.6 / 1e8;
    EXPECT_NEAR(projected_solid_angle(kDisk, 1e4 * away, n) / point, 1, 1e-7);
    const DiskLight<float> light{Vec3<float>(0), {0, 0, 1}, 0.5f, Emission::one_sided};
    EXPECT_NEAR(projected_solid_angle(light, Vec3<float>(1e4 * away), Vec3<float>(n)) / point, 1, 1e-6);
    EXPECT_NEAR(solid_angle(light, Vec3<float>(1e4 * away)) / (pi * 0.25 * 0.8 / 1e8), 1, 1e-6);
}

RC_GTEST_PROP(DiskLight, SmallOnesKeepTheirDigitsAcrossTheHorizon, ()) {
    // Similar triangles: a disk edge-on over the horizon, its upper part y in (-t, 1) r; see the cap's test.
    const double r = *log_uniform(1e-6, 1e-3), t = *uniform(-0.9, 0.9), w = std::sqrt(1 - t * t);
    const DiskLight<double> light{{1, 0, t * r}, {-1, 0, 0}, r};
    const double expected = r * r * r * (2 / 3.0 * w * w * w + t * (pi / 2 + std::asin(t) + t * w));
    const double E = projected_solid_angle(light, Vec(0), Vec(0, 0, 1));
    RC_ASSERT(std::abs(E - expected) < 1e-14 * r + 10 * r * r * expected);
}

const auto kSolidAngle = [](const Vec& p) { return solid_angle(kDisk, p); };
const auto kExact = [](const Vec& p, const Vec& n) { return projected_solid_angle(kDisk, p, n); };

TEST(DiskLight, FrostbiteErrsAsStated) {
    const auto frostbite = [](const Vec& p, const Vec& n) {
        return projected_solid_angle_frostbite(kDisk, p, n);
    };
    for (const double distance : {0.5, 1.0, 4.0})  // head-on it is exact from one radius on
        EXPECT_NEAR(
            frostbite(Vec(0, 0, distance), Vec(0, 0, -1)) / kExact(Vec(0, 0, distance), Vec(0, 0, -1)), 1,
            1e-14);
    EXPECT_NEAR(frostbite(Vec(0, 0, 0.1), Vec(0, 0, -1)) / kExact(Vec(0, 0, 0.1), Vec(0, 0, -1)), 0.52, 5e-3);
    EXPECT_NEAR(worst_error(0.5, frostbite, kExact, kSolidAngle), 0.69, 5e-3);
    EXPECT_NEAR(worst_error(1, frostbite, kExact, kSolidAngle), 0.38, 5e-3);
    EXPECT_NEAR(worst_error(2, frostbite, kExact, kSolidAngle), 0.116, 5e-4);
    EXPECT_NEAR(worst_error(4, frostbite, kExact, kSolidAngle), 0.0305, 5e-4);
}

TEST(DiskLight, MostRepresentativePointErrsAsStated) {
    const auto mrp = [](const Vec& p, const Vec& n) { return projected_solid_angle_mrp(kDisk, p, n); };
    EXPECT_NEAR(worst_error(0.5, mrp, kExact, kSolidAngle), 0.59, 5e-3);
    EXPECT_NEAR(worst_error(1, mrp, kExact, kSolidAngle), 0.40, 5e-3);
    EXPECT_NEAR(worst_error(2, mrp, kExact, kSolidAngle), 0.23, 5e-3);
    EXPECT_NEAR(worst_error(4, mrp, kExact, kSolidAngle), 0.12, 5e-3);
}

TEST(DiskLight, StructuredSamplingErrsAsStated) {
    const auto structured = [](const Vec& p, const Vec& n) {
        return projected_solid_angle_structured(kDisk, p, n);
    };
    EXPECT_NEAR(worst_error(0.5, structured, kExact, kSolidAngle), 0.47, 5e-3);
    EXPECT_NEAR(worst_error(1, structured, kExact, kSolidAngle), 0.076, 5e-4);
    EXPECT_NEAR(worst_error(2, structured, kExact, kSolidAngle), 0.024, 5e-4);
    EXPECT_NEAR(worst_error(4, structured, kExact, kSolidAngle), 0.0048, 5e-5);
}

RC_GTEST_PROP(DiskLight, AreaSampleAndInverseAreARoundTrip, ()) {
    const DiskLight<double> light = random_disk();
    const double u1 = *uniform(0.001, 1), u2 = *uniform(0, 1);
    const Vec x = sample_disk_area(light, u1, u2) - light.centre;
    RC_ASSERT(std::abs(glm::dot(x, light.normal)) < 1e-15 * (light.radius + glm::length(light.centre)));
    RC_ASSERT(glm::length(x) <= light.radius + 1e-15 * (light.radius + glm::length(light.centre)));
    const Sample2 back = inverse_disk_area(light, x + light.centre);
    const double rounding = 1e-14 * (1 + glm::length(light.centre) / light.radius);
    RC_ASSERT(std::abs(back.u1 - u1) < rounding);
    RC_ASSERT(std::abs(std::remainder(back.u2 - u2, 1.0)) < 40 * rounding);
}

TEST(DiskLight, AreaSamplesHaveTheDisksMoments) {
    // Uniform in area: a point's squared distance from the centre is uniform in [0, r^2], and u1's mean and
    // variance are those of a uniform number; directions have no preference.
    double mean = 0, square = 0;
    Vec sum(0);
    constexpr int kCount = 100'000;
    for (int i = 0; i < kCount; ++i) {
        const Vec x = sample_disk_area(kDisk, random_unit(5, i, 0), random_unit(5, i, 1));
        const double q = glm::dot(x, x) / 0.25;
        mean += q / kCount;
        square += q * q / kCount;
        sum += x / static_cast<double>(kCount);
    }
    EXPECT_NEAR(mean, 0.5, 4e-3);
    EXPECT_NEAR(square, 1 / 3.0, 4e-3);
    EXPECT_LT(glm::length(sum), 4e-3);
    EXPECT_NEAR(pdf_area(kDisk) * pi * 0.25, 1, 1e-15);
}

TEST(DiskLight, AreaSamplesAreUniform) {
    // Cells of equal area, on axes other than the sampler's: eight rings of equal area by sixteen sectors.
    const DiskLight<double> light{{1, -2, 3}, glm::normalize(Vec(.3, -.8, .4)), 0.7};
    const auto [x, y] = plane_of(light.normal);
    constexpr int kCount = 100'000;
    std::vector<double> observed(8 * 16), expected(8 * 16, kCount / 128.0);
    for (int i = 0; i < kCount; ++i) {
        const Vec at = sample_disk_area(light, random_unit(6, i, 0), random_unit(6, i, 1)) - light.centre;
        const double share = glm::dot(at, at) / (light.radius * light.radius);
        const double turns = std::atan2(glm::dot(at, y), glm::dot(at, x)) / (2 * pi) + .5;
        observed[std::min(7, int(8 * share)) * 16 + std::min(15, int(16 * turns))] += 1;
    }
    EXPECT_GT(pearson_p_value(observed, expected), kSignificance);
}

TEST(DiskLight, IsWithinTheErrorStatedOffItsAxis) {
    // Against the reference's integral over the disk's own area, which is smooth clear of the horizon.
    const DiskLight<double> lights[] = {{{0.5, 0.2, 1}, glm::normalize(Vec(-0.3, 0.1, -1)), 0.6},
                                        {{1, 2, 1.5}, glm::normalize(Vec(-0.7, -0.9, -0.3)), 0.8}};
    for (const DiskLight<double>& light : lights) {
        const AxisFrame<double> frame = frame_about(light.normal);
        const FlatLight flat{light.centre, light.radius * frame.x, light.radius * frame.y};
        const auto integral = [&](const auto& brdf) {
            return reflected_radiance_from_disk(brdf, Vec(0, 0, 1), flat, [](const Vec&) { return 1.0; },
                                                {1e-14})
                .value;
        };
        const double E = integral([](const Vec&, const Vec&) { return 1.0; });
        EXPECT_NEAR(projected_solid_angle(light, Vec(0), Vec(0, 0, 1)) / E, 1, 1e-13);
        const double omega = integral([](const Vec&, const Vec& wi) { return 1 / wi.z; });
        EXPECT_NEAR(solid_angle(light, Vec(0)) / omega, 1, 1e-12);
    }
}

}  // namespace
}  // namespace pbr

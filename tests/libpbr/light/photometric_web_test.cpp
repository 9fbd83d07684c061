#include "pbr/light/photometric_web.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "pbr/numerics/quadrature.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;

/// n + 1 angles from `first` to `last`.
std::vector<double> steps(double first, double last, int n) {
    std::vector<double> angles;
    for (int i = 0; i <= n; ++i) angles.push_back(first + (last - first) * i / n);
    return angles;
}

/// `count` ascending angles: the two ends, and others at random between them.
std::vector<double> random_angles(double first, double last, int count) {
    std::set<double> angles{first, last};
    while (static_cast<int>(angles.size()) < count) angles.insert(*uniform(first, last));
    return {angles.begin(), angles.end()};
}

std::vector<double> random_candela(std::size_t count) {
    std::vector<double> candela(count);
    for (double& cd : candela) cd = *uniform(0, 1000);
    return candela;
}

/// A web of any type, cover and range.
PhotometricWeb random_web() {
    const auto type = *rc::gen::element(Photometry::type_a, Photometry::type_b, Photometry::type_c);
    HorizontalCover cover = HorizontalCover::range;
    std::vector<double> vertical, horizontal;
    if (type != Photometry::type_c) {
        cover = *rc::gen::element(HorizontalCover::mirrored, HorizontalCover::range);
        vertical = random_angles(*rc::gen::element(-90., 0., -37.5), *rc::gen::element(90., 41.), 5);
        horizontal = random_angles(cover == HorizontalCover::mirrored ? 0 : *rc::gen::element(-90., -20.),
                                   *rc::gen::element(90., 63.), 4);
    } else {
        cover = *rc::gen::element(HorizontalCover::axial, HorizontalCover::mirrored, HorizontalCover::ring,
                                  HorizontalCover::range);
        vertical = random_angles(*rc::gen::element(0., 90., 12.), *rc::gen::element(180., 121.), 6);
        if (cover == HorizontalCover::axial) horizontal = {*rc::gen::element(0., 90., 205.)};
        if (cover == HorizontalCover::mirrored) {
            const double first = *rc::gen::element(0., 90., 180., 270.);
            horizontal = random_angles(first, first + *rc::gen::element(90., 180.), 4);
        }
        if (cover == HorizontalCover::ring)
            horizontal = random_angles(0, *rc::gen::element(345., 360., 270.), 5);
        if (cover == HorizontalCover::range) horizontal = random_angles(0, *rc::gen::element(45., 200.), 3);
    }
    auto candela = random_candela(vertical.size() * horizontal.size());
    return {type, cover, std::move(vertical), std::move(horizontal), std::move(candela)};
}

PhotometricWeb axial(std::vector<double> vertical, std::vector<double> candela) {
    return {Photometry::type_c, HorizontalCover::axial, std::move(vertical), {0}, std::move(candela)};
}

/// Flux by quadrature of evaluate_cd cell by cell in the web's own coordinates: bilinear times sine there, so
/// smooth. Knows evaluation alone, no weights.
double flux_by_quadrature(const PhotometricWeb& web) {
    const PhotometricWeb full = web.unfolded();
    const QuadratureRule rule = gauss_legendre(12);
    double flux = 0;
    const auto &v = full.vertical_deg(), &h = full.horizontal_deg();
    for (std::size_t i = 0; i + 1 < v.size(); ++i)
        for (std::size_t j = 0; j + 1 < h.size(); ++j)
            for (int a = 0; a < rule.size(); ++a)
                for (int b = 0; b < rule.size(); ++b) {
                    const double vd = v[i] + (v[i + 1] - v[i]) * rule.nodes[static_cast<std::size_t>(a)];
                    const double hd = h[j] + (h[j + 1] - h[j]) * rule.nodes[static_cast<std::size_t>(b)];
                    const double density = web.type() == Photometry::type_c   ? std::sin(vd * kPi / 180)
                                           : web.type() == Photometry::type_a ? std::cos(vd * kPi / 180)
                                                                              : std::cos(hd * kPi / 180);
                    flux += rule.weights[static_cast<std::size_t>(a)] *
                            rule.weights[static_cast<std::size_t>(b)] * (v[i + 1] - v[i]) *
                            (h[j + 1] - h[j]) * std::pow(kPi / 180, 2) * density *
                            web.evaluate_cd(photometric_direction(web.type(), {vd, hd}));
                }
    return flux;
}

TEST(PhotometricFrame, PutsTheAxesWhereItSays) {
    const auto expect = [](Photometry type, PhotometricAngles angles, Vec3<double> d) {
        const Vec3<double> made = photometric_direction(type, angles);
        EXPECT_NEAR(made.x, d.x, 5e-16);
        EXPECT_NEAR(made.y, d.y, 5e-16);
        EXPECT_NEAR(made.z, d.z, 5e-16);
    };
    expect(Photometry::type_c, {0, 77}, {0, 0, -1});
    expect(Photometry::type_c, {90, 0}, {1, 0, 0});
    expect(Photometry::type_c, {90, 90}, {0, 1, 0});
    expect(Photometry::type_c, {180, 0}, {0, 0, 1});
    for (const Photometry type : {Photometry::type_a, Photometry::type_b}) {
        expect(type, {0, 0}, {0, 0, -1});
        expect(type, {0, 90}, {1, 0, 0});
        expect(type, {90, 0}, {0, 1, 0});
    }
    // The two differ off the axes: A's H turns about y, B's V about x.
    expect(Photometry::type_a, {90, 45}, {0, 1, 0});
    expect(Photometry::type_b, {45, 90}, {1, 0, 0});
}

RC_GTEST_PROP(PhotometricFrame, AnglesInvertDirections, ()) {
    const auto type = *rc::gen::element(Photometry::type_a, Photometry::type_b, Photometry::type_c);
    const Vec3<double> d = *direction();
    const Vec3<double> back = photometric_direction(type, photometric_angles(type, d));
    RC_ASSERT(std::abs(back.x - d.x) + std::abs(back.y - d.y) + std::abs(back.z - d.z) < 4e-15);
}

TEST(PhotometricWeb, IsotropicSphereHasFourPi) {
    EXPECT_NEAR(axial(steps(0, 180, 36), std::vector<double>(37, 100)).flux_lm(), 400 * kPi,
                400 * kPi * 1e-12);
    EXPECT_NEAR(axial({0, 180}, {100, 100}).flux_lm(FluxRule::zonal), 400 * kPi, 400 * kPi * 1e-12);
    const PhotometricWeb b(Photometry::type_b, HorizontalCover::mirrored, {-90, 90}, {0, 90}, {1, 1, 1, 1});
    EXPECT_NEAR(b.flux_lm(), 2 * kPi, 1e-12);
    const PhotometricWeb a(Photometry::type_a, HorizontalCover::range, {-90, 90}, {-90, 90}, {1, 1, 1, 1});
    EXPECT_NEAR(a.flux_lm(), 2 * kPi, 1e-12);
}

TEST(PhotometricWeb, LinearFallHasItsAnalyticFlux) {
    // I = 1 - g / (pi/2) down to the horizon: 2 pi (1 - 2 / pi).
    EXPECT_NEAR(axial({0, 90}, {1, 0}).flux_lm(), 2 * kPi * (1 - 2 / kPi), 1e-14);
    // The same in a thousand cells takes the series for narrow ones.
    std::vector<double> falling;
    for (int i = 0; i <= 4000; ++i) falling.push_back(1 - i / 4000.);
    EXPECT_NEAR(axial(steps(0, 90, 4000), falling).flux_lm(), 2 * kPi * (1 - 2 / kPi), 1e-12);
}

TEST(PhotometricWeb, ZonalRuleIsTheMeanTimesTheZone) {
    EXPECT_NEAR(axial({0, 60, 90}, {10, 4, 1}).flux_lm(FluxRule::zonal), 2 * kPi * (7 * .5 + 2.5 * .5),
                1e-13);
}

TEST(PhotometricWeb, OpenRingKeepsItsLastWedge) {
    std::vector<double> angles;
    for (int i = 0; i < 24; ++i) angles.push_back(15 * i);
    const PhotometricWeb ring(Photometry::type_c, HorizontalCover::ring, {0, 180}, angles,
                              std::vector<double>(48, 1));
    EXPECT_NEAR(ring.flux_lm(), 4 * kPi, 1e-12);
    EXPECT_EQ(ring.at_cd(90, 352), 1);
}

TEST(PhotometricWeb, IsDarkOutsideTheMeasuredRange) {
    const PhotometricWeb web = axial({0, 90}, {1, 5});
    EXPECT_EQ(web.at_cd(90, 0), 5);
    EXPECT_EQ(web.at_cd(90 + 5e-10, 0), 5);
    EXPECT_EQ(web.at_cd(90.001, 0), 0);
    EXPECT_EQ(web.evaluate_cd({0, 0, 1}), 0);
    const PhotometricWeb b(Photometry::type_b, HorizontalCover::range, {-90, 90}, {-90, 90}, {1, 1, 1, 1});
    EXPECT_EQ(b.evaluate_cd({.1, .2, .5}), 0);
    EXPECT_EQ(b.evaluate_cd({.1, .2, -.5}), 1);
}

TEST(PhotometricWeb, BeamAndFieldAngleOfALinearFall) {
    const PhotometricWeb web = axial({0, 10, 20, 180}, {100, 100, 0, 0});
    EXPECT_NEAR(beam_angle_deg(web, AxialPlane::c0, .5), 30, 1e-9);
    EXPECT_NEAR(beam_angle_deg(web, AxialPlane::c90, .1), 38, 1e-9);
    // Upside down, cut off by the range, all round, dark.
    EXPECT_NEAR(beam_angle_deg(axial({0, 160, 170, 180}, {0, 0, 100, 100}), AxialPlane::c0, .5), 30, 1e-9);
    EXPECT_NEAR(beam_angle_deg(axial({0, 25}, {100, 90}), AxialPlane::c0, .5), 50, 1e-9);
    EXPECT_NEAR(beam_angle_deg(axial({0, 180}, {1, 1}), AxialPlane::c0, .5), 180, 1e-9);
    EXPECT_EQ(beam_angle_deg(axial({0, 180}, {0, 0}), AxialPlane::c0, .5), 0);
    // A floodlight that is narrow upwards and wide sideways.
    const PhotometricWeb flood(Photometry::type_b, HorizontalCover::mirrored, {-90, -10, 0, 10, 90},
                               {0, 40, 90}, {0, 0, 8, 0, 0, 0, 0, 4, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_NEAR(beam_angle_deg(flood, AxialPlane::c0, .5), 80, 1e-9);
    EXPECT_NEAR(beam_angle_deg(flood, AxialPlane::c90, .5), 10, 1e-9);
}

RC_GTEST_PROP(PhotometricWeb, ExactFluxIsTheIntegralOfWhatItEvaluates, ()) {
    const PhotometricWeb web = random_web();
    const double flux = web.flux_lm();
    RC_ASSERT(std::abs(flux_by_quadrature(web) - flux) <= 1e-10 * flux);
}

RC_GTEST_PROP(PhotometricWeb, UnfoldingCommutesWithEvaluation, ()) {
    const PhotometricWeb web = random_web(), full = web.unfolded();
    RC_ASSERT(full.cover() != HorizontalCover::mirrored && full.cover() != HorizontalCover::axial);
    const Vec3<double> d = *direction();
    RC_ASSERT(std::abs(web.evaluate_cd(d) - full.evaluate_cd(d)) <= 1e-9 * web.max_cd());
    for (const FluxRule rule : {FluxRule::exact, FluxRule::zonal})
        RC_ASSERT(std::abs(web.flux_lm(rule) - full.flux_lm(rule)) <= 1e-12 * web.flux_lm(rule));
}

RC_GTEST_PROP(PhotometricWeb, TurningCommutesWithEvaluation, ()) {
    const PhotometricWeb web = random_web();
    const double deg = *rc::gen::element(0., 90., 180., 359., 17.25, -33.);
    const double c = std::cos(deg * kPi / 180), s = std::sin(deg * kPi / 180);
    const Vec3<double> d = *direction();
    // The rotation that takes the angle about the polar axis to itself plus deg.
    const Vec3<double> turned_d =
        web.type() == Photometry::type_c   ? Vec3<double>(c * d.x - s * d.y, s * d.x + c * d.y, d.z)
        : web.type() == Photometry::type_a ? Vec3<double>(c * d.x - s * d.z, d.y, s * d.x + c * d.z)
                                           : Vec3<double>(d.x, c * d.y - s * d.z, s * d.y + c * d.z);
    const PhotometricAngles angles = photometric_angles(web.type(), d);
    // Beside the rim of the measured range, rounding decides.
    const double nudge = 1e-7;
    for (const double v : {angles.vertical_deg - nudge, angles.vertical_deg + nudge})
        for (const double h : {angles.horizontal_deg - nudge, angles.horizontal_deg + nudge})
            RC_PRE(web.vertical_place(v).is_inside() == web.vertical_place(angles.vertical_deg).is_inside() &&
                   web.horizontal_place(h).is_inside() ==
                       web.horizontal_place(angles.horizontal_deg).is_inside());
    const PhotometricWeb turned = web.turned(deg);
    RC_ASSERT(std::abs(turned.evaluate_cd(turned_d) - web.evaluate_cd(d)) <= 1e-6 * web.max_cd());
    RC_ASSERT(std::abs(turned.flux_lm() - web.flux_lm()) <= 1e-12 * web.flux_lm());
}

RC_GTEST_PROP(PhotometricWeb, NeverExceedsItsMaximumAndReachesIt, ()) {
    const PhotometricWeb web = random_web();
    RC_ASSERT(web.evaluate_cd(*direction()) <= web.max_cd() * (1 + 1e-15));
    const PhotometricAngles at = web.max_angles();
    RC_ASSERT(web.at_cd(at.vertical_deg, at.horizontal_deg) == web.max_cd());
}

}  // namespace
}  // namespace pbr

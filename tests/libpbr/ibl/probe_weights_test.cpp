#include "pbr/ibl/probe_weights.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "pbr/ibl/zonal_kernel.hpp"
#include "tests/libpbr/support/integrate.hpp"
#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

template <class T>
void sums_to_one(T tolerance) {
    FrontToBackWeights<T> weights;
    double sum = 0;
    for (int layer = 0; layer < 8; ++layer) {
        const T coverage = static_cast<T>(*unit_interval());
        const T weight =
            *rc::gen::arbitrary<bool>() ? weights.add_nested(coverage) : weights.add_independent(coverage);
        RC_ASSERT(weight >= 0);
        RC_ASSERT(weight <= coverage);
        sum += static_cast<double>(weight);
    }
    RC_ASSERT(weights.remaining() >= 0);
    RC_ASSERT(weights.remaining() <= 1);
    RC_ASSERT(std::abs(sum + static_cast<double>(weights.remaining()) - 1) < static_cast<double>(tolerance));
}

RC_GTEST_PROP(FrontToBackWeights, SumToOne, ()) {
    sums_to_one<double>(1e-15);
    sums_to_one<float>(1e-6f);
}

TEST(FrontToBackWeights, NestedProbesCoverWhatTheLargestCovers) {
    FrontToBackWeights<double> nested, independent;
    for (int i = 0; i < 10; ++i) {
        nested.add_nested(0.1);
        independent.add_independent(0.1);
    }
    EXPECT_NEAR(nested.remaining(), 0.9, 1e-15);
    EXPECT_NEAR(independent.remaining(), std::pow(0.9, 10), 1e-15);
}

TEST(FrontToBackWeights, AFullLayerHidesAllBehindIt) {
    FrontToBackWeights<double> weights;
    EXPECT_EQ(weights.add_independent(0.25), 0.25);
    EXPECT_EQ(weights.add_nested(1.0), 0.75);
    EXPECT_EQ(weights.add_independent(0.5), 0);
    EXPECT_EQ(weights.add_nested(1.0), 0);
    EXPECT_EQ(weights.remaining(), 0);
    FrontToBackWeights<double> clamped;
    EXPECT_EQ(clamped.add_independent(-0.5), 0);
    EXPECT_EQ(clamped.add_nested(1.5), 1);
}

/// Prefiltered value of f about +z.
template <class F>
double prefiltered(const F& f, double alpha) {
    const GgxZonalKernel kernel(alpha);
    return integrate_hemisphere([&](const Vec3<double>& w) { return kernel.value(1 - w.z) * f(w); }, 1e-8);
}

TEST(VisibleFallback, CountsConstantSkyOnce) {
    // Walls of radiance 1 at y < .2 x, sky of radiance 4 elsewhere.
    const auto is_wall = [](const Vec3<double>& w) { return w.y < 0.2 * w.x; };
    for (const double alpha : {0.1, 0.5, 1.0}) {
        const double local = prefiltered([&](const auto& w) { return is_wall(w) ? 1.0 : 0.0; }, alpha);
        const double exact = prefiltered([&](const auto& w) { return is_wall(w) ? 1.0 : 4.0; }, alpha);
        EXPECT_NEAR(visible_fallback(local, local, 4.0), exact, 1e-5)
            << alpha;  // visibility is `local`: walls have radiance 1
    }
    EXPECT_EQ(visible_fallback(2.0, 1.0, 5.0), 2);
    EXPECT_EQ(visible_fallback(0.0, 0.0, 5.0), 5);
    EXPECT_EQ(visible_fallback(2.0, 1.5, 5.0), 2);
}

TEST(VisibleFallback, IsOffByTheStatedFigureWhereSkyAndVisibilityGoTogether) {
    // Black walls hide y < 0, and there the sky behind them is bright: 3 against 1.
    constexpr double kAlpha = 0.5;
    const auto sky = [](const Vec3<double>& w) { return w.y < 0 ? 3.0 : 1.0; };
    const double visibility = prefiltered([](const auto& w) { return w.y < 0 ? 1.0 : 0.0; }, kAlpha);
    const double exact = prefiltered([&](const auto& w) { return w.y < 0 ? 0.0 : sky(w); }, kAlpha);
    const double composed = visible_fallback(0.0, visibility, prefiltered(sky, kAlpha));
    EXPECT_NEAR(visibility, 0.5, 1e-6);
    EXPECT_NEAR(composed / exact, 2, 1e-5);
}

RC_GTEST_PROP(Influence, IsOneInsideZeroOutsideAndContinuous, ()) {
    const OrientedBox<double> box{{1, 2, 3}, glm::dmat3(0, 1, 0, 0, 0, 1, 1, 0, 0), {2, 3, 4}};
    const ProxySphere<double> sphere{{1, 2, 3}, 3};
    const Vec3<double> point = box.centre + *direction() * *uniform(0, 6), step = 1e-6 * *direction();
    const double fade = *rc::gen::element(0.5, 2.0);
    const double in_box = influence_of_box(box, point, fade),
                 in_sphere = influence_of_sphere(sphere, point, fade);
    for (const double value : {in_box, in_sphere}) RC_ASSERT(value >= 0 && value <= 1);
    RC_ASSERT(std::abs(influence_of_box(box, point + step, fade) - in_box) <= 1.01e-6 / fade);
    RC_ASSERT(std::abs(influence_of_sphere(sphere, point + step, fade) - in_sphere) <= 1.01e-6 / fade);
}

TEST(Influence, HasTheValuesOfItsDefinition) {
    const OrientedBox<double> box{{0, 0, 0}, glm::dmat3(1), {1, 2, 3}};
    EXPECT_EQ(influence_of_box(box, {0, 0, 0}, 0.5), 1);
    EXPECT_NEAR(influence_of_box(box, {0.8, 0, 0}, 0.5), 0.4, 1e-15);
    EXPECT_EQ(influence_of_box(box, {1, 0, 0}, 0.5), 0);
    EXPECT_EQ(influence_of_box(box, {0, 2.5, 0}, 0.5), 0);
    EXPECT_EQ(influence_of_box(box, {0.99, 0, 0}, 0.0), 1);  // a step
    const ProxySphere<double> sphere{{0, 0, 0}, 2};
    EXPECT_NEAR(influence_of_sphere(sphere, {0, 1.75, 0}, 0.5), 0.5, 1e-15);
    EXPECT_EQ(influence_of_sphere(sphere, {0, 2, 0}, 0.0), 0);
}

/// Lagarde & Zanuttini's blend as printed, from their normalised distances 1 - influence.
std::vector<double> published_blend(const std::vector<double>& influences) {
    double distances = 0, inverse = 0, sum = 0;
    for (const double f : influences) distances += 1 - f, inverse += f;
    std::vector<double> blend;
    for (const double f : influences) {
        blend.push_back((1 - (1 - f) / distances) / static_cast<double>(influences.size() - 1) *
                        (f / inverse));
        sum += blend.back();
    }
    for (double& b : blend) b /= sum;
    return blend;
}

std::vector<double> blend(const std::vector<double>& influences) {
    std::vector<double> weights(influences.size());
    blend_influences<double>(influences, weights);
    return weights;
}

RC_GTEST_PROP(BlendInfluences, OfTwoIsThePublishedOne, ()) {
    const std::vector<double> influences = {*uniform(0.01, 0.99), *uniform(0.01, 0.99)};
    RC_ASSERT(std::abs(blend(influences)[0] - published_blend(influences)[0]) < 1e-13);
}

RC_GTEST_PROP(BlendInfluences, SumsToOneAndAProbeAtItsBoundaryChangesNothing, ()) {
    std::vector<double> influences;
    for (int i = 0; i < 4; ++i) influences.push_back(*unit_interval());
    const std::vector<double> weights = blend(influences);
    double sum = 0, total = 0;
    for (int i = 0; i < 4; ++i) {
        RC_ASSERT(weights[i] >= 0 && weights[i] <= 1);
        if (influences[i] == 0) RC_ASSERT(weights[i] == 0);
        sum += weights[i];
        total += influences[i];
    }
    RC_ASSERT(std::abs(sum - (total > 0 ? 1 : 0)) < 1e-14);
    influences.push_back(0);
    const std::vector<double> more = blend(influences);
    for (int i = 0; i < 4; ++i) RC_ASSERT(more[i] == weights[i]);
}

TEST(BlendInfluences, PublishedFormPopsWhereAThirdProbeStarts) {
    EXPECT_NEAR(published_blend({.5, .25})[0], .75, 1e-12);
    EXPECT_NEAR(published_blend({.5, .25, 0})[0], .7, 1e-2);
    EXPECT_NEAR(blend({.5, .25, 0})[0], .75, 1e-12);
}

TEST(BlendInfluences, FullInfluenceTakesAllAndIsShared) {
    EXPECT_EQ(blend({1, .9, .3}), (std::vector<double>{1, 0, 0}));
    EXPECT_EQ(blend({1, 1, .3}), (std::vector<double>{.5, .5, 0}));
    EXPECT_EQ(blend({0, 0}), (std::vector<double>{0, 0}));
    EXPECT_EQ(blend({.2}), (std::vector<double>{1}));
    EXPECT_GT(blend({1 - 1e-9, .9, .3})[0], 1 - 1e-7);  // continuous at full influence
}

}  // namespace
}  // namespace pbr

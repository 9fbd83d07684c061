// What certificates say of probes, against full measurements and planted errors.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bakers/io/io.hpp"
#include "tests/bakers/probe/pictures.hpp"

namespace pbrbake::probe {
namespace {

/// Figures of a metric, by level from 1 on.
std::vector<Figure> figures_of(const Certificate& certificate, const std::string& metric) {
    std::vector<Figure> found;
    for (const Figure& figure : certificate.figures)
        if (figure.metric == metric && figure.level > 0) found.push_back(figure);
    return found;
}

struct Coverage {
    double rmse, energy;
};

/// How often the intervals of many sampled certificates hold what a full one measures; none may find a larger
/// error than there is.
Coverage coverage(const ProbeParams& params, const Inputs& inputs, PixelType pixel) {
    Product product = bake_probe(params, inputs);
    product.scale = io::quantise(product.images, pixel);
    Context full_context(2, {});
    full_context.set_certify_fully(true);
    const Certificate full = certify(params, inputs, product, full_context);
    const std::vector<Figure> truth = figures_of(full, "relative_rmse"),
                              energy = figures_of(full, "energy_error"),
                              largest = figures_of(full, "max_error_over_mean");
    const auto holds = [](const Figure& figure, double value) {
        const auto [low, high] = figure.interval.value_or(std::pair{figure.value, figure.value});
        const double slack = 1e-4 * std::abs(value);  // both are against sums with a far field
        return low <= value + slack && value <= high + slack;
    };
    Coverage held{0, 0};
    constexpr int kSeeds = 40;
    int count = 0;
    for (int seed = 0; seed < kSeeds; ++seed) {
        ProbeParams with_seed = params;
        with_seed.seed = static_cast<std::uint64_t>(seed) + 100;
        Context context(2, {});
        const Certificate sampled = certify(with_seed, inputs, product, context);
        count += params.levels - 1;
        const std::vector<Figure> ours = figures_of(sampled, "relative_rmse"),
                                  balance = figures_of(sampled, "energy_error"),
                                  found = figures_of(sampled, "max_error_over_mean");
        for (std::size_t l = 0; l < truth.size(); ++l) {
            EXPECT_EQ(truth[l].evidence, Evidence::measured);
            EXPECT_LE(found[l].value, largest[l].value + 1e-4);  // both against sums with a far field
            held.rmse += holds(ours[l], truth[l].value);
            held.energy += holds(balance[l], energy[l].value);
        }
    }
    return {held.rmse / count, held.energy / count};
}

TEST(ProbeCertificate, IntervalsHoldTheFullMeasurement) {
    ProbeParams params = defaults();
    const Inputs soft = equirect(
        64, [](const glm::dvec3& d) { return glm::dvec3(1 + d.x, d.y > 0 ? 3 : 0.5, d.z > 0.8 ? 5 : 0.1); });
    const Inputs sun = equirect(128, [](const glm::dvec3& d) {
        return glm::dvec3(1 + d.y) + glm::dvec3(d.x * 0.48 + d.y * 0.6 + d.z * 0.64 > 0.9985 ? 1e5 : 0);
    });
    for (const Inputs* inputs : {&soft, &sun})
        for (const Integrator integrator : {Integrator::fis, Integrator::harmonic})
            for (const PixelType pixel : {PixelType::half, PixelType::float32}) {
                if (pixel == PixelType::half && integrator == Integrator::fis)
                    continue;  // its noise hides storage
                params.integrator = integrator;
                params.samples = {integrator == Integrator::fis ? 64 : 0};
                const Coverage held = coverage(params, *inputs, pixel);
                EXPECT_GE(std::min(held.rmse, held.energy), 0.9)
                    << held.rmse << " " << held.energy << " sun " << (inputs == &sun) << " integrator "
                    << static_cast<int>(integrator) << " half " << (pixel == PixelType::half);
            }
}

TEST(ProbeCertificate, IntervalsOfTheMirrorHoldWhatStorageChanged) {
    // A sun and its glow: what half pixels change is at the peak, and a thousandth of it around.
    const Inputs inputs = equirect(256, [](const glm::dvec3& d) {
        const double versine = 1 - (d.x * 0.48 + d.y * 0.6 + d.z * 0.64);
        return glm::dvec3(1 + d.y) + glm::dvec3(versine < 5e-4 ? 1e4 : 1 / (1e-3 + versine));
    });
    ProbeParams params = defaults();
    params.size = 64;
    params.levels = 1;
    Product product = bake_probe(params, inputs);
    product.scale = io::quantise(product.images, PixelType::half);
    Context full(1, {});
    full.set_certify_fully(true);
    const double truth = certify(params, inputs, product, full).headline->value;
    int held = 0;
    for (params.seed = 1; params.seed <= 40; ++params.seed) {
        Context context(1, {});
        const auto [low, high] = certify(params, inputs, product, context).headline->interval.value();
        held += low <= truth * (1 + 1e-6) && truth <= high * (1 + 1e-6);
    }
    EXPECT_GE(held, 36);
}

TEST(ProbeCertificate, LowBandsShowWhatSamplesMayMiss) {
    // One texel in a thousand wrong: hash-chosen texels miss it, sums over all texels don't.
    const Inputs inputs = equirect(128, axes_picture);
    ProbeParams params = defaults();
    params.integrator = Integrator::harmonic;
    params.samples = {0};
    params.size = 64;
    const Product sound = bake_probe(params, inputs);
    Product broken = sound;
    for (std::size_t i = 0; i < 18; ++i) broken.images[0].levels[1].texels[5000 + i] = 0;
    Context context(2, {});
    const Figure of_sound = figures_of(certify(params, inputs, sound, context), "low_band_error")[0];
    const Figure of_broken = figures_of(certify(params, inputs, broken, context), "low_band_error")[0];
    EXPECT_LT(of_sound.value, 1.0 / (32 * 32));
    EXPECT_GT(of_broken.value, 3 * of_sound.value);
}

TEST(ProbeCertificate, EnergyBalancesOnLevelsOfAnySize) {
    // A sun on the cube's corner, whose sum over 24 texels is some per cent off, exact as these may be.
    const Inputs sun = equirect(128, [](const glm::dvec3& d) {
        return glm::dvec3(1 + d.y) + glm::dvec3(d.x + d.y + d.z > 1.7294 ? 1e5 : 0);
    });
    ProbeParams params = defaults();
    params.integrator = Integrator::harmonic;
    params.samples = {0};
    params.size = 32;
    params.levels = 6;
    Product product = bake_probe(params, sun);
    Context context(1, {});
    context.set_certify_fully(true);
    for (const Figure& figure : figures_of(certify(params, sun, product, context), "energy_error"))
        EXPECT_LT(std::abs(figure.value), 1e-4) << *figure.level;
    for (float& value : product.images[0].levels[4].texels) value *= 1.01f;
    EXPECT_NEAR(figures_of(certify(params, sun, product, context), "energy_error")[3].value, 0.01, 1e-3);
}

TEST(ProbeCertificate, FindsPlantedErrors) {
    const Inputs inputs = equirect(64, axes_picture);
    ProbeParams params = defaults();
    params.samples = {1024};
    const Product sound = bake_probe(params, inputs);
    const auto headline = [&](const Product& product) {
        Context context(2, {});
        return certify(params, inputs, product, context).headline->value;
    };
    EXPECT_LT(headline(sound), 5e-3);
    Product dimmed = sound, mirror_off = sound, swapped = sound;
    for (float& value : dimmed.images[0].levels[2].texels) value *= 0.98f;
    for (float& value : mirror_off.images[0].levels[0].texels) value *= 1.02f;
    auto& texels = swapped.images[0].levels[1].texels;
    std::swap_ranges(texels.begin(), texels.begin() + 16 * 16 * 3,
                     texels.begin() + 16 * 16 * 3);  // +X and -X
    for (const Product* broken : {&dimmed, &mirror_off, &swapped}) EXPECT_GT(headline(*broken), 0.015);
}

TEST(ProbeCertificate, CountsEveryTexelOnceAtAnySize) {
    const Inputs inputs = equirect(32, axes_picture);
    for (const int size : {6, 9}) {
        ProbeParams params = defaults();
        params.size = size * 2;
        params.levels = 2;
        params.samples = {16};
        const Product product = bake_probe(params, inputs);
        ProbeParams reference = params;
        reference.integrator = Integrator::reference;
        const Product truth = bake_probe(reference, inputs);
        const auto &a = product.images[0].levels[1].texels, &b = truth.images[0].levels[1].texels;
        double squared = 0, mean = 0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            squared += (a[i] - b[i]) * (a[i] - b[i]);
            mean += a[i];
        }
        const double expected = std::sqrt(squared * static_cast<double>(a.size())) / mean;
        Context context(1, {});
        context.set_certify_fully(true);
        for (const Figure& figure : certify(params, inputs, product, context).figures)
            if (figure.metric == "relative_rmse" && figure.level == 1) {
                EXPECT_NEAR(figure.value, expected, 2e-3 * expected);  // the reference is off by its points
            }
    }
}

}  // namespace
}  // namespace pbrbake::probe

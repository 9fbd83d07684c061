// Pictures that break bakers: huge texels, stripes, suns where faces meet and where horizons cut them. Baked
// as jobs are, and held against sums over the one texel that is lit.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "bakers/io/io.hpp"
#include "bakers/probe/chain.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"
#include "tests/bakers/probe/pictures.hpp"

namespace pbrbake::probe {
namespace {

ProbeParams job(Integrator integrator, int size = 64) {
    ProbeParams params = defaults();
    params.integrator = integrator;
    params.size = size;
    params.samples = {integrator == Integrator::fis || integrator == Integrator::mis ? 256 : 0};
    return params;
}

constexpr Integrator kFast[] = {Integrator::automatic, Integrator::fis, Integrator::mis};

Inputs stripes(bool along_rows) {
    Inputs inputs = equirect(128, [](const glm::dvec3&) { return glm::dvec3(0); });
    Level& level = inputs.at("source").image.levels[0];
    for (std::size_t i = 0; i < level.texels.size(); ++i)
        level.texels[i] = static_cast<float>((along_rows ? i / (128 * 3) : i / 3) % 2);
    return inputs;
}

/// One texel lit, of a picture of 512 x 256 that is black else.
struct Sun {
    explicit Sun(const glm::dvec3& at, float radiance = 1e5f)
        : inputs(equirect(512, [](const glm::dvec3&) { return glm::dvec3(0); })) {
        const glm::dvec2 uv = pbr::equirect_point(at);
        texel = {0, std::min(511, static_cast<int>(uv.x * 512)), std::min(255, static_cast<int>(uv.y * 256))};
        std::fill_n(inputs.at("source").image.texel(0, 0, texel.y, texel.x), 3, radiance);
    }

    /// What a level's texels should be, in the order of faces, rows and columns.
    std::vector<double> truth(const ProbeParams& params, int level) const {
        const Level& source = inputs.at("source").image.levels[0];
        const pbr::PatchBlocks lit(pbr::EquirectView{source.texels.data(), source.width, source.height},
                                   {&texel, 1});
        const int size = size_of_level(params, level);
        std::vector<glm::dvec3> directions;
        for (int i = 0; i < 6 * size * size; ++i)
            directions.push_back(
                pbr::cubemap_texel_direction({i / (size * size), i % size, i / size % size}, size));
        std::vector<double> rgb(directions.size() * 3);
        std::uint64_t evaluations = 0;
        pbr::ld_partial(lit, alpha_of_level(params, level), directions, rgb, evaluations);
        return rgb;
    }

    Inputs inputs;
    pbr::CubeTexel texel;
};

struct Place {
    const char* name;
    glm::dvec3 at;
};
constexpr Place kPlaces[] = {{"corner", {1, 1, 1}},      {"other corner", {-1, -1, 1}},
                             {"edge", {1, 0.2, 1}},      {"upper edge", {0.3, 1, 1}},
                             {"pole", {0, 1, 0}},        {"seam", {0, 0.1, -1}},
                             {"middle", {1, 0.01, 0.01}}};

double energy(int size, const auto& rgb) {
    const std::vector<double> solid_angles = pbr::cubemap_solid_angles(size);
    double sum = 0;
    for (std::size_t i = 0; i < rgb.size(); ++i)
        sum += solid_angles[i / 3 % solid_angles.size()] * static_cast<double>(rgb[i]);
    return sum;
}

TEST(HardCases, AreFiniteAndNowhereNegative) {
    std::vector<Inputs> pictures{stripes(true), stripes(false)};
    for (const float huge : {1e6f, 1e9f, 3e38f}) {
        Inputs lit = equirect(64, [](const glm::dvec3&) { return glm::dvec3(1); });
        lit.at("source").image.texel(0, 0, 10, 20)[0] = huge;
        pictures.push_back(lit);
        pictures.push_back(Sun({1, 1, 1}, huge).inputs);
    }
    for (const Inputs& inputs : pictures)
        for (const Integrator integrator : kFast) {
            Product product = bake_probe(job(integrator, 32), inputs);
            for (const PixelType pixel : {PixelType::float32, PixelType::half}) {
                io::quantise(product.images, pixel);
                for (const Level& level : product.images[0].levels)
                    for (const float value : level.texels) {
                        ASSERT_TRUE(std::isfinite(value)) << enum_name(integrator);
                        ASSERT_GE(value, 0) << enum_name(integrator);
                    }
            }
        }
}

TEST(HardCases, StripesOfOneTexelBecomeTheirMean) {
    for (const bool along_rows : {true, false})
        for (const Integrator integrator : kFast) {
            const Product product = bake_probe(job(integrator), stripes(along_rows));
            for (const std::size_t l : {2u, 3u})
                for (const float value : product.images[0].levels[l].texels)
                    ASSERT_NEAR(value, 0.5, integrator == Integrator::automatic ? 0.02 : 0.15)
                        << along_rows << " " << enum_name(integrator) << " " << l;
        }
}

TEST(HardCases, AConstantStaysConstantToAnUlpOfHalf) {
    const Inputs inputs = equirect(64, [](const glm::dvec3&) { return glm::dvec3(0.5, 7.3, 1e-3); });
    for (const Integrator integrator : kFast) {
        Product product = bake_probe(job(integrator, 32), inputs);
        io::quantise(product.images, PixelType::half);
        const float* first = product.images[0].texel(0, 0, 0, 0);
        for (const Level& level : product.images[0].levels)
            for (std::size_t i = 0; i < level.texels.size(); ++i)
                ASSERT_NEAR(level.texels[i], first[i % 3], first[i % 3] * 0x1p-10f) << enum_name(integrator);
    }
}

TEST(HardCases, ASunIsARoundSpotOfItsEnergyWhereverItStands) {
    const ProbeParams params = job(Integrator::automatic);
    for (const Place& place : kPlaces) {
        const Sun sun(place.at);
        const Product product = bake_probe(params, sun.inputs);
        for (int l = 1; l < 4; ++l) {
            const std::vector<double> truth = sun.truth(params, l);
            const std::vector<float>& found = product.images[0].levels[static_cast<std::size_t>(l)].texels;
            const double peak = *std::max_element(truth.begin(), truth.end());
            const int size = size_of_level(params, l), texels = size * size;
            double worst = 0;
            for (int i = 0; i < 6 * texels; ++i) {
                const glm::dvec3 n =
                    pbr::cubemap_texel_direction({i / texels, i % size, i / size % size}, size);
                const double exact = truth[static_cast<std::size_t>(i) * 3];
                if (exact < 1e-3 * peak || glm::dot(n, glm::normalize(place.at)) < 0.025)
                    continue;  // the horizon cuts the texel: see README.md
                worst = std::max(worst, std::abs(found[static_cast<std::size_t>(i) * 3] / exact - 1));
            }
            EXPECT_LT(worst, 0.01) << place.name << " level " << l;
            EXPECT_NEAR(energy(size, found) / energy(size, truth), 1, 1e-4) << place.name << " level " << l;
        }
    }
}

/// Root mean square and largest step of the error between neighbours, inside faces and across the cube's
/// edges.
struct Steps {
    double rms_inside, rms_across, worst_inside, worst_across;
};
Steps steps_of_error(int size, const std::vector<float>& found, const std::vector<double>& truth) {
    const auto error = [&](const pbr::CubeTexel& texel) {
        const std::size_t i = 3 * (static_cast<std::size_t>(texel.face * size + texel.y) * size + texel.x);
        return found[i] - truth[i];
    };
    double squares[2] = {0, 0}, worst[2] = {0, 0};
    int counts[2] = {0, 0};
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                // Right and down; from the first column and row also left and up, so that all edges are
                // crossed.
                for (const auto& [i, j] : {std::pair{x + 1, y}, {x, y + 1}, {x - 1, y}, {x, y - 1}}) {
                    const bool across = i < 0 || j < 0 || i == size || j == size;
                    if (!across && (i < x || j < y)) continue;  // the same pair again
                    const double step = error(pbr::cubemap_neighbour(face, i, j, size)) - error({face, x, y});
                    squares[across] += step * step;
                    worst[across] = std::max(worst[across], std::abs(step));
                    ++counts[across];
                }
    return {std::sqrt(squares[0] / counts[0]), std::sqrt(squares[1] / counts[1]), worst[0], worst[1]};
}

TEST(HardCases, NoEdgeOrCornerOfTheCubeShows) {
    // A sun on black beside the seam makes any texel's error its own: what a seam adds stands out. Where the
    // sun stands on the edge, the largest steps are there: a quarter more is no seam.
    for (const Place& place : kPlaces) {
        const Sun sun(place.at);
        for (const Integrator integrator : {Integrator::automatic, Integrator::mis}) {
            const ProbeParams params = job(integrator);
            const Product product = bake_probe(params, sun.inputs);
            for (int l = 1; l < 4; ++l) {
                const std::vector<double> truth = sun.truth(params, l);
                const Steps steps =
                    steps_of_error(size_of_level(params, l),
                                   product.images[0].levels[static_cast<std::size_t>(l)].texels, truth);
                const double peak = *std::max_element(truth.begin(), truth.end());
                EXPECT_LE(steps.worst_across, std::max(1.25 * steps.worst_inside, 1e-5 * peak))
                    << place.name << " " << enum_name(integrator) << " level " << l;
            }
        }
    }
}

TEST(HardCases, NoSeamShowsInNoise) {
    const Inputs inputs = noise_cube(32);
    const auto bake = [&](Integrator integrator) {
        return bake_probe(job(integrator, 32), inputs).images[0];
    };
    const Image truth = bake(Integrator::reference);
    for (const Integrator integrator : kFast) {
        const Image found = bake(integrator);
        for (std::size_t l = 1; l < 4; ++l) {
            const std::vector<float>& exact = truth.levels[l].texels;
            const Steps steps =
                steps_of_error(found.levels[l].width, found.levels[l].texels, {exact.begin(), exact.end()});
            EXPECT_LE(steps.rms_across, std::max(1.3 * steps.rms_inside, 1e-5))
                << enum_name(integrator) << " level " << l;
        }
    }
}

}  // namespace
}  // namespace pbrbake::probe

// What is known of a probe's error: texels chosen by hash against the exact sum, a level at a time.

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bakers/probe/chain.hpp"
#include "bakers/probe/environment.hpp"
#include "bakers/probe/method.hpp"
#include "bakers/probe/probe.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"
#include "pbr/numerics/sequence.hpp"
#include "pbr/numerics/sum.hpp"

namespace pbrbake::probe {
namespace {

/// A tile of up to 4 x 4 texels is checked together, since the exact sum shares its work among neighbours.
constexpr int kTile = 4;
constexpr int kTilesACall = 8;

struct Tile {
    int face, left, top, width, height;
    int texels() const { return width * height; }
};

Tile random_tile(int size, std::uint64_t bits) {
    const int side = std::min(kTile, size);
    const auto places = static_cast<unsigned>(size - side + 1);
    return {static_cast<int>(bits % 6), static_cast<int>((bits >> 8) % places),
            static_cast<int>((bits >> 32) % places), side, side};
}

/// Tiles side by side that cover all faces, those at the ends cut short.
std::vector<Tile> all_tiles(int size) {
    std::vector<Tile> tiles;
    for (int face = 0; face < 6; ++face)
        for (int top = 0; top < size; top += kTile)
            for (int left = 0; left < size; left += kTile)
                tiles.push_back({face, left, top, std::min(kTile, size - left), std::min(kTile, size - top)});
    return tiles;
}

/// How many tiles a level can afford, so that checking costs no more than the bake. An exact texel costs as
/// many kernel evaluations as about half the source has texels; in these a filtered sample costs about ten,
/// and the harmonic solver 100 a texel of the source, shared by the levels, and 200 a texel of the level.
int affordable_tiles(const ProbeParams& params, const Method& method, const Accuracy& accuracy,
                     const Environment& environment, int level) {
    constexpr double kFewest = 2, kMost = 64;
    const double n = environment.equivalent_size(), size = size_of_level(params, level);
    const double source_texels = 6 * n * n, texels = 6 * size * size;
    const double whole = std::max(1.0, texels / (kTile * kTile));
    if (method.integrator == Integrator::reference) return static_cast<int>(std::min(kMost, whole));
    const double work = method.integrator == Integrator::harmonic
                            ? source_texels * 100 / (level_count(params) - 1) + texels * 200
                            : texels * samples_of_level(params, accuracy, level) * 10;
    const double affordable = work / (source_texels / 2 * kTile * kTile);
    return static_cast<int>(std::min(std::clamp(affordable, kFewest, kMost), whole));
}

struct TileError {
    double squared = 0;    ///< sum over texels and channels of (stored - true)^2
    double largest = 0;    ///< largest |stored - true|
    double deviation = 0;  ///< |1 - integral of the kernel| of the exact sums: the error of the truth
};

/// Errors of some tiles of a level. One call of the exact sum serves them all: it decodes the source once.
void tile_errors(const pbr::PatchBlocks& blocks, double alpha, const Product& product, int level,
                 std::span<const Tile> tiles, std::span<TileError> errors, Context& context) {
    const int size = product.images[0].levels[static_cast<std::size_t>(level)].width;
    std::vector<glm::dvec3> directions;
    for (const Tile& tile : tiles)
        for (int i = 0; i < tile.texels(); ++i)
            directions.push_back(pbr::cubemap_texel_direction(
                {tile.face, tile.left + i % tile.width, tile.top + i / tile.width}, size));
    std::vector<double> truth(directions.size() * 3);
    std::uint64_t evaluations = 0;
    const double deviation = pbr::ld_exact(blocks, alpha, directions, truth, evaluations);
    context.count("certify.ld", evaluations);
    const double* exact = truth.data();
    for (std::size_t k = 0; k < tiles.size(); ++k) {
        const Tile& tile = tiles[k];
        errors[k].deviation = deviation;
        for (int i = 0; i < tile.texels(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double stored = product.images[0].texel(level, tile.face, tile.top + i / tile.width,
                                                              tile.left + i % tile.width)[c];
                const double difference = std::abs(stored / product.scale - *exact++);
                errors[k].squared += difference * difference;
                errors[k].largest = std::max(errors[k].largest, difference);
            }
        context.advance(tile.texels());
    }
}

/// Mean of a level's stored values over texels and channels; 1 for a black level, whose errors are then
/// absolute.
double mean_of_level(const Product& product, int level) {
    const std::vector<float>& texels = product.images[0].levels[static_cast<std::size_t>(level)].texels;
    pbr::CompensatedSum sum;
    for (const float value : texels) sum += static_cast<double>(value);
    const double mean = sum.value() / static_cast<double>(texels.size()) / product.scale;
    return mean > 0 ? mean : 1;
}

/// Radiance times solid angle over all texels and channels.
double energy_of_level(const Product& product, int level) {
    const Image& image = product.images[0];
    const int n = image.levels[static_cast<std::size_t>(level)].width;
    pbr::CompensatedSum flux;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const double solid_angle = pbr::cubemap_texel_solid_angle(n, x, y);
            for (int face = 0; face < 6; ++face)
                for (int c = 0; c < 3; ++c)
                    flux += solid_angle * static_cast<double>(image.texel(level, face, y, x)[c]);
        }
    return flux.value() / product.scale;
}

/// Root mean square over texels, over the level's mean; with its 95 % interval where tiles were chosen by
/// hash.
Figure relative_rmse(std::span<const Tile> tiles, std::span<const TileError> errors, int level, double mean,
                     bool all) {
    double squared = 0, values = 0;
    for (std::size_t k = 0; k < tiles.size(); ++k) {
        squared += errors[k].squared;
        values += tiles[k].texels() * 3;
    }
    squared /= values;
    const double value = std::sqrt(squared) / mean;
    if (all)
        return {
            "relative_rmse", value, Evidence::measured, "all stored texels against the exact sum", {}, level};
    Figure figure{"relative_rmse",
                  value,
                  Evidence::estimate,
                  "stored texels against the exact sum, " + std::to_string(tiles.size()) +
                      " tiles of up to " + std::to_string(kTile) + " x " + std::to_string(kTile) +
                      " texels chosen by hash",
                  {},
                  level};
    if (tiles.size() < 2) return figure;
    const double count = static_cast<double>(tiles.size());
    double variance = 0;
    for (std::size_t k = 0; k < tiles.size(); ++k) {
        const double of_tile = errors[k].squared / (tiles[k].texels() * 3) - squared;
        variance += of_tile * of_tile;
    }
    const double half_width = 1.96 * std::sqrt(variance / (count * (count - 1)));
    figure.interval = {std::sqrt(std::max(0.0, squared - half_width)) / mean,
                       std::sqrt(squared + half_width) / mean};
    return figure;
}

/// Level 0 against the resampled source, on all rows or on some chosen by hash: what storage changed.
Figure mirror_figure(const ProbeParams& params, const Environment& environment, const Product& product,
                     Context& context) {
    constexpr int kRows = 16;
    const int size = params.size;
    const bool all = context.certify_fully() || 6 * size <= kRows;
    const int rows = all ? 6 * size : kRows;
    std::vector<double> squared(static_cast<std::size_t>(rows));
    context.parallel_for(rows, 1, [&](std::int64_t begin, std::int64_t) {
        const auto row = all ? static_cast<std::uint64_t>(begin)
                             : pbr::random_bits(params.seed, 0x6d69u, begin) % (6u * size);
        const int face = static_cast<int>(row / size), y = static_cast<int>(row % size);
        std::vector<float> truth(static_cast<std::size_t>(size) * 3);
        environment.resample_row(size, face, y, truth);
        const float* stored = product.images[0].texel(0, face, y, 0);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const double difference = stored[i] / product.scale - static_cast<double>(truth[i]);
            squared[static_cast<std::size_t>(begin)] += difference * difference;
        }
    });
    double sum = 0;
    for (const double of_row : squared) sum += of_row;
    return {"relative_rmse",
            std::sqrt(sum / (rows * size * 3.0)) / mean_of_level(product, 0),
            all ? Evidence::measured : Evidence::estimate,
            "stored texels of " + std::to_string(rows) + " rows against the resampled source",
            {},
            0};
}

std::vector<Tile> tiles_of_level(const ProbeParams& params, const Environment& environment, int level,
                                 const Context& context) {
    const int size = size_of_level(params, level);
    if (context.certify_fully()) return all_tiles(size);
    std::vector<Tile> tiles;
    const int count = affordable_tiles(params, method_of(params, context.accuracy()), context.accuracy(),
                                       environment, level);
    for (int i = 0; i < count; ++i)
        tiles.push_back(random_tile(size, pbr::random_bits(params.seed, 0x6365u, level, i)));
    return tiles;
}

/// A filtered level against the exact sum.
std::vector<Figure> level_figures(const std::vector<Tile>& tiles, const pbr::PatchBlocks& blocks,
                                  const Product& product, int level, double alpha, Context& context) {
    std::vector<TileError> errors(tiles.size());
    context.parallel_for(
        static_cast<std::int64_t>(tiles.size()), kTilesACall, [&](std::int64_t begin, std::int64_t end) {
            const auto first = static_cast<std::size_t>(begin), count = static_cast<std::size_t>(end - begin);
            tile_errors(blocks, alpha, product, level, std::span(tiles).subspan(first, count),
                        std::span(errors).subspan(first, count), context);
        });
    const double mean = mean_of_level(product, level);
    TileError worst;
    for (const TileError& error : errors) {
        worst.largest = std::max(worst.largest, error.largest);
        worst.deviation = std::max(worst.deviation, error.deviation);
    }
    const Figure rmse = relative_rmse(tiles, errors, level, mean, context.certify_fully());
    return {rmse,
            {"max_error_over_mean", worst.largest / mean, rmse.evidence, rmse.method, {}, level},
            {"error_of_the_exact_sum",
             worst.deviation,
             Evidence::measured,
             "largest |1 - integral of the kernel| by the quadrature of the exact sums",
             {},
             level}};
}

}  // namespace

Certificate certify(const ProbeParams& params, const Inputs& inputs, const Product& product,
                    Context& context) {
    const Environment environment(params, inputs.at("source"));
    const pbr::PatchBlocks blocks = environment.blocks();
    const double source_energy = environment.energy();
    std::vector<std::vector<Tile>> tiles(static_cast<std::size_t>(level_count(params)));
    for (int l = 1; l < level_count(params); ++l) {
        tiles[static_cast<std::size_t>(l)] = tiles_of_level(params, environment, l, context);
        for (const Tile& tile : tiles[static_cast<std::size_t>(l)]) context.expect(tile.texels());
    }
    Certificate certificate;
    for (int l = 0; l < level_count(params); ++l) {
        const double alpha = pbr::alpha_from_perceptual_roughness(perceptual_roughness_of_level(params, l));
        std::vector<Figure> figures;
        if (l == 0) {
            figures = {mirror_figure(params, environment, product, context)};
        } else {
            figures = level_figures(tiles[static_cast<std::size_t>(l)], blocks, product, l, alpha, context);
        }
        if (!certificate.headline || figures[0].value > certificate.headline->value)
            certificate.headline = figures[0];
        certificate.figures.insert(certificate.figures.end(), figures.begin(), figures.end());
        const double ratio = source_energy > 0 ? energy_of_level(product, l) / source_energy - 1 : 0;
        certificate.figures.push_back({"energy_error",
                                       ratio,
                                       Evidence::measured,
                                       "solid-angle weighted sum of all texels against the source's",
                                       {},
                                       l});
    }
    return certificate;
}

}  // namespace pbrbake::probe

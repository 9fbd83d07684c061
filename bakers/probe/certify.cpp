// What is known of a probe's error: texels chosen by hash against the exact sum, a level at a time.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "bakers/probe/chain.hpp"
#include "bakers/probe/environment.hpp"
#include "bakers/probe/levels.hpp"
#include "bakers/probe/method.hpp"
#include "bakers/probe/probe.hpp"
#include "bakers/probe/source_layout.hpp"
#include "bakers/probe/tile_sample.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/moment_tree.hpp"
#include "pbr/ibl/spherical_harmonics.hpp"
#include "pbr/ibl/zonal_harmonics.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"
#include "pbr/numerics/sum.hpp"

namespace pbrbake::probe {
namespace {

/// A tile of 4 x 4 texels is checked together, since they share the exact sum's work; but where such a tile
/// is wide, its texels are better alone.
constexpr int kTile = 4, kSmallestTiled = 128, kSmallestTiledOfAll = 64;

/// What distant parts may move the exact sum by, of the error that was asked for.
constexpr double kFarFieldShare = 0.1;

/// What the exact sum may be off by its points: nothing smaller is told.
constexpr double kErrorOfPoints = 3e-5;

/// Bands that are checked whole: l = 0 to 4.
constexpr int kLowBands = 5;

struct Tile {
    int face, left, top, width, height;
    int texels() const { return width * height; }
};

/// Tiles side by side that cover all faces, those at the ends cut short.
std::vector<Tile> all_tiles(int size, int smallest_tiled) {
    const int side = size < smallest_tiled ? 1 : kTile;
    std::vector<Tile> tiles;
    for (int face = 0; face < 6; ++face)
        for (int top = 0; top < size; top += side)
            for (int left = 0; left < size; left += side)
                tiles.push_back({face, left, top, std::min(side, size - left), std::min(side, size - top)});
    return tiles;
}

/// Evaluations of the exact sum that a level can afford, so that checking costs no more than the bake. An
/// evaluation takes about 20 ns; the tree that they stand on about 40 ns a texel of the source. In these the
/// harmonic solver takes about 90 ns a texel of the source, shared by the levels, and 200 ns a texel of the
/// level; a filtered sample 10.
double affordable_evaluations(const ProbeParams& params, const Method& method, const Accuracy& accuracy,
                              const Environment& environment, int level) {
    const double size = size_of_level(params, level), texels = 6 * size * size;
    const double source_texels = environment.texels() / (level_count(params) - 1.0);
    switch (method.integrator) {
        case Integrator::reference:
            return 1e9;
        case Integrator::harmonic:
            return (source_texels * 50 + texels * 200) / 20;
        default:
            return (texels * samples_of_level(params, accuracy, level) * 10 - source_texels * 40) / 20;
    }
}

struct TileError {
    double squared = 0;  ///< sum over texels and channels of (stored - true)^2
    double largest = 0;  ///< largest |stored - true|
    pbr::LdTreeError of_truth{0, 0};
    std::uint64_t evaluations = 0;
};

/// What certifying needs of a level.
struct LevelCheck {
    const Product& product;
    const pbr::MomentTree& tree;
    int level;
    double alpha;
    double tolerance;  ///< of the exact sum's far field, over the mean
};

TileError error_of_tile(const LevelCheck& check, const Tile& tile) {
    const Image& image = check.product.images[0];
    const int size = image.levels[static_cast<std::size_t>(check.level)].width;
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < tile.texels(); ++i)
        directions.push_back(pbr::cubemap_texel_direction(
            {tile.face, tile.left + i % tile.width, tile.top + i / tile.width}, size));
    std::vector<double> truth(directions.size() * 3);
    TileError error;
    error.of_truth =
        pbr::ld_exact(check.tree, check.alpha, check.tolerance, directions, truth, error.evaluations);
    const double* exact = truth.data();
    for (int i = 0; i < tile.texels(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double stored =
                image.texel(check.level, tile.face, tile.top + i / tile.width, tile.left + i % tile.width)[c];
            const double difference = std::abs(stored / check.product.scale - *exact++);
            error.squared += difference * difference;
            error.largest = std::max(error.largest, difference);
        }
    return error;
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

/// Sums of squared stored values, by which tiles are chosen.
std::vector<double> brightness_of_tiles(const Image& image, int level, std::span<const Tile> tiles) {
    std::vector<double> brightness;
    for (const Tile& tile : tiles) {
        double sum = 0;
        for (int y = tile.top; y < tile.top + tile.height; ++y) {
            const float* values = image.texel(level, tile.face, y, tile.left);
            for (int i = 0; i < 3 * tile.width; ++i)
                sum += static_cast<double>(values[i]) * static_cast<double>(values[i]);
        }
        brightness.push_back(sum);
    }
    return brightness;
}

/// Root mean square over `values` numbers, over a mean, from a total of squares.
/// The interval is widened by what the truth itself may be off.
Figure relative_rmse(const TotalEstimate& squared, double values, double mean, double of_truth, bool all,
                     std::string method, int level) {
    const auto root = [&](double total) { return std::sqrt(total / values) / mean; };
    Figure figure{"relative_rmse",
                  root(squared.value),
                  all ? Evidence::measured : Evidence::estimate,
                  std::move(method),
                  {},
                  level};
    if (!all)
        figure.interval = {std::max(0.0, root(squared.interval.first) - of_truth),
                           root(squared.interval.second) + of_truth};
    return figure;
}

/// Level 0 against the resampled source, on all rows, or on the brightest and some chosen by hash: what
/// storage changed.
Figure mirror_figure(const ProbeParams& params, const Environment& environment, const Product& product,
                     Context& context) {
    constexpr int kRows = 24;
    const int size = params.size, rows = 6 * size;
    std::vector<double> brightness;
    for (int row = 0; row < rows; ++row) {
        const Tile tile{row / size, 0, row % size, size, 1};
        brightness.push_back(brightness_of_tiles(product.images[0], 0, {&tile, 1})[0]);
    }
    const TileSample sample = choose_tiles(brightness, context.certify_fully() ? rows : kRows, params.seed);
    std::vector<std::size_t> chosen = sample.certain;
    chosen.insert(chosen.end(), sample.drawn.begin(), sample.drawn.end());
    std::vector<double> squared(chosen.size());
    context.parallel_for(static_cast<std::int64_t>(chosen.size()), 1, [&](std::int64_t begin, std::int64_t) {
        const auto k = static_cast<std::size_t>(begin);
        const int face = static_cast<int>(chosen[k]) / size, y = static_cast<int>(chosen[k]) % size;
        std::vector<float> truth(static_cast<std::size_t>(size) * 3);
        environment.resample_row(size, face, y, truth);
        const float* stored = product.images[0].texel(0, face, y, 0);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const double difference = stored[i] / product.scale - static_cast<double>(truth[i]);
            squared[k] += difference * difference;
        }
    });
    const bool all = sample.drawn.empty();
    return relative_rmse(estimate_total(sample, std::span(squared).first(sample.certain.size()),
                                        std::span(squared).subspan(sample.certain.size())),
                         3.0 * size * rows, mean_of_level(product, 0), 0, all,
                         all ? "all stored texels against the resampled source"
                             : "stored texels of " + std::to_string(chosen.size()) +
                                   " rows, the brightest and others by hash, against the resampled source",
                         0);
}

/// The largest error of a level: what was found, and how large it may be elsewhere if errors follow
/// brightness as they did where they were measured, and are scattered about that no wider than exponentially,
/// whose largest of N grows like log N.
Figure largest_error(std::span<const Tile> tiles, std::span<const double> brightness,
                     std::span<const std::size_t> chosen, std::span<const TileError> errors, double mean,
                     bool all, const std::string& method, int level) {
    const auto scale_of = [&](std::size_t tile) {
        return mean + std::sqrt(brightness[tile] / (3.0 * tiles[tile].texels()));
    };
    double found = 0, share = 0, largest_scale = 0;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        found = std::max(found, errors[k].largest);
        share = std::max(share, errors[k].largest / scale_of(chosen[k]));
    }
    Figure figure{"max_error_over_mean",
                  found / mean,
                  all ? Evidence::measured : Evidence::estimate,
                  method,
                  {},
                  level};
    if (all) return figure;
    std::vector<bool> measured(tiles.size());
    for (const std::size_t tile : chosen) measured[tile] = true;
    for (std::size_t tile = 0; tile < tiles.size(); ++tile)
        if (!measured[tile]) largest_scale = std::max(largest_scale, scale_of(tile));
    const double growth = pbr::log_exact(2.0 + static_cast<double>(tiles.size())) /
                          pbr::log_exact(2.0 + static_cast<double>(chosen.size()));
    figure.interval = {found / mean, std::max(found, share * largest_scale * growth) / mean};
    return figure;
}

/// A filtered level against the exact sum, on all tiles or as many as `affordable` evaluations pay for.
std::vector<Figure> level_figures(const LevelCheck& check, double affordable, const ProbeParams& params,
                                  Context& context) {
    constexpr double kFewest = 12, kMost = 96;
    const int size = size_of_level(params, check.level);
    const std::vector<Tile> tiles =
        all_tiles(size, context.certify_fully() ? kSmallestTiledOfAll : kSmallestTiled);
    const std::vector<double> brightness = brightness_of_tiles(check.product.images[0], check.level, tiles);
    int count = static_cast<int>(tiles.size());
    if (!context.certify_fully()) {
        // What a tile costs shows in the first: it depends on the picture's size and the lobe, not on the
        // machine.
        const TileError first = error_of_tile(check, tiles[0]);
        context.count("certify.ld", first.evaluations);
        count =
            static_cast<int>(std::clamp(affordable / static_cast<double>(first.evaluations), kFewest, kMost));
    }
    const TileSample sample =
        choose_tiles(brightness, count, pbr::random_bits(params.seed, 0x6365u, check.level));
    std::vector<std::size_t> chosen = sample.certain;
    chosen.insert(chosen.end(), sample.drawn.begin(), sample.drawn.end());
    context.expect(static_cast<double>(chosen.size()));
    std::vector<TileError> errors(chosen.size());
    context.parallel_for(static_cast<std::int64_t>(chosen.size()), 1, [&](std::int64_t begin, std::int64_t) {
        const auto k = static_cast<std::size_t>(begin);
        errors[k] = error_of_tile(check, tiles[chosen[k]]);
        context.count("certify.ld", errors[k].evaluations);
        context.advance(1);
    });

    const double mean = mean_of_level(check.product, check.level);
    std::vector<double> squared;
    pbr::LdTreeError of_truth{0, 0};
    for (const TileError& error : errors) {
        squared.push_back(error.squared);
        of_truth.deviation = std::max(of_truth.deviation, error.of_truth.deviation);
        of_truth.far_field = std::max(of_truth.far_field, error.of_truth.far_field);
    }
    const bool all = sample.drawn.empty();
    const std::string method =
        all ? "all stored texels against the exact sum"
            : "stored texels against the exact sum, the " + std::to_string(sample.certain.size()) +
                  " brightest parts of the level and " + std::to_string(sample.drawn.size()) +
                  " chosen by hash, of " + std::to_string(tiles[0].texels()) + " texels each";
    const TotalEstimate total = estimate_total(sample, std::span(squared).first(sample.certain.size()),
                                               std::span(squared).subspan(sample.certain.size()));
    return {relative_rmse(total, 18.0 * size * size, mean, std::max(of_truth.deviation, kErrorOfPoints), all,
                          method, check.level),
            largest_error(tiles, brightness, chosen, errors, mean, all, method, check.level),
            {"error_of_the_exact_sum",
             of_truth.deviation,
             Evidence::measured,
             "largest |1 - integral of the kernel| by the quadrature of the exact sums",
             {},
             check.level},
            {"far_field_error",
             of_truth.far_field,
             Evidence::bound,
             "what taking distant parts of the source by their moments moved an exact sum by at most, over "
             "the mean",
             {},
             check.level}};
}

/// The lowest bands of a level against the source's, which the kernel must have multiplied by k_l: a check of
/// all texels that needs no exact sum. What the source's bands foretell is taken off each texel, so that the
/// sums over texels have to integrate only the rest.
Figure low_band_figure(const Product& product, const std::vector<glm::dvec3>& source_bands, double mean,
                       double alpha, int level) {
    const std::vector<double> kernel = pbr::zonal_ggx(pbr::GgxZonalKernel(alpha), kLowBands);
    std::vector<glm::dvec3> expected = source_bands;
    pbr::sh_scale_bands<double, glm::dvec3>(kernel, expected);
    const Image& image = product.images[0];
    const int size = image.levels[static_cast<std::size_t>(level)].width;
    std::vector<glm::dvec3> rest(expected.size(), glm::dvec3(0));
    std::vector<double> basis(expected.size());
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double solid_angle = pbr::cubemap_texel_solid_angle(size, x, y);
            for (int face = 0; face < 6; ++face) {
                pbr::sh_evaluate<double>(kLowBands, pbr::cubemap_texel_direction({face, x, y}, size), basis);
                const float* texel = image.texel(level, face, y, x);
                glm::dvec3 value = glm::dvec3(texel[0], texel[1], texel[2]) / product.scale;
                for (std::size_t i = 0; i < basis.size(); ++i) value -= basis[i] * expected[i];
                for (std::size_t i = 0; i < basis.size(); ++i) rest[i] += solid_angle * basis[i] * value;
            }
        }
    double largest = 0;
    for (const glm::dvec3& coefficient : rest)
        for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(coefficient[c]));
    return {"low_band_error",
            largest / (mean * std::sqrt(4 * std::numbers::pi)),
            Evidence::measured,
            "largest difference of LD_lm from k_l E_lm, l to 4, over the mean's own coefficient; sums over "
            "texels "
            "leave up to 1 / size^2 of what is in higher bands",
            {},
            level};
}

}  // namespace

Certificate certify(const ProbeParams& params, const Inputs& inputs, const Product& product,
                    Context& context) {
    SourceImage unfolded;
    const Environment environment(params, environment_source(params, inputs, unfolded));
    const pbr::PatchBlocks blocks = environment.blocks();
    const pbr::MomentTree tree(blocks, each_on(context, 0));
    const std::vector<glm::dvec3> source_bands = pbr::sh_project(tree, kLowBands);
    const double source_energy = 4 * std::numbers::pi * (tree.mean().x + tree.mean().y + tree.mean().z);
    const double source_mean = source_energy > 0 ? source_energy / (12 * std::numbers::pi) : 1;
    const Method method = method_of(params, context.accuracy());
    Certificate certificate;
    for (int l = 0; l < level_count(params); ++l) {
        std::vector<Figure> figures;
        if (l == 0) {
            figures = {mirror_figure(params, environment, product, context)};
        } else {
            const double alpha = alpha_of_level(params, l);
            figures = level_figures(
                {product, tree, l, alpha, std::min(1.0, kFarFieldShare * method.max_error)},
                affordable_evaluations(params, method, context.accuracy(), environment, l), params, context);
            figures.push_back(low_band_figure(product, source_bands, source_mean, alpha, l));
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

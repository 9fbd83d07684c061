// What is known of a probe's error: texels chosen by hash against the exact sum, a level at a time.

#include <algorithm>
#include <array>
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

/// Bands that are checked whole: l = 0 to 3.
constexpr int kLowBands = pbr::kMomentBands;

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

/// Evaluations of the exact sum that a level can afford, so that beyond the fewest parts checking costs about
/// half the bake. An evaluation takes about 20 ns; the tree that they stand on about 20 ns a texel of the
/// source. Of what is paid for in these the harmonic solver gives 10 ns a texel of the source, shared by the
/// levels, and 40 ns a texel of the level; a filtered sample takes 10.
double affordable_evaluations(const ProbeParams& params, const Method& method, const Accuracy& accuracy,
                              const Environment& environment, int level) {
    const double size = size_of_level(params, level), texels = 6 * size * size;
    const double source_texels = environment.texels() / (level_count(params) - 1.0);
    switch (method.integrator) {
        case Integrator::reference:
            return 1e9;
        case Integrator::harmonic:
            return (source_texels * 10 + texels * 40) / 20;
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

/// Solid angles of a face's texels, sr, by rows: those of an eighth of it, and its mirror images.
std::vector<double> solid_angles_of_face(int n) {
    std::vector<double> solid_angles(static_cast<std::size_t>(n) * n);
    for (int y = 0; y < (n + 1) / 2; ++y)
        for (int x = y; x < (n + 1) / 2; ++x) {
            const double solid_angle = pbr::cubemap_texel_solid_angle(n, x, y);
            for (const auto& [column, row] : {std::pair{x, y}, std::pair{y, x}})
                for (const int j : {row, n - 1 - row})
                    for (const int i : {column, n - 1 - column})
                        solid_angles[static_cast<std::size_t>(j) * n + i] = solid_angle;
        }
    return solid_angles;
}

/// Radiance times solid angle over all texels and channels.
double energy_of_level(const Product& product, int level) {
    const Image& image = product.images[0];
    const int n = image.levels[static_cast<std::size_t>(level)].width;
    const std::vector<double> solid_angles = solid_angles_of_face(n);
    pbr::CompensatedSum flux;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < n; ++y) {
            const float* texel = image.texel(level, face, y, 0);
            const double* solid_angle = &solid_angles[static_cast<std::size_t>(y) * n];
            double row = 0;
            for (int x = 0; x < n; ++x, texel += 3)
                row += solid_angle[x] * (static_cast<double>(texel[0]) + static_cast<double>(texel[1]) +
                                         static_cast<double>(texel[2]));
            flux += row;
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
/// The interval is widened by what the truth itself may be off, and by what its far field is allowed, a tenth
/// of the error asked for: what is left of a solved level beside a sun sits on single texels that a draw
/// misses, and is smaller.
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
    constexpr int kRows = 12;
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

/// The largest error found in a level. Of a sample it is a lower bound: no other texel is known to err less.
Figure largest_error(std::span<const TileError> errors, double mean, bool all, const std::string& method,
                     int level) {
    double found = 0;
    for (const TileError& error : errors) found = std::max(found, error.largest);
    return {"max_error_over_mean",
            found / mean,
            all ? Evidence::measured : Evidence::estimate,
            all ? method : "a lower bound, the largest found: " + method,
            {},
            level};
}

/// A filtered level against the exact sum, on all tiles or as many as `affordable` evaluations pay for.
std::vector<Figure> level_figures(const LevelCheck& check, double affordable, const ProbeParams& params,
                                  Context& context) {
    constexpr double kFewest = 12, kMost = 64;
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
    return {relative_rmse(total, 18.0 * size * size, mean,
                          std::max(of_truth.deviation, kErrorOfPoints) + check.tolerance, all, method,
                          check.level),
            largest_error(errors, mean, all, method, check.level),
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
    constexpr std::size_t kCount = kLowBands * kLowBands;
    std::array<std::array<double, kCount>, 3> foretold{}, rest{};
    for (std::size_t i = 0; i < kCount; ++i)
        for (int c = 0; c < 3; ++c) foretold[static_cast<std::size_t>(c)][i] = expected[i][c];
    const Image& image = product.images[0];
    const int size = image.levels[static_cast<std::size_t>(level)].width;
    std::array<double, kCount> basis{};
    const std::vector<double> solid_angles = solid_angles_of_face(size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double solid_angle = solid_angles[static_cast<std::size_t>(y) * size + x];
            for (int face = 0; face < 6; ++face) {
                pbr::sh_evaluate<double>(kLowBands, pbr::cubemap_texel_direction({face, x, y}, size), basis);
                const float* texel = image.texel(level, face, y, x);
                for (std::size_t c = 0; c < 3; ++c) {
                    std::array<double, 4> known{};  // sums side by side
                    for (std::size_t i = 0; i < kCount; ++i) known[i % 4] += basis[i] * foretold[c][i];
                    const double value = static_cast<double>(texel[c]) / product.scale -
                                         ((known[0] + known[1]) + (known[2] + known[3]));
                    for (std::size_t i = 0; i < kCount; ++i) rest[c][i] += solid_angle * value * basis[i];
                }
            }
        }
    double largest = 0;
    for (const std::array<double, kCount>& channel : rest)
        for (const double coefficient : channel) largest = std::max(largest, std::abs(coefficient));
    return {"low_band_error",
            largest / (mean * std::sqrt(4 * std::numbers::pi)),
            Evidence::measured,
            "largest difference of LD_lm from k_l E_lm, l to 3, over the mean's own coefficient; sums over "
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

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
#include "bakers/probe/low_bands.hpp"
#include "bakers/probe/method.hpp"
#include "bakers/probe/probe.hpp"
#include "bakers/probe/source_layout.hpp"
#include "bakers/probe/tile_sample.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/moment_tree.hpp"
#include "pbr/numerics/sequence.hpp"
#include "pbr/numerics/sum.hpp"

namespace pbrbake::probe {
namespace {

/// Where all texels are checked, tiles of 4 x 4 share the exact sum's work; but where such a tile is wide,
/// its texels are better alone, as those are that are drawn.
constexpr int kTile = 4, kSmallestTiled = 64;

/// Texels of a level that are checked: sampling errs by noise, and takes longer.
constexpr int kChecked = 8, kCheckedOfSamples = 48;

/// Level 0 is checked in strips of a row's texels, and as many of them.
constexpr int kStrip = 16, kStrips = 16;

/// What distant parts may move the exact sum by at most, of the error that was asked for. What they do is a
/// hundredth of that.
constexpr double kFarFieldShare = 1.0 / 3;

/// Intervals are widened by this share of the error asked for: what is left of a solved level beside a sun
/// sits on single texels that a draw misses, and is smaller.
constexpr double kSlack = 0.1;

/// What the exact sum may be off by its points: nothing smaller is told.
constexpr double kErrorOfPoints = 3e-5;

struct Tile {
    int face, left, top, width, height;
    int texels() const { return width * height; }
};

/// Tiles side by side that cover all faces, those at the ends cut short: by faces, rows and columns.
class Tiling {
  public:
    Tiling(int size, int width, int height)
        : size_(size),
          width_(width),
          height_(height),
          columns_((size + width - 1) / width),
          rows_((size + height - 1) / height) {}

    std::size_t count() const { return static_cast<std::size_t>(6) * rows_ * columns_; }

    Tile operator[](std::size_t index) const {
        const int i = static_cast<int>(index), left = i % columns_ * width_,
                  top = i / columns_ % rows_ * height_;
        return {i / columns_ / rows_, left, top, std::min(width_, size_ - left),
                std::min(height_, size_ - top)};
    }

    /// Sums of a level's squared values over each tile, by which they are chosen.
    std::vector<double> brightness(const Image& image, int level) const {
        std::vector<double> sums(count());
        for (int row = 0; row < 6 * size_; ++row) {
            const int face = row / size_, y = row % size_;
            const float* values = image.texel(level, face, y, 0);
            double* sum = &sums[static_cast<std::size_t>(face * rows_ + y / height_) * columns_];
            for (int left = 0; left < size_; left += width_)
                *sum++ += sum_of_squares(values + 3 * left, std::min(width_, size_ - left));
        }
        return sums;
    }

  private:
    /// Of texels; the channels' sums don't wait for each other.
    static double sum_of_squares(const float* rgb, int count) {
        std::array<double, 3> sums{};
        for (int x = 0; x < count; ++x)
            for (std::size_t c = 0; c < 3; ++c, ++rgb)
                sums[c] += static_cast<double>(*rgb) * static_cast<double>(*rgb);
        return sums[0] + sums[1] + sums[2];
    }

    int size_, width_, height_, columns_, rows_;
};

struct TileError {
    double squared = 0;  ///< sum over texels and channels of (stored - true)^2
    double largest = 0;  ///< largest |stored - true|
    double energy = 0;   ///< sum of (stored - true) times solid angle
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
    double slack;      ///< of intervals
    double source_energy;
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
    for (int i = 0; i < tile.texels(); ++i) {
        const int x = tile.left + i % tile.width, y = tile.top + i / tile.width;
        const float* stored = image.texel(check.level, tile.face, y, x);
        const double solid_angle = pbr::cubemap_texel_solid_angle(size, x, y);
        for (int c = 0; c < 3; ++c) {
            const double difference = static_cast<double>(stored[c]) / check.product.scale - *exact++;
            error.squared += difference * difference;
            error.largest = std::max(error.largest, std::abs(difference));
            error.energy += difference * solid_angle;
        }
    }
    return error;
}

/// Sum of a row's values; the channels' sums don't wait for each other.
double sum_of_row(const float* rgb, int count) {
    std::array<double, 3> sums{};
    for (int x = 0; x < count; ++x)
        for (std::size_t c = 0; c < 3; ++c) sums[c] += static_cast<double>(*rgb++);
    return sums[0] + sums[1] + sums[2];
}

/// Mean of a level's stored values over texels and channels; 1 for a black level, whose errors are then
/// absolute.
double mean_of_level(const Product& product, int level) {
    const Level& own = product.images[0].levels[static_cast<std::size_t>(level)];
    pbr::CompensatedSum sum;
    for (int row = 0; row < 6 * own.height; ++row)
        sum += sum_of_row(product.images[0].texel(level, row / own.height, row % own.height, 0), own.width);
    const double mean = sum.value() / static_cast<double>(own.texels.size()) / product.scale;
    return mean > 0 ? mean : 1;
}

/// Radiance times solid angle over all texels and channels of level 0.
double energy_of_mirror(const Product& product) {
    const Image& image = product.images[0];
    const int n = image.levels[0].width;
    const std::vector<double> solid_angles = pbr::cubemap_solid_angles(n);
    pbr::CompensatedSum flux;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < n; ++y) {
            const float* texel = image.texel(0, face, y, 0);
            const double* solid_angle = &solid_angles[static_cast<std::size_t>(y) * n];
            double row = 0;
            for (int x = 0; x < n; ++x, texel += 3)
                row += solid_angle[x] * (static_cast<double>(texel[0]) + static_cast<double>(texel[1]) +
                                         static_cast<double>(texel[2]));
            flux += row;
        }
    return flux.value() / product.scale;
}

/// Root mean square over `values` numbers, over a mean, from a total of squares. The interval is widened by
/// `slack`.
Figure relative_rmse(const TotalEstimate& squared, double values, double mean, double slack, bool all,
                     std::string method, int level) {
    const auto root = [&](double total) { return std::sqrt(total / values) / mean; };
    Figure figure{"relative_rmse",
                  root(squared.value),
                  all ? Evidence::measured : Evidence::estimate,
                  std::move(method),
                  {},
                  level};
    if (!all)
        figure.interval = {std::max(0.0, root(squared.interval.first) - slack),
                           root(squared.interval.second) + slack};
    return figure;
}

/// Level 0 against the resampled source, on all texels, or on strips of rows, the brightest and some chosen
/// by hash: what storage changed.
Figure mirror_figure(const ProbeParams& params, const Environment& environment, const Product& product,
                     Context& context) {
    const int size = params.size;
    const Tiling strips(size, context.certify_fully() ? size : std::min(size, kStrip), 1);
    const TileSample sample =
        choose_tiles(strips.brightness(product.images[0], 0),
                     context.certify_fully() ? static_cast<int>(strips.count()) : kStrips, params.seed);
    std::vector<std::size_t> chosen = sample.certain;
    chosen.insert(chosen.end(), sample.drawn.begin(), sample.drawn.end());
    std::vector<double> squared(chosen.size());
    context.parallel_for(static_cast<std::int64_t>(chosen.size()), 1, [&](std::int64_t begin, std::int64_t) {
        const auto k = static_cast<std::size_t>(begin);
        const Tile strip = strips[chosen[k]];
        std::vector<float> truth(static_cast<std::size_t>(strip.width) * 3);
        environment.resample_strip(size, {strip.face, strip.left, strip.top}, truth);
        const float* stored = product.images[0].texel(0, strip.face, strip.top, strip.left);
        for (std::size_t i = 0; i < truth.size(); ++i) {
            const double difference = stored[i] / product.scale - static_cast<double>(truth[i]);
            squared[k] += difference * difference;
        }
    });
    const bool all = sample.drawn.empty();
    return relative_rmse(estimate_total(sample, std::span(squared).first(sample.certain.size()),
                                        std::span(squared).subspan(sample.certain.size())),
                         18.0 * size * size, mean_of_level(product, 0), 0, all,
                         all ? "all stored texels against the resampled source"
                             : "stored texels of " + std::to_string(chosen.size()) + " strips of " +
                                   std::to_string(std::min(size, kStrip)) +
                                   ", the brightest and others by hash, against the resampled source",
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

/// What a filtered level holds too much of the source's light, from its texels' errors. A sum over all stored
/// texels would tell more of how few of them there are: of a sun, 24 texels at alpha 1 sum to up to .09 more
/// or less, true as they may be.
Figure energy_figure(const TotalEstimate& surplus, double source_energy, double slack, bool all,
                     const std::string& method, int level) {
    const double scale = source_energy > 0 ? 1 / source_energy : 0;
    Figure figure{"energy_error",
                  surplus.value * scale,
                  all ? Evidence::measured : Evidence::estimate,
                  "solid-angle weighted, over the source's: " + method,
                  {},
                  level};
    if (!all)
        figure.interval = {surplus.interval.first * scale - slack, surplus.interval.second * scale + slack};
    return figure;
}

/// Tiles of a level that were measured.
struct Measured {
    TileSample sample;
    std::vector<TileError> errors;  ///< in its order
};

/// Measures a filtered level against the exact sum, on all texels or on `count` of them.
Measured measure(const LevelCheck& check, int count, const ProbeParams& params, Context& context) {
    const int size = size_of_level(params, check.level);
    const bool tiled = context.certify_fully() && size >= kSmallestTiled;
    const Tiling tiles(size, tiled ? kTile : 1, tiled ? kTile : 1);
    if (context.certify_fully()) count = static_cast<int>(tiles.count());
    const TileSample sample = choose_tiles(tiles.brightness(check.product.images[0], check.level), count,
                                           pbr::random_bits(params.seed, 0x6365u, check.level));
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
    return {sample, errors};
}

/// What measured tiles say of their level.
std::vector<Figure> level_figures(const LevelCheck& check, const Measured& measured) {
    const auto& [sample, errors] = measured;
    const int size = check.product.images[0].levels[static_cast<std::size_t>(check.level)].width;
    const double mean = mean_of_level(check.product, check.level);
    std::vector<double> squared, energy;
    pbr::LdTreeError of_truth{0, 0};
    for (const TileError& error : errors) {
        squared.push_back(error.squared);
        energy.push_back(error.energy);
        of_truth.deviation = std::max(of_truth.deviation, error.of_truth.deviation);
        of_truth.far_field = std::max(of_truth.far_field, error.of_truth.far_field);
    }
    const bool all = sample.drawn.empty();
    const std::string method =
        all ? "all stored texels against the exact sum"
            : "stored texels against the exact sum, the " + std::to_string(sample.certain.size()) +
                  " brightest of the level and " + std::to_string(sample.drawn.size()) + " chosen by hash";
    const std::size_t certain = sample.certain.size();
    const TotalEstimate total =
        estimate_total(sample, std::span(squared).first(certain), std::span(squared).subspan(certain));
    const TotalEstimate surplus =
        estimate_balance(sample, std::span(energy).first(certain), std::span(energy).subspan(certain));
    const double error_of_sums = std::max(of_truth.deviation, kErrorOfPoints);
    return {
        relative_rmse(total, 18.0 * size * size, mean, error_of_sums + check.slack, all, method, check.level),
        largest_error(errors, mean, all, method, check.level),
        energy_figure(surplus, check.source_energy, error_of_sums, all, method, check.level),
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

/// A check of all texels that needs no exact sum.
Figure low_band_figure(const Product& product, const pbr::SphereMoments& source, double mean, double alpha,
                       int level, Context& context) {
    return {"low_band_error",
            low_band_difference(product.images[0], level, product.scale, source, alpha, each_on(context, 0)) /
                (mean * std::sqrt(4 * std::numbers::pi)),
            Evidence::measured,
            "largest difference of LD_lm from k_l E_lm, l to 3, over the mean's own coefficient; sums over "
            "texels leave up to 1 / size^2 of what is in higher bands",
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
    const pbr::SphereMoments source_moments = pbr::sphere_moments(tree);
    const double source_energy = 4 * std::numbers::pi * (tree.mean().x + tree.mean().y + tree.mean().z);
    const double source_mean = source_energy > 0 ? source_energy / (12 * std::numbers::pi) : 1;
    const Method method = method_of(params, context.accuracy());
    Certificate certificate;
    for (int l = 0; l < level_count(params); ++l) {
        std::vector<Figure> figures;
        if (l == 0) {
            const double ratio = source_energy > 0 ? energy_of_mirror(product) / source_energy - 1 : 0;
            figures = {mirror_figure(params, environment, product, context),
                       {"energy_error",
                        ratio,
                        Evidence::measured,
                        "solid-angle weighted sum of all texels against the source's",
                        {},
                        l}};
        } else {
            const double alpha = alpha_of_level(params, l);
            const LevelCheck check{product,
                                   tree,
                                   l,
                                   alpha,
                                   std::min(1.0, kFarFieldShare * method.max_error),
                                   kSlack * method.max_error,
                                   source_energy};
            const int count = method.integrator == Integrator::harmonic ? kChecked : kCheckedOfSamples;
            figures = level_figures(check, measure(check, count, params, context));
            figures.push_back(low_band_figure(product, source_moments, source_mean, alpha, l, context));
        }

        if (!certificate.headline || figures[0].value > certificate.headline->value)
            certificate.headline = figures[0];
        certificate.figures.insert(certificate.figures.end(), figures.begin(), figures.end());
    }
    return certificate;
}

}  // namespace pbrbake::probe

// What is known of a probe's error: texels chosen by hash against the exact sum, a level at a time.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bakers/probe/chain.hpp"
#include "bakers/probe/environment.hpp"
#include "bakers/probe/probe.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"
#include "pbr/numerics/sequence.hpp"
#include "pbr/numerics/sum.hpp"

namespace pbrbake::probe {
namespace {

/// A tile of 4 x 4 texels is checked together, since the exact sum shares its work among neighbours.
constexpr int kTile = 4;

struct TileError {
    double squared = 0;  ///< mean over the tile of (stored - true)^2, all channels
    double mean = 0;     ///< mean of the truth
    double largest = 0;  ///< largest |stored - true|
};

/// Upper left texel of a tile.
struct Place {
    int face, left, top;
};

Place random_place(int size, std::uint64_t bits) {
    const auto places = static_cast<unsigned>(size - std::min(kTile, size) + 1);
    return {static_cast<int>(bits % 6), static_cast<int>((bits >> 8) % places), static_cast<int>((bits >> 32) % places)};
}

/// Places of tiles side by side that cover all faces; those of the last row and column may overlap their neighbours.
std::vector<Place> all_places(int size) {
    std::vector<Place> places;
    const int last = std::max(0, size - kTile);
    for (int face = 0; face < 6; ++face)
        for (int top = 0; top < size; top += kTile)
            for (int left = 0; left < size; left += kTile)
                places.push_back({face, std::min(left, last), std::min(top, last)});
    return places;
}

TileError tile_error(const pbr::PatchBlocks& blocks, double alpha, const Product& product, int level, int size,
                     const Place& place, Context& context) {
    const int side = std::min(kTile, size);
    const auto [face, left, top] = place;
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < side * side; ++i)
        directions.push_back(pbr::cubemap_texel_direction({face, left + i % side, top + i / side}, size));
    std::vector<double> truth(directions.size() * 3);
    std::uint64_t evaluations = 0;
    pbr::ld_exact(blocks, alpha, directions, truth, evaluations);
    context.count("certify.ld.kernel", evaluations);
    TileError error;
    for (int i = 0; i < side * side; ++i)
        for (int c = 0; c < 3; ++c) {
            const double stored = product.images[0].texel(level, face, top + i / side, left + i % side)[c] / product.scale;
            const double exact = truth[static_cast<std::size_t>(i * 3 + c)], difference = std::abs(stored - exact);
            error.squared += difference * difference;
            error.mean += exact;
            error.largest = std::max(error.largest, difference);
        }
    error.squared /= side * side * 3;
    error.mean /= side * side * 3;
    return error;
}

/// How many tiles a level can afford, so that checking costs no more than the bake: an exact texel costs about as many
/// kernel evaluations as the upper half of the source has texels, each about a fifth of a filtered sample.
int tiles_of_level(const ProbeParams& params, const Environment& environment, int level) {
    const double n = environment.equivalent_size(), size = size_of_level(params, level);
    const double exact_texel = 6 * n * n / 2 / 5;
    const double baked_level = 6 * size * size * samples_of_level(params, std::min(level, level_count(params) - 1));
    const double affordable = baked_level / (exact_texel * kTile * kTile);
    const double whole = std::max(1.0, 6 * size * size / (kTile * kTile));
    return static_cast<int>(std::min({std::clamp(affordable, 6.0, 64.0), whole}));
}

/// Mean radiance of a level, weighted by solid angle: its energy over 4 pi. Sum of channels.
double energy(const Image& image, int level) {
    const int n = image.levels[static_cast<std::size_t>(level)].width;
    pbr::CompensatedSum flux;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const double solid_angle = pbr::cubemap_texel_solid_angle(n, x, y);
            for (int face = 0; face < 6; ++face)
                for (int c = 0; c < 3; ++c)
                    flux += solid_angle * static_cast<double>(image.texel(level, face, y, x)[c]);
        }
    return flux.value();
}

Figure relative_rmse(const std::vector<TileError>& tiles, int level, bool all, double& largest) {
    double squared = 0, mean = 0;
    largest = 0;
    for (const TileError& tile : tiles) {
        squared += tile.squared;
        mean += tile.mean;
        largest = std::max(largest, tile.largest);
    }
    const double count = static_cast<double>(tiles.size());
    squared /= count;
    mean /= count;
    double variance = 0;
    for (const TileError& tile : tiles) variance += (tile.squared - squared) * (tile.squared - squared);
    const double half_width = tiles.size() > 1 ? 1.96 * std::sqrt(variance / (count * (count - 1))) : squared;
    const double safe_mean = mean > 0 ? mean : 1;
    largest /= safe_mean;
    if (all)
        return {"relative_rmse", std::sqrt(squared) / safe_mean, Evidence::measured,
                "all stored texels against the exact sum", {}, level};
    Figure figure{"relative_rmse", std::sqrt(squared) / safe_mean, Evidence::estimate,
                  "stored texels against the exact sum, " + std::to_string(tiles.size()) + " tiles of " +
                      std::to_string(kTile) + " x " + std::to_string(kTile) + " texels chosen by hash", {}, level};
    figure.interval = {std::sqrt(std::max(0.0, squared - half_width)) / safe_mean,
                       std::sqrt(squared + half_width) / safe_mean};
    return figure;
}

}  // namespace

Certificate certify(const ProbeParams& params, const Inputs& inputs, const Product& product, Context& context) {
    const Environment environment(params, inputs.at("source"));
    const pbr::PatchBlocks blocks = environment.blocks();
    const double source_energy = energy(product.images[0], 0);
    Certificate certificate;
    for (int l = 1; l < level_count(params); ++l) {
        const int size = size_of_level(params, l);
        const double alpha = pbr::alpha_from_perceptual_roughness(perceptual_roughness_of_level(params, l));
        std::vector<Place> places;
        if (context.certify_fully()) places = all_places(size);
        for (int i = 0; !context.certify_fully() && i < tiles_of_level(params, environment, l); ++i)
            places.push_back(random_place(size, pbr::random_bits(params.seed, 0x6365u, l, i)));
        std::vector<TileError> tiles(places.size());
        context.parallel_for(static_cast<std::int64_t>(tiles.size()), 1, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t i = begin; i < end; ++i)
                tiles[static_cast<std::size_t>(i)] = tile_error(blocks, alpha, product, l, size,
                                                                places[static_cast<std::size_t>(i)], context);
        });
        double largest = 0;
        Figure rmse = relative_rmse(tiles, l, context.certify_fully(), largest);
        if (!certificate.headline || rmse.value > certificate.headline->value) certificate.headline = rmse;
        certificate.figures.push_back(rmse);
        certificate.figures.push_back({"max_error_over_mean", largest, rmse.evidence, rmse.method, {}, l});
        const double ratio = source_energy > 0 ? energy(product.images[0], l) / source_energy - 1 : 0;
        certificate.figures.push_back({"energy_against_level_0", ratio, Evidence::measured,
                                       "solid-angle weighted sum of all texels, relative to level 0", {}, l});
    }
    return certificate;
}

}  // namespace pbrbake::probe

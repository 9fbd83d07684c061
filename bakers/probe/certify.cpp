// What is known of a probe's error: texels chosen by hash against the exact sum, a level at a time.

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <utility>
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
constexpr int kTilesACall = 8;

struct TileError {
    double squared = 0;  ///< mean over the tile of (stored - true)^2, all channels
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

/// Errors of some tiles of a level. One call of the exact sum serves them all: it decodes the source once.
void tile_errors(const pbr::PatchBlocks& blocks, double alpha, const Product& product, int level, int size,
                 std::span<const Place> places, std::span<TileError> errors, Context& context) {
    const int side = std::min(kTile, size), texels = side * side;
    std::vector<glm::dvec3> directions;
    for (const auto& [face, left, top] : places)
        for (int i = 0; i < texels; ++i)
            directions.push_back(pbr::cubemap_texel_direction({face, left + i % side, top + i / side}, size));
    std::vector<double> truth(directions.size() * 3);
    std::uint64_t evaluations = 0;
    pbr::ld_exact(blocks, alpha, directions, truth, evaluations);
    context.count("certify.ld", evaluations);
    const double* exact = truth.data();
    for (std::size_t tile = 0; tile < places.size(); ++tile) {
        const auto [face, left, top] = places[tile];
        TileError& error = errors[tile];
        for (int i = 0; i < texels; ++i)
            for (int c = 0; c < 3; ++c) {
                const double stored = product.images[0].texel(level, face, top + i / side, left + i % side)[c];
                const double difference = std::abs(stored / product.scale - *exact++);
                error.squared += difference * difference / (texels * 3);
                error.largest = std::max(error.largest, difference);
            }
    }
}

/// How many tiles a level can afford, so that checking costs no more than the bake: an exact texel costs as many kernel
/// evaluations as about half the source has texels, each a tenth of a filtered sample's time.
int tiles_of_level(const ProbeParams& params, const Environment& environment, int level) {
    constexpr double kFewest = 6, kMost = 64;
    const double n = environment.equivalent_size(), size = size_of_level(params, level);
    const double whole = std::max(1.0, 6 * size * size / (kTile * kTile));
    if (params.integrator == Integrator::reference) return static_cast<int>(std::min(kMost, whole));
    const double exact_texel = 6 * n * n / 2 / 10;
    const double affordable = 6 * size * size * samples_of_level(params, level) / (exact_texel * kTile * kTile);
    return static_cast<int>(std::min(std::clamp(affordable, kFewest, kMost), whole));
}

/// Mean of a level's stored values over texels and channels.
double mean_of_level(const Product& product, int level) {
    const std::vector<float>& texels = product.images[0].levels[static_cast<std::size_t>(level)].texels;
    pbr::CompensatedSum sum;
    for (const float value : texels) sum += static_cast<double>(value);
    return sum.value() / static_cast<double>(texels.size()) / product.scale;
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

Figure relative_rmse(const std::vector<TileError>& tiles, int level, double mean, bool all) {
    const double count = static_cast<double>(tiles.size()), safe_mean = mean > 0 ? mean : 1;
    double squared = 0, variance = 0;
    for (const TileError& tile : tiles) squared += tile.squared / count;
    for (const TileError& tile : tiles) variance += (tile.squared - squared) * (tile.squared - squared);
    const double value = std::sqrt(squared) / safe_mean;
    if (all) return {"relative_rmse", value, Evidence::measured, "all stored texels against the exact sum", {}, level};
    const double half_width = tiles.size() > 1 ? 1.96 * std::sqrt(variance / (count * (count - 1))) : squared;
    return {"relative_rmse", value, Evidence::estimate,
            "stored texels against the exact sum, " + std::to_string(tiles.size()) + " tiles of up to " +
                std::to_string(kTile) + " x " + std::to_string(kTile) + " texels chosen by hash",
            std::pair{std::sqrt(std::max(0.0, squared - half_width)) / safe_mean,
                      std::sqrt(squared + half_width) / safe_mean},
            level};
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
        context.parallel_for(static_cast<std::int64_t>(tiles.size()), kTilesACall, [&](std::int64_t begin, std::int64_t end) {
            const auto first = static_cast<std::size_t>(begin), count = static_cast<std::size_t>(end - begin);
            tile_errors(blocks, alpha, product, l, size, std::span(places).subspan(first, count),
                        std::span(tiles).subspan(first, count), context);
        });
        const double mean = mean_of_level(product, l);
        double largest = 0;
        for (const TileError& tile : tiles) largest = std::max(largest, tile.largest / (mean > 0 ? mean : 1));
        const Figure rmse = relative_rmse(tiles, l, mean, context.certify_fully());
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

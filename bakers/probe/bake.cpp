#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "bakers/probe/chain.hpp"
#include "bakers/probe/environment.hpp"
#include "bakers/probe/probe.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"

namespace pbrbake::probe {
namespace {

constexpr double kLargestPyramid = 1024;  // 134 MB of RGBA floats; far finer than any lobe that is sampled

/// Calls row(face, y, span of RGB) for every row of a level.
template <class Row>
void fill_level(Context& context, int size, Level& level, double work, const Row& row) {
    level = {size, size, std::vector<float>(static_cast<std::size_t>(size) * size * 18)};
    const std::size_t stride = static_cast<std::size_t>(size) * 3;
    context.parallel_for(6 * size, std::max(1, 64 / size), [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            const int face = static_cast<int>(i / size), y = static_cast<int>(i % size);
            row(face, y, std::span(&level.texels[static_cast<std::size_t>(i) * stride], stride));
            context.advance(work * size);
        }
    });
}

/// Exact levels, in tiles of 4 x 4 texels: the kernel's groups of directions then lie close together.
void exact_level(Context& context, const pbr::PatchBlocks& blocks, double alpha, int size, Level& level, double work) {
    level = {size, size, std::vector<float>(static_cast<std::size_t>(size) * size * 18)};
    const int side = std::min(size, 4), tiles = (size + side - 1) / side;
    std::atomic<std::uint64_t> evaluations{0};
    context.parallel_for(6 * tiles, 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            const int face = static_cast<int>(i / tiles), top = static_cast<int>(i % tiles) * side;
            std::vector<glm::dvec3> directions;
            std::vector<float*> texels;
            for (int left = 0; left < size; left += side)
                for (int y = top; y < std::min(top + side, size); ++y)
                    for (int x = left; x < std::min(left + side, size); ++x) {
                        directions.push_back(pbr::cubemap_texel_direction({face, x, y}, size));
                        texels.push_back(&level.texels[((static_cast<std::size_t>(face) * size + y) * size + x) * 3]);
                    }
            std::vector<double> rgb(directions.size() * 3);
            std::uint64_t used = 0;
            pbr::ld_exact(blocks, alpha, directions, rgb, used);
            evaluations += used;
            for (std::size_t k = 0; k < texels.size(); ++k)
                for (std::size_t c = 0; c < 3; ++c) texels[k][c] = static_cast<float>(rgb[k * 3 + c]);
            context.advance(work * static_cast<double>(directions.size()));
        }
    });
    context.count("ld.kernel", evaluations);
}

/// Work of a texel, in samples: for the progress bar.
double work_of_texel(const ProbeParams& params, int level, const Environment& environment) {
    if (level == 0) return 100;
    if (params.integrator != Integrator::reference) return samples_of_level(params, level);
    const double n = environment.equivalent_size();
    return 6 * n * n / 8;
}

/// Texels a side of the pyramid that samples read: about ten across the narrowest lobe (finer ones change no digit of the
/// result), but not below a quarter of the source's texels, whose edges it then shows exactly enough.
int pyramid_size(const ProbeParams& params, const Environment& environment) {
    const double alpha = pbr::alpha_from_perceptual_roughness(perceptual_roughness_of_level(params, 1));
    const double wanted = std::min({8 / alpha, 4.0 * environment.equivalent_size(), kLargestPyramid});
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(wanted))));
}

void sampled_levels(const ProbeParams& params, const Environment& environment, Context& context, Image& image) {
    const int base = pyramid_size(params, environment);
    Level resampled;
    const bool level_0_serves = base == params.size && base <= environment.equivalent_size();
    if (!level_0_serves)
        fill_level(context, base, resampled, 0, [&](int face, int y, std::span<float> rgb) {
            environment.resample_area_row(base, face, y, rgb);
        });
    const pbr::CubePyramid pyramid(level_0_serves ? image.levels[0].texels : resampled.texels, base);
    const auto estimator = params.integrator == Integrator::is ? pbr::LdEstimator::importance_sampling
                                                               : pbr::LdEstimator::filtered_importance_sampling;
    for (int l = 1; l < level_count(params); ++l) {
        const int size = size_of_level(params, l), samples = samples_of_level(params, l);
        const double alpha = pbr::alpha_from_perceptual_roughness(perceptual_roughness_of_level(params, l));
        const pbr::LdSamples set = pbr::make_ld_samples(estimator, alpha, samples, base, params.level_bias);
        fill_level(context, size, image.levels[static_cast<std::size_t>(l)], work_of_texel(params, l, environment),
                   [&](int face, int y, std::span<float> rgb) {
                       pbr::ld_sampled_row(pyramid, set, params.seed, size, face, y, rgb);
                   });
        context.count("ld.samples", std::uint64_t{6} * size * size * static_cast<std::uint64_t>(samples));
    }
}

Json level_properties(const ProbeParams& params) {
    Json levels = Json::array();
    for (int l = 0; l < level_count(params); ++l) {
        const double perceptual_roughness = perceptual_roughness_of_level(params, l);
        Json level = {{"size", size_of_level(params, l)},
                      {"perceptual_roughness", perceptual_roughness},
                      {"alpha", pbr::alpha_from_perceptual_roughness(perceptual_roughness)}};
        if (l > 0 && params.integrator != Integrator::reference) level["samples"] = samples_of_level(params, l);
        levels.push_back(std::move(level));
    }
    return levels;
}

}  // namespace

std::vector<Mistake> check(const ProbeParams& params) {
    std::vector<Mistake> mistakes;
    const int full = full_chain(params.size);
    if (params.levels > full)
        mistakes.push_back({"/levels", "found " + std::to_string(params.levels) + "; allowed: at most " +
                                           std::to_string(full) + " for size " + std::to_string(params.size)});
    const int levels = std::min(level_count(params), full);
    if (params.samples.size() > 1 && params.samples.size() != static_cast<std::size_t>(levels))
        mistakes.push_back({"/samples", "found " + std::to_string(params.samples.size()) +
                                            " counts; allowed: one for all levels, or one a level (" +
                                            std::to_string(levels) + ")"});
    return mistakes;
}

std::vector<Read> reads(const ProbeParams& params) { return {{"source", params.source, params.colour_space}}; }

Product bake(const ProbeParams& params, const Inputs& inputs, Context& context) {
    const SourceImage& source = inputs.at("source");
    if (source.image.faces == 6 && !permutes_cube(params.rotate_deg))
        throw Error(ExitCode::invalid_job, params.source,
                    "is a cube map, which turns only by multiples of 90 degrees; found rotate_deg " +
                        std::to_string(params.rotate_deg));
    const Environment environment(params, source);
    Image image;
    image.channels = {"R", "G", "B"};
    image.faces = 6;
    image.levels.resize(static_cast<std::size_t>(level_count(params)));
    for (int l = 0; l < level_count(params); ++l) {
        const int size = size_of_level(params, l);
        context.expect(6.0 * size * size * work_of_texel(params, l, environment));
    }
    fill_level(context, params.size, image.levels[0], work_of_texel(params, 0, environment),
               [&](int face, int y, std::span<float> rgb) { environment.resample_row(params.size, face, y, rgb); });
    if (level_count(params) > 1 && params.integrator != Integrator::reference)
        sampled_levels(params, environment, context, image);
    if (level_count(params) > 1 && params.integrator == Integrator::reference) {
        const pbr::PatchBlocks blocks = environment.blocks();
        for (int l = 1; l < level_count(params); ++l)
            exact_level(context, blocks, pbr::alpha_from_perceptual_roughness(perceptual_roughness_of_level(params, l)),
                        size_of_level(params, l), image.levels[static_cast<std::size_t>(l)],
                        work_of_texel(params, l, environment));
    }

    Product product;
    product.images.push_back(std::move(image));
    product.units = params.units == Units::automatic ? source.units : std::string(enum_name(params.units));
    product.properties["level_mapping"] = "level = (levels - 1) * perceptual_roughness";
    product.properties["levels"] = level_properties(params);
    return product;
}

}  // namespace pbrbake::probe

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bakers/formats.hpp"
#include "bakers/probe/chain.hpp"
#include "bakers/probe/environment.hpp"
#include "bakers/probe/probe.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"

namespace pbrbake::probe {
namespace {

constexpr double kLargestPyramid = 1024;  // 134 MB of RGBA floats; far finer than any lobe that is sampled

Level empty_level(int size) {
    return {size, size, std::vector<float>(static_cast<std::size_t>(size) * size * 18)};
}

float* texel_of(Level& level, const pbr::CubeTexel& texel) {
    return &level.texels[((static_cast<std::size_t>(texel.face) * level.height + texel.y) * level.width +
                          texel.x) *
                         3];
}

/// Fills a level by row(face, y, RGB of the row).
template <class Row>
void fill_rows(Context& context, int size, Level& level, const Row& row) {
    level = empty_level(size);
    const std::size_t stride = static_cast<std::size_t>(size) * 3;
    context.parallel_for(6 * size, std::max(1, 64 / size), [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            row(static_cast<int>(i / size), static_cast<int>(i % size),
                std::span(&level.texels[static_cast<std::size_t>(i) * stride], stride));
            context.advance(size);
        }
    });
}

/// Fills a level by integration, in strips of 4 x 4 tiles: the exact estimator likes texels that lie
/// together.
void fill_strips(Context& context, const pbr::LdIntegrator& integrator, int size, double work_of_texel,
                 Level& level) {
    level = empty_level(size);
    const int side = std::min(size, 4), strips = (size + side - 1) / side;
    std::atomic<std::uint64_t> evaluations{0};
    context.parallel_for(6 * strips, 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            const int face = static_cast<int>(i / strips), top = static_cast<int>(i % strips) * side;
            std::vector<pbr::CubeTexel> texels;
            for (int left = 0; left < size; left += side)
                for (int y = top; y < std::min(top + side, size); ++y)
                    for (int x = left; x < std::min(left + side, size); ++x) texels.push_back({face, x, y});
            std::vector<float> rgb(texels.size() * 3);
            evaluations += integrator.integrate(size, texels, rgb);
            for (std::size_t k = 0; k < texels.size(); ++k)
                std::copy_n(&rgb[k * 3], 3, texel_of(level, texels[k]));
            context.advance(work_of_texel * static_cast<double>(texels.size()));
        }
    });
    context.count("ld", evaluations);
}

/// Texels a side of the pyramid that samples read: about ten across the narrowest lobe (finer ones change no
/// digit of the result), but no texel below a quarter of the source's, whose edges it then shows exactly
/// enough.
int pyramid_size(const ProbeParams& params, const Environment& environment) {
    const double alpha = pbr::alpha_from_perceptual_roughness(perceptual_roughness_of_level(params, 1));
    const double wanted = std::min({8 / alpha, 4.0 * environment.equivalent_size(), kLargestPyramid});
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(wanted))));
}

pbr::CubePyramid make_pyramid(const ProbeParams& params, const Environment& environment, const Level& level_0,
                              Context& context) {
    const int base = pyramid_size(params, environment);
    if (base == params.size && base <= environment.equivalent_size()) return {level_0.texels, base};
    Level resampled;
    context.expect(6.0 * base * base);
    fill_rows(context, base, resampled, [&](int face, int y, std::span<float> rgb) {
        environment.resample_area_row(base, face, y, rgb);
    });
    return {resampled.texels, base};
}

pbr::LdMethod method_of_level(const ProbeParams& params, int level) {
    if (params.integrator == Integrator::reference) return {};
    return {params.integrator == Integrator::is ? pbr::LdEstimator::importance_sampling
                                                : pbr::LdEstimator::filtered_importance_sampling,
            samples_of_level(params, level), params.level_bias, params.seed};
}

/// Work of a texel for the progress bar, a resampled texel being 1.
double work_of_texel(const ProbeParams& params, int level, const Environment& environment) {
    if (params.integrator != Integrator::reference) return samples_of_level(params, level) * 0.01;
    const double n = environment.equivalent_size();
    return 6 * n * n * 1e-3;
}

/// Levels from 1 on.
void filtered_levels(const ProbeParams& params, const Environment& environment, Context& context,
                     Image& image) {
    std::optional<pbr::PatchBlocks> source;
    std::optional<pbr::CubePyramid> pyramid;
    if (params.integrator == Integrator::reference) {
        source.emplace(environment.blocks());
    } else {
        pyramid.emplace(make_pyramid(params, environment, image.levels[0], context));
    }
    for (int l = 1; l < level_count(params); ++l) {
        const double alpha = pbr::alpha_from_perceptual_roughness(perceptual_roughness_of_level(params, l));
        const pbr::LdIntegrator integrator(method_of_level(params, l), alpha, source ? &*source : nullptr,
                                           pyramid ? &*pyramid : nullptr);
        fill_strips(context, integrator, size_of_level(params, l), work_of_texel(params, l, environment),
                    image.levels[static_cast<std::size_t>(l)]);
    }
}

Json level_properties(const ProbeParams& params) {
    Json levels = Json::array();
    for (int l = 0; l < level_count(params); ++l) {
        const double perceptual_roughness = perceptual_roughness_of_level(params, l);
        Json level = {{"size", size_of_level(params, l)},
                      {"perceptual_roughness", perceptual_roughness},
                      {"alpha", pbr::alpha_from_perceptual_roughness(perceptual_roughness)}};
        if (l > 0 && params.integrator != Integrator::reference)
            level["samples"] = samples_of_level(params, l);
        levels.push_back(std::move(level));
    }
    return levels;
}

}  // namespace

std::vector<Mistake> check(const ProbeParams& params, const std::string& format) {
    std::vector<Mistake> mistakes;
    if (const Format* container = find_format(format); container && !container->is_chain)
        mistakes.push_back(
            {"/format", "found \"" + format + "\", which holds no cube map; allowed: exr, ktx2, dds"});
    const int full = full_chain(params.size);
    if (params.levels > full)
        mistakes.push_back({"/levels", "found " + std::to_string(params.levels) + "; allowed: at most " +
                                           std::to_string(full) + " for size " +
                                           std::to_string(params.size)});
    const int levels = std::min(level_count(params), full);
    if (format == "exr" &&
        params.size % (1 << (levels - 1)) != 0)  // OpenEXR halves the six faces as one picture
        mistakes.push_back({"/size", "found " + std::to_string(params.size) + "; allowed: multiples of " +
                                         std::to_string(1 << (levels - 1)) + " for an EXR cube map of " +
                                         std::to_string(levels) + " levels; or take fewer levels, or ktx2"});
    if (params.samples.size() > 1 && params.samples.size() != static_cast<std::size_t>(levels))
        mistakes.push_back({"/samples", "found " + std::to_string(params.samples.size()) +
                                            " counts; allowed: one for all levels, or one a level (" +
                                            std::to_string(levels) + ")"});
    return mistakes;
}

std::vector<Read> reads(const ProbeParams& params) {
    return {{"source", params.source, params.colour_space}};
}

Product bake(const ProbeParams& params, const Inputs& inputs, Context& context) {
    const SourceImage& source = inputs.at("source");
    if (source.image.faces == 6 && !permutes_cube(params.rotate_deg))
        throw Error(ExitCode::invalid_job, params.source,
                    "is a cube map, and rotate_deg is " + std::to_string(params.rotate_deg) +
                        "; allowed for cube maps: multiples of 90, or give the environment as an equirect");
    const Environment environment(params, source);
    Image image;
    image.channels = {"R", "G", "B"};
    image.faces = 6;
    image.levels.resize(static_cast<std::size_t>(level_count(params)));
    context.expect(6.0 * params.size * params.size);
    for (int l = 1; l < level_count(params); ++l) {
        const double size = size_of_level(params, l);
        context.expect(6 * size * size * work_of_texel(params, l, environment));
    }
    fill_rows(context, params.size, image.levels[0], [&](int face, int y, std::span<float> rgb) {
        environment.resample_row(params.size, face, y, rgb);
    });
    if (level_count(params) > 1) filtered_levels(params, environment, context, image);

    Product product;
    product.images.push_back(std::move(image));
    product.units = params.units == Units::automatic ? source.units : std::string(enum_name(params.units));
    product.properties["level_mapping"] = "level = (levels - 1) * perceptual_roughness";
    product.properties["levels"] = level_properties(params);
    return product;
}

}  // namespace pbrbake::probe

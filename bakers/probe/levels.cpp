#include "bakers/probe/levels.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include "bakers/probe/chain.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/ld.hpp"
#include "pbr/ibl/ld_harmonic.hpp"
#include "pbr/ibl/ld_mis.hpp"

namespace pbrbake::probe {
namespace {

constexpr double kLargestPyramid = 1024;  // 134 MB of RGBA floats; far finer than any lobe that is sampled

/// What fills texels of a level of `size` with RGB, and returns its evaluations.
using Filter =
    std::function<std::uint64_t(int size, std::span<const pbr::CubeTexel> texels, std::span<float> rgb)>;

/// A level in runs of 4 x 4 tiles, for exact sums like texels that lie together. A run is a strip of a face,
/// or so much of it as keeps an interrupt waiting for some 1e-2 s.
Level filled_by_tiles(Context& context, int size, double work_of_texel, const Filter& filter) {
    constexpr double kMostWork = 3e4;
    Level level = empty_level(size);
    const int side = std::min(size, 4), strips = (size + side - 1) / side;
    const double most = std::clamp(kMostWork / (work_of_texel * side * side), 1.0, 1.0 * strips);
    const int width = static_cast<int>(most) * side, runs = (size + width - 1) / width;
    std::atomic<std::uint64_t> evaluations{0};
    context.parallel_for(6 * strips * runs, 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            const int strip = static_cast<int>(i / runs), first = static_cast<int>(i % runs) * width;
            const int face = strip / strips, top = strip % strips * side;
            std::vector<pbr::CubeTexel> texels;
            for (int left = first; left < std::min(first + width, size); left += side)
                for (int y = top; y < std::min(top + side, size); ++y)
                    for (int x = left; x < std::min(left + side, size); ++x) texels.push_back({face, x, y});
            std::vector<float> rgb(texels.size() * 3);
            evaluations += filter(size, texels, rgb);
            for (std::size_t k = 0; k < texels.size(); ++k) {
                const std::size_t row = static_cast<std::size_t>(face) * size + texels[k].y;
                std::copy_n(&rgb[k * 3], 3, &level.texels[(row * size + texels[k].x) * 3]);
            }
            context.advance(work_of_texel * static_cast<double>(texels.size()));
        }
    });
    context.count("ld", evaluations);
    return level;
}

/// Level 0: the environment itself, resampled.
void fill_mirror(const ProbeParams& params, const Environment& environment, Context& context, Image& image) {
    image.levels[0] = empty_level(params.size);
    environment.resample(params.size, each_on(context, params.size), image.levels[0].texels);
}

/// Fills levels from 1 on by tiles, and side by side; `filter_of(level, alpha, note)` makes each level's
/// filter and says what there is to say of it.
template <class FilterOf>
Json filter_levels(const ProbeParams& params, double work_of_texel, Context& context, Image& image,
                   const FilterOf& filter_of) {
    const int levels = level_count(params);
    for (int l = 1; l < levels; ++l)
        context.expect(6 * work_of_texel * size_of_level(params, l) * size_of_level(params, l));
    Json notes(static_cast<std::size_t>(levels - 1), Json::object());
    each_on(context, 0)(levels - 1, [&](int i) {
        const int l = i + 1, size = size_of_level(params, l);
        image.levels[static_cast<std::size_t>(l)] =
            filled_by_tiles(context, size, work_of_texel,
                            filter_of(l, alpha_of_level(params, l), notes[static_cast<std::size_t>(i)]));
    });
    return notes;
}

/// Texels a side of the pyramid that samples read: about ten across the narrowest lobe (finer ones change no
/// digit of the result), but no texel below a quarter of the source's, whose edges it then shows exactly
/// enough.
int pyramid_size(const ProbeParams& params, const Environment& environment) {
    const double wanted =
        std::min({8 / alpha_of_level(params, 1), 4.0 * environment.equivalent_size(), kLargestPyramid});
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(wanted))));
}

pbr::CubePyramid make_pyramid(const ProbeParams& params, const Environment& environment, const Level& level_0,
                              Context& context) {
    const int base = pyramid_size(params, environment);
    if (base == params.size && base <= environment.equivalent_size()) return {level_0.texels, base};
    context.expect(6.0 * base * base);
    Level resampled = empty_level(base);
    environment.resample_area(base, each_on(context, base), resampled.texels);
    return {resampled.texels, base};
}

/// Work of a sample, in texels copied.
constexpr double kWorkOfSample = 0.01;

/// Fills levels by sampling; `filter_of(samples, alpha)` makes each level's filter.
template <class FilterOf>
Json sampled_levels(const ProbeParams& params, Context& context, Image& image, const FilterOf& filter_of) {
    return filter_levels(params, samples_of_level(params, context.accuracy(), 1) * kWorkOfSample, context,
                         image, [&](int l, double alpha, Json& note) {
                             const int samples = samples_of_level(params, context.accuracy(), l);
                             note["samples"] = samples;
                             return
                                 [integrator = filter_of(samples, alpha)](
                                     int size, std::span<const pbr::CubeTexel> texels, std::span<float> rgb) {
                                     return integrator.integrate(size, texels, rgb);
                                 };
                         });
}

/// Plain or filtered samples of a pyramid.
Json sample_levels(const ProbeParams& params, const Method& method, const Environment& environment,
                   Context& context, Image& image) {
    const pbr::CubePyramid pyramid = make_pyramid(params, environment, image.levels[0], context);
    const auto estimator = method.integrator == Integrator::is
                               ? pbr::LdEstimator::importance_sampling
                               : pbr::LdEstimator::filtered_importance_sampling;
    return sampled_levels(params, context, image, [&](int samples, double alpha) {
        return pbr::LdIntegrator({estimator, samples, params.level_bias, params.seed}, alpha, nullptr,
                                 &pyramid);
    });
}

/// Samples of lobe and light together.
Json mis_levels(const ProbeParams& params, const Environment& environment, Context& context, Image& image) {
    const pbr::EnvironmentSampler sampler = environment.sampler();
    return sampled_levels(params, context, image, [&](int samples, double alpha) {
        return pbr::LdMis(sampler, alpha, samples, params.seed);
    });
}

Json sum_levels(const ProbeParams& params, const Environment& environment, Context& context, Image& image) {
    const pbr::PatchBlocks blocks = environment.blocks();
    const double n = environment.equivalent_size();
    return filter_levels(params, 6 * n * n * 1e-3, context, image, [&](int, double alpha, Json&) {
        return [integrator = pbr::LdIntegrator({}, alpha, &blocks, nullptr)](
                   int size, std::span<const pbr::CubeTexel> texels, std::span<float> rgb) {
            return integrator.integrate(size, texels, rgb);
        };
    });
}

/// Level 0 while the picture is transformed, which leaves a second thread little to do.
Json solve_levels(const ProbeParams& params, const Method& method, const Environment& environment,
                  Context& context, Image& image) {
    const pbr::ForEach each = each_on(context, 0);
    std::optional<pbr::LdHarmonic> harmonic;
    each(2, [&](int task) {
        if (task == 0)
            fill_mirror(params, environment, context, image);
        else
            harmonic.emplace(environment.harmonic(alpha_of_level(params, 1), method.max_error, each));
    });
    return filter_levels(params, 0.1, context, image, [&](int, double alpha, Json& note) {
        const auto level = std::make_shared<pbr::LdHarmonic::Level>(harmonic->level(alpha, each));
        note = {{"bands", level->bands()},
                {"truncation_error", level->truncation_error()},
                {"bright_texels_apart", harmonic->bright_texels()}};
        if (level->near_radius() > 0) note["near_radius_rad"] = level->near_radius();
        return [level](int size, std::span<const pbr::CubeTexel> texels, std::span<float> rgb) {
            std::vector<glm::dvec3> directions;
            for (const pbr::CubeTexel& texel : texels)
                directions.push_back(pbr::cubemap_texel_direction(texel, size));
            return texels.size() + level->integrate(directions, rgb);
        };
    });
}

}  // namespace

Level empty_level(int size) {
    return {size, size, std::vector<float>(static_cast<std::size_t>(size) * size * 18)};
}

pbr::ForEach each_on(Context& context, double work) {
    return [&context, work](int count, const std::function<void(int)>& body) {
        const std::int64_t grain =
            std::max(1, count / 512);  // few enough tasks to cost nothing, enough to share
        context.parallel_for(count, grain, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t i = begin; i < end; ++i) body(static_cast<int>(i));
            context.advance(work * static_cast<double>(end - begin));
        });
    };
}

Json fill_levels(const ProbeParams& params, const Method& method, const Environment& environment,
                 Context& context, Image& image) {
    context.expect(6.0 * params.size * params.size);
    if (level_count(params) > 1 && method.integrator == Integrator::harmonic)
        return solve_levels(params, method, environment, context, image);
    fill_mirror(params, environment, context, image);
    if (level_count(params) < 2) return Json::array();
    switch (method.integrator) {
        case Integrator::reference:
            return sum_levels(params, environment, context, image);
        case Integrator::mis:
            return mis_levels(params, environment, context, image);
        default:
            return sample_levels(params, method, environment, context, image);
    }
}

}  // namespace pbrbake::probe

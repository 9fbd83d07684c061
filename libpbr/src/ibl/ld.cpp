#include "pbr/ibl/ld.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <numbers>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbr {

void LdSamples::add(const glm::dvec3& direction, double lod, int levels, double weight) {
    assert(levels >= 2);
    const double level = std::clamp(lod, 0.0, levels - 1.0);
    const int first = std::min(static_cast<int>(level), levels - 2);
    const double of_coarser = (level - first) * weight;
    ++count;
    x.push_back(static_cast<float>(direction.x));
    y.push_back(static_cast<float>(direction.y));
    z.push_back(static_cast<float>(direction.z));
    half_size.push_back(static_cast<float>(1 << (levels - 2 - first)));
    finer.push_back(static_cast<float>(weight - of_coarser));
    coarser.push_back(static_cast<float>(of_coarser));
}

void LdSamples::pad() {
    const std::size_t padded = (static_cast<std::size_t>(count) + 15) / 16 * 16;
    for (std::vector<float>* array : {&x, &y, &z, &half_size, &finer, &coarser})
        array->resize(padded, array->back());
}

LdSamples make_ld_samples(LdEstimator estimator, double alpha, int count, int base_size, double level_bias) {
    const GgxZonalKernel kernel(alpha);
    const double texel_angle = 4 * std::numbers::pi / (6.0 * base_size * base_size);
    const int levels = std::bit_width(static_cast<unsigned>(base_size));
    LdSamples samples;
    for (int i = 0; i < count; ++i) {
        const Sample2 u = hammersley(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(count));
        const double one_minus_mu = kernel.sample(u.u1);
        const double sine = std::sqrt(one_minus_mu * (2 - one_minus_mu));
        const SinCos azimuth = sin_cos_pi(2 * u.u2);
        const double sample_angle = 1 / (count * std::max(kernel.value(one_minus_mu), 1e-30));
        const double lod = estimator == LdEstimator::filtered_importance_sampling
                               ? log2_exact(level_bias * sample_angle / texel_angle) / 2
                               : 0;
        samples.add({sine * azimuth.cos, sine * azimuth.sin, 1 - one_minus_mu}, lod, levels, 1.0 / count);
    }
    samples.pad();
    return samples;
}

LdIntegrator::LdIntegrator(const LdMethod& method, double alpha, const PatchBlocks* source,
                           const CubePyramid* pyramid)
    : method_(method), alpha_(alpha), source_(source), pyramid_(pyramid) {
    const bool exact = method.estimator == LdEstimator::exact;
    assert(exact ? source != nullptr : pyramid != nullptr && method.samples > 0);
    if (!exact)
        samples_ =
            make_ld_samples(method.estimator, alpha, method.samples, pyramid->size(), method.level_bias);
}

std::uint64_t LdIntegrator::integrate(int size, std::span<const CubeTexel> texels,
                                      std::span<float> rgb_out) const {
    if (method_.estimator != LdEstimator::exact) {
        ld_sampled(*pyramid_, samples_, method_.seed, size, texels, rgb_out);
        return texels.size() * static_cast<std::uint64_t>(samples_.count);
    }
    std::vector<glm::dvec3> directions;
    for (const CubeTexel& texel : texels) directions.push_back(cubemap_texel_direction(texel, size));
    std::vector<double> rgb(texels.size() * 3);
    std::uint64_t evaluations = 0;
    ld_exact(*source_, alpha_, directions, rgb, evaluations);
    std::transform(rgb.begin(), rgb.end(), rgb_out.begin(),
                   [](double value) { return static_cast<float>(value); });
    return evaluations;
}

}  // namespace pbr

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

CubePyramid::CubePyramid(std::span<const float> rgb, int size)
    : size_(size), levels_(std::bit_width(static_cast<unsigned>(size))) {
    assert(size > 0 && size <= 4096 && (size & (size - 1)) == 0 &&
           rgb.size() == static_cast<std::size_t>(size) * size * 18);
    texels_.resize(static_cast<std::size_t>(offset(-1)));  // where a finer level would begin
    const auto at = [&](int level, int f, int x, int y) {
        return const_cast<float*>(face(level, f)) +
               ((static_cast<std::size_t>(y) + 1) * (size_of(level) + 2) + x + 1) * 4;
    };
    for (int f = 0; f < 6; ++f)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                std::copy_n(&rgb[((static_cast<std::size_t>(f) * size + y) * size + x) * 3], 3,
                            at(0, f, x, y));
    for (int level = 1; level < levels(); ++level) {
        const int n = size_of(level);
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                double weights[4], total_weight = 0;
                for (int k = 0; k < 4; ++k)
                    total_weight += weights[k] =
                        cubemap_texel_solid_angle(2 * n, 2 * x + (k & 1), 2 * y + (k >> 1));
                for (int f = 0; f < 6; ++f)
                    for (int c = 0; c < 3; ++c) {
                        double sum = 0;
                        for (int k = 0; k < 4; ++k)
                            sum += weights[k] * static_cast<double>(
                                                    at(level - 1, f, 2 * x + (k & 1), 2 * y + (k >> 1))[c]);
                        at(level, f, x, y)[c] = static_cast<float>(sum / total_weight);
                    }
            }
    }
    for (int level = 0; level < levels(); ++level) fill_border(level);
}

const float* CubePyramid::face(int level, int face) const {
    const std::size_t side = static_cast<std::size_t>(size_of(level)) + 2;
    return texels_.data() + static_cast<std::size_t>(offset(level)) + face * side * side * 4;
}

void CubePyramid::fill_border(int level) {
    const int n = size_of(level);
    const auto at = [&](int f, int x, int y) {
        return const_cast<float*>(face(level, f)) + ((static_cast<std::size_t>(y) + 1) * (n + 2) + x + 1) * 4;
    };
    for (int f = 0; f < 6; ++f) {
        for (int i = 0; i < n; ++i)
            for (const auto& [x, y] : {std::pair{i, -1}, {i, n}, {-1, i}, {n, i}}) {
                const CubeTexel from = cubemap_neighbour(f, x, y, n);
                std::copy_n(at(from.face, from.x, from.y), 3, at(f, x, y));
            }
        for (const int y : {-1, n})
            for (const int x : {-1, n}) {  // the three texels that meet at this corner of the cube
                const int ix = std::clamp(x, 0, n - 1), iy = std::clamp(y, 0, n - 1);
                for (int c = 0; c < 3; ++c)
                    at(f, x, y)[c] = static_cast<float>(
                        (static_cast<double>(at(f, ix, iy)[c]) + at(f, x, iy)[c] + at(f, ix, y)[c]) / 3);
            }
    }
}

glm::vec3 CubePyramid::sample(const glm::vec3& direction, float lod) const {
    const CubePoint point = cube_point(glm::dvec3(direction));
    const double clamped = std::clamp(static_cast<double>(lod), 0.0, levels() - 1.0);
    const int first = static_cast<int>(clamped);
    glm::dvec3 result(0);
    for (const int level : {first, std::min(first + 1, levels() - 1)}) {
        const int n = size_of(level);
        const double px = (point.s + 1) / 2 * n + 0.5, py = (point.t + 1) / 2 * n + 0.5;
        const int ix = std::clamp(static_cast<int>(px), 0, n), iy = std::clamp(static_cast<int>(py), 0, n);
        const double fx = px - ix, fy = py - iy;
        const float* p = face(level, point.face) + (static_cast<std::size_t>(iy) * (n + 2) + ix) * 4;
        const float* q = p + (n + 2) * 4;
        const double weight = level == first && first + 1 < levels() ? 1 - (clamped - first)
                              : level == first                       ? 1
                                                                     : clamped - first;
        for (int c = 0; c < 3; ++c) {
            const double top = p[c] + fx * (static_cast<double>(p[c + 4]) - p[c]);
            const double bottom = q[c] + fx * (static_cast<double>(q[c + 4]) - q[c]);
            result[c] += weight * (top + fy * (bottom - top));
        }
        if (first + 1 >= levels()) break;
    }
    return glm::vec3(result);
}

LdSamples make_ld_samples(LdEstimator estimator, double alpha, int count, int base_size, double level_bias) {
    const GgxZonalKernel kernel(alpha);
    LdSamples samples;
    samples.count = count;
    for (int i = 0; i < count; ++i) {
        const Sample2 u = hammersley(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(count));
        const double one_minus_mu = kernel.sample(u.u1);
        const double sine = std::sqrt(one_minus_mu * (2 - one_minus_mu));
        const SinCos azimuth = sin_cos_pi(2 * u.u2);
        samples.x.push_back(static_cast<float>(sine * azimuth.cos));
        samples.y.push_back(static_cast<float>(sine * azimuth.sin));
        samples.z.push_back(static_cast<float>(1 - one_minus_mu));
        double lod = -2;  // plain sampling: below 0 even with the kernel's correction of at most 3/4 log2(3)
        if (estimator == LdEstimator::filtered_importance_sampling) {
            const double sample_angle = 1 / (count * std::max(kernel.value(one_minus_mu), 1e-30));
            const double texel_angle = 4.0 / (static_cast<double>(base_size) * base_size);
            lod = log2_exact(level_bias * sample_angle / texel_angle) / 2;
        }
        samples.lod.push_back(static_cast<float>(lod));
    }
    const std::size_t padded = (static_cast<std::size_t>(count) + 15) / 16 * 16;
    for (std::vector<float>* array : {&samples.x, &samples.y, &samples.z, &samples.lod})
        array->resize(padded, array->back());
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

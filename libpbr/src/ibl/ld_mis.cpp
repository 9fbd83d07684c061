#include "pbr/ibl/ld_mis.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"
#include "src/simd/ld_kernels.hpp"

namespace pbr {
namespace {

/// Sets enough that neighbours seldom share one, few enough to stay in the second cache.
constexpr int kMostSets = 64, kSamplesOfAllSets = 1 << 14;

// What the hashes of a set are for.
enum Purpose : std::uint64_t { kLobeRing, kLobeTurn, kPictureRow, kPictureColumn, kSetOfTexel, kTurnOfTexel };

double shifted(double u, double shift) { return u + shift < 1 ? u + shift : u + shift - 1; }

void pad(std::vector<float>& array, float value) {
    array.resize((array.size() + kMisPadding - 1) / kMisPadding * kMisPadding, value);
}

void add_lobe_set(const GgxZonalKernel& kernel, std::uint64_t seed, int set, MisSamples& samples) {
    const double ring = random_unit(seed, kLobeRing, set), turn = random_unit(seed, kLobeTurn, set);
    for (int i = 0; i < samples.lobe_count; ++i) {
        const Sample2 u =
            hammersley(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(samples.lobe_count), turn);
        const double one_minus_mu = kernel.sample((i + ring) / samples.lobe_count);
        const double sine = std::sqrt(one_minus_mu * (2 - one_minus_mu));
        const SinCos azimuth = sin_cos_pi(2 * u.u2);
        samples.x.push_back(static_cast<float>(sine * azimuth.cos));
        samples.y.push_back(static_cast<float>(sine * azimuth.sin));
        samples.z.push_back(static_cast<float>(1 - one_minus_mu));
        samples.picture_over_lobe.push_back(
            static_cast<float>(samples.picture_count / std::max(kernel.value(one_minus_mu), 1e-30)));
    }
    for (std::vector<float>* array : {&samples.x, &samples.y, &samples.z, &samples.picture_over_lobe})
        pad(*array, array->back());
}

void add_picture_set(const EnvironmentSampler& environment, std::uint64_t seed, int set,
                     MisSamples& samples) {
    const double row = random_unit(seed, kPictureRow, set), column = random_unit(seed, kPictureColumn, set);
    for (int i = 0; i < samples.picture_count; ++i) {
        const Sample2 u =
            hammersley(static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(samples.picture_count));
        const EnvironmentSampler::Draw draw =
            environment.sample((i + row) / samples.picture_count, shifted(u.u2, column));
        const float* texel = &environment.texels()[static_cast<std::size_t>(draw.texel) * 4];
        samples.px.push_back(static_cast<float>(draw.direction.x));
        samples.py.push_back(static_cast<float>(draw.direction.y));
        samples.pz.push_back(static_cast<float>(draw.direction.z));
        samples.r.push_back(texel[0]);
        samples.g.push_back(texel[1]);
        samples.b.push_back(texel[2]);
        samples.density.push_back(static_cast<float>(samples.picture_count * draw.pdf));
    }
    for (std::vector<float>* array :
         {&samples.px, &samples.py, &samples.pz, &samples.r, &samples.g, &samples.b})
        pad(*array, 0);
    pad(samples.density, 1);
}

}  // namespace

LdMis::LdMis(const EnvironmentSampler& environment, double alpha, int samples, std::uint64_t seed)
    : environment_(environment), alpha_(alpha), seed_(seed) {
    assert(alpha > 0 && alpha <= 1 && samples >= 1);
    samples_.picture_count = environment.flat() ? 0 : samples / 2;
    samples_.lobe_count = samples - samples_.picture_count;
    samples_.sets = std::clamp(kSamplesOfAllSets / samples, 1, kMostSets);
    const GgxZonalKernel kernel(alpha);
    for (int set = 0; set < samples_.sets; ++set) {
        add_lobe_set(kernel, seed, set, samples_);
        add_picture_set(environment, seed, set, samples_);
    }
}

std::uint64_t LdMis::integrate(int size, std::span<const CubeTexel> texels, std::span<float> rgb_out) const {
    const GgxZonalKernel kernel(alpha_);
    const MisLobe lobe{static_cast<float>(alpha_ * alpha_), static_cast<float>(kernel.normalisation())};
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const auto& [face, x, y] = texels[i];
        const auto hash = [&, face = face, x = x, y = y](Purpose purpose) {
            return random_bits(seed_, purpose, size, face, x, y);
        };
        const glm::dvec3 n = cubemap_texel_direction(texels[i], size);
        const int set = static_cast<int>(hash(kSetOfTexel) % static_cast<std::uint64_t>(samples_.sets));
        const TexelFrame in_picture =
            turned_frame(n, unit_double(hash(kTurnOfTexel)), environment_.world_to_source());
        mis_texel(environment_, samples_, set, lobe, n, in_picture, &rgb_out[i * 3]);
    }
    return texels.size() * (static_cast<std::uint64_t>(samples_.lobe_count) + samples_.picture_count);
}

}  // namespace pbr

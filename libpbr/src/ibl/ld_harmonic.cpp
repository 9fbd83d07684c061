#include "pbr/ibl/ld_harmonic.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "pbr/ibl/split_kernel.hpp"
#include "pbr/ibl/zonal_harmonics.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "pbr/numerics/elementary.hpp"
#include "src/simd/spread_kernel.hpp"

namespace pbr {
namespace {

constexpr double kBrightShare = 1e-3, kBrightOverMean = 20;

/// Rows of texels of a picture, those of a cube map's faces one after the other.
int row_count(const EquirectView& source) { return source.height; }
int row_count(const CubeView& source) { return 6 * source.size; }
int row_width(const EquirectView& source) { return source.width; }
int row_width(const CubeView& source) { return source.size; }
CubeTexel texel_of(const EquirectView&, int row, int x) { return {0, x, row}; }
CubeTexel texel_of(const CubeView& source, int row, int x) {
    return {row / source.size, x, row % source.size};
}
const float* rgb_of(const EquirectView& source, const CubeTexel& texel) {
    return source.texel(texel.x, texel.y);
}
const float* rgb_of(const CubeView& source, const CubeTexel& texel) {
    return source.texel(texel.face, texel.x, texel.y);
}

/// Solid angles of a row's texels; a cube map's by the density at the centre, which is near enough to choose
/// texels by.
std::vector<double> solid_angles(const EquirectView& source, int row) {
    return std::vector<double>(static_cast<std::size_t>(source.width),
                               equirect_texel_solid_angle(source.width, source.height, row));
}
std::vector<double> solid_angles(const CubeView& source, int row) {
    std::vector<double> result;
    const double t = cube_coordinate(row % source.size, source.size);
    for (int x = 0; x < source.size; ++x) {
        const double s = cube_coordinate(x, source.size), q = 1 + s * s + t * t;
        result.push_back(4.0 / source.size / source.size / (q * std::sqrt(q)));
    }
    return result;
}

/// Flux of a row's channels, and their largest values.
RowLight light_of_row(const EquirectView& source, int row) {
    RowLight light = row_light(source.texel(0, row), source.width);
    for (double& sum : light.sum) sum *= equirect_texel_solid_angle(source.width, source.height, row);
    return light;
}
RowLight light_of_row(const CubeView& source, int row) {
    RowLight light;
    const std::vector<double> weights = solid_angles(source, row);
    const float* rgb = rgb_of(source, texel_of(source, row, 0));
    for (const double solid_angle : weights)
        for (std::size_t c = 0; c < 3; ++c, ++rgb) {
            light.sum[c] += solid_angle * static_cast<double>(*rgb);
            light.largest[c] = std::max(light.largest[c], *rgb);
        }
    return light;
}

/// Texels, by rows, that hold more than their share of any channel's light.
template <class View>
std::vector<CubeTexel> find_bright_texels(const View& source, const ForEach& each) {
    std::vector<RowLight> rows(static_cast<std::size_t>(row_count(source)));
    each(row_count(source),
         [&](int row) { rows[static_cast<std::size_t>(row)] = light_of_row(source, row); });
    std::array<double, 3> flux{};
    for (const RowLight& row : rows)
        for (std::size_t c = 0; c < 3; ++c) flux[c] += row.sum[c];
    std::vector<CubeTexel> bright;
    for (int row = 0; row < row_count(source); ++row) {
        const auto exceeds_mean = [&](std::size_t c, double value) {
            return value > kBrightOverMean * flux[c] / (4 * std::numbers::pi);
        };
        const std::array<float, 3>& largest = rows[static_cast<std::size_t>(row)].largest;
        if (!exceeds_mean(0, largest[0]) && !exceeds_mean(1, largest[1]) && !exceeds_mean(2, largest[2]))
            continue;
        const std::vector<double> weights = solid_angles(source, row);
        for (int x = 0; x < row_width(source); ++x) {
            const CubeTexel texel = texel_of(source, row, x);
            const float* rgb = rgb_of(source, texel);
            const auto is_bright = [&](std::size_t c) {
                return exceeds_mean(c, rgb[c]) &&
                       static_cast<double>(rgb[c]) * weights[static_cast<std::size_t>(x)] >
                           kBrightShare * flux[c];
            };
            if (is_bright(0) || is_bright(1) || is_bright(2)) bright.push_back(texel);
        }
    }
    return bright;
}

}  // namespace

LdHarmonic::LdHarmonic(const EquirectView& source, double smallest_alpha, double max_error,
                       const ForEach& each)
    : max_error_(max_error), bright_(find_bright_texels(source, each)) {
    constexpr int kMostBands = 600;
    equirect_ = source;
    prepare(source, source.height, smallest_alpha, kMostBands, each);
}

LdHarmonic::LdHarmonic(const CubeView& source, double smallest_alpha, double max_error, const ForEach& each)
    : max_error_(max_error), bright_(find_bright_texels(source, each)) {
    // Texels are pi / (2 size) high at the middle of a face.
    prepare(source, 2 * source.size, smallest_alpha, std::numeric_limits<int>::max(), each);
}

template <class View>
void LdHarmonic::prepare(const View& source, int rows, double smallest_alpha, int most_bands,
                         const ForEach& each) {
    assert(smallest_alpha > 0 && smallest_alpha <= 1 && max_error_ > 0);
    if (!bright_.empty()) bright_texels_.emplace(PatchBlocks(source, bright_));
    const int wanted = bands_for(smallest_alpha, max_error_), bands = std::min(wanted, most_bands);
    const double narrowest = smallest_alpha * wanted / bands;  // of the lobes left to harmonics
    spectrum_.emplace(source, bands, points_a_row(rows, narrowest, max_error_), each, bright_);
    powers_ = spectrum_->powers();
}

glm::dvec3 LdHarmonic::mean() const {
    const std::span<const double, 6> average = spectrum_->coefficient(0, 0);
    return glm::dvec3(average[0], average[2], average[4]) / std::sqrt(4 * std::numbers::pi);
}

int LdHarmonic::bands_for(double alpha, double max_error) {
    const double digits = std::clamp(-log2_exact(max_error) / log2_exact(10), 1.0, 6.0);
    const double for_the_peak = (1.7 + 1.2 * digits) / alpha;
    const double for_the_kink = 32 * exp_exact((digits - 1) * std::numbers::ln2);
    return static_cast<int>(std::ceil(std::max(for_the_peak, for_the_kink)));
}

LdHarmonic::Level::Level(const LdHarmonic& of, double alpha, const ForEach& each)
    : alpha_(alpha), bright_(of.bright_texels_ ? &*of.bright_texels_ : nullptr) {
    const GgxZonalKernel lobe(alpha);
    std::vector<double> kernel;
    if (bands_for(alpha, of.max_error_) <= of.bands() || !of.equirect_.rgb) {
        kernel = zonal_ggx(lobe, of.bands() + 1);
    } else {
        const SplitKernel split(lobe, SplitKernel::radius_for(of.bands(), of.max_error_));
        kernel = zonal_far(split, of.bands() + 1);
        // Rounded, so that the near part of a constant picture is nothing but what is added here.
        const glm::dvec3 constant(glm::vec3(of.mean()));
        near_constant_ = constant * (1 - kernel[0]);
        near_.emplace(of.equirect_, constant, of.bright_, split);
    }
    bands_ = band_limit(of, kernel);
    grid_.emplace(*of.spectrum_, std::span(kernel).first(static_cast<std::size_t>(bands_) + 1), each);
}

int LdHarmonic::Level::band_limit(const LdHarmonic& of, std::span<const double> kernel) {
    const glm::dvec3 channels = of.mean();
    const double mean = (channels.x + channels.y + channels.z) / 3;
    if (!(mean > 0)) return 0;
    const double scale = 12 * std::numbers::pi * mean * mean;  // sphere times channels
    const double allowed = 0.01 * of.max_error_ * of.max_error_ * scale;
    double lost = 0;
    int bands = of.bands();
    for (; bands > 0; --bands) {
        const double k = kernel[static_cast<std::size_t>(bands)];
        const double more = lost + k * k * of.powers_[static_cast<std::size_t>(bands)];
        if (more > allowed) break;
        lost = more;
    }
    truncation_error_ = std::sqrt(lost / scale);
    return bands;
}

std::uint64_t LdHarmonic::Level::integrate(std::span<const glm::dvec3> directions,
                                           std::span<float> rgb_out) const {
    std::uint64_t evaluations = 0;
    std::vector<double> apart(directions.size() * 3);
    if (bright_) evaluations += bright_->integrate(alpha_, directions, apart);
    if (near_) {
        for (std::size_t i = 0; i < apart.size(); ++i) apart[i] += near_constant_[static_cast<int>(i % 3)];
        evaluations += near_->add(directions, apart);
    }
    grid_->sample(directions, rgb_out);
    for (std::size_t i = 0; i < rgb_out.size(); ++i)
        rgb_out[i] = std::max(0.0f, static_cast<float>(static_cast<double>(rgb_out[i]) + apart[i]));
    return evaluations;
}

}  // namespace pbr

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
/// From how many bright texels on it pays to have what is far of them by harmonics.
constexpr std::size_t kManyBright = 24;

/// Errors below this want bright texels by finer points: a sun's 3e-5 of its values are a few times as much
/// over the mean.
constexpr double kFineError = 3e-4;

/// What interpolation may err by, over the mean, where a picture that is turned - an equirect about its axis,
/// a cube map about any - should give the same values, turned.
constexpr double kTurnError = 5e-6;

/// Shares of the error asked for, root mean square: of degrees that are known and left out, of those beyond
/// what is analysed, of interpolation, of each bright texel that a horizon cuts. The rules of analysis take a
/// tenth each.
constexpr double kTruncationShare = 0.35, kBeyondShare = 0.25, kInterpolationShare = 0.15,
                 kHorizonShare = 0.1;

/// The sum of (2l + 1) k_l^2 beyond a degree: by Parseval's theorem what leaving these out moves a level by,
/// over its mean and squared, where all light is one point; of uncorrelated points, times the sum of their
/// shares squared. Of the lobe's peak, from k_l = x K1(x): the integral of x^3 K1(x)^2 / (2 alpha^2) from x =
/// 2 alpha l on.
double tail_of_peak(double alpha, int degree) {
    const double x = 2 * alpha * degree;
    return std::numbers::pi / 4 * x * (x + 2) * exp_exact(-2 * x) / (2 * alpha * alpha);
}

/// The same of the kink at the horizon: at alpha 1 k_l is 1.6 l^-5/2 and 0 for every other degree, and else
/// as much less as the slope is.
double tail_of_kink(double alpha, int degree) {
    const double f = (1 + alpha * alpha) / 2, l = degree;
    const double slope = std::numbers::pi * GgxZonalKernel(alpha).normalisation() / (f * f);
    return 0.85 * slope * slope / (l * l * l);
}

/// Rows of texels of a picture, those of a cube map's faces one after the other.
int row_count(const EquirectView& source) { return source.height; }
int row_count(const CubeView& source) { return 6 * source.size; }
int row_width(const EquirectView& source) { return source.width; }
int row_width(const CubeView& source) { return source.size; }
int row_of_texel(const EquirectView&, const CubeTexel& texel) { return texel.y; }
int row_of_texel(const CubeView& source, const CubeTexel& texel) {
    return texel.face * source.size + texel.y;
}
CubeTexel texel_of(const EquirectView&, int row, int x) { return {0, x, row}; }
CubeTexel texel_of(const CubeView& source, int row, int x) {
    return {row / source.size, x, row % source.size};
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

/// At least as large as all of them.
double largest_solid_angle(const EquirectView& source, int row) {
    return equirect_texel_solid_angle(source.width, source.height, row);
}
double largest_solid_angle(const CubeView& source, int) { return 4.0 / source.size / source.size; }

/// Flux of a row's channels, and their largest values, from its texels.
RowLight light_of_row(const EquirectView& source, int row, const float* rgb) {
    RowLight light = row_light(rgb, source.width);
    for (double& sum : light.sum) sum *= equirect_texel_solid_angle(source.width, source.height, row);
    return light;
}
RowLight light_of_row(const CubeView& source, int row, const float* rgb) {
    RowLight light;
    const std::vector<double> weights = solid_angles(source, row);
    for (const double solid_angle : weights)
        for (std::size_t c = 0; c < 3; ++c, ++rgb) {
            light.sum[c] += solid_angle * static_cast<double>(*rgb);
            light.largest[c] = std::max(light.largest[c], *rgb);
        }
    return light;
}

const float* row_of(const EquirectView& source, int row) { return source.texel(0, row); }
const float* row_of(const CubeView& source, int row) {
    return source.texel(row / source.size, 0, row % source.size);
}

std::array<double, 3> flux_of(const std::vector<RowLight>& rows) {
    std::array<double, 3> flux{};
    for (const RowLight& row : rows)
        for (std::size_t c = 0; c < 3; ++c) flux[c] += row.sum[c];
    return flux;
}

/// Leaves texels, which are by rows, out of the light of all rows, and returns the mean of the others. Rows
/// that hold some are summed anew: to subtract them wouldn't do, since they may dwarf the rest.
template <class View>
std::array<float, 3> leave_out(const View& source, std::span<const CubeTexel> without,
                               std::vector<RowLight>& rows) {
    const auto row_with = [&](const CubeTexel& texel) { return row_of_texel(source, texel); };
    double solid_angle = 4 * std::numbers::pi;
    for (auto texel = without.begin(); texel != without.end();) {
        const int row = row_with(*texel);
        const float* rgb = row_of(source, row);
        std::vector<float> rest(rgb, rgb + 3L * row_width(source));
        const std::vector<double> weights = solid_angles(source, row);
        for (; texel != without.end() && row_with(*texel) == row; ++texel) {
            std::fill_n(&rest[static_cast<std::size_t>(texel->x) * 3], 3, 0.0f);
            solid_angle -= weights[static_cast<std::size_t>(texel->x)];
        }
        rows[static_cast<std::size_t>(row)] = light_of_row(source, row, rest.data());
    }
    std::array<float, 3> mean;
    std::ranges::transform(flux_of(rows), mean.begin(),
                           [=](double flux) { return static_cast<float>(flux / solid_angle); });
    return mean;
}

/// Texels, by rows, that hold more than their share of any channel's light.
template <class View>
std::vector<CubeTexel> find_bright_texels(const View& source, const std::vector<RowLight>& rows) {
    const std::array<double, 3> flux = flux_of(rows);
    std::vector<CubeTexel> bright;
    for (int row = 0; row < row_count(source); ++row) {
        const auto exceeds = [&](std::size_t c, double value, double solid_angle) {
            return value > kBrightOverMean * flux[c] / (4 * std::numbers::pi) &&
                   value * solid_angle > kBrightShare * flux[c];
        };
        const auto is_bright = [&](const auto& rgb, double solid_angle) {
            return exceeds(0, rgb[0], solid_angle) || exceeds(1, rgb[1], solid_angle) ||
                   exceeds(2, rgb[2], solid_angle);
        };
        if (!is_bright(rows[static_cast<std::size_t>(row)].largest, largest_solid_angle(source, row)))
            continue;
        const std::vector<double> weights = solid_angles(source, row);
        for (int x = 0; x < row_width(source); ++x)
            if (is_bright(row_of(source, row) + 3L * x, weights[static_cast<std::size_t>(x)]))
                bright.push_back(texel_of(source, row, x));
    }
    return bright;
}

}  // namespace

LdHarmonic::LdHarmonic(const EquirectView& source, double smallest_alpha, double max_error,
                       const ForEach& each)
    : max_error_(max_error), equirect_(source) {
    constexpr int kMostBands = 600;
    const HarmonicRule rule = prepare(source, source.height, smallest_alpha, kMostBands, each);
    if (bright_.size() > kManyBright) {
        bright_spectrum_.emplace(source, rest(), rule, each);
        bright_powers_ = bright_spectrum_->powers();
    }
}

LdHarmonic::LdHarmonic(const CubeView& source, double smallest_alpha, double max_error, const ForEach& each)
    : max_error_(max_error) {
    // Texels are pi / (2 size) high at the middle of a face.
    prepare(source, 2 * source.size, smallest_alpha, std::numeric_limits<int>::max(), each);
}

template <class View>
HarmonicRule LdHarmonic::prepare(const View& source, int height, double smallest_alpha, int most_bands,
                                 const ForEach& each) {
    assert(smallest_alpha > 0 && smallest_alpha <= 1 && max_error_ > 0);
    std::vector<RowLight> rows(static_cast<std::size_t>(row_count(source)));
    each(row_count(source), [&](int row) {
        rows[static_cast<std::size_t>(row)] = light_of_row(source, row, row_of(source, row));
    });
    bright_ = find_bright_texels(source, rows);
    const std::array<double, 3> flux = flux_of(rows);
    ground_ = leave_out(source, bright_, rows);
    if (!bright_.empty()) {
        const double mean = (flux[0] + flux[1] + flux[2]) / (12 * std::numbers::pi);
        bright_texels_.emplace(PatchBlocks(source, bright_), ground_, kHorizonShare * max_error_ * mean,
                               max_error_ < kFineError);
    }

    // The narrowest lobe has the longest peak, the widest the sharpest kink.
    const int wanted = std::max(bands_for(smallest_alpha, max_error_), bands_for(1, max_error_));
    const int bands = std::min(wanted, most_bands);
    const double narrowest = smallest_alpha * wanted / bands;  // of the lobes left to harmonics
    const HarmonicRule rule = harmonic_rule(height, bands, narrowest, max_error_);
    spectrum_.emplace(source, rule, each, rest());
    powers_ = spectrum_->powers();
    return rule;
}

glm::dvec3 LdHarmonic::mean() const {
    const std::span<const double, 6> average = spectrum_->coefficient(0, 0);
    return glm::dvec3(average[0], average[2], average[4]) / std::sqrt(4 * std::numbers::pi);
}

double LdHarmonic::sphere_mean2() const {
    const glm::dvec3 channels = mean();
    const double mean = (channels.x + channels.y + channels.z) / 3;
    return 12 * std::numbers::pi * mean * mean;
}

int LdHarmonic::bands_for(double alpha, double max_error) {
    const double error = kBeyondShare * std::max(max_error, 3e-6);  // less is lost in sums of floats
    const double allowed = error * error / kBrightShare;
    int bands = 8;
    while (tail_of_peak(alpha, bands) + tail_of_kink(alpha, bands) > allowed) bands += 1 + bands / 64;
    return bands;
}

LdHarmonic::Level::Level(const LdHarmonic& of, double alpha, const ForEach& each)
    : alpha_(alpha), bright_(of.bright_texels_ ? &*of.bright_texels_ : nullptr) {
    const GgxZonalKernel lobe(alpha);
    const bool is_narrow = bands_for(alpha, of.max_error_) > of.bands() && of.equirect_.rgb;
    std::vector<double> kernel, kernel_of_bright;
    if (!is_narrow) {
        kernel = zonal_ggx(lobe, of.bands() + 1);
        if (of.bright_spectrum_) kernel_of_bright = split_bright(of, lobe, kernel);
    } else {
        const SplitKernel split(lobe, SplitKernel::radius_for(of.bands(), of.max_error_));
        kernel = zonal_far(split, of.bands() + 1);
        near_constant_ = glm::dvec3(of.ground_[0], of.ground_[1], of.ground_[2]) * (1 - kernel[0]);
        near_.emplace(of.equirect_, of.rest(), split);
    }
    bands_ = band_limit(of, kernel, kernel_of_bright);
    const std::size_t kept = static_cast<std::size_t>(bands_) + 1;
    std::vector<HarmonicGrid::Term> terms{{&*of.spectrum_, std::span(kernel).first(kept)}};
    if (!kernel_of_bright.empty())
        terms.push_back({&*of.bright_spectrum_, std::span(kernel_of_bright).first(kept)});
    const double mean = std::sqrt(of.sphere_mean2() / (12 * std::numbers::pi));
    const double scale = mean > 0 ? mean : 1, share = kInterpolationShare * of.max_error_;
    const double of_turns = std::min(share, kTurnError);
    grid_.emplace(terms, HarmonicGrid::Error{scale * (of.equirect_.rgb ? share : of_turns), scale * of_turns},
                  each);
}

std::vector<double> LdHarmonic::Level::split_bright(const LdHarmonic& of, const GgxZonalKernel& lobe,
                                                    const std::vector<double>& whole) {
    // Beyond the degrees that are known, bright texels go on as they do in the last quarter of them.
    const int bands = of.bands();
    double power = 0, orders = 0;
    for (int l = 3 * bands / 4; l <= bands; ++l) {
        power += of.bright_powers_[static_cast<std::size_t>(l)];
        orders += 2 * l + 1;
    }
    const double scale = of.sphere_mean2(), error = kBeyondShare * of.max_error_;
    const double allowed = error * error * scale * orders / power;  // of one point with all light
    const auto take = [&](double tail) { truncation_error_ = std::sqrt(tail * power / orders / scale); };
    const double kink = tail_of_kink(alpha_, bands), tail = tail_of_peak(alpha_, bands) + kink;
    if (tail <= allowed) {
        take(tail);
        bright_ = nullptr;
        return whole;
    }
    if (kink > allowed) return {};  // which splitting doesn't mend
    const double first = SplitKernel::radius_for(bands, std::sqrt(allowed));
    for (double radius = first; radius < std::min(0.6, 2 * first); radius *= 1.3) {
        const SplitKernel split(lobe, radius);
        std::vector<double> far = zonal_far(split, bands + 1);
        const double far_tail = zonal_far_tail(split, far);
        if (far_tail > allowed) continue;
        take(far_tail);
        bright_split_ = split;
        return far;
    }
    return {};
}

int LdHarmonic::Level::band_limit(const LdHarmonic& of, std::span<const double> kernel,
                                  std::span<const double> kernel_of_bright) {
    const double scale = of.sphere_mean2();
    if (!(scale > 0)) return 0;
    const double allowed = kTruncationShare * kTruncationShare * of.max_error_ * of.max_error_ * scale;
    double lost = truncation_error_ * truncation_error_ * scale;
    int bands = of.bands();
    for (; bands > 0; --bands) {
        const std::size_t l = static_cast<std::size_t>(bands);
        double more = lost + kernel[l] * kernel[l] * of.powers_[l];
        if (!kernel_of_bright.empty())
            more += kernel_of_bright[l] * kernel_of_bright[l] * of.bright_powers_[l];
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
    if (bright_)
        evaluations += bright_split_ ? bright_->integrate(*bright_split_, directions, apart)
                                     : bright_->integrate(alpha_, directions, apart);
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

#include "pbr/ibl/harmonic_filter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/fourier.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "src/ibl/flux_grid.hpp"
#include "src/ibl/lat_long_grid.hpp"
#include "src/ibl/ring_modes.hpp"
#include "src/simd/lat_long_kernel.hpp"
#include "src/simd/legendre_kernel.hpp"
#include "src/simd/spread_kernel.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kElement = 2 * kFourierLanes;

/// The texels of a sorted list that lie in a row.
std::span<const CubeTexel> in_row(std::span<const CubeTexel> texels, int face, int y) {
    const auto range = std::equal_range(texels.begin(), texels.end(), CubeTexel{face, 0, y},
                                        [](const CubeTexel& p, const CubeTexel& q) {
                                            return std::pair(p.face, p.y) < std::pair(q.face, q.y);
                                        });
    return {range.first, range.second};
}

/// The sum of a row's texels but those left out; these aren't subtracted afterwards, since they may dwarf the
/// rest.
glm::dvec3 row_sum(const float* row, int width, std::span<const CubeTexel> without) {
    glm::dvec3 sum(0);
    int from = 0;
    const auto add_until = [&](int to) {
        const std::array<double, 3> piece = row_light(row + 3L * from, to - from).sum;
        sum += glm::dvec3(piece[0], piece[1], piece[2]);
    };
    for (const CubeTexel& texel : without) {
        add_until(texel.x);
        from = texel.x + 1;
    }
    add_until(width);
    return sum;
}

std::array<float, 3> floats_of(const glm::dvec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// The mean over the sphere. Transforms start from what a picture differs from it, so that a constant one has
/// no error of quadrature at all.
glm::dvec3 mean_of(const EquirectView& source, std::span<const CubeTexel> without, const ForEach& each) {
    std::vector<glm::dvec3> rows(static_cast<std::size_t>(source.height));
    each(source.height, [&](int y) {
        rows[static_cast<std::size_t>(y)] = row_sum(source.texel(0, y), source.width, in_row(without, 0, y)) *
                                            equirect_texel_solid_angle(source.width, source.height, y);
    });
    glm::dvec3 flux(0);
    for (const glm::dvec3& row : rows) flux += row;
    return flux / (4 * kPi);
}

/// The same of a cube map, every texel counting alike: near enough, whatever constant is taken out is put
/// back.
glm::dvec3 mean_of(const CubeView& source, std::span<const CubeTexel> without) {
    glm::dvec3 sum(0);
    for (int row = 0; row < 6 * source.size; ++row) {
        const int face = row / source.size, y = row % source.size;
        sum += row_sum(source.texel(face, 0, y), source.size, in_row(without, face, y));
    }
    return sum / (6.0 * source.size * source.size);
}

/// The integral of e^(i m phi) over a column about its middle, for orders 0 ... bands.
std::vector<double> widths(int columns, int bands) {
    std::vector<double> result;
    for (int m = 0; m <= bands; ++m) {
        const double half = static_cast<double>(m) / columns;
        result.push_back(2 * kPi / columns * (m == 0 ? 1 : sin_cos_pi(half).sin / (kPi * half)));
    }
    return result;
}

/// Rings of a picture less its mean, with the integral over each constant texel: its sinc, from the first
/// texel's centre on.
RingSource rings_of(const EquirectView& source, const glm::dvec3& mean, int bands,
                    std::span<const CubeTexel> without) {
    RingSource rings{source.width, source.height, {}, {}};
    rings.read = [source, mean, without](int y, int channel, double* out) {
        const float* texel = source.texel(0, y) + channel;
        for (int x = 0; x < source.width; ++x)
            out[x * kElement] = static_cast<double>(texel[x * 3]) - mean[channel];
        for (const CubeTexel& black : in_row(without, 0, y)) out[black.x * kElement] = -mean[channel];
    };
    const std::vector<double> integrals = widths(source.width, bands);
    for (int m = 0; m <= bands; ++m) {
        const SinCos angle = sin_cos_pi(static_cast<double>(m) / source.width);
        const double scale = integrals[static_cast<std::size_t>(m)];
        rings.factors.emplace_back(scale * angle.cos, -scale * angle.sin);
    }
    return rings;
}

/// The points of all northern rows, and their weights.
struct RowPoints {
    std::vector<double> colatitudes_rad, weights;
};

RowPoints row_points(int height, int points) {
    const QuadratureRule rule = gauss_legendre(points);
    RowPoints result;
    for (int y = 0; y < (height + 1) / 2; ++y) {
        double sum = 0;
        const std::size_t first = result.weights.size();
        for (int i = 0; i < points; ++i) {
            const double v = (y + rule.nodes[i]) / height;
            result.colatitudes_rad.push_back(v * kPi);
            result.weights.push_back(rule.weights[i] * sin_cos_pi(v).sin);
            sum += result.weights.back();
        }
        // cos a - cos b = 2 sin((a + b)/2) sin((b - a)/2); the middle row of an odd number is its own mirror
        // image.
        const double area = 2 * sin_cos_pi((y + 0.5) / height).sin * sin_cos_pi(0.5 / height).sin;
        const double share = 2 * y + 1 == height ? 0.5 : 1;
        for (std::size_t i = first; i < result.weights.size(); ++i) result.weights[i] *= share * area / sum;
    }
    return result;
}

}  // namespace

int points_a_row(int height, double alpha, double max_error) {
    // A Gauss rule of n points acts on degree l as the exact mean over a row of height h up to
    //   (l h)^(2n) n!^4 / ((2n + 1) (2n)!^3),
    // and k_l = x K1(x), x = 2 alpha l, weights it: x^(2n+1) K1(x) is at most 1.16, 11 and 260 for n = 1,
    // 2, 3. Rows wider than the lobe need a point for every two radians of l h, and k_l is 1e-5 at x = 13.
    const double reach = kPi / height / (2 * alpha), allowed = max_error / 10;
    if (1.16 * reach * reach / 24 < allowed) return 1;
    const double reach2 = reach * reach;
    if (11 * reach2 * reach2 / 4320 < allowed) return 2;
    if (260 * reach2 * reach2 * reach2 * 5e-7 < allowed) return 3;
    return std::max(4, static_cast<int>(std::ceil(6.5 * reach)) + 2);
}

HarmonicSpectrum::HarmonicSpectrum(const EquirectView& source, int bands, int points_a_row,
                                   const ForEach& each, std::span<const CubeTexel> without)
    : HarmonicSpectrum(bands, source.world_to_source) {
    assert(points_a_row >= 1);
    // Rounded to float: then what is left of a constant picture is 0 in both arithmetics.
    const std::array<float, 3> constant = floats_of(mean_of(source, without, each));
    const glm::dvec3 mean(constant[0], constant[1], constant[2]);
    if (source.height > 3 * grid_rows(bands) / 2) {  // finer than such a field needs
        const FluxGrid grid = spread_equirect(source, constant, bands, points_a_row, without, each);
        integrate_grid(grid, widths(source.width, bands), each);
    } else {
        RingModes modes = analyse_rings(rings_of(source, mean, bands, without), each);
        const RowPoints points = row_points(source.height, points_a_row);
        integrate(modes, points.colatitudes_rad, points.weights, points_a_row, each);
    }
    add_constant(mean);
}

HarmonicSpectrum::HarmonicSpectrum(const CubeView& source, int bands, int points_a_side, const ForEach& each,
                                   std::span<const CubeTexel> without)
    : HarmonicSpectrum(bands, glm::dmat3(1)) {
    assert(points_a_side >= 1);
    const glm::dvec3 mean = mean_of(source, without);
    const FluxGrid grid = spread_cube(source, mean, bands, points_a_side, without, each);
    integrate_grid(grid, std::vector<double>(static_cast<std::size_t>(bands) + 1, 1.0), each);
    add_constant(mean);
}

void HarmonicSpectrum::add_constant(const glm::dvec3& value) {
    for (std::size_t c = 0; c < 3; ++c)
        coefficients_[2 * c] += value[static_cast<int>(c)] * std::sqrt(4 * kPi);
}

HarmonicSpectrum::HarmonicSpectrum(int bands, const glm::dmat3& world_to_source)
    : bands_(bands),
      world_to_source_(world_to_source),
      coefficients_(static_cast<std::size_t>(bands + 1) * (bands + 2) / 2 * kParts) {
    assert(bands >= 0);
}

void HarmonicSpectrum::integrate(RingModes& modes, const std::vector<double>& colatitudes_rad,
                                 const std::vector<double>& weights, int points_a_ring, const ForEach& each) {
    const Rings rings(colatitudes_rad);
    each(bands_ + 1, [&](int m) {
        const int first = rings.first(m, std::max(1, bands_));
        std::vector<double> values(static_cast<std::size_t>(2 * kParts) * rings.padded());
        for (int part = 0; part < 2 * kParts; ++part) {
            const double* from = modes.part(m, part / kParts, part % kParts);
            double* to = &values[static_cast<std::size_t>(part) * rings.padded()];
            for (std::size_t i = static_cast<std::size_t>(first); i < weights.size(); ++i)
                to[i] = weights[i] * from[i / points_a_ring];
        }
        legendre_analyse(rings, LegendreOrder(m, bands_), first, values.data(),
                         &values[static_cast<std::size_t>(kParts) * rings.padded()],
                         &coefficients_[start(m)]);
    });
}

void HarmonicSpectrum::integrate_grid(const FluxGrid& grid, const std::vector<double>& factors,
                                      const ForEach& each) {
    RingModes modes = analyse_rings(grid.rings({factors.begin(), factors.end()}), each);
    const std::vector<double> colatitudes_rad = grid.colatitudes_rad();
    integrate(modes, colatitudes_rad, std::vector<double>(colatitudes_rad.size(), 1.0), 1, each);
}

std::size_t HarmonicSpectrum::start(int order) const {
    return (static_cast<std::size_t>(order) * (bands_ + 1) -
            static_cast<std::size_t>(order) * (order - 1) / 2) *
           kParts;
}

std::span<const double, 6> HarmonicSpectrum::coefficient(int degree, int order) const {
    return std::span<const double, 6>(
        &coefficients_[start(order) + static_cast<std::size_t>(degree - order) * kParts], 6);
}

std::span<const double> HarmonicSpectrum::of_order(int order) const {
    return {&coefficients_[start(order)], static_cast<std::size_t>(bands_ - order + 1) * kParts};
}

std::vector<double> HarmonicSpectrum::powers() const {
    std::vector<double> result(static_cast<std::size_t>(bands_) + 1);
    for (int m = 0; m <= bands_; ++m) {  // as they lie in memory
        const std::span<const double> parts = of_order(m);
        for (std::size_t i = 0; i < parts.size(); ++i)
            result[static_cast<std::size_t>(m) + i / kParts] += (m == 0 ? 1 : 2) * parts[i] * parts[i];
    }
    return result;
}

HarmonicGrid::HarmonicGrid(const HarmonicSpectrum& spectrum, std::span<const double> kernel,
                           const ForEach& each)
    : world_to_source_(spectrum.world_to_source()) {
    const int bands = static_cast<int>(kernel.size()) - 1;
    assert(bands >= 0 && bands <= spectrum.bands());
    rows_ = grid_rows(bands);
    columns_ = 2 * fast_fourier_size(rows_);
    stride_ = columns_ + 2 * kBorder;
    texels_.resize(static_cast<std::size_t>(stride_) * (rows_ + 2 * kBorder) * 4);

    const int pairs = rows_ / 2;
    std::vector<double> colatitudes;
    for (int y = 0; y < pairs; ++y) colatitudes.push_back((y + 0.5) / rows_ * kPi);
    const Rings rings(colatitudes);
    RingModes modes(bands + 1, pairs);
    each(bands + 1, [&](int m) {
        const LegendreOrder legendre(m, bands);
        std::vector<double> filtered(static_cast<std::size_t>(legendre.degrees()) * kParts);
        const std::span<const double> coefficients = spectrum.of_order(m);
        for (std::size_t i = 0; i < filtered.size(); ++i)
            filtered[i] =
                (m == 0 ? 1 : 2) * kernel[static_cast<std::size_t>(m) + i / kParts] * coefficients[i];
        legendre_synthesise(rings, legendre, rings.first(m, std::max(1, bands)), filtered.data(),
                            modes.part(m, 0, 0), modes.part(m, 1, 0));
    });

    synthesise_rings(
        modes, columns_, rows_,
        [&](int y, int channel, const double* in) {
            for (int x = 0; x < columns_; ++x) at(y, x)[channel] = static_cast<float>(in[x * kElement]);
        },
        each);
    fill_border();
}

void HarmonicGrid::fill_border() {
    const auto copy = [&](int row, int column, int from_row, int from_column) {
        std::copy_n(at(from_row, from_column), 4, at(row, column));
    };
    for (int k = 1; k <= kBorder; ++k)  // over a pole the other side's rows follow
        for (int x = 0; x < columns_; ++x) {
            const int opposite = (x + columns_ / 2) % columns_;
            copy(-k, x, k - 1, opposite);
            copy(rows_ - 1 + k, x, rows_ - k, opposite);
        }
    for (int y = -kBorder; y < rows_ + kBorder; ++y)
        for (int k = 1; k <= kBorder; ++k) {
            copy(y, -k, y, columns_ - k);
            copy(y, columns_ - 1 + k, y, k - 1);
        }
}

void HarmonicGrid::sample(std::span<const glm::dvec3> directions, std::span<float> rgb_out) const {
    const LatLongTexels grid{&texels_[(kBorder * stride_ + kBorder) * 4], stride_, rows_, columns_};
    std::vector<glm::dvec3> turned(directions.size());
    for (std::size_t i = 0; i < directions.size(); ++i) turned[i] = world_to_source_ * directions[i];
    std::vector<glm::dvec2> points(directions.size());
    equirect_points(turned, points);
    interpolate(grid, points, rgb_out);
}

}  // namespace pbr

#include "pbr/ibl/harmonic_filter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "pbr/ibl/equirect_rows.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/fourier.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "src/ibl/flux_grid.hpp"
#include "src/ibl/lat_long_grid.hpp"
#include "src/ibl/ring_modes.hpp"
#include "src/simd/lat_long_kernel.hpp"
#include "src/simd/legendre_kernel.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kElement = 2 * kFourierLanes;

/// The integral of e^(i m phi) over a column about its middle, for orders 0 ... bands.
std::vector<double> widths(int columns, int bands) {
    std::vector<double> result;
    for (int m = 0; m <= bands; ++m) {
        const double half = static_cast<double>(m) / columns;
        result.push_back(2 * kPi / columns * (m == 0 ? 1 : sin_cos_pi(half).sin / (kPi * half)));
    }
    return result;
}

/// The same times e^(-i m phi) of the first column's middle.
std::vector<std::complex<double>> texel_factors(int columns, int bands) {
    std::vector<std::complex<double>> result;
    const std::vector<double> integrals = widths(columns, bands);
    for (int m = 0; m <= bands; ++m) {
        const SinCos angle = sin_cos_pi(static_cast<double>(m) / columns);
        const double scale = integrals[static_cast<std::size_t>(m)];
        result.emplace_back(scale * angle.cos, -scale * angle.sin);
    }
    return result;
}

/// Rings of a picture less its constant, with the integral over each constant texel: its sinc, from the first
/// texel's centre on. Refers to `rows`.
RingSource rings_of(const EquirectView& source, const EquirectRows& rows,
                    const std::array<float, 3>& constant, int bands) {
    RingSource rings{source.width, source.height, {}, {}};
    rings.read = [&rows, constant, width = source.width](int y, int channel, double* out) {
        const double taken = static_cast<double>(constant[static_cast<std::size_t>(channel)]);
        const float* texel = rows.row(y) + channel;
        for (int x = 0; x < width; ++x) out[x * kElement] = static_cast<double>(texel[x * 3]) - taken;
    };
    rings.factors = texel_factors(source.width, bands);
    return rings;
}

/// The points of some northern rows, and their weights.
struct RowPoints {
    std::vector<double> colatitudes_rad, weights;
};

RowPoints row_points(int height, int points, const std::vector<int>& rows) {
    const QuadratureRule rule = gauss_legendre(points);
    RowPoints result;
    for (const int y : rows) {
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

/// Points a row of a picture for kernels of width alpha.
int points_a_row(int height, double alpha, double allowed) {
    // A Gauss rule of n points acts on degree l as the exact mean over a row of height h up to
    //   (l h)^(2n) n!^4 / ((2n + 1) (2n)!^3),
    // and k_l = x K1(x), x = 2 alpha l, weights it: x^(2n+1) K1(x) is at most 1.16, 11 and 260 for n = 1,
    // 2, 3. Rows wider than the lobe need a point for every two radians of l h, and k_l is 1e-5 at x = 13.
    const double reach = kPi / height / (2 * alpha);
    if (1.16 * reach * reach / 24 < allowed) return 1;
    const double reach2 = reach * reach;
    if (11 * reach2 * reach2 / 4320 < allowed) return 2;
    if (260 * reach2 * reach2 * reach2 * 5e-7 < allowed) return 3;
    return std::max(4, static_cast<int>(std::ceil(6.5 * reach)) + 2);
}

/// The pairs of rows, a northern one and its mirror image, that hold any of some texels.
std::vector<int> pairs_with(std::span<const CubeTexel> texels, int height) {
    std::vector<int> pairs;
    for (const CubeTexel& texel : texels) pairs.push_back(std::min(texel.y, height - 1 - texel.y));
    std::ranges::sort(pairs);
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

/// As analyse_rings(rings_of()) of a picture that is black but for what a part lacks, for the given pairs of
/// rows.
RingModes analyse_texels(const EquirectView& source, const PicturePart& part, const std::vector<int>& pairs,
                         int bands, const ForEach& each) {
    std::vector<SinCos> turns;  // by half texels
    for (int i = 0; i < 2 * source.width; ++i)
        turns.push_back(sin_cos_pi(static_cast<double>(i) / source.width));
    const std::vector<double> integrals = widths(source.width, bands);
    RingModes modes(bands + 1, static_cast<int>(pairs.size()));
    each(bands + 1, [&](int m) {
        for (const CubeTexel& texel : part.without) {
            const int mirrored = source.height - 1 - texel.y;
            const auto pair = std::ranges::lower_bound(pairs, std::min(texel.y, mirrored)) - pairs.begin();
            const SinCos& turn =
                turns[static_cast<std::size_t>((2L * texel.x + 1) * m % (2L * source.width))];
            const double width = integrals[static_cast<std::size_t>(m)];
            // A middle row counts as north and south.
            const double north = texel.y <= mirrored ? width : 0, south = texel.y >= mirrored ? width : 0;
            for (int channel = 0; channel < 3; ++channel) {
                const double value = static_cast<double>(source.texel(texel.x, texel.y)[channel]) -
                                     static_cast<double>(part.constant[static_cast<std::size_t>(channel)]);
                modes.part(m, 0, 2 * channel)[pair] += (north + south) * value * turn.cos;
                modes.part(m, 0, 2 * channel + 1)[pair] -= (north + south) * value * turn.sin;
                modes.part(m, 1, 2 * channel)[pair] += (north - south) * value * turn.cos;
                modes.part(m, 1, 2 * channel + 1)[pair] -= (north - south) * value * turn.sin;
            }
        }
    });
    return modes;
}

}  // namespace

HarmonicRule harmonic_rule(int height, int bands, double alpha, double max_error) {
    // x^7 K1(x) is at most 382: the weight of (l h)^6 at h = 2 alpha.
    const auto rows_for = [&](double allowed) {
        return grid_rows(2 * alpha * grid_step(allowed, 382), bands);
    };
    const double allowed = max_error / 10;
    return {bands, points_a_row(height, alpha, allowed), rows_for(allowed),
            grid_columns(rows_for(std::min(allowed, 5e-6)))};
}

HarmonicSpectrum::HarmonicSpectrum(const EquirectView& source, const HarmonicRule& rule, const ForEach& each,
                                   const PicturePart& part)
    : HarmonicSpectrum(rule.bands, source.world_to_source, part.constant) {
    assert(rule.points_a_row >= 1);
    if (source.height > rule.grid_rows) {
        const bool keeps_columns = source.width <= rule.grid_columns && source.width % 2 == 0;
        const FluxGrid grid =
            spread_equirect(source, part, rule.grid_rows, keeps_columns ? source.width : rule.grid_columns,
                            rule.points_a_row, each);
        const std::vector<double> centred = widths(source.width, bands_);
        integrate_grid(grid,
                       keeps_columns ? texel_factors(source.width, bands_)
                                     : std::vector<std::complex<double>>(centred.begin(), centred.end()),
                       each);
    } else {
        const EquirectRows texels(source, part);
        RingModes modes = analyse_rings(rings_of(source, texels, part.constant, bands_), each);
        std::vector<int> rows(static_cast<std::size_t>(source.height + 1) / 2);
        std::iota(rows.begin(), rows.end(), 0);
        const RowPoints points = row_points(source.height, rule.points_a_row, rows);
        integrate(modes, points.colatitudes_rad, points.weights, rule.points_a_row, each);
    }
    add_constant();
}

HarmonicSpectrum::HarmonicSpectrum(const CubeView& source, const HarmonicRule& rule, const ForEach& each,
                                   const PicturePart& part)
    : HarmonicSpectrum(rule.bands, glm::dmat3(1), part.constant) {
    assert(rule.points_a_row >= 1);
    const FluxGrid grid = spread_cube(source, part, rule.grid_columns, rule.points_a_row, each);
    integrate_grid(grid, std::vector<std::complex<double>>(static_cast<std::size_t>(bands_) + 1, 1.0), each);
    add_constant();
}

HarmonicSpectrum::HarmonicSpectrum(const EquirectView& source, const PicturePart& part,
                                   const HarmonicRule& rule, const ForEach& each)
    : HarmonicSpectrum(rule.bands, source.world_to_source, {}) {
    const std::vector<int> pairs = pairs_with(part.without, source.height);
    RingModes modes = analyse_texels(source, part, pairs, bands_, each);
    const RowPoints points = row_points(source.height, rule.points_a_row, pairs);
    integrate(modes, points.colatitudes_rad, points.weights, rule.points_a_row, each);
}

void HarmonicSpectrum::add_constant() {
    for (std::size_t c = 0; c < 3; ++c)
        coefficients_[2 * c] += static_cast<double>(constant_[c]) * std::sqrt(4 * kPi);
}

HarmonicSpectrum::HarmonicSpectrum(int bands, const glm::dmat3& world_to_source,
                                   const std::array<float, 3>& constant)
    : bands_(bands),
      constant_(constant),
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

void HarmonicSpectrum::integrate_grid(const FluxGrid& grid, std::vector<std::complex<double>> factors,
                                      const ForEach& each) {
    RingModes modes = analyse_rings(grid.rings(std::move(factors)), each);
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

namespace {

/// Coefficients of a field, [order] the parts of all its degrees, doubled where an order stands for its
/// negative too.
using FieldCoefficients = std::vector<std::vector<double>>;

FieldCoefficients add_up(std::span<const HarmonicGrid::Term> terms, int bands, const ForEach& each) {
    FieldCoefficients field(static_cast<std::size_t>(bands) + 1);
    each(bands + 1, [&](int m) {
        std::vector<double>& of_order = field[static_cast<std::size_t>(m)];
        of_order.resize(static_cast<std::size_t>(bands + 1 - m) * kParts);
        for (const HarmonicGrid::Term& term : terms) {
            const std::span<const double> coefficients = term.spectrum->of_order(m);
            const int degrees = static_cast<int>(term.kernel.size()) - m;
            for (int i = 0; i < degrees * kParts; ++i)
                of_order[static_cast<std::size_t>(i)] +=
                    (m == 0 ? 1 : 2) * term.kernel[static_cast<std::size_t>(m + i / kParts)] *
                    coefficients[static_cast<std::size_t>(i)];
        }
    });
    return field;
}

/// Root mean square, over the sphere and the channels, of the field whose degrees are multiplied by l^6.
double sixth_derivative(const FieldCoefficients& field) {
    const int bands = static_cast<int>(field.size()) - 1;
    std::vector<double> powers(field.size());
    for (int m = 0; m <= bands; ++m) {
        const std::vector<double>& of_order = field[static_cast<std::size_t>(m)];
        for (std::size_t i = 0; i < of_order.size(); ++i)
            powers[static_cast<std::size_t>(m) + i / kParts] += of_order[i] * of_order[i] / (m == 0 ? 1 : 2);
    }
    double sum = 0;
    for (int l = 0; l <= bands; ++l) {
        const double l2 = static_cast<double>(l) * l, l6 = l2 * l2 * l2;
        sum += powers[static_cast<std::size_t>(l)] * l6 * l6;
    }
    return std::sqrt(sum / (12 * kPi));
}

}  // namespace

HarmonicGrid::HarmonicGrid(std::span<const Term> terms, const Error& allowed, const ForEach& each)
    : world_to_source_(terms[0].spectrum->world_to_source()) {
    int bands = 0;
    for (const Term& term : terms) bands = std::max(bands, static_cast<int>(term.kernel.size()) - 1);
    FieldCoefficients field = add_up(terms, bands, each);
    for (std::size_t c = 0; c < 3; ++c) {
        double constant = 0;
        for (const Term& term : terms)
            constant += term.kernel[0] * static_cast<double>(term.spectrum->constant()[c]);
        constant_[c] = static_cast<float>(constant);
        field[0][2 * c] -= constant * std::sqrt(4 * kPi);
    }
    const double derivative = sixth_derivative(field);
    const auto rows_for = [&](double error) {
        return grid_rows(grid_step(error, std::max(derivative, 1e-12 * error)), bands);
    };
    rows_ = rows_for(allowed.of_rows);
    columns_ = grid_columns(rows_for(allowed.of_columns));
    stride_ = columns_ + 2 * kBorder;
    texels_.resize(static_cast<std::size_t>(stride_) * (rows_ + 2 * kBorder) * 4);

    const int pairs = rows_ / 2;
    std::vector<double> colatitudes;
    for (int y = 0; y < pairs; ++y) colatitudes.push_back((y + 0.5) / rows_ * kPi);
    const Rings rings(colatitudes);
    RingModes modes(bands + 1, pairs);
    each(bands + 1, [&](int m) {
        legendre_synthesise(rings, LegendreOrder(m, bands), rings.first(m, std::max(1, bands)),
                            field[static_cast<std::size_t>(m)].data(), modes.part(m, 0, 0),
                            modes.part(m, 1, 0));
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
    for (std::size_t i = 0; i < rgb_out.size(); ++i) rgb_out[i] += constant_[i % 3];
}

}  // namespace pbr

#include "pbr/ibl/harmonic_filter.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/fourier.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "src/simd/legendre_kernel.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kElement = 2 * kFourierLanes;

int padded_to(int count, int multiple) { return (count + multiple - 1) / multiple * multiple; }

/// Fourier coefficients of pairs of rings, north and south, as sums and differences: what even and odd
/// degrees need. part(order, parity, part) is an array over pairs, the pole's first.
class RingModes {
  public:
    RingModes(int orders, int pairs)
        : stride_(padded_to(pairs, kRingGroup)),
          modes_(static_cast<std::size_t>(orders) * 2 * kParts * stride_) {}
    int stride() const { return stride_; }
    double* part(int order, int parity, int part) {
        return &modes_[((static_cast<std::size_t>(order) * 2 + parity) * kParts + part) * stride_];
    }

  private:
    int stride_;
    std::vector<double> modes_;
};

/// Rows of a picture to Fourier coefficients: eight pairs of rows at once, a northern row as the real part
/// and its mirror image as the imaginary part.
class RowTransform {
  public:
    RowTransform(const EquirectView& source, int bands, std::span<const glm::ivec2> without)
        : source_(source),
          without_(without),
          bands_(bands),
          plan_(source.width),
          pairs_((source.height + 1) / 2),
          modes(bands + 1, pairs_) {}

    int batches() const { return 3 * batches_a_channel(); }

    void transform(int batch) {
        const int channel = batch / batches_a_channel(), first = batch % batches_a_channel() * kFourierLanes;
        std::vector<double> data(static_cast<std::size_t>(plan_.batch_doubles())), work(data.size());
        for (int lane = 0; lane < kFourierLanes && first + lane < pairs_; ++lane) {
            const float* north = source_.texel(0, first + lane) + channel;
            const float* south = source_.texel(0, source_.height - 1 - first - lane) + channel;
            for (int x = 0; x < source_.width; ++x) {
                data[static_cast<std::size_t>(x) * kElement + lane] = static_cast<double>(north[x * 3]);
                data[static_cast<std::size_t>(x) * kElement + kFourierLanes + lane] =
                    static_cast<double>(south[x * 3]);
            }
        }
        for (const glm::ivec2& texel : without_) {
            const int north = texel.y - first, south = source_.height - 1 - texel.y - first;
            double* element = &data[static_cast<std::size_t>(texel.x) * kElement];
            if (north >= 0 && north < kFourierLanes) element[north] = 0;
            if (south >= 0 && south < kFourierLanes) element[kFourierLanes + south] = 0;
        }
        plan_.transform(data.data(), work.data());
        for (int m = 0; m <= bands_; ++m) store(data, m, channel, first);
    }

  private:
    int batches_a_channel() const { return (pairs_ + kFourierLanes - 1) / kFourierLanes; }

    /// Integral of the rows times e^(-i m phi), texels being constant: the transform at m, folded beyond
    /// Nyquist, times the texel's own sinc, from the first texel's centre on.
    void store(const std::vector<double>& data, int m, int channel, int first) {
        const int width = source_.width;
        const SinCos centre = sin_cos_pi(-static_cast<double>(m) / width);
        const double half = static_cast<double>(m) / width;
        const double sinc = m == 0 ? 1 : sin_cos_pi(half).sin / (kPi * half);
        const double scale = 2 * kPi / width * sinc;
        const double* z = &data[static_cast<std::size_t>(m % width) * kElement];
        const double* mirrored = &data[static_cast<std::size_t>((width - m % width) % width) * kElement];
        double *even_re = modes.part(m, 0, 2 * channel), *even_im = modes.part(m, 0, 2 * channel + 1);
        double *odd_re = modes.part(m, 1, 2 * channel), *odd_im = modes.part(m, 1, 2 * channel + 1);
        for (int lane = 0; lane < kFourierLanes && first + lane < pairs_; ++lane) {
            const double a = z[lane], b = z[lane + kFourierLanes];
            const double c = mirrored[lane], d = mirrored[lane + kFourierLanes];
            // north = (Z_m + conj Z_-m) / 2, south = (Z_m - conj Z_-m) / 2i
            const double north_re = (a + c) / 2, north_im = (b - d) / 2, south_re = (b + d) / 2,
                         south_im = (c - a) / 2;
            const auto turned = [&](double re, double im, double* to_re, double* to_im) {
                to_re[first + lane] = scale * (re * centre.cos - im * centre.sin);
                to_im[first + lane] = scale * (re * centre.sin + im * centre.cos);
            };
            turned(north_re + south_re, north_im + south_im, even_re, even_im);
            turned(north_re - south_re, north_im - south_im, odd_re, odd_im);
        }
    }

    const EquirectView& source_;
    std::span<const glm::ivec2> without_;
    int bands_;
    FourierPlan plan_;
    int pairs_;

  public:
    RingModes modes;
};

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

void for_each_in_turn(int count, const std::function<void(int)>& body) {
    for (int i = 0; i < count; ++i) body(i);
}

int points_a_row(int height, double alpha, double max_error) {
    // A Gauss rule of n points acts on degree l as the exact mean over a row of height h up to (l h)^(2n)
    // n!^4 /
    // ((2n + 1) (2n)!^3), and k_l = x K1(x), x = 2 alpha l, weights it: x^(2n+1) K1(x) is at most 1.16, 11
    // and 260 for n = 1, 2, 3.
    const double reach = kPi / height / (2 * alpha), allowed = max_error / 10;
    if (1.16 * reach * reach / 24 < allowed) return 1;
    if (11 * std::pow(reach, 4) / 4320 < allowed) return 2;
    return std::max(3, static_cast<int>(std::ceil(2 * reach)) + 2);
}

HarmonicSpectrum::HarmonicSpectrum(const EquirectView& source, int bands, int points_a_row,
                                   const ForEach& each, std::span<const glm::ivec2> without)
    : bands_(bands),
      world_to_source_(source.world_to_source),
      coefficients_(static_cast<std::size_t>(bands + 1) * (bands + 2) / 2 * kParts) {
    assert(bands >= 0 && points_a_row >= 1);
    RowTransform rows(source, bands, without);
    each(rows.batches(), [&](int batch) { rows.transform(batch); });

    const RowPoints points = row_points(source.height, points_a_row);
    const Rings rings(points.colatitudes_rad);
    each(bands + 1, [&](int m) {
        const int first = rings.first(m, std::max(1, bands));
        std::vector<double> values(static_cast<std::size_t>(2 * kParts) * rings.padded());
        for (int part = 0; part < 2 * kParts; ++part) {
            const double* from = rows.modes.part(m, part / kParts, part % kParts);
            double* to = &values[static_cast<std::size_t>(part) * rings.padded()];
            for (std::size_t i = static_cast<std::size_t>(first); i < points.weights.size(); ++i)
                to[i] = points.weights[i] * from[i / points_a_row];
        }
        legendre_analyse(rings, LegendreOrder(m, bands), first, values.data(),
                         &values[static_cast<std::size_t>(kParts) * rings.padded()],
                         &coefficients_[start(m)]);
    });
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

double HarmonicSpectrum::power(int degree) const {
    double sum = 0;
    for (int m = 0; m <= degree; ++m)
        for (const double part : coefficient(degree, m)) sum += (m == 0 ? 1 : 2) * part * part;
    return sum;
}

HarmonicGrid::HarmonicGrid(const HarmonicSpectrum& spectrum, std::span<const double> kernel,
                           const ForEach& each)
    : world_to_source_(spectrum.world_to_source()) {
    const int bands = static_cast<int>(kernel.size()) - 1;
    assert(bands >= 0 && bands <= spectrum.bands());
    constexpr double kRowsADegree = 1.25;
    rows_ = padded_to(std::max(8, static_cast<int>(kRowsADegree * (bands + 2))), 2);
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

    const FourierPlan plan(columns_);
    const int batches = (pairs + kFourierLanes - 1) / kFourierLanes;
    each(3 * batches, [&](int batch) {
        const int channel = batch / batches, first = batch % batches * kFourierLanes;
        std::vector<double> data(static_cast<std::size_t>(plan.batch_doubles())), work(data.size());
        for (int m = 0; m <= bands; ++m) {
            const double *even_re = modes.part(m, 0, 2 * channel),
                         *even_im = modes.part(m, 0, 2 * channel + 1);
            const double *odd_re = modes.part(m, 1, 2 * channel), *odd_im = modes.part(m, 1, 2 * channel + 1);
            for (int lane = 0; lane < kFourierLanes && first + lane < pairs; ++lane) {
                // The sum of c_m e^(i m phi) over m >= 0, whose real part is the field; north as its real
                // part and south as the imaginary part of one signal. The forward transform of swapped parts
                // is the inverse.
                const int y = first + lane;
                const double north_re = (even_re[y] + odd_re[y]) / 2, north_im = (even_im[y] + odd_im[y]) / 2;
                const double south_re = (even_re[y] - odd_re[y]) / 2, south_im = (even_im[y] - odd_im[y]) / 2;
                double* plus = &data[static_cast<std::size_t>(m) * kElement + lane];
                double* minus = &data[static_cast<std::size_t>((columns_ - m) % columns_) * kElement + lane];
                plus[0] += north_im + south_re;
                plus[kFourierLanes] += north_re - south_im;
                minus[0] += south_re - north_im;
                minus[kFourierLanes] += north_re + south_im;
            }
        }
        plan.transform(data.data(), work.data());
        for (int lane = 0; lane < kFourierLanes && first + lane < pairs; ++lane)
            for (int x = 0; x < columns_; ++x) {
                const double* z = &data[static_cast<std::size_t>(x) * kElement + lane];
                at(first + lane, x)[channel] = static_cast<float>(z[kFourierLanes]);
                at(rows_ - 1 - first - lane, x)[channel] = static_cast<float>(z[0]);
            }
    });
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

namespace {

/// Weights of Lagrange's polynomial through the points -2 … 3, at t in [0, 1].
std::array<float, 6> lagrange_weights(double t) {
    const double a = t + 2, b = t + 1, c = t, d = t - 1, e = t - 2, f = t - 3;
    const double ab = a * b, ef = e * f, cd = c * d;
    return {static_cast<float>(-b * cd * ef / 120), static_cast<float>(a * cd * ef / 24),
            static_cast<float>(-ab * d * ef / 12),  static_cast<float>(ab * c * ef / 12),
            static_cast<float>(-ab * cd * f / 24),  static_cast<float>(ab * cd * e / 120)};
}

}  // namespace

std::array<float, 3> HarmonicGrid::sample(const glm::dvec3& direction) const {
    const glm::dvec2 point = equirect_point(world_to_source_ * direction);
    const double px = point.x * columns_, py = point.y * rows_ - 0.5;
    const int x = std::min(static_cast<int>(px), columns_ - 1), y = static_cast<int>(std::floor(py));
    const std::array<float, 6> wx = lagrange_weights(px - x), wy = lagrange_weights(py - y);
    float sum[4] = {0, 0, 0, 0};
    for (int j = 0; j < 6; ++j) {
        const float* p = &texels_[((y - 2 + j + kBorder) * stride_ + x - 2 + kBorder) * 4];
        float row[4] = {0, 0, 0, 0};
        for (int i = 0; i < 6; ++i)
            for (int c = 0; c < 4; ++c) row[c] += wx[i] * p[i * 4 + c];
        for (int c = 0; c < 4; ++c) sum[c] += wy[j] * row[c];
    }
    return {sum[0], sum[1], sum[2]};
}

}  // namespace pbr

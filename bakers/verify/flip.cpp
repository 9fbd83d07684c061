#include "bakers/verify/flip.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>

namespace pbrbake::verify {
namespace {

constexpr double kPi = std::numbers::pi;
// The papers' constants (2020, table 1 and section 4).
constexpr double kColourExponent = 0.7, kColourKnee = 0.4, kColourAtKnee = 0.95;
constexpr double kFeatureWidthDeg = 0.082, kFeatureExponent = 0.5;
constexpr double kTargetTone = 0.85;  // of the brightest and the median (2021, section 4)

using Plane = std::vector<float>;
using Kernel = std::vector<float>;  ///< of odd length, about its middle

/// Rec. 709 primaries with D65 to XYZ (IEC 61966-2-1), columns first.
const glm::dmat3 kToXyz{0.4123908, 0.2126390, 0.0193308,  //
                        0.3575843, 0.7151687, 0.1191948,  //
                        0.1804808, 0.0721923, 0.9505322};
const glm::dmat3 kFromXyz = glm::inverse(kToXyz);
const glm::dvec3 kWhite = kToXyz * glm::dvec3(1);

/// The same with values before CIELAB's cube root: YCxCz, an opponent space linear in light.
glm::dvec3 opponent(const glm::dvec3& f) { return {116 * f.y - 16, 500 * (f.x - f.y), 200 * (f.y - f.z)}; }

glm::dvec3 rgb_of_opponent(const glm::dvec3& ycc) {
    const double y = (ycc.x + 16) / 116;
    return kFromXyz * (glm::dvec3(y + ycc.y / 500, y, y - ycc.z / 200) * kWhite);
}

/// CIELAB, chroma lessened in the dark as Hunt found.
glm::dvec3 hunt_lab(const glm::dvec3& rgb) {
    constexpr double kDelta = 6.0 / 29;
    glm::dvec3 f = kToXyz * rgb / kWhite;
    for (int c = 0; c < 3; ++c)
        f[c] = f[c] > kDelta * kDelta * kDelta ? std::cbrt(static_cast<float>(f[c]))
                                               : f[c] / (3 * kDelta * kDelta) + 4.0 / 29;
    const glm::dvec3 lab = opponent(f);
    return {lab.x, 0.01 * lab.x * lab.y, 0.01 * lab.x * lab.z};
}

/// Abasi, Tehran & Fairchild's distance for large differences: city block in lightness, Euclid in chroma.
double hyab(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// A Gaussian cut at a radius, and before it where it is too small to count in a float.
Kernel gaussian(double variance, int radius) {
    const auto value = [&](int i) { return std::exp(-i * i / (2 * variance)); };
    while (radius > 1 && value(radius) < 1e-8) --radius;
    Kernel kernel;
    double sum = 0;
    for (int i = -radius; i <= radius; ++i) sum += value(i);
    for (int i = -radius; i <= radius; ++i) kernel.push_back(static_cast<float>(value(i) / sum));
    return kernel;
}

/// First or second derivative of a Gaussian; what is above 0 sums to 1, what is below to -1.
Kernel derivative(double deviation, int radius, bool second) {
    std::vector<double> values;
    double above = 0, below = 0;
    for (int i = -radius; i <= radius; ++i) {
        const double t = i / deviation;
        values.push_back((second ? t * t - 1 : -t) * std::exp(-t * t / 2));
        (values.back() > 0 ? above : below) += std::abs(values.back());
    }
    Kernel kernel;
    for (const double value : values)
        kernel.push_back(static_cast<float>(value / (value > 0 ? above : below)));
    return kernel;
}

struct Size {
    int width, height;
    std::size_t texels() const { return static_cast<std::size_t>(width) * height; }
};

/// Along rows; texels beyond an edge repeat it.
Plane along_rows(const Plane& plane, const Kernel& kernel, Size size) {
    const int radius = static_cast<int>(kernel.size()) / 2;
    Plane result(size.texels(), 0.f), padded(static_cast<std::size_t>(size.width) + 2 * radius);
    for (int y = 0; y < size.height; ++y) {
        const float* row = &plane[static_cast<std::size_t>(y) * size.width];
        std::fill_n(padded.begin(), radius, row[0]);
        std::copy_n(row, size.width, padded.begin() + radius);
        std::fill_n(padded.end() - radius, radius, row[size.width - 1]);
        float* out = &result[static_cast<std::size_t>(y) * size.width];
        for (std::size_t k = 0; k < kernel.size(); ++k)
            for (int x = 0; x < size.width; ++x)
                out[x] += kernel[k] * padded[k + static_cast<std::size_t>(x)];
    }
    return result;
}

Plane down_columns(const Plane& plane, const Kernel& kernel, Size size) {
    const int radius = static_cast<int>(kernel.size()) / 2;
    Plane result(size.texels(), 0.f);
    for (int y = 0; y < size.height; ++y) {
        float* out = &result[static_cast<std::size_t>(y) * size.width];
        for (int k = 0; k < static_cast<int>(kernel.size()); ++k) {
            const int from = std::clamp(y + k - radius, 0, size.height - 1);
            const float* row = &plane[static_cast<std::size_t>(from) * size.width];
            const float weight = kernel[static_cast<std::size_t>(k)];
            for (int x = 0; x < size.width; ++x) out[x] += weight * row[x];
        }
    }
    return result;
}

/// The filters for one distance of sight.
struct Filters {
    explicit Filters(double pixels_per_degree) {
        // Contrast sensitivity (2020, table 1): sums of a sqrt(pi/b) exp(-pi² x²/b), x in degrees.
        constexpr double kLuminance = 0.0047, kRedGreen = 0.0053, kBlueYellow = 0.04,
                         kBlueYellowNarrow = 0.025;
        constexpr double kBlueYellowShare = 34.1, kBlueYellowNarrowShare = 13.5;
        const auto variance = [&](double b) {
            return b / (2 * kPi * kPi) * pixels_per_degree * pixels_per_degree;
        };
        const int radius = static_cast<int>(std::ceil(3 * std::sqrt(variance(kBlueYellow))));
        luminance = gaussian(variance(kLuminance), radius);
        red_green = gaussian(variance(kRedGreen), radius);
        blue_yellow = gaussian(variance(kBlueYellow), radius);
        blue_yellow_narrow = gaussian(variance(kBlueYellowNarrow), radius);
        const auto mass = [&](double share, double b) {
            double sum = 0;
            for (int i = -radius; i <= radius; ++i) sum += std::exp(-i * i / (2 * variance(b)));
            return share * std::sqrt(kPi / b) * sum * sum;
        };
        const double wide = mass(kBlueYellowShare, kBlueYellow),
                     narrow = mass(kBlueYellowNarrowShare, kBlueYellowNarrow);
        narrow_share = static_cast<float>(narrow / (wide + narrow));

        const double deviation = kFeatureWidthDeg / 2 * pixels_per_degree;
        const int reach = static_cast<int>(std::ceil(3 * deviation));
        blur = gaussian(deviation * deviation, reach);
        edge = derivative(deviation, reach, false);
        point = derivative(deviation, reach, true);
    }
    Kernel luminance, red_green, blue_yellow, blue_yellow_narrow, blur, edge, point;
    float narrow_share;
};

Plane blurred(const Plane& plane, const Kernel& kernel, Size size) {
    return down_columns(along_rows(plane, kernel, size), kernel, size);
}

/// What FLIP sees in one picture.
struct Seen {
    std::vector<glm::dvec3> colour;  ///< filtered by contrast sensitivity, Hunt-adjusted CIELAB
    Plane edges, points;             ///< magnitudes of luminance's derivatives
};

Seen seen(const LinearPicture& picture, const Filters& filters) {
    const Size size{picture.width, picture.height};
    std::array<Plane, 3> planes;
    for (Plane& plane : planes) plane.resize(size.texels());
    for (std::size_t i = 0; i < size.texels(); ++i) {
        const glm::dvec3 ycc = opponent(kToXyz * glm::clamp(picture.rgb[i], 0.0, 1.0) / kWhite);
        for (int c = 0; c < 3; ++c) planes[static_cast<std::size_t>(c)][i] = static_cast<float>(ycc[c]);
    }
    Seen result;
    const Plane y = blurred(planes[0], filters.luminance, size),
                cx = blurred(planes[1], filters.red_green, size),
                cz = blurred(planes[2], filters.blue_yellow, size),
                cz_narrow = blurred(planes[2], filters.blue_yellow_narrow, size);
    for (std::size_t i = 0; i < size.texels(); ++i) {
        const double z = (1 - filters.narrow_share) * cz[i] + filters.narrow_share * cz_narrow[i];
        result.colour.push_back(hunt_lab(glm::clamp(rgb_of_opponent({y[i], cx[i], z}), 0.0, 1.0)));
    }
    const Plane smooth = along_rows(planes[0], filters.blur, size);
    const Plane edge_x = down_columns(along_rows(planes[0], filters.edge, size), filters.blur, size),
                edge_y = down_columns(smooth, filters.edge, size),
                point_x = down_columns(along_rows(planes[0], filters.point, size), filters.blur, size),
                point_y = down_columns(smooth, filters.point, size);
    for (std::size_t i = 0; i < size.texels(); ++i) {
        result.edges.push_back(std::hypot(edge_x[i], edge_y[i]) / 116);
        result.points.push_back(std::hypot(point_x[i], point_y[i]) / 116);
    }
    return result;
}

/// Colour difference of a pixel, 0 to 1 (2020, section 4.1.3).
double colour_difference(const glm::dvec3& a, const glm::dvec3& b) {
    static const double most = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kColourExponent);
    const double difference = std::pow(static_cast<float>(hyab(a, b)), static_cast<float>(kColourExponent)),
                 knee = kColourKnee * most;
    if (difference < knee) return kColourAtKnee / knee * difference;
    return kColourAtKnee + (difference - knee) / (most - knee) * (1 - kColourAtKnee);
}

FlipMap difference(const Seen& a, const Seen& b, Size size) {
    FlipMap map{size.width, size.height, {}};
    for (std::size_t i = 0; i < size.texels(); ++i) {
        const double feature =
            std::max(std::abs(a.edges[i] - b.edges[i]), std::abs(a.points[i] - b.points[i]));
        static_assert(kFeatureExponent == 0.5);
        const double features = std::sqrt(feature / std::numbers::sqrt2);
        map.error.push_back(std::pow(static_cast<float>(colour_difference(a.colour[i], b.colour[i])),
                                     static_cast<float>(1 - features)));
    }
    return map;
}

/// ACES as Narkowicz fitted it ("ACES filmic tone mapping curve", 2015), with his pre-exposure of 0.6 inside.
struct ToneCurve {
    double a = 0.36 * 2.51, b = 0.6 * 0.03, c = 0.36 * 2.43, d = 0.6 * 0.59, e = 0.14;
    double operator()(double x) const { return x * (a * x + b) / (x * (c * x + d) + e); }
    /// The value that becomes `tone`.
    double inverse(double tone) const {
        const double p = a - tone * c, q = b - tone * d, r = -tone * e;
        return (-q + std::sqrt(q * q - 4 * p * r)) / (2 * p);
    }
};

LinearPicture toned(const LinearPicture& picture, double exposure) {
    const ToneCurve curve;
    const double factor = std::exp2(exposure);
    LinearPicture result(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            // Beyond, the curve is flat and its terms overflow.
            const double x = std::clamp(picture.rgb[i][c] * factor, 0.0, 1e6);
            result.rgb[i][c] = std::min(curve(x), 1.0);
        }
    return result;
}

}  // namespace

double default_pixels_per_degree() { return 0.7 * (3840 / 0.7) * kPi / 180; }

double FlipMap::mean() const {
    double sum = 0;
    for (const double value : error) sum += value;
    return error.empty() ? 0 : sum / static_cast<double>(error.size());
}

double FlipMap::max() const { return error.empty() ? 0 : *std::ranges::max_element(error); }

FlipMap ldr_flip(const LinearPicture& reference, const LinearPicture& test, double pixels_per_degree) {
    const Filters filters(pixels_per_degree);
    return difference(seen(reference, filters), seen(test, filters), {reference.width, reference.height});
}

std::pair<double, double> flip_exposures(const LinearPicture& reference) {
    std::vector<double> luminances;
    for (const glm::dvec3& rgb : reference.rgb) {
        const double luminance = (kToXyz * rgb).y;
        luminances.push_back(luminance);
    }
    if (luminances.empty()) return {0, 0};
    const double most = *std::ranges::max_element(luminances);
    if (!(most > 0)) return {0, 0};
    const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
    std::nth_element(luminances.begin(), middle, luminances.end());
    double median = *middle;
    if (!(median > 0)) {  // mostly black: the median of what isn't, or there would be no last exposure
        std::erase_if(luminances, [](double luminance) { return !(luminance > 0); });
        const auto of_lit = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
        std::nth_element(luminances.begin(), of_lit, luminances.end());
        median = *of_lit;
    }
    const double target = ToneCurve{}.inverse(kTargetTone);
    return {std::log2(target / most), std::log2(target / median)};
}

FlipMap hdr_flip(const LinearPicture& reference, const LinearPicture& test,
                 std::optional<std::pair<double, double>> exposures, double pixels_per_degree) {
    const auto [start, stop] = exposures ? *exposures : flip_exposures(reference);
    const int count = std::max(2, static_cast<int>(std::ceil(stop - start)));
    const Filters filters(pixels_per_degree);
    const Size size{reference.width, reference.height};
    FlipMap worst{size.width, size.height, std::vector<double>(size.texels(), 0.0)};
    for (int i = 0; i < count; ++i) {
        const double exposure = start + i * (stop - start) / (count - 1);
        const FlipMap map =
            difference(seen(toned(reference, exposure), filters), seen(toned(test, exposure), filters), size);
        for (std::size_t k = 0; k < map.error.size(); ++k)
            worst.error[k] = std::max(worst.error[k], map.error[k]);
    }
    return worst;
}

}  // namespace pbrbake::verify

#pragma once
// Bakes of photometric files in memory, and their textures read as a shader would: by code that shares
// nothing with the baker's own.

#include <cmath>
#include <functional>
#include <numbers>
#include <string>

#include "bakers/formats.hpp"
#include "bakers/ies/ies.hpp"
#include "bakers/io/io.hpp"
#include "tests/bakers/parse/fixtures.hpp"

namespace pbrbake::ies::test {

inline constexpr double kPi = std::numbers::pi;

/// The schema's defaults.
inline IesParams defaults() {
    IesParams params{};
    params.projection = Projection::latlong;
    params.size = {0};
    params.max_size = 1024;
    params.align = Align::automatic;
    params.normalise = Normalise::max;
    params.lamp_set = 1;
    params.c0 = C0::x;
    params.aim = Aim::minus_z;
    params.squash = 1;
    params.documents = {DocumentKind::light};
    return params;
}

struct Baked {
    Product product;
    Certificate certificate;

    double figure(const std::string& metric) const {
        for (const Figure& figure : certificate.figures)
            if (figure.metric == metric) return figure.value;
        return std::nan("");
    }
    const Json& texture() const { return product.properties["texture"]; }
    /// Candela of a stored value of 1.
    double unit_cd() const { return texture()["candela_per_unit"].get<double>() / product.scale; }
};

inline Inputs inputs_of(const std::string& text, const std::string& name = "lamp.ies") {
    Inputs inputs;
    SourceImage& source = inputs["source"];
    const auto bytes = parse::test::bytes_of(text);
    source.bytes.assign(bytes.begin(), bytes.end());
    source.name = name;
    return inputs;
}

inline Baked bake_text(const std::string& text, const IesParams& params, PixelType pixel = PixelType::half,
                       Accuracy accuracy = {}) {
    const Inputs inputs = inputs_of(text);
    Context context(1, accuracy);
    Baked baked{bake(params, inputs, context), {}};
    baked.product.scale = io::quantise(baked.product.images, pixel);
    baked.certificate = certify(params, inputs, baked.product, context);
    return baked;
}

/// Bilinear, clamped; texel centres at (i + .5) / n.
inline double lookup(const Image& image, int face, double u, double v) {
    const Level& level = image.levels.front();
    const double x = std::clamp(u * level.width - .5, 0., level.width - 1.),
                 y = std::clamp(v * level.height - .5, 0., level.height - 1.);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, level.width - 1), y1 = std::min(y0 + 1, level.height - 1);
    const auto at = [&](int row, int column) {
        return static_cast<double>(*image.texel(0, face, row, column));
    };
    const double top = at(y0, x0) + (at(y0, x1) - at(y0, x0)) * (x - x0),
                 low = at(y1, x0) + (at(y1, x1) - at(y1, x0)) * (x - x0);
    return top + (low - top) * (y - y0);
}

/// What a shader reads in a direction (light's frame, axis -z), by the formulas of the README.
inline double shade(const Image& image, const Json& texture, double x, double y, double z) {
    const std::string projection = texture["projection"];
    const double w = texture["size"][0], h = texture["size"][1];
    const bool ends = texture["align"] == "ends";
    const auto spread = [&](double t, double n) { return ends ? (t * (n - 1) + .5) / n : t; };
    if (projection == "latlong" || projection == "axial") {
        const double polar = std::acos(std::clamp(-z, -1., 1.)) / kPi;
        double azimuth = std::atan2(y, x) / (2 * kPi);
        if (azimuth < 0) azimuth += 1;
        if (projection == "axial") return lookup(image, 0, spread(polar, w), .5);
        // Not aligned to the ends, a row wraps; the fixtures' lookup clamps, which is half a texel.
        return lookup(image, 0, spread(azimuth, w), spread(polar, h));
    }
    if (projection == "octahedral") {
        const double sum = std::abs(x) + std::abs(y) + std::abs(z);
        double px = x / sum, py = y / sum;
        if (z > 0) {
            const double qx = (1 - std::abs(py)) * (px < 0 ? -1 : 1),
                         qy = (1 - std::abs(px)) * (py < 0 ? -1 : 1);
            px = qx, py = qy;
        }
        return lookup(image, 0, spread(px / 2 + .5, w), spread(py / 2 + .5, w));
    }
    if (projection == "cube") {
        const double ax = std::abs(x), ay = std::abs(y), az = std::abs(z);
        if (ax >= ay && ax >= az)
            return x > 0 ? lookup(image, 0, (1 - z / ax) / 2, (1 - y / ax) / 2)
                         : lookup(image, 1, (1 + z / ax) / 2, (1 - y / ax) / 2);
        if (ay >= az)
            return y > 0 ? lookup(image, 2, (1 + x / ay) / 2, (1 + z / ay) / 2)
                         : lookup(image, 3, (1 + x / ay) / 2, (1 - z / ay) / 2);
        return z > 0 ? lookup(image, 4, (1 + x / az) / 2, (1 - y / az) / 2)
                     : lookup(image, 5, (1 - x / az) / 2, (1 - y / az) / 2);
    }
    const double tangent = std::tan(texture["cone_deg"].get<double>() / 2 * kPi / 180);
    const double px = x / (-z * tangent), py = -y / (-z * tangent);
    if (z >= 0 || std::abs(px) > 1 || std::abs(py) > 1) return 0;
    return lookup(image, 0, spread(px / 2 + .5, w), spread(py / 2 + .5, w));
}

/// Integral over the sphere by midpoints in polar angle and azimuth.
inline double integrate_shaded(const Image& image, const Json& texture, int rows = 720) {
    double sum = 0;
    for (int i = 0; i < rows; ++i) {
        const double polar = (i + .5) * kPi / rows, sine = std::sin(polar), down = std::cos(polar);
        // Midpoints weigh a band by sin(middle); the band's solid angle is larger by (h/2) / sin(h/2) for
        // all.
        double row = 0;
        constexpr int columns = 360;
        for (int j = 0; j < columns; ++j) {
            const double azimuth = (j + .5) * 2 * kPi / columns;
            row += shade(image, texture, sine * std::cos(azimuth), sine * std::sin(azimuth), -down);
        }
        sum += row * sine * (2 * kPi / columns);
    }
    const double half = kPi / rows / 2;
    return sum * 2 * std::sin(half);
}

}  // namespace pbrbake::ies::test

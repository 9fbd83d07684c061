#include "bakers/ies/decoded.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pbr/numerics/sum.hpp"

namespace pbrbake::ies {
namespace {

/// Angles of an axis's texels, with the ends of its range where the first and last texel are held to.
struct Held {
    std::vector<double> angles;
    std::vector<int> texels;
};

Held held(const Axis& axis, bool wraps) {
    Held list;
    const auto add = [&](double angle, int texel) {
        list.angles.push_back(angle);
        list.texels.push_back(texel);
    };
    const bool clamps = !axis.ends && !wraps;
    if (clamps) add(axis.first, 0);
    for (int i = 0; i < axis.count; ++i) add(axis.at(i), i);
    if (clamps) add(axis.last, axis.count - 1);
    return list;
}

/// The texture as a web: what is bilinear in polar angle and azimuth is one, so its flux is known exactly.
pbr::PhotometricWeb web_of(const Layout& layout, const Profile& profile, const Image& image) {
    const bool is_row = layout.projection == Projection::axial;
    const Axis& azimuth = is_row ? layout.y : layout.x;
    const Held polar = held(is_row ? layout.x : layout.y, false);
    const bool folds = layout.is_folded && profile.web().cover() == pbr::HorizontalCover::mirrored;
    Held planes = held(azimuth, !folds);
    pbr::HorizontalCover cover = folds ? pbr::HorizontalCover::mirrored : pbr::HorizontalCover::ring;
    if (azimuth.count == 1) {
        cover = pbr::HorizontalCover::axial;
        planes = {{0}, {0}};
    }
    std::vector<double> values;
    values.reserve(planes.texels.size() * polar.texels.size());
    for (const int plane : planes.texels)
        for (const int texel : polar.texels)
            values.push_back(is_row ? *image.texel(0, 0, 0, texel) : *image.texel(0, 0, texel, plane));
    return {pbr::Photometry::type_c, cover, polar.angles, planes.angles, std::move(values)};
}

/// Integral over a face of value(i, j, fx, fy) x density, where (i, j) is a cell between texel centres (-1:
/// before the first) and fx, fy lie in it.
template <class Value>
double integrate_face(const Layout& layout, const Value& value) {
    constexpr std::array<double, 2> kGauss{.21132486540518712, .78867513459481288};  // (1 -+ 1/sqrt 3) / 2
    const Held knots = held(layout.x, false);
    pbr::CompensatedSum sum;
    for (std::size_t j = 0; j + 1 < knots.angles.size(); ++j)
        for (std::size_t i = 0; i + 1 < knots.angles.size(); ++i) {
            const double width = knots.angles[i + 1] - knots.angles[i],
                         height = knots.angles[j + 1] - knots.angles[j];
            double cell = 0;
            for (const double fy : kGauss)
                for (const double fx : kGauss) {
                    const double x = knots.angles[i] + fx * width, y = knots.angles[j] + fy * height;
                    cell += value(i, j, fx, fy, x, y) * face_density(layout, x, y);
                }
            sum += cell * width * height / 4;
        }
    return sum.value();
}

double face_flux(const Layout& layout, const Image& image, int face) {
    const Held knots = held(layout.x, false);
    return integrate_face(layout, [&](std::size_t i, std::size_t j, double fx, double fy, double, double) {
        const auto at = [&](std::size_t row, std::size_t column) {
            return static_cast<double>(*image.texel(0, face, knots.texels[row], knots.texels[column]));
        };
        return (1 - fy) * ((1 - fx) * at(j, i) + fx * at(j, i + 1)) +
               fy * ((1 - fx) * at(j + 1, i) + fx * at(j + 1, i + 1));
    });
}

bool is_web(const Layout& layout) {
    return layout.projection == Projection::latlong || layout.projection == Projection::axial;
}

}  // namespace

Decoded decode(const Layout& layout, const Profile& profile, const Image& image) {
    const std::vector<float>& texels = image.levels.front().texels;
    Decoded decoded;
    decoded.peak = static_cast<double>(*std::max_element(texels.begin(), texels.end()));
    if (is_web(layout))
        decoded.flux = web_of(layout, profile, image).flux_lm();
    else
        for (int face = 0; face < layout.faces(); ++face) decoded.flux += face_flux(layout, image, face);
    return decoded;
}

Decoded truth(const Layout& layout, const Profile& profile) {
    if (layout.projection != Projection::cookie) return {profile.web().flux_lm(), profile.web().max_cd()};
    const double flux =
        integrate_face(layout, [&](std::size_t, std::size_t, double, double, double x, double y) {
            return profile.sample_cd(face_direction(layout, 0, x, y));
        });
    return {flux, profile.max_within_cd(layout.half_cone_deg)};
}

}  // namespace pbrbake::ies

#include "bakers/ies/projection.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/parse/text.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::ies {
namespace {

using Direction = pbr::Vec3<double>;

double tan_deg(double deg) {
    const pbr::SinCos at = pbr::sin_cos_pi(deg / 180);
    return at.sin / at.cos;
}

/// Polar angles that a folded texture spans, or the whole half-circle.
Axis polar_axis(const Profile& profile, bool folded, int count, bool ends) {
    const auto& angles = profile.web().vertical_deg();
    return folded ? Axis{angles.front(), angles.back(), count, ends} : Axis{0, 180, count, ends};
}

Axis azimuth_axis(const Profile& profile, bool folded, int count, bool ends) {
    const auto& angles = profile.web().horizontal_deg();
    if (folded && profile.web().cover() == pbr::HorizontalCover::axial) return {0, 0, 1, true};
    if (folded && profile.web().cover() == pbr::HorizontalCover::mirrored)
        return {angles.front(), angles.back(), count, ends};
    return {0, 360, count, ends};
}

/// The mean over azimuth at a polar angle, cd. Exact for type C; types A and B by 720 samples.
double azimuthal_mean_cd(const Profile& profile, double polar_deg) {
    constexpr int kSamples = 720;
    double sum = 0;
    if (!profile.is_polar()) {
        for (int i = 0; i < kSamples; ++i) sum += profile.sample_cd(polar_deg, (i + .5) * 360 / kSamples);
        return sum / kSamples;
    }
    const pbr::PhotometricWeb& web = profile.web();
    if (web.cover() == pbr::HorizontalCover::axial) return profile.sample_cd(polar_deg, 0);
    // Linear between planes: the trapezoid rule over them is exact.
    const pbr::PhotometricWeb full = web.unfolded();
    const auto& angles = full.horizontal_deg();
    const auto at = [&](std::size_t i) {
        const pbr::GridPlace plane{static_cast<int>(i), static_cast<int>(i), 0};
        return full.blend_cd(full.vertical_place(polar_deg), plane);
    };
    for (std::size_t i = 0; i + 1 < angles.size(); ++i)
        sum += (angles[i + 1] - angles[i]) * (at(i) + at(i + 1)) / 2;
    return sum / 360 * profile.rim_share(polar_deg);
}

void render_latlong(const Layout& layout, const Profile& profile, Image& image, Context& context) {
    const Level& level = image.levels.front();
    // Type C has angles of its own to look up once a row and column.
    const bool direct = profile.is_polar() && profile.web().cover() != pbr::HorizontalCover::range;
    std::vector<pbr::GridPlace> columns;
    for (int x = 0; direct && x < level.width; ++x)
        columns.push_back(profile.web().horizontal_place(layout.x.at(x)));
    const auto rows = [&](std::int64_t begin, std::int64_t end) {
        for (int y = static_cast<int>(begin); y < end; ++y) {
            float* texel = image.texel(0, 0, y, 0);
            const double polar = layout.y.at(y);
            if (!direct) {
                for (int x = 0; x < level.width; ++x)
                    texel[x] = static_cast<float>(profile.sample_cd(polar, layout.x.at(x)));
                continue;
            }
            const pbr::GridPlace row = profile.web().vertical_place(polar);
            // A folded texture ends on the rim, and has all of its light there.
            const double share = layout.is_folded ? 1 : profile.rim_share(polar);
            for (int x = 0; x < level.width; ++x)
                texel[x] = static_cast<float>(
                    share * profile.web().blend_cd(row, columns[static_cast<std::size_t>(x)]));
        }
    };
    constexpr std::int64_t kWorthThreads = 1 << 16;
    if (static_cast<std::int64_t>(level.width) * level.height < kWorthThreads)
        rows(0, level.height);
    else
        context.parallel_for(level.height, 16, rows);
}

void render_faces(const Layout& layout, const Profile& profile, Image& image, Context& context) {
    const Level& level = image.levels.front();
    context.parallel_for(
        static_cast<std::int64_t>(image.faces) * level.height, 16, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t row = begin; row < end; ++row) {
                const int face = static_cast<int>(row / level.height),
                          y = static_cast<int>(row % level.height);
                for (int x = 0; x < level.width; ++x)
                    *image.texel(0, face, y, x) = static_cast<float>(
                        profile.sample_cd(face_direction(layout, face, layout.x.at(x), layout.y.at(y))));
            }
        });
}

std::string span_text(const Axis& axis, const std::string& angle, const std::string& count) {
    const std::string range = parse::number_text(axis.last - axis.first);
    const std::string from =
        axis.first == 0 ? angle : "(" + angle + " - " + parse::number_text(axis.first) + ")";
    if (axis.count == 1) return "0.5";
    if (!axis.ends) return from + " / " + range;
    return "(" + from + " / " + range + " * (" + count + " - 1) + 0.5) / " + count;
}

}  // namespace

Layout make_layout(const IesParams& params, const Profile& profile, int width, int height, bool ends) {
    Layout layout;
    layout.projection = params.projection;
    layout.aim = params.aim;
    if (params.projection == Projection::latlong) {
        layout.is_folded =
            params.fold && profile.is_polar() && profile.web().cover() != pbr::HorizontalCover::range;
        const int rows = height > 0 ? height : std::max(1, width / 2);
        layout.x = azimuth_axis(profile, layout.is_folded, width, ends);
        layout.y = polar_axis(profile, layout.is_folded, rows, ends);
    } else if (params.projection == Projection::axial) {
        layout.is_folded = params.fold && profile.is_polar();
        layout.x = polar_axis(profile, layout.is_folded, width, ends);
        layout.y = {0, 0, 1, true};
    } else {
        if (params.projection == Projection::cube) ends = false;
        layout.x = layout.y = {-1, 1, width, ends};
        if (params.projection == Projection::cookie)
            layout.half_cone_deg =
                params.cone_deg > 0 ? params.cone_deg / 2 : std::clamp(profile.lit_polar_deg(), 1., 80.);
    }
    return layout;
}

Direction face_direction(const Layout& layout, int face, double x, double y) {
    if (layout.projection == Projection::cookie) {
        const double tangent = tan_deg(layout.half_cone_deg);
        return {tangent * x, -tangent * y, -1};
    }
    if (layout.projection == Projection::octahedral) {
        const double forward = 1 - std::abs(x) - std::abs(y);
        if (forward >= 0) return {x, y, -forward};
        return {(1 - std::abs(y)) * (x < 0 ? -1 : 1), (1 - std::abs(x)) * (y < 0 ? -1 : 1), -forward};
    }
    const Direction d = pbr::cube_vector(face, x, y);
    if (layout.aim == Aim::minus_z) return d;
    return {d.x, -d.z, d.y};  // the light's y lies along -z, its axis along -y
}

double face_density(const Layout& layout, double x, double y) {
    if (layout.projection == Projection::cookie) {
        const double tangent = tan_deg(layout.half_cone_deg),
                     square = 1 + tangent * tangent * (x * x + y * y);
        return tangent * tangent / (square * std::sqrt(square));
    }
    if (layout.projection == Projection::octahedral) {
        // A face of the octahedron |x|+|y|+|z| = 1: dA cos / r^2, and cos dA = dx dy / r.
        const Direction p = face_direction(layout, 0, x, y);
        const double square = p.x * p.x + p.y * p.y + p.z * p.z;
        return 1 / (square * std::sqrt(square));
    }
    const double square = 1 + x * x + y * y;
    return 1 / (square * std::sqrt(square));
}

Image render(const Layout& layout, const Profile& profile, Context& context) {
    Image image;
    image.channels = {"Y"};
    image.faces = layout.faces();
    const std::size_t texels = static_cast<std::size_t>(image.faces) * layout.x.count * layout.y.count;
    image.levels.push_back({layout.x.count, layout.y.count, std::vector<float>(texels)});
    if (layout.projection == Projection::latlong)
        render_latlong(layout, profile, image, context);
    else if (layout.projection == Projection::axial)
        for (int x = 0; x < layout.x.count; ++x) {
            const double polar = layout.x.at(x), share = layout.is_folded ? profile.rim_share(polar) : 1;
            *image.texel(0, 0, 0, x) = static_cast<float>(azimuthal_mean_cd(profile, polar) / share);
        }
    else
        render_faces(layout, profile, image, context);
    context.count("photometric_web", texels);
    return image;
}

std::string lookup_text(const Layout& layout, const Profile& profile) {
    const std::string side =
        "x to the right, y up, a along the axis; d is the direction away from the light, of unit length. ";
    switch (layout.projection) {
        case Projection::latlong: {
            std::string text =
                side + "polar = degrees(acos(d.a)), azimuth = degrees(atan2(d.y, d.x)) in [0, 360)";
            if (layout.is_folded && profile.web().cover() == pbr::HorizontalCover::mirrored)
                text += ", folded by mirroring at " + parse::number_text(layout.x.first) + " and " +
                        parse::number_text(layout.x.last);
            if (layout.is_folded)
                text += "; dark for polar outside " + parse::number_text(layout.y.first) + " to " +
                        parse::number_text(layout.y.last);
            return text + "; u = " + span_text(layout.x, "azimuth", "width") +
                   ", v = " + span_text(layout.y, "polar", "height");
        }
        case Projection::axial:
            return side + "polar = degrees(acos(d.a)); u = " + span_text(layout.x, "polar", "width");
        case Projection::octahedral:
        case Projection::cookie: {
            const std::string uv =
                layout.x.ends ? "uv = ((p * 0.5 + 0.5) * (size - 1) + 0.5) / size" : "uv = p * 0.5 + 0.5";
            if (layout.projection == Projection::cookie)
                return side + "p = (d.x, -d.y) / (d.a * tan(cone_deg / 2)); " + uv + "; dark outside";
            return side +
                   "q = d / (|d.x| + |d.y| + |d.a|); p = q.a >= 0 ? q.xy : (1 - |q.yx|) * sign(q.xy); " + uv;
        }
        case Projection::cube:
            break;
    }
    return "a cube map, faces +X -X +Y -Y +Z -Z as OpenGL samples them, right-handed, y up, in the light's "
           "own axes";
}

}  // namespace pbrbake::ies

#pragma once
// How directions lie in a texture.
//
//     latlong     u: azimuth 0 … 360, v: polar angle 0 (the axis) … 180, row 0 at the axis
//     axial       u: polar angle; the mean over azimuth, which keeps the flux
//     octahedral  the axis in the middle, what lies behind in the corners
//     cube        six faces as ibl/cubemap.hpp has them, in the light's axes (`aim`)
//     cookie      gnomonic: what a lamp throws on a wall before it, up to half the cone at the middle of a
//     side
//
// Samples lie at texel centres ("center"), or the first and last sample of an axis lie at the ends of its
// range
// ("ends"), so that a grid that divides the file's keeps its points.

#include "bakers/ies/profile.hpp"
#include "bakers/image.hpp"

namespace pbrbake::ies {

/// One side of a texture: an angle, or -1 … 1.
struct Axis {
    double first = 0, last = 0;
    int count = 1;
    bool ends = true;

    /// Where sample i lies.
    double at(int i) const {
        if (!ends) return first + (last - first) * (i + .5) / count;
        return count == 1 ? first : first + (last - first) * i / (count - 1);
    }
};

/// A texture's layout.
struct Layout {
    Projection projection = Projection::latlong;
    Axis x, y;
    bool is_folded = false;    ///< latlong: x and y span just what the file has, the rest by its symmetry
    double half_cone_deg = 0;  ///< cookie
    Aim aim = Aim::minus_z;    ///< cube

    int faces() const { return projection == Projection::cube ? 6 : 1; }
};

/// The layout of a size. `size` is the width, or the side of a square; height 0: a square, or half of a
/// latlong.
Layout make_layout(const IesParams& params, const Profile& profile, int width, int height, bool ends);

/// The direction, in the light's frame, of a point of a square projection's face, x and y in [-1, 1]; any
/// length.
pbr::Vec3<double> face_direction(const Layout& layout, int face, double x, double y);

/// Solid angle per area of a face at a point, sr.
double face_density(const Layout& layout, double x, double y);

/// The picture in candela, one channel.
Image render(const Layout& layout, const Profile& profile, Context& context);

/// The texture coordinates of a direction, in words: what a shader computes.
std::string lookup_text(const Layout& layout, const Profile& profile);

}  // namespace pbrbake::ies

#pragma once
// Environments as pictures store them, and their exact resampling to cube maps.
//
// A picture is constant over each of its texels: that is the function every integral of this library means.
// Pictures are RGB floats, interleaved, row 0 at the top.

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/numerics/for_each.hpp"

namespace pbr {

/// An equirectangular picture. Its own frame is OpenEXR's for latitude-longitude maps: the top row surrounds
/// +y, the middle of the picture looks at +z, and +x is a quarter of the width to the left of it
/// (right-handed, seen from within). `world_to_source` is a rotation or reflection that takes world
/// directions to that frame.
struct EquirectView {
    const float* rgb = nullptr;
    int width = 0;
    int height = 0;
    glm::dmat3 world_to_source{1.0};

    /// RGB of column x, row y.
    const float* texel(int x, int y) const { return rgb + (static_cast<long>(y) * width + x) * 3; }
};

/// A cube map picture, in the orientation of ibl/cubemap.hpp, faces one after the other.
struct CubeView {
    const float* rgb = nullptr;
    int size = 0;

    /// RGB of column x, row y of a face.
    const float* texel(int face, int x, int y) const {
        return rgb + ((static_cast<long>(face) * size + y) * size + x) * 3;
    }
};

/// Unit vector in the picture's own frame of (u, v) in [0, 1]^2, v = 0 at the top.
glm::dvec3 equirect_direction(double u, double v);

/// (u, v) in [0, 1) x [0, 1] of a direction (any length but 0) in the picture's own frame.
glm::dvec2 equirect_point(const glm::dvec3& direction);

/// The same of many directions at once, within 1e-15 of it; `uv_out` holds as many.
/// Bits do not depend on the vector width, nor on which directions are asked for together.
void equirect_points(std::span<const glm::dvec3> directions, std::span<glm::dvec2> uv_out);

/// Solid angle of a texel of row y, sr: 2 pi / width (cos a - cos b), without cancellation. Relative error
/// below 1e-14.
double equirect_texel_solid_angle(int width, int height, int y);

/// Texels of a cube map of `size`: each the mean radiance of the picture over the texel's solid angle.
/// `rgb_out` holds texels.size() * 3 floats. Every texel's integral is exact in colatitude and by quadrature
/// in longitude between the picture's columns, cut where an edge of the texel leaves a row. Error, as a share
/// of the contrast between neighbouring texels of the picture: below 1e-5; 0 for a constant picture.
void resample_area(const EquirectView& source, int size, std::span<const CubeTexel> texels,
                   std::span<float> rgb_out);

/// The same for row y of a face.
void resample_area(const EquirectView& source, int size, int face, int y, std::span<float> rgb_out);

/// All faces at once, in rgb_out[((face * size + y) * size + x) * 3], more than ten times faster where
/// world_to_source takes the picture's vertical axis to an axis of the cube, its width is a multiple of 4
/// from 64 up and, for the two faces at the poles, `size` is even. By two points between columns:
/// error 1.2e-3 root mean square, 2.5e-2 at most, but as above for texels more than 20 times as bright as the
/// mean and their neighbours (of the brightest in 256).
void resample_area(const EquirectView& source, int size, const ForEach& each, std::span<float> rgb_out);

/// The same for a cube map of another size: exact.
void resample_area(const CubeView& source, int size, int face, int y, std::span<float> rgb_out);

/// Row y of a face, each texel the bilinear interpolation of the picture at the texel's centre; wraps around
/// the seam and over the poles, and for cube maps across edges.
void resample_bilinear(const EquirectView& source, int size, int face, int y, std::span<float> rgb_out);
void resample_bilinear(const CubeView& source, int size, int face, int y, std::span<float> rgb_out);

/// All faces at once, laid out as resample_area's, several times faster where that is. Differs by rounding.
void resample_bilinear(const EquirectView& source, int size, const ForEach& each, std::span<float> rgb_out);

}  // namespace pbr

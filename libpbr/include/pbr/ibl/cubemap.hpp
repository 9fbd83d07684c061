#pragma once
// Cube map geometry: directions, texels, solid angles, neighbours.
//
// Right-handed, y up, faces in the order +X -X +Y -Y +Z -Z, each as OpenGL samples it (OpenGL 4.6
// specification, table 8.19). Texel (x, y) of a face of n texels a side covers s in [2x/n - 1, 2(x+1)/n - 1],
// t likewise, row 0 at t = -1.
//
//                 +----+
//                 | +Y |          s to the right, t downwards
//            +----+----+----+----+
//            | -X | +Z | +X | -Z |
//            +----+----+----+----+
//                 | -Y |
//                 +----+

#include <cmath>
#include <glm/vec3.hpp>
#include <vector>

namespace pbr {

/// A point of a cube map: face 0-5, s and t in [-1, 1].
struct CubePoint {
    int face;
    double s;
    double t;
};

/// A texel of a cube map.
struct CubeTexel {
    int face;
    int x;
    int y;
    bool operator==(const CubeTexel&) const = default;
};

/// The vector from the centre to a point of the cube of half side 1; not normalised. s and t may lie outside
/// [-1, 1].
constexpr glm::dvec3 cube_vector(int face, double s, double t) {
    switch (face) {
        case 0:
            return {1, -t, -s};
        case 1:
            return {-1, -t, s};
        case 2:
            return {s, 1, t};
        case 3:
            return {s, -1, -t};
        case 4:
            return {s, -t, 1};
        default:
            return {-s, -t, -1};
    }
}

/// Where a direction (any length but 0) pierces the cube. Of equal components the order is x, y, z.
constexpr CubePoint cube_point(const glm::dvec3& d) {
    const double ax = d.x < 0 ? -d.x : d.x, ay = d.y < 0 ? -d.y : d.y, az = d.z < 0 ? -d.z : d.z;
    if (ax >= ay && ax >= az)
        return d.x > 0 ? CubePoint{0, -d.z / ax, -d.y / ax} : CubePoint{1, d.z / ax, -d.y / ax};
    if (ay >= az) return d.y > 0 ? CubePoint{2, d.x / ay, d.z / ay} : CubePoint{3, d.x / ay, -d.z / ay};
    return d.z > 0 ? CubePoint{4, d.x / az, -d.y / az} : CubePoint{5, -d.x / az, -d.y / az};
}

/// s or t at the middle of texel `index` of `size`; size >= 1. Indices outside 0 … size-1 continue the grid.
constexpr double cube_coordinate(int index, int size) { return (2 * index + 1.0) / size - 1; }

/// Unit vector to the middle of a texel.
inline glm::dvec3 cubemap_texel_direction(const CubeTexel& texel, int size) {
    const double s = cube_coordinate(texel.x, size), t = cube_coordinate(texel.y, size);
    return cube_vector(texel.face, s, t) / std::sqrt(1 + s * s + t * t);
}

/// The texel that a direction (any length but 0) falls into.
CubeTexel cubemap_texel(const glm::dvec3& direction, int size);

/// Solid angle of the rectangle [s0, s1] x [t0, t1] of a face, sr: two triangles after Van Oosterom &
/// Strackee (1983, "The solid angle of a plane triangle", eq. 8). Relative error below 1e-13 at any size; 0
/// for an empty rectangle.
double cube_rectangle_solid_angle(double s0, double s1, double t0, double t1);

/// Solid angle of texel (x, y) of any face, sr. The texels of a cube sum to 4 pi within 1e-12.
double cubemap_texel_solid_angle(int size, int x, int y);

/// Those of a whole face, by rows: the same on all faces.
std::vector<double> cubemap_solid_angles(int size);

/// The texel that lies across the edge from (x, y), where x or y (not both) is -1 or size: the one that
/// shares that piece of the edge. For an (x, y) inside the face, that texel itself.
CubeTexel cubemap_neighbour(int face, int x, int y, int size);

}  // namespace pbr

#include "pbr/ibl/cubemap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pbr/numerics/elementary.hpp"

namespace pbr {
namespace {

int texel_index(double coordinate, int size) {
    return std::clamp(static_cast<int>(std::floor((coordinate + 1) * 0.5 * size)), 0, size - 1);
}

/// Solid angle of the triangle (a, b, c) in the plane z = 1, given twice its area (its determinant there).
double triangle_solid_angle(const double (&a)[2], const double (&b)[2], const double (&c)[2],
                            double twice_area) {
    const auto dot = [](const double(&p)[2], const double(&q)[2]) { return 1 + p[0] * q[0] + p[1] * q[1]; };
    const double la = std::sqrt(dot(a, a)), lb = std::sqrt(dot(b, b)), lc = std::sqrt(dot(c, c));
    return 2 * atan2_exact(twice_area, la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la);
}

}  // namespace

CubeTexel cubemap_texel(const glm::dvec3& direction, int size) {
    const CubePoint point = cube_point(direction);
    return {point.face, texel_index(point.s, size), texel_index(point.t, size)};
}

double cube_rectangle_solid_angle(double s0, double s1, double t0, double t1) {
    const double p00[2] = {s0, t0}, p10[2] = {s1, t0}, p01[2] = {s0, t1}, p11[2] = {s1, t1};
    const double twice_area = (s1 - s0) * (t1 - t0);
    return triangle_solid_angle(p00, p10, p11, twice_area) + triangle_solid_angle(p00, p11, p01, twice_area);
}

double cubemap_texel_solid_angle(int size, int x, int y) {
    return cube_rectangle_solid_angle(2.0 * x / size - 1, 2.0 * (x + 1) / size - 1, 2.0 * y / size - 1,
                                      2.0 * (y + 1) / size - 1);
}

std::vector<double> cubemap_solid_angles(int size) {
    // Those of an eighth of the face, and its mirror images.
    const std::size_t n = static_cast<std::size_t>(size);
    std::vector<double> solid_angles(n * n);
    for (int y = 0; 2 * y < size; ++y)
        for (int x = y; 2 * x < size; ++x) {
            const double solid_angle = cubemap_texel_solid_angle(size, x, y);
            for (const auto& [column, row] : {std::pair{x, y}, std::pair{y, x}})
                for (const int j : {row, size - 1 - row})
                    for (const int i : {column, size - 1 - column}) solid_angles[j * n + i] = solid_angle;
        }
    return solid_angles;
}

CubeTexel cubemap_neighbour(int face, int x, int y, int size) {
    if (x >= 0 && x < size && y >= 0 && y < size) return {face, x, y};
    // A point a hair beyond the edge lies in the texel that shares it.
    constexpr double kBeyond = 1 + 1e-9;
    const auto coordinate = [&](int index) {
        return index < 0 ? -kBeyond : index >= size ? kBeyond : cube_coordinate(index, size);
    };
    return cubemap_texel(cube_vector(face, coordinate(x), coordinate(y)), size);
}

}  // namespace pbr

#include "src/ibl/cube_images.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "pbr/ibl/cubemap.hpp"

namespace pbr {
namespace {

struct FaceVectors {
    glm::dvec3 normal, s, t;  ///< in the picture's frame
};

FaceVectors face_vectors(const EquirectView& source, int face) {
    const glm::dvec3 normal = source.world_to_source * cube_vector(face, 0, 0);
    return {normal, source.world_to_source * cube_vector(face, 1, 0) - normal,
            source.world_to_source * cube_vector(face, 0, 1) - normal};
}

/// True if columns grow from p towards q, which is square to it: u falls with longitude.
bool is_eastward(const glm::dvec3& p, const glm::dvec3& q) { return q.x * p.z - q.z * p.x < 0; }

}  // namespace

std::optional<CubeFaces> CubeFaces::of(const EquirectView& source, int size) {
    constexpr int kFewestColumns = 64;  // the series of add_wedge are good for their width
    const auto is_zero = [](double x) { return std::abs(x) < 1e-12; };
    if (source.width % 4 != 0 || source.width < kFewestColumns) return std::nullopt;
    CubeFaces faces;
    for (int face = 0; face < 6; ++face) {
        const FaceVectors v = face_vectors(source, face);
        if (is_zero(v.normal.x) && is_zero(v.normal.z))
            faces.add_pierced(source, size, face);
        else if (is_zero(v.normal.y) && (is_zero(v.s.y) || is_zero(v.t.y)))
            faces.add_beside(source, size, face);
        else
            return std::nullopt;
    }
    return faces;
}

void CubeFaces::add_beside(const EquirectView& source, int size, int face) {
    const FaceVectors v = face_vectors(source, face);
    const bool across_is_s = std::abs(v.s.y) < 1e-12;
    const glm::dvec3 &across = across_is_s ? v.s : v.t, &up = across_is_s ? v.t : v.s;
    const long of_i = across_is_s ? 1 : size, of_j = across_is_s ? size : 1;
    const bool eastward = is_eastward(v.normal, across);
    const int column = column_of(source, v.normal);
    for (const bool south : {false, true}) {
        const bool upward = (up.y > 0) != south;
        const int first = upward ? size / 2 : size - 1 - size / 2;  // of j
        beside.push_back({column, south,
                          static_cast<long>(face) * size * size + first * of_j +
                              (eastward ? 0 : static_cast<long>(size - 1) * of_i),
                          eastward ? of_i : -of_i, upward ? of_j : -of_j});
    }
}

void CubeFaces::add_pierced(const EquirectView& source, int size, int face) {
    const FaceVectors v = face_vectors(source, face);
    struct Axis {
        glm::dvec3 direction;
        long x, y;  ///< in texels
    };
    std::array<Axis, 4> axes{Axis{v.s, 1, 0}, {v.t, 0, 1}, {-v.s, -1, 0}, {-v.t, 0, -1}};
    if (!is_eastward(v.s, v.t)) std::swap(axes[1], axes[3]);
    for (std::size_t k = 0; k < 4; ++k) {
        const Axis &a = axes[k], &b = axes[(k + 1) % 4];
        // Texel (0, 0) lies beside the middle towards both axes.
        const long x = (size - 1 + a.x + b.x) / 2, y = (size - 1 + a.y + b.y) / 2;
        pierced.push_back({column_of(source, a.direction), v.normal.y < 0,
                           (static_cast<long>(face) * size + y) * size + x, a.y * size + a.x,
                           b.y * size + b.x});
    }
}

}  // namespace pbr

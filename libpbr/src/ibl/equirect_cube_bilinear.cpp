// A whole cube map from an equirect by bilinear interpolation: eight images of one pattern
// (src/ibl/cube_images.hpp).

#include <cmath>
#include <optional>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "src/ibl/cube_images.hpp"
#include "src/simd/cube_images_kernel.hpp"

namespace pbr {
namespace {

/// Points of the picture for directions whose azimuth counts from the middle of a face.
std::vector<BilinearPoint> points_of(const EquirectView& source, const std::vector<glm::dvec3>& directions,
                                     double phase) {
    std::vector<glm::dvec2> uv(directions.size());
    equirect_points(directions, uv);
    std::vector<BilinearPoint> points;
    for (const glm::dvec2& at : uv) {
        const double x = (at.x - 0.5) * source.width + phase - 0.5, y = at.y * source.height - 0.5;
        const double left = std::floor(x), top = std::floor(y);
        points.push_back({static_cast<int>(left), static_cast<int>(top), x - left, y - top});
    }
    return points;
}

/// Row j of half a face beside the axis: direction = normal + a across + b up, a eastward.
std::vector<glm::dvec3> beside_row(int size, int j) {
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < size; ++i)
        directions.emplace_back(-cube_coordinate(i, size), (2.0 * j + 1 - size % 2) / size, 1);
    return directions;
}

/// Row j of a quadrant of a face that the axis pierces: direction = axis + a e + b f, f to the east of e.
std::vector<glm::dvec3> pierced_row(int size, int j) {
    std::vector<glm::dvec3> directions;
    for (int i = 0; i < size / 2; ++i)
        directions.emplace_back(-(2.0 * j + 1) / size, 1, (2.0 * i + 1) / size);
    return directions;
}

}  // namespace

void resample_bilinear(const EquirectView& source, int size, const ForEach& each, std::span<float> rgb_out) {
    const std::optional<CubeFaces> faces = CubeFaces::of(source, size);
    if (!faces || size % 2 != 0)
        return each(6 * size, [&](int row) {
            const std::size_t stride = static_cast<std::size_t>(size) * 3;
            resample_bilinear(source, size, row / size, row % size,
                              rgb_out.subspan(static_cast<std::size_t>(row) * stride, stride));
        });
    const int half = size / 2;
    each(size, [&](int task) {
        const bool beside = task < half;
        const int j = task % half;
        interpolate_images(
            source, beside ? faces->beside : faces->pierced,
            points_of(source, beside ? beside_row(size, j) : pierced_row(size, j), faces->phase), j, rgb_out);
    });
}

}  // namespace pbr

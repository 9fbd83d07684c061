#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pbr/numerics/quadrature.hpp"
#include "src/ibl/flux_grid.hpp"
#include "src/ibl/lat_long_grid.hpp"

namespace pbr {
namespace {

/// A point of light in grid coordinates.
struct Point {
    float column;  ///< fraction of a grid step beyond `x`
    float row;     ///< beyond `y`
    int x, y;
    double rgb[3];
};

/// All points of one row of texels of a face, less a constant; the texels left out have none.
void add_points(const CubeView& source, const PicturePart& part, int face, int y, const QuadratureRule& rule,
                int columns, int rows, std::vector<Point>& points) {
    const auto [left_out, end] =
        std::equal_range(part.without.begin(), part.without.end(), CubeTexel{face, 0, y},
                         [](const CubeTexel& p, const CubeTexel& q) {
                             return std::pair(p.face, p.y) < std::pair(q.face, q.y);
                         });
    std::vector<int> kept;
    for (int x = 0; x < source.size; ++x)
        if (std::none_of(left_out, end, [x](const CubeTexel& texel) { return texel.x == x; }))
            kept.push_back(x);
    std::vector<glm::dvec3> directions;
    for (const int x : kept)
        for (int j = 0; j < rule.size(); ++j)
            for (int i = 0; i < rule.size(); ++i)
                directions.push_back(cube_vector(face, 2 * (x + rule.nodes[i]) / source.size - 1,
                                                 2 * (y + rule.nodes[j]) / source.size - 1));
    std::vector<glm::dvec2> at(directions.size());
    equirect_points(directions, at);
    for (const int x : kept) {
        const std::size_t first = points.size();
        double sum = 0;
        for (int j = 0; j < rule.size(); ++j)
            for (int i = 0; i < rule.size(); ++i) {
                const double length2 = glm::dot(directions[points.size()], directions[points.size()]),
                             weight = rule.weights[i] * rule.weights[j] / (length2 * std::sqrt(length2));
                const double column = at[points.size()].x * columns, row = at[points.size()].y * rows - 0.5;
                const double left = std::floor(column), top = std::floor(row);
                points.push_back({static_cast<float>(column - left),
                                  static_cast<float>(row - top),
                                  static_cast<int>(left),
                                  static_cast<int>(top),
                                  {weight, 0, 0}});
                sum += weight;
            }
        const float* texel = source.texel(face, x, y);
        const double solid_angle = cubemap_texel_solid_angle(source.size, x, y);
        for (std::size_t k = first; k < points.size(); ++k) {
            const double flux = points[k].rgb[0] / sum * solid_angle;
            for (std::size_t c = 0; c < 3; ++c)
                points[k].rgb[c] =
                    flux * (static_cast<double>(texel[c]) - static_cast<double>(part.constant[c]));
        }
    }
}

}  // namespace

FluxGrid spread_cube(const CubeView& source, const PicturePart& part, int grid_columns, int points_a_side,
                     const ForEach& each) {
    FluxGrid grid((grid_columns / 2 + 1) / 2 * 2, grid_columns);
    const int rows = grid.rows(), columns = grid.columns();
    const QuadratureRule rule = gauss_legendre(points_a_side);
    std::vector<std::vector<Point>> of_row(static_cast<std::size_t>(6) * source.size);
    each(6 * source.size, [&](int i) {
        add_points(source, part, i / source.size, i % source.size, rule, columns, rows,
                   of_row[static_cast<std::size_t>(i)]);
    });
    // By grid rows, in the order of the texels, so that sums don't depend on who computes them.
    std::vector<std::vector<const Point*>> near(static_cast<std::size_t>(rows) + 1);
    for (const std::vector<Point>& row : of_row)
        for (const Point& point : row) near[static_cast<std::size_t>(point.y + 1)].push_back(&point);
    each(rows, [&](int target) {
        // A point's six rows lie from two above it on; over a pole rows go on with the azimuth turned by pi.
        const auto take = [&](int virtual_row) {
            const bool across = virtual_row < 0 || virtual_row >= rows;
            for (int offset = -2; offset <= 3; ++offset) {
                const int y = virtual_row - offset;
                if (y < -1 || y >= rows) continue;
                for (const Point* point : near[static_cast<std::size_t>(y + 1)]) {
                    const double weight = lagrange_weights(
                        static_cast<double>(point->row))[static_cast<std::size_t>(offset + 2)];
                    const std::array<double, 6> wx = lagrange_weights(static_cast<double>(point->column));
                    for (int k = 0; k < 6; ++k) {
                        const int x = (point->x - 2 + k + columns + (across ? columns / 2 : 0)) % columns;
                        double* rgb = grid.rgb(x, target);
                        for (int c = 0; c < 3; ++c)
                            rgb[c] += weight * wx[static_cast<std::size_t>(k)] * point->rgb[c];
                    }
                }
            }
        };
        take(target);
        if (target < 3) take(-1 - target);
        if (target >= rows - 3) take(2 * rows - 1 - target);
    });
    return grid;
}

}  // namespace pbr

#include <algorithm>
#include <array>
#include <cmath>

#include "pbr/ibl/equirect_rows.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "src/ibl/flux_grid.hpp"
#include "src/ibl/lat_long_grid.hpp"
#include "src/simd/spread_kernel.hpp"

namespace pbr {
namespace {

/// What a row of the picture adds to a row of the grid; across a pole, where azimuths turn by pi, or not.
struct RowShare {
    int source_row;
    bool across;
    double weight;
};

/// The shares of all rows of the grid.
std::vector<std::vector<RowShare>> row_shares(int height, int points, int rows) {
    const QuadratureRule rule = gauss_legendre(points);
    std::vector<std::vector<RowShare>> shares(static_cast<std::size_t>(rows));
    const auto add = [&](int virtual_row, int source_row, double weight) {
        const bool across = virtual_row < 0 || virtual_row >= rows;
        const int row = virtual_row < 0       ? -1 - virtual_row
                        : virtual_row >= rows ? 2 * rows - 1 - virtual_row
                                              : virtual_row;
        std::vector<RowShare>& of_row = shares[static_cast<std::size_t>(row)];
        const bool known = !of_row.empty() && of_row.back().source_row == source_row;
        if (known && of_row.back().across == across)
            of_row.back().weight += weight;
        else
            of_row.push_back({source_row, across, weight});
    };
    for (int y = 0; y < height; ++y) {
        // cos a - cos b = 2 sin((a + b)/2) sin((b - a)/2)
        const double area = 2 * sin_cos_pi((y + 0.5) / height).sin * sin_cos_pi(0.5 / height).sin;
        double sum = 0;
        for (int i = 0; i < points; ++i)
            sum += rule.weights[i] * sin_cos_pi((y + rule.nodes[i]) / height).sin;
        for (int i = 0; i < points; ++i) {
            const double v = (y + rule.nodes[i]) / height, at = v * rows - 0.5;
            const int top = static_cast<int>(std::floor(at));
            const std::array<double, 6> weights = lagrange_weights(at - top);
            const double share = rule.weights[i] * sin_cos_pi(v).sin / sum * area;
            for (int k = 0; k < 6; ++k) add(top - 2 + k, y, share * weights[static_cast<std::size_t>(k)]);
        }
    }
    return shares;
}

/// Columns of the picture before and behind a row, so that sums need not wrap.
int padding(int width, int columns) { return 4 * width / columns + 2; }

/// What each column of the grid is made of.
std::vector<ColumnSum> column_sums(int width, int columns) {
    std::vector<ColumnSum> sums(static_cast<std::size_t>(columns));
    const int margin = padding(width, columns);
    for (int x = -margin; x < width + margin; ++x) {
        const double at = (x + 0.5) / width * columns, left = std::floor(at);
        const std::array<double, 6> weights = lagrange_weights(at - left);
        for (int k = 0; k < 6; ++k) {
            const int column = static_cast<int>(left) - 2 + k;
            if (column < 0 || column >= columns) continue;
            ColumnSum& sum = sums[static_cast<std::size_t>(column)];
            if (sum.weights.empty()) sum.first = x;
            sum.weights.push_back(static_cast<float>(weights[static_cast<std::size_t>(k)]));
        }
    }
    return sums;
}

/// Sums of rows are in floats, of what texels differ from the constant: a constant picture sums to 0.
class RowSum {
  public:
    RowSum(int width, int margin)
        : width_(width), margin_(margin), sums_((static_cast<std::size_t>(width) + 2 * margin) * 3 + 1) {}

    /// The sums from column 0 on, continued on both sides.
    const float* of(std::span<const WeightedRow> rows, const std::array<float, 3>& constant) {
        sum_rows(rows, width_, constant, texel(0));
        for (int k = 0; k < margin_; ++k) {
            std::copy_n(texel((width_ - 1 - k % width_)), 3, texel(-1 - k));
            std::copy_n(texel(k % width_), 3, texel(width_ + k));
        }
        return texel(0);
    }

  private:
    float* texel(int x) { return &sums_[static_cast<std::size_t>(x + margin_) * 3]; }

    int width_, margin_;
    std::vector<float> sums_;
};

}  // namespace

FluxGrid spread_equirect(const EquirectView& source, const PicturePart& part, int grid_rows, int grid_columns,
                         int points_a_row, const ForEach& each) {
    FluxGrid grid(grid_rows, grid_columns);
    const EquirectRows rows(source, part);
    const std::vector<std::vector<RowShare>> shares = row_shares(source.height, points_a_row, grid.rows());
    const bool keeps_columns = grid_columns == source.width;
    const std::vector<ColumnSum> columns =
        keeps_columns ? std::vector<ColumnSum>() : column_sums(source.width, grid.columns());
    const int margin = padding(source.width, grid.columns());
    each(grid.rows(), [&](int y) {
        std::vector<double> rgb(static_cast<std::size_t>(grid.columns()) * 3);
        RowSum sum(source.width, margin);
        for (const bool across : {false, true}) {
            std::vector<WeightedRow> summands;
            for (const RowShare& share : shares[static_cast<std::size_t>(y)])
                if (share.across == across)
                    summands.push_back({rows.row(share.source_row), static_cast<float>(share.weight)});
            if (summands.empty()) continue;
            const float* row = sum.of(summands, part.constant);
            if (keeps_columns)
                std::copy_n(row, rgb.size(), rgb.begin());
            else
                sum_columns(row, columns, rgb.data());
            const int turn = across ? grid.columns() / 2 : 0;
            for (int x = 0; x < grid.columns(); ++x)
                for (std::size_t c = 0; c < 3; ++c)
                    grid.rgb((x + turn) % grid.columns(), y)[c] += rgb[static_cast<std::size_t>(x) * 3 + c];
        }
    });
    return grid;
}

}  // namespace pbr

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "src/ibl/flux_grid.hpp"
#include "src/ibl/lat_long_grid.hpp"
#include "src/simd/spread_kernel.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;

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

/// A weighted sum of rows, in floats from what each differs from a constant: a constant picture sums to 0.
class RowSum {
  public:
    RowSum(const EquirectView& source, const std::array<float, 3>& constant,
           std::span<const CubeTexel> without, int margin)
        : source_(source),
          constant_(constant),
          without_(without),
          margin_(margin),
          sums_((static_cast<std::size_t>(source.width) + 2 * margin) * 3 + 1) {}

    /// Texels left out count as black.
    void add(int row, float weight) {
        const auto [left_out, end] =
            std::equal_range(without_.begin(), without_.end(), CubeTexel{0, 0, row},
                             [](const CubeTexel& p, const CubeTexel& q) { return p.y < q.y; });
        int from = 0;
        const auto add_until = [&](int to) {
            add_scaled(source_.texel(from, row), to - from, weight, constant_, texel(from));
        };
        for (auto black = left_out; black != end; ++black) {
            add_until(black->x);
            for (std::size_t c = 0; c < 3; ++c) texel(black->x)[c] -= weight * constant_[c];
            from = black->x + 1;
        }
        add_until(source_.width);
    }

    /// The sums from column 0 on, continued on both sides.
    const float* wrapped() {
        const int width = source_.width;
        for (int k = 0; k < margin_; ++k) {
            std::copy_n(texel((width - 1 - k % width)), 3, texel(-1 - k));
            std::copy_n(texel(k % width), 3, texel(width + k));
        }
        return texel(0);
    }

  private:
    float* texel(int x) { return &sums_[static_cast<std::size_t>(x + margin_) * 3]; }

    const EquirectView& source_;
    std::array<float, 3> constant_;
    std::span<const CubeTexel> without_;
    int margin_;
    std::vector<float> sums_;
};

}  // namespace

FluxGrid spread_equirect(const EquirectView& source, const std::array<float, 3>& constant, int grid_rows,
                         int points_a_row, std::span<const CubeTexel> without, const ForEach& each) {
    FluxGrid grid(grid_rows);
    const std::vector<std::vector<RowShare>> rows = row_shares(source.height, points_a_row, grid.rows());
    const std::vector<ColumnSum> columns = column_sums(source.width, grid.columns());
    const int margin = padding(source.width, grid.columns());
    each(grid.rows(), [&](int y) {
        std::vector<double> rgb(static_cast<std::size_t>(grid.columns()) * 3);
        for (const bool across : {false, true}) {
            RowSum sum(source, constant, without, margin);
            bool found = false;
            for (const RowShare& share : rows[static_cast<std::size_t>(y)])
                if (share.across == across) {
                    sum.add(share.source_row, static_cast<float>(share.weight));
                    found = true;
                }
            if (!found) continue;
            sum_columns(sum.wrapped(), columns, rgb.data());
            const int turn = across ? grid.columns() / 2 : 0;
            for (int x = 0; x < grid.columns(); ++x)
                for (std::size_t c = 0; c < 3; ++c)
                    grid.rgb((x + turn) % grid.columns(), y)[c] += rgb[static_cast<std::size_t>(x) * 3 + c];
        }
    });
    return grid;
}

}  // namespace pbr

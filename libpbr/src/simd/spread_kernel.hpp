#pragma once
// Sums over rows and columns of a picture.

#include <array>
#include <span>
#include <vector>

namespace pbr {

/// A row of RGB in a sum of rows.
struct WeightedRow {
    const float* rgb;
    float weight;
};

/// sums[i] = the sum over rows, in their order, of weight * (rgb[i] - constant of its channel).
void sum_rows(std::span<const WeightedRow> rows, long texels, const std::array<float, 3>& constant,
              float* sums);

/// Neighbouring columns that a column of a grid is the weighted sum of.
struct ColumnSum {
    int first;  ///< may be negative
    std::vector<float> weights;
};

/// rgb_out[3 i] … = the sum over columns x of weight times rgb[3 x] …, for all of `columns`. Reads a float
/// past the last column.
void sum_columns(const float* rgb, std::span<const ColumnSum> columns, double* rgb_out);

/// Sums and largest values of a row's channels.
struct RowLight {
    std::array<double, 3> sum{};
    std::array<float, 3> largest{};  ///< at least 0
};
RowLight row_light(const float* rgb, long texels);

}  // namespace pbr

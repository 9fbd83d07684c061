#include "src/ibl/texel_shares.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "pbr/ibl/environment.hpp"

namespace pbr {
namespace {

/// Turns of an outline, rad, that are more than rounding: it goes about a pole or passes through it.
constexpr double kTurns = 1e-6;

/// Of a texel's solid angle: less is rounding.
constexpr double kLeast = 1e-10;

}  // namespace

RowShares mirrored(const RowShares& row, int reflected, int width) {
    RowShares result = row;
    auto shares = result.shares.begin();
    for (TexelRun& run : result.runs) {
        const int column = (reflected - run.column - (run.count - 1)) % width;  // of its last texel
        run.column = column < 0 ? column + width : column;
        std::reverse(shares, shares + run.count);
        shares += run.count;
    }
    return result;
}

GridShares::GridShares(const Graticule& graticule, const TexelGrid& grid, int first, int last)
    : graticule_(graticule),
      column_width_(2 * std::numbers::pi / graticule.width()),
      columns_(grid.columns),
      first_(first),
      rows_(last - first),
      // Columns grow clockwise about +y: seen from outside, the picture's own frame is a mirror image.
      orientation_(glm::dot(glm::cross(grid.s, grid.t), grid.centre) < 0 ? 1 : -1),
      along_(graticule),
      upright_(graticule) {
    std::vector<std::vector<Corner>> lines;
    for (int j = first; j <= last; ++j) {
        lines.push_back(corners(grid, j));
        along_.add_line(circle_through(grid.corner(0, j), grid.corner(columns_, j)), lines.back());
    }
    std::vector<Corner> upright(lines.size());
    for (int i = 0; i <= columns_; ++i) {
        std::ranges::transform(lines, upright.begin(), [&](const auto& line) { return line[i]; });
        upright_.add_line(circle_through(grid.corner(i, first), grid.corner(i, last)), upright);
    }
}

std::vector<Corner> GridShares::corners(const TexelGrid& grid, int j) const {
    std::vector<glm::dvec3> directions;
    for (int i = 0; i <= columns_; ++i) directions.push_back(grid.corner(i, j));
    std::vector<glm::dvec2> uv(directions.size());
    equirect_points(directions, uv);
    const int width = graticule_.width(), height = graticule_.height();
    std::vector<Corner> result;
    for (std::size_t i = 0; i < uv.size(); ++i) {
        const glm::dvec3& d = directions[i];
        const double beside = std::sqrt(d.x * d.x + d.z * d.z);
        const int column = static_cast<int>(uv[i].x * width + graticule_.phase());
        result.push_back({beside > 0 ? glm::dvec2(-d.z, d.x) / beside : glm::dvec2(1, 0), column % width,
                          std::min(static_cast<int>(uv[i].y * height), height - 1)});
    }
    return result;
}

const RowShares& GridShares::of_row(int j) {
    shares_.texels.clear();
    shares_.runs.clear();
    shares_.shares.clear();
    for (int i = 0; i < columns_; ++i) add_texel(outline(i, j - first_));
    return shares_;
}

GridShares::Outline GridShares::outline(int i, int j) const {
    const Edge &below = along_.edge(j * columns_ + i), &above = along_.edge((j + 1) * columns_ + i),
               &left = upright_.edge(i * rows_ + j), &right = upright_.edge((i + 1) * rows_ + j);
    return {Side{&along_, &below, orientation_},
            {&upright_, &right, orientation_},
            {&along_, &above, -orientation_},
            {&upright_, &left, -orientation_}};
}

void GridShares::add_texel(const Outline& outline) {
    double turn = 0;
    for (const Side& side : outline) turn += side.sign * side.edge->width;
    const Box box = box_about(outline, turn);
    const auto cells = static_cast<std::size_t>(box.columns) * static_cast<std::size_t>(box.rows);
    cells_.assign(cells, {});
    for (const Side& side : outline) add_side(side, box);
    add_shares(box, turn);
}

/// Beside a pole an outline turns about it, and may have texels of all columns.
GridShares::Box GridShares::box_about(const Outline& outline, double turn) const {
    const int width = graticule_.width();
    int reference = -1, west = 0, east = 0, top = graticule_.height(), bottom = 0;
    for (const Side& side : outline) {
        const Edge& edge = *side.edge;
        if (edge.first == edge.last) continue;
        if (reference < 0) reference = west = east = edge.west;
        int begin = edge.west - reference;  // the short way round
        begin = reference + (begin >= width - width / 2 ? begin - width
                             : begin < -(width / 2)     ? begin + width
                                                        : begin);
        west = std::min(west, begin);
        east = std::max(east, begin + edge.east - edge.west);
        top = std::min(top, edge.top);
        bottom = std::max(bottom, edge.bottom);
    }
    if (turn > kTurns) top = 0;
    if (turn < -kTurns) bottom = graticule_.height() - 1;
    if (std::abs(turn) > kTurns || east - west + 1 > width) west = 0, east = width - 1;
    return {west < 0 ? west + width : west, top, east - west + 1, bottom - top + 1};
}

void GridShares::add_side(const Side& side, const Box& box) {
    const int width = graticule_.width();
    for (const EdgePiece& piece : side.edges->pieces(*side.edge)) {
        int column = piece.column - box.west;
        column = column < 0 ? column + width : column >= width ? column - width : column;
        Cell& cell = cells_[static_cast<std::size_t>((piece.row - box.top) * box.columns + column)];
        cell.area += side.sign * piece.area;
        cell.width += side.sign * piece.width;
    }
}

/// Of each texel in the box: what pieces within it bound, and all of its height times the width of the pieces
/// below it. About the south pole the outline is closed by the pole.
void GridShares::add_shares(const Box& box, double turn) {
    const auto columns = static_cast<std::size_t>(box.columns);
    shares_.texels.push_back({0, 0});
    covered_.assign(columns, 0);
    if (turn < -kTurns)
        for (std::size_t k = 0; k < cells_.size(); ++k) covered_[k % columns] -= cells_[k].width;
    for (int row = box.rows - 1; row >= 0; --row) {
        const double height = graticule_.cosine(box.top + row) - graticule_.cosine(box.top + row + 1);
        const std::span cells(&cells_[static_cast<std::size_t>(row) * columns], columns);
        for (std::size_t k = 0; k < columns; ++k) {
            cells[k].area += height * covered_[k];
            covered_[k] += cells[k].width;
        }
        add_run(cells, kLeast * height * column_width_, box.west, box.top + row);
    }
    shares_.texels.back().runs_end = shares_.runs.size();
}

void GridShares::add_run(std::span<const Cell> cells, double least, int west, int row) {
    std::size_t first = 0, last = cells.size();
    while (first < last && cells[first].area < least) ++first;
    while (first < last && cells[last - 1].area < least) --last;
    if (first == last) return;
    const int column = west + static_cast<int>(first), width = graticule_.width();
    shares_.runs.push_back({column < width ? column : column - width, row, static_cast<int>(last - first)});
    double sum = 0;
    for (const Cell& cell : cells.subspan(first, last - first)) {
        shares_.shares.push_back(cell.area < least ? 0 : cell.area);
        sum += shares_.shares.back();
    }
    shares_.texels.back().solid_angle += sum;
}

}  // namespace pbr

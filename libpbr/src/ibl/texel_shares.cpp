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

}  // namespace

GridShares::GridShares(const Graticule& graticule, const TexelGrid& grid, int first)
    : graticule_(graticule),
      grid_(grid),
      j_(first),
      // Columns grow clockwise about +y: seen from outside, the picture's own frame is a mirror image.
      orientation_(glm::dot(glm::cross(grid.s, grid.t), grid.centre) < 0 ? 1 : -1),
      line_(graticule),
      line_next_(graticule),
      across_(graticule) {
    for (int i = 0; i <= grid.columns; ++i)
        upright_.push_back(GreatCircle::through(grid.corner(i, 0), grid.corner(i, grid.rows)));
    trace_line(first, line_, corners_);
    trace_row();
}

void GridShares::next_row() {
    ++j_;
    std::swap(line_, line_next_);
    std::swap(corners_, corners_next_);
    trace_row();
}

std::vector<Corner> GridShares::corners(int j) const {
    std::vector<glm::dvec3> directions;
    for (int i = 0; i <= grid_.columns; ++i) directions.push_back(grid_.corner(i, j));
    std::vector<glm::dvec2> uv(directions.size());
    equirect_points(directions, uv);
    std::vector<Corner> result;
    for (std::size_t i = 0; i < uv.size(); ++i) {
        const glm::dvec3& d = directions[i];
        const double beside = std::sqrt(d.x * d.x + d.z * d.z);
        const int width = graticule_.width(), height = graticule_.height();
        const int column = static_cast<int>(std::floor(uv[i].x * width + graticule_.phase()));
        result.push_back({beside > 0 ? glm::dvec2(-d.z, d.x) / beside : glm::dvec2(1, 0),
                          column < width ? column : column - width,
                          std::min(static_cast<int>(uv[i].y * height), height - 1)});
    }
    return result;
}

void GridShares::trace_line(int j, EdgePieces& line, std::vector<Corner>& at) {
    at = corners(j);
    line.clear();
    const GreatCircle circle = GreatCircle::through(grid_.corner(0, j), grid_.corner(grid_.columns, j));
    for (std::size_t i = 0; i + 1 < at.size(); ++i) line.add(circle, at[i], at[i + 1]);
}

void GridShares::trace_row() {
    trace_line(j_ + 1, line_next_, corners_next_);
    across_.clear();
    for (std::size_t i = 0; i < upright_.size(); ++i) across_.add(upright_[i], corners_[i], corners_next_[i]);
}

const TexelShares& GridShares::of_texel(int i) {
    const double sign = orientation_;
    const Outline outline{Side{&line_, &line_.edge(i), sign},
                          {&across_, &across_.edge(i + 1), sign},
                          {&line_next_, &line_next_.edge(i), -sign},
                          {&across_, &across_.edge(i), -sign}};
    double turn = 0;
    for (const Side& side : outline) turn += side.sign * side.edge->width;
    const Box box = box_about(outline, turn);
    const auto cells = static_cast<std::size_t>(box.columns) * static_cast<std::size_t>(box.rows);
    areas_.assign(cells, 0);
    widths_.assign(cells, 0);
    for (const Side& side : outline) add_side(side, box);
    find_shares(box, turn);
    return shares_;
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
    const Edge& edge = *side.edge;
    for (const EdgePiece *piece = side.edges->piece(edge.first), *end = piece + (edge.last - edge.first);
         piece < end; ++piece) {
        int column = piece->column - box.west;
        column = column < 0 ? column + width : column >= width ? column - width : column;
        const auto cell = static_cast<std::size_t>((piece->row - box.top) * box.columns + column);
        areas_[cell] += side.sign * piece->area;
        widths_[cell] += side.sign * piece->width;
    }
}

/// Of each texel in the box: what pieces within it bound, and all of its height times the width of the pieces
/// below it. About the south pole the outline is closed by the pole.
void GridShares::find_shares(const Box& box, double turn) {
    shares_.runs.clear();
    shares_.solid_angles.clear();
    shares_.sum = 0;
    const auto columns = static_cast<std::size_t>(box.columns);
    covered_.assign(columns, 0);
    if (turn < -kTurns)
        for (std::size_t cell = 0; cell < widths_.size(); ++cell) covered_[cell % columns] -= widths_[cell];
    for (int row = box.rows - 1; row >= 0; --row) {
        const double height = graticule_.cosine(box.top + row) - graticule_.cosine(box.top + row + 1);
        double *areas = &areas_[static_cast<std::size_t>(row) * columns],
               *widths = &widths_[static_cast<std::size_t>(row) * columns];
        for (std::size_t k = 0; k < columns; ++k) {
            areas[k] += height * covered_[k];
            covered_[k] += widths[k];
        }
        add_run(box, box.top + row, {areas, columns});
    }
}

void GridShares::add_run(const Box& box, int row, std::span<const double> shares) {
    constexpr double kRounding = 1e-10;
    const double least = kRounding * (graticule_.cosine(row) - graticule_.cosine(row + 1)) * 2 *
                         std::numbers::pi / graticule_.width();
    std::size_t first = 0, last = shares.size();
    while (first < last && shares[first] < least) ++first;
    while (first < last && shares[last - 1] < least) --last;
    if (first == last) return;
    const int column = box.west + static_cast<int>(first), width = graticule_.width();
    shares_.runs.push_back({column < width ? column : column - width, row, static_cast<int>(last - first)});
    std::vector<double>& out = shares_.solid_angles;
    std::size_t at = out.size();
    out.resize(at + (last - first + 3) / 4 * 12);
    for (std::size_t k = first; k < last; ++k, at += 3) {
        const double share = shares[k] < least ? 0 : shares[k];
        out[at] = out[at + 1] = out[at + 2] = share;
        shares_.sum += share;
    }
}

}  // namespace pbr

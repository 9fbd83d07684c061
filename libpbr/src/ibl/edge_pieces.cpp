#include "src/ibl/edge_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pbr/numerics/elementary.hpp"

namespace pbr {
namespace {

double cross(const glm::dvec2& p, const glm::dvec2& q) { return p.x * q.y - p.y * q.x; }

}  // namespace

Graticule::Graticule(int width, int height, double phase) : width_(width), phase_(phase) {
    for (int row = 0; row <= height; ++row)
        cosines_.push_back(sin_cos_pi(static_cast<double>(row) / height).cos);
    for (int column = 0; column < width; ++column) {
        const SinCos azimuth = sin_cos_pi(2 * (column - phase) / width);
        meridians_.emplace_back(azimuth.cos, azimuth.sin);
    }
}

std::optional<GreatCircle> circle_through(const glm::dvec3& p, const glm::dvec3& q) {
    constexpr double kOnMeridian = 1e-12;  // what such a circle bounds beside a pole is no share of a texel
    const glm::dvec3 across = glm::cross(p, q);
    const double length = glm::length(across);
    if (std::abs(across.y) <= kOnMeridian * length) return std::nullopt;
    const glm::dvec3 normal = across / (across.y > 0 ? length : -length);
    return GreatCircle{normal.z, -normal.x, normal.y};
}

void EdgePieces::add_line(const std::optional<GreatCircle>& circle, std::span<const Corner> corners) {
    const std::size_t edges = corners.size() - 1;
    if (!circle) {
        edges_.resize(edges_.size() + edges);
        return;
    }
    const bool eastward = cross(corners.front().azimuth, corners.back().azimuth) >= 0;
    place_points(corners, eastward);
    find_arcs(*circle, points_);
    for (std::size_t i = 0; i < edges; ++i) {
        const std::size_t from_west = eastward ? i : edges - 1 - i, begin = corners_[from_west],
                          end = corners_[from_west + 1];
        const int row = corners[eastward ? i : i + 1].row;
        // Columns count from the first on again once an edge begins there.
        const int turn = columns_[begin] >= graticule_->width() ? graticule_->width() : 0;
        Walk walk{*circle, eastward ? 1.0 : -1.0, turn, row, {}};
        walk.edge = {pieces_.size(), 0, columns_[begin] - turn, columns_[end - 1] - turn, row, row, 0};
        for (std::size_t k = begin; k < end; ++k) add_arc(k, walk);
        walk.edge.last = pieces_.size();
        edges_.push_back(walk.edge);
    }
}

/// The corners from west to east, and the meridians between.
void EdgePieces::place_points(std::span<const Corner> corners, bool eastward) {
    points_.cos.clear(), points_.sin.clear();
    columns_.clear(), corners_.clear();
    const auto place = [&](const glm::dvec2& azimuth, int column) {
        points_.cos.push_back(azimuth.x), points_.sin.push_back(azimuth.y);
        columns_.push_back(column);
    };
    const std::size_t count = corners.size();
    const Corner& west = eastward ? corners.front() : corners.back();
    // A corner on a meridian may have been put to either side of it: the line begins where it leads on.
    int column = west.column;
    if (cross(graticule_->meridian(column + 1), west.azimuth) >= 0) ++column;
    if (cross(graticule_->meridian(column), west.azimuth) < 0)
        column = (column == 0 ? graticule_->width() : column) - 1;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec2& azimuth = corners[eastward ? i : count - 1 - i].azimuth;
        while (i > 0 && cross(graticule_->meridian(column + 1), azimuth) > 0)
            ++column, place(graticule_->meridian(column), column);
        corners_.push_back(columns_.size());
        place(azimuth, column);
    }
}

EdgePieces::Point EdgePieces::point(std::size_t index) const {
    return {points_.cos[index], points_.sin[index], points_.s[index], points_.m[index],
            points_.cosine[index]};
}

/// Where a circle has the colatitude above a row, east (side > 0) or west of its northernmost point.
EdgePieces::Point EdgePieces::crossing(const GreatCircle& circle, int row, double side) const {
    const double cosine = graticule_->cosine(row), rho2 = circle.u * circle.u + circle.v * circle.v,
                 m = circle.n / std::sqrt((1 - cosine) * (1 + cosine)), t = m * cosine,
                 s = std::copysign(std::sqrt(std::max(0.0, rho2 - t * t)), side);
    return {(circle.u * t - circle.v * s) / rho2, (circle.v * t + circle.u * s) / rho2, s, m, cosine};
}

void EdgePieces::add_arc(std::size_t index, Walk& walk) {
    const bool over_top = points_.s[index] < 0 && points_.s[index + 1] > 0;
    const double end = points_.cosine[index + 1];
    if (over_top || end > graticule_->cosine(walk.row) || end < graticule_->cosine(walk.row + 1))
        return add_steep_arc(index, over_top, walk);
    add_piece(columns_[index], points_.width[index], points_.below[index], walk);
}

/// An arc that may leave its row, cut where it does.
void EdgePieces::add_steep_arc(std::size_t index, bool over_top, Walk& walk) {
    const GreatCircle& circle = walk.circle;
    Point at = point(index);
    const auto go_to = [&](const Point& to) {
        add_piece(columns_[index], small_arc_sine(at.cos * to.sin - at.sin * to.cos),
                  small_arc_sine(at.m * to.s - at.s * to.m), walk);
        at = to;
    };
    const auto walk_to = [&](const Point& to) {
        const double side = at.s + to.s;
        for (; to.cosine < graticule_->cosine(walk.row + 1); ++walk.row)
            go_to(crossing(circle, walk.row + 1, side));
        for (; to.cosine > graticule_->cosine(walk.row); --walk.row) go_to(crossing(circle, walk.row, side));
        go_to(to);
    };
    if (over_top) {
        const double rho = std::sqrt(circle.u * circle.u + circle.v * circle.v);
        walk_to({circle.u / rho, circle.v / rho, 0, 1, std::min(1.0, rho)});
    }
    walk_to(point(index + 1));
}

void EdgePieces::add_piece(int column, double width, double below, Walk& walk) {
    pieces_.push_back({column - walk.turn, walk.row, walk.sign * width,
                       walk.sign * (graticule_->cosine(walk.row) * width - below)});
    walk.edge.width += walk.sign * width;
    walk.edge.top = std::min(walk.edge.top, walk.row);
    walk.edge.bottom = std::max(walk.edge.bottom, walk.row);
}

}  // namespace pbr

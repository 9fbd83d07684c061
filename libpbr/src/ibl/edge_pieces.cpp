#include "src/ibl/edge_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pbr/numerics/elementary.hpp"

namespace pbr {
namespace {

double cross(const glm::dvec2& p, const glm::dvec2& q) { return p.x * q.y - p.y * q.x; }

/// The angle of (cosine, sine), which have length 1. Error below 1e-12 of it.
double angle(double sine, double cosine) {
    constexpr double kSmall = 0.1;  // the first term left out is 3e-12 of the angle there
    if (std::abs(sine) > kSmall || cosine < 0) return atan2_exact(sine, cosine);
    const double x = sine * sine;
    return sine * (1 + x * (1. / 6 + x * (3. / 40 + x * (15. / 336 + x * (105. / 3456)))));
}

}  // namespace

/// A point of a great circle; s = rho sin(A - A0).
struct EdgePieces::Point {
    glm::dvec2 azimuth;
    double s, m, cosine;
};

/// A walk eastward along a great circle.
struct EdgePieces::Walk {
    const GreatCircle& circle;
    double sign;  ///< of what is added
    Point at;
    int column, row;  ///< that it is in
    Edge edge;
};

Graticule::Graticule(int width, int height, double phase) : width_(width), phase_(phase) {
    for (int row = 0; row <= height; ++row) {
        const SinCos colatitude = sin_cos_pi(static_cast<double>(row) / height);
        cosines_.push_back(colatitude.cos);
        cotangents_.push_back(colatitude.cos / colatitude.sin);
    }
    for (int column = 0; column < width; ++column) {
        const SinCos azimuth = sin_cos_pi(2 * (column - phase) / width);
        meridians_.emplace_back(azimuth.cos, azimuth.sin);
    }
}

GreatCircle GreatCircle::through(const glm::dvec3& p, const glm::dvec3& q) {
    constexpr double kOnMeridian = 1e-12;  // what such a circle bounds beside a pole is no share of a texel
    const glm::dvec3 across = glm::cross(p, q);
    const double length = glm::length(across);
    if (!(std::abs(across.y) > kOnMeridian * length)) return {};
    const glm::dvec3 normal = across / (across.y > 0 ? length : -length);
    return {normal.z, -normal.x, normal.y};
}

EdgePieces::Point EdgePieces::point(const GreatCircle& circle, const glm::dvec2& azimuth) {
    const double t = circle.u * azimuth.x + circle.v * azimuth.y,
                 s = circle.u * azimuth.y - circle.v * azimuth.x, m = std::sqrt(circle.n * circle.n + t * t);
    return {azimuth, s, m, t / m};
}

/// Where a circle has the colatitude above a row, east (side > 0) or west of its northernmost point.
EdgePieces::Point EdgePieces::crossing(const GreatCircle& circle, int row, double side) const {
    const double rho2 = circle.u * circle.u + circle.v * circle.v, t = graticule_->cotangent(row) * circle.n,
                 s = std::copysign(std::sqrt(std::max(0.0, rho2 - t * t)), side);
    return {glm::dvec2(circle.u * t - circle.v * s, circle.v * t + circle.u * s) / rho2, s,
            std::sqrt(circle.n * circle.n + t * t), graticule_->cosine(row)};
}

void EdgePieces::add(const GreatCircle& circle, const Corner& p, const Corner& q) {
    const std::size_t first = pieces_.size();
    if (circle.n == 0) {
        edges_.push_back({first, first, 0, 0, 0, 0, 0});
        return;
    }
    const bool eastward = cross(p.azimuth, q.azimuth) >= 0;
    const Corner &west = eastward ? p : q, &east = eastward ? q : p;
    // A corner on a meridian may have been put to either side of it: the walk begins where it leads on.
    int column = west.column;
    if (cross(graticule_->meridian(column + 1), west.azimuth) >= 0) ++column;
    if (cross(graticule_->meridian(column), west.azimuth) < 0) --column;
    if (column < 0 || column >= graticule_->width())
        column += column < 0 ? graticule_->width() : -graticule_->width();
    Walk walk{circle,
              eastward ? 1.0 : -1.0,
              point(circle, west.azimuth),
              column,
              west.row,
              {first, first, column, column, west.row, west.row, 0}};
    const Point end = point(circle, east.azimuth);
    const double rho2 = circle.u * circle.u + circle.v * circle.v;
    const bool over_top = walk.at.s < 0 && end.s > 0;
    const Point top = over_top ? point(circle, glm::dvec2(circle.u, circle.v) / std::sqrt(rho2)) : end;
    const auto walk_over = [&](const Point& to) {
        if (walk.at.s < 0 && to.s > 0) walk_to(top, walk);
        walk_to(to, walk);
    };
    while (cross(graticule_->meridian(walk.column + 1), east.azimuth) > 0) {
        walk_over(point(circle, graticule_->meridian(walk.column + 1)));
        ++walk.column;
    }
    walk_over(end);
    walk.edge.last = pieces_.size();
    walk.edge.east = walk.column;
    edges_.push_back(walk.edge);
}

/// Goes on to a point in the same column, on the same side of the northernmost point.
void EdgePieces::walk_to(const Point& to, Walk& walk) {
    const double side = walk.at.s + to.s;
    for (; walk.row + 1 < graticule_->height() && to.cosine < graticule_->cosine(walk.row + 1); ++walk.row) {
        add_piece(crossing(walk.circle, walk.row + 1, side), walk);
        walk.edge.bottom = std::max(walk.edge.bottom, walk.row + 1);
    }
    for (; walk.row > 0 && to.cosine > graticule_->cosine(walk.row); --walk.row) {
        add_piece(crossing(walk.circle, walk.row, side), walk);
        walk.edge.top = std::min(walk.edge.top, walk.row - 1);
    }
    add_piece(to, walk);
}

void EdgePieces::add_piece(const Point& to, Walk& walk) {
    const Point& from = walk.at;
    const double width = angle(cross(from.azimuth, to.azimuth), glm::dot(from.azimuth, to.azimuth)),
                 below = angle(to.s * from.m - from.s * to.m, from.m * to.m + from.s * to.s);
    pieces_.push_back({walk.column, walk.row, walk.sign * width,
                       walk.sign * (graticule_->cosine(walk.row) * width - below)});
    walk.edge.width += walk.sign * width;
    walk.at = to;
}

}  // namespace pbr

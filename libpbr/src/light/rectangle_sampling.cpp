#include "pbr/light/rectangle_sampling.hpp"

namespace pbr {
namespace {

using Vec = Vec3<double>;
using std::numbers::pi;

/// Below this solid angle, sr, angles' excess over 2 pi keeps fewer than 7 digits.
constexpr double kSmallestSpherical = 1e-8;

/// Solid angle of [x0, x1] x [y0, y1] at distance `depth`.
double solid_angle_of(double x0, double x1, double y0, double y1, double depth) {
    const Vec a(x0, y0, depth), b(x1, y0, depth), c(x1, y1, depth), d(x0, y1, depth), origin(0);
    return std::abs(solid_angle_triangle(a, b, c, origin) + solid_angle_triangle(a, c, d, origin));
}

/// Sine of the elevation of y over the plane of x and z, at distance `reach` in it.
double height_fraction(double y, double reach) { return y / std::sqrt(reach * reach + y * y); }

}  // namespace

SphericalRectangle::SphericalRectangle(const RectangleLight<double>& light, const Vec& p)
    : x_(0), y_(0), z_(0) {
    if (!is_lit(light, p)) return;
    const double half_x = glm::length(light.half_x), half_y = glm::length(light.half_y);
    x_ = light.half_x / half_x;
    y_ = light.half_y / half_y;
    const Vec to_centre = light.centre - p;
    z_ = glm::cross(x_, y_);
    if (glm::dot(z_, to_centre) < 0) z_ = -z_;
    depth_ = glm::dot(z_, to_centre);
    x0_ = glm::dot(x_, to_centre) - half_x;
    x1_ = x0_ + 2 * half_x;
    y0_ = glm::dot(y_, to_centre) - half_y;
    y1_ = y0_ + 2 * half_y;
    solid_angle_ = solid_angle_of(x0_, x1_, y0_, y1_, depth_);
    by_area_ = solid_angle_ < kSmallestSpherical;
}

Vec SphericalRectangle::sample(double u1, double u2) const {
    if (!(solid_angle_ > 0)) return Vec(0, 0, 1);
    const auto towards = [&](double x, double y) { return glm::normalize(x * x_ + y * y_ + depth_ * z_); };
    if (by_area_) return towards(x0_ + u1 * (x1_ - x0_), y0_ + u2 * (y1_ - y0_));
    // The planes through p and the sides y0, y1 and x0 have unit normals with z-parts b0, b1 and n0. By
    // Girard the part of the rectangle up to x has the solid angle acos(b0 c) + acos(b1 c) less the same at
    // x0, up to signs and 2 pi, where c is the z-part for the side at x. Solved for c with the addition
    // theorem, and x from c.
    const double b0 = -y0_ / std::hypot(depth_, y0_), b1 = y1_ / std::hypot(depth_, y1_);
    const double n0 = x0_ / std::hypot(depth_, x0_);
    const double at_x0 =
        std::acos(std::clamp(b1 * n0, -1.0, 1.0)) + std::acos(std::clamp(b0 * n0, -1.0, 1.0));
    const double angle = u1 * solid_angle_ - at_x0;
    const double sine = std::sin(angle);
    const double f = (std::cos(angle) * b0 - b1) / sine;
    const double c = std::copysign(1 / std::hypot(f, b0), f);
    double x = c * depth_ / std::sqrt(std::max((1 - c) * (1 + c), 0.0));
    x = std::isnan(x) ? x0_ : std::clamp(x, x0_, x1_);
    const double reach = std::hypot(x, depth_);
    const double h0 = height_fraction(y0_, reach), h1 = height_fraction(y1_, reach);
    const double h = h0 + u2 * (h1 - h0);
    const double y = std::clamp(h * reach / std::sqrt((1 - h) * (1 + h)), y0_, y1_);
    return towards(x, y);
}

bool SphericalRectangle::meets_plane(const Vec& wi, Point& point) const {
    const double descent = glm::dot(wi, z_);
    if (!(descent > 0) || !(solid_angle_ > 0)) return false;
    point = {glm::dot(wi, x_) * (depth_ / descent), glm::dot(wi, y_) * (depth_ / descent)};
    return true;
}

double SphericalRectangle::pdf(const Vec& wi) const {
    Point point;
    if (!meets_plane(wi, point)) return 0;
    // Samples that were clamped to a side must not miss it by the rounding of their direction.
    const double slack = 1e-12 * (std::abs(x0_) + std::abs(x1_) + std::abs(y0_) + std::abs(y1_) + depth_);
    if (point.x < x0_ - slack || point.x > x1_ + slack || point.y < y0_ - slack || point.y > y1_ + slack)
        return 0;
    if (!by_area_) return 1 / solid_angle_;
    const double d2 = point.x * point.x + point.y * point.y + depth_ * depth_;
    return d2 * std::sqrt(d2) / (depth_ * (x1_ - x0_) * (y1_ - y0_));
}

Sample2 SphericalRectangle::inverse(const Vec& wi) const {
    Point point;
    if (!meets_plane(wi, point)) return {0, 0};
    const double x = std::clamp(point.x, x0_, x1_), y = std::clamp(point.y, y0_, y1_);
    if (by_area_) return {(x - x0_) / (x1_ - x0_), (y - y0_) / (y1_ - y0_)};
    const double u1 = solid_angle_of(x0_, x, y0_, y1_, depth_) / solid_angle_;
    const double reach = std::hypot(x, depth_);
    const double h0 = height_fraction(y0_, reach), h1 = height_fraction(y1_, reach);
    return {std::clamp(u1, 0.0, 1.0), std::clamp((height_fraction(y, reach) - h0) / (h1 - h0), 0.0, 1.0)};
}

}  // namespace pbr

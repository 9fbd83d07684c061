#include "pbr/light/tube_light.hpp"

#include "pbr/light/polygon.hpp"

namespace pbr {
namespace {

using Vec = Vec3<double>;
using std::numbers::pi;

/// Lambert's contour integral of a convex outline on the sphere of directions, the part above the horizon of
/// n. Pieces come in order, counterclockwise about the light as seen along the way from p. What lies above
/// the horizon is summed, and consecutive parts are joined by great arcs: where the outline dives and comes
/// up again that is the horizon itself, and where pieces meet it is a rounding long, so that pieces need not
/// agree on which of them crosses.
class ClippedOutline {
  public:
    explicit ClippedOutline(const Vec& n) : n_(n) {}

    /// The great arc between the directions of a and b.
    void great_arc(Vec a, Vec b) {
        const double ha = glm::dot(n_, a), hb = glm::dot(n_, b);
        if (!(ha > 0) && !(hb > 0)) return;
        if (!(ha > 0)) a += (b - a) * (ha / (ha - hb));
        if (!(hb > 0)) b += (a - b) * (hb / (hb - ha));
        part(a, b, lambert_edge(a, b, n_));
    }

    /// The arc of the small circle cos_s axis + sin_s (x cos phi + y sin phi), |phi| <= half <= pi; x, y,
    /// axis right-handed.
    void small_arc(const Vec& axis, const Vec& x, const Vec& y, double sin_s, double half) {
        const double cos_s = std::sqrt((1 - sin_s) * (1 + sin_s));
        const double n_x = glm::dot(n_, x), n_y = glm::dot(n_, y), n_axis = glm::dot(n_, axis);
        const double middle = cos_s * n_axis, swing = sin_s * std::hypot(n_x, n_y);
        if (middle <= -swing) return;
        const auto stretch = [&](double from, double to) {
            if (!(to > from)) return;
            const auto at = [&](double phi) {
                return cos_s * axis + sin_s * (std::cos(phi) * x + std::sin(phi) * y);
            };
            // n.(r x dr) = sin^2 n_axis - sin cos (n_x cos phi + n_y sin phi)
            const double swept =
                sin_s * n_axis * (to - from) -
                cos_s * (n_x * (std::sin(to) - std::sin(from)) - n_y * (std::cos(to) - std::cos(from)));
            part(at(from), at(to), 0.5 * sin_s * swept);
        };
        if (middle >= swing) return stretch(-half, half);
        const double highest = std::atan2(n_y, n_x);
        const double reach = std::atan2(std::sqrt((swing - middle) * (swing + middle)), -middle);
        for (int turn = -1; turn <= 1; ++turn) {
            const double centre = highest + 2 * pi * turn;
            stretch(std::max(-half, centre - reach), std::min(half, centre + reach));
        }
    }

    /// The projected solid angle.
    double total() const { return has_part_ ? sum_ + lambert_edge(last_, first_, n_) : 0; }

  private:
    void part(const Vec& from, const Vec& to, double integral) {
        if (has_part_)
            sum_ += lambert_edge(last_, from, n_);
        else
            first_ = from;
        has_part_ = true;
        last_ = to;
        sum_ += integral;
    }

    Vec n_, first_{}, last_{};
    bool has_part_ = false;
    double sum_ = 0;
};

/// Appends the outline's arc around the end at c (relative to p), whose outward axis is `out`; `edge` is the
/// cosine share sqrt(1 - r^2/D^2) of the tangent planes through p, D the distance of p from the axis' line.
void append_cap(ClippedOutline& outline, const Vec& c, const Vec& out, double radius, double D, double edge) {
    const double distance = glm::length(c);
    const Vec axis = c / distance;
    const double along = glm::dot(axis, out);
    const Vec x = glm::normalize(out - along * axis);
    // The arc ends where the tangent planes touch: their normal is (r/D) towards the axis +- edge across.
    outline.small_arc(axis, x, glm::cross(axis, x), radius / distance, std::atan2(edge, radius / D * along));
}

}  // namespace

double projected_solid_angle(const TubeLight<double>& light, const Vec& p, const Vec& n) {
    const Vec c0 = light.end0 - p, c1 = light.end1 - p, along = light.end1 - light.end0;
    const Vec nearest = closest_point_on_segment(light.end0, light.end1, p) - p;
    const double r = light.radius, nearest2 = glm::dot(nearest, nearest), length = glm::length(along);
    if (!(r > 0)) return 0;
    if (nearest2 < r * r) return pi;
    const Vec axis = length > 0 ? along / length : Vec(0, 0, 1);
    const Vec foot = c0 - glm::dot(c0, axis) * axis;
    const double D = glm::length(foot);
    if (!(length > 0) || D <= r)  // the nearer end hides all else
        return projected_solid_angle(SphereLight<double>{nearest, r}, Vec(0), n);
    const Vec towards = foot / D, across = glm::cross(axis, towards);
    const double edge = std::sqrt((1 - r / D) * (1 + r / D));
    // Where the two planes through p that are tangent to the cylinder touch it: c - r (towards r/D +- across
    // edge).
    const Vec left = -r * (r / D * towards - edge * across), right = -r * (r / D * towards + edge * across);
    ClippedOutline outline(n);
    outline.great_arc(c0 + left, c1 + left);
    append_cap(outline, c1, axis, r, D, edge);
    outline.great_arc(c1 + right, c0 + right);
    append_cap(outline, c0, -axis, r, D, edge);
    return std::clamp(outline.total(), 0.0, pi);
}

}  // namespace pbr

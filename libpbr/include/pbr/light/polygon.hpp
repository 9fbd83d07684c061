#pragma once
// Solid angle and projected solid angle of triangles and planar polygons. T is float or double.
//
// Vertices are in order; results are positive where p sees them run counterclockwise, negative from behind.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "pbr/light/area_light.hpp"

namespace pbr {

/// Signed solid angle, sr, in (-2 pi, 2 pi), of triangle a b c seen from p (van Oosterom & Strackee 1983,
/// "The solid angle of a plane triangle", eq. 8): tan(Omega/2) = det(a, b, c) / (abc + (a.b)c + (b.c)a +
/// (c.a)b). The determinant is taken of edges, so that small triangles keep their digits: relative error
/// below 50 eps / (smallest of the triangle's extent and its height, as angles). 0 in the triangle's plane,
/// in it too, and for no area.
template <class T>
T solid_angle_triangle(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c, const Vec3<T>& p) {
    const Vec3<T> ra = a - p, rb = b - p, rc = c - p;
    const T la = glm::length(ra), lb = glm::length(rb), lc = glm::length(rc);
    const T determinant = -glm::dot(ra, glm::cross(b - a, c - a));
    if (determinant == T(0)) return T(0);
    const T denominator =
        la * lb * lc + glm::dot(ra, rb) * lc + glm::dot(rb, rc) * la + glm::dot(rc, ra) * lb;
    return T(2) * std::atan2(determinant, denominator);
}

/// Half the signed projected solid angle between two edge vectors, sr: n.(a x b)/|a x b| times the angle from
/// a to b, halved. One term of Lambert's sum (Baum et al. 1989, "Improving radiosity solutions through the
/// use of analytically determined form-factors"). a, b any length; parallel, opposite or zero vectors give 0,
/// which is the limit but for opposite ones: then p is on the edge and the direction of a x b is undefined.
template <class T>
T lambert_edge(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& n) {
    const Vec3<T> normal = glm::cross(a, b - a);  // = a x b, with fewer digits lost where a and b are close
    const T sine = glm::length(normal);
    return sine > T(0) ? T(0.5) * glm::dot(n, normal) / sine * std::atan2(sine, glm::dot(a, b)) : T(0);
}

/// The integral over triangle a b c, relative to p, of (n.x)(x.dA)/|x|^4, by Radon's seven-point rule of
/// degree 5 (Abramowitz & Stegun 1964, 25.4.63). Relative error about the 6th power of extent / distance.
template <class T>
T lambert_triangle_gauss(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c, const Vec3<T>& n) {
    const Vec3<T> area = T(0.5) * glm::cross(b - a, c - a);
    const auto at = [&](T wa, T wb, T wc) {
        const Vec3<T> x = wa * a + wb * b + wc * c;
        const T x2 = glm::dot(x, x);
        return glm::dot(n, x) * glm::dot(x, area) / (x2 * x2);
    };
    const T root = std::sqrt(T(15));
    const T third = T(1) / T(3);
    const auto ring = [&](T w) {
        return at(w, w, T(1) - 2 * w) + at(w, T(1) - 2 * w, w) + at(T(1) - 2 * w, w, w);
    };
    return T(0.225) * at(third, third, third) + (T(155) - root) / T(1200) * ring((T(6) - root) / T(21)) +
           (T(155) + root) / T(1200) * ring((T(6) + root) / T(21));
}

/// Below this extent / nearest vertex the projected solid angle of a polygon is a cubature over its area,
/// above it a sum over edges. The sum loses digits like eps / extent, and the cubature's error, 0.03^6, is
/// below 1e-9.
constexpr double kSmallPolygonExtent = 0.03;

/// Walks a polygon's vertices relative to p, clipped to the horizon, and sums. See
/// projected_solid_angle_polygon.
template <class T>
class HorizonClippedSum {
  public:
    /// n is the receiver's unit normal; small: by cubature of triangles, else by edges.
    HorizonClippedSum(const Vec3<T>& n, bool small) : n_(n), small_(small) {}

    /// The side from one vertex to the next, relative to p.
    void edge(const Vec3<T>& from, const Vec3<T>& to) {
        const T h0 = glm::dot(n_, from), h1 = glm::dot(n_, to);
        if ((h0 > T(0)) != (h1 > T(0))) add(from + (to - from) * (h0 / (h0 - h1)));
        if (h1 > T(0)) add(to);
    }

    /// The signed projected solid angle.
    T total() const { return count_ < 3 ? T(0) : small_ ? -sum_ : -(sum_ + lambert_edge(last_, first_, n_)); }

  private:
    /// A vertex of the clipped polygon.
    void add(const Vec3<T>& v) {
        if (count_ == 0)
            first_ = v;
        else if (!small_)
            sum_ += lambert_edge(last_, v, n_);
        else if (count_ >= 2)
            sum_ += lambert_triangle_gauss(first_, last_, v, n_);
        last_ = v;
        ++count_;
    }

    Vec3<T> n_;
    bool small_;
    int count_ = 0;
    Vec3<T> first_{}, last_{};
    T sum_ = T(0);
};

/// Exact signed projected solid angle, sr, of a planar simple polygon, convex or not, at p with unit normal
/// n, the part below the horizon clipped (Lambert 1760; Baum et al. 1989). In [-pi, pi]. 0 for fewer than
/// three vertices, no area, and at points of the polygon's plane outside it; a point *on* the polygon is not
/// meaningful. Absolute error below 20 eps x (extent of the polygon, rad); double within 2e-9 and float
/// within 2e-5 of its largest value at this place whatever its size, as small polygons are integrated over
/// their area.
template <class T>
T projected_solid_angle_polygon(std::span<const Vec3<T>> vertices, const Vec3<T>& p, const Vec3<T>& n) {
    if (vertices.size() < 3) return T(0);
    const Vec3<T> origin = vertices.front() - p;
    T extent2 = T(0), nearest2 = glm::dot(origin, origin);
    for (const Vec3<T>& v : vertices) {
        const Vec3<T> across = v - vertices.front(), ray = v - p;
        extent2 = std::max(extent2, glm::dot(across, across));
        nearest2 = std::min(nearest2, glm::dot(ray, ray));
    }
    HorizonClippedSum<T> sum(n, extent2 < T(kSmallPolygonExtent * kSmallPolygonExtent) * nearest2);
    Vec3<T> from = vertices.back() - p;
    for (const Vec3<T>& v : vertices) {
        const Vec3<T> to = v - p;
        sum.edge(from, to);
        from = to;
    }
    return sum.total();
}

}  // namespace pbr

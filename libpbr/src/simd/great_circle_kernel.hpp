#pragma once
// Points of a great circle, and what lies between neighbours.

#include <cstddef>
#include <vector>

namespace pbr {

/// A great circle of unit normal n, n.y > 0, by azimuth A from the direction -z by way of +x: the cosine of
/// colatitude is t / m with t = u cos A + v sin A = rho cos(A - A0), m^2 = n.y^2 + t^2 = 1 - s^2,
/// s = rho sin(A - A0); its integral over A is asin s.
struct GreatCircle {
    double u, v, n;  ///< n: n.y
};

/// Points of a circle, and arcs from each to the next.
struct CirclePoints {
    std::vector<double> cos, sin;      ///< of azimuth
    std::vector<double> s, m, cosine;  ///< cosine of colatitude
    std::vector<double> width;         ///< azimuth to the next point
    std::vector<double> below;         ///< integral of cosine over it

    std::size_t size() const { return cos.size(); }
};

/// The arc sine of |x| <= .1 to 3e-12 of it: its Taylor series.
inline double small_arc_sine(double x) {
    const double x2 = x * x;
    return x * (1 + x2 * (1. / 6 + x2 * (3. / 40 + x2 * (15. / 336 + x2 * (105. / 3456)))));
}

/// Fills in all but cos and sin. Of points less than .1 rad apart width and below are good to 3e-12 of them.
/// Bits do not depend on the vector width.
void find_arcs(const GreatCircle& circle, CirclePoints& points);

}  // namespace pbr

#pragma once
// Sampling the rectangle light uniformly in solid angle: a triple sample / inverse / pdf. T is float or
// double; evaluation is in double for both.

#include "pbr/light/rectangle_light.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbr {

/// A rectangle as one point sees it: what the triple below has in common, so that many samples share it.
class SphericalRectangle {
  public:
    /// Of `light` as seen from p, where is_lit must hold, else nothing is drawn and all densities are 0.
    SphericalRectangle(const RectangleLight<double>& light, const Vec3<double>& p);

    /// Solid angle, sr; error of solid_angle_triangle.
    double solid_angle() const { return solid_angle_; }

    /// A unit vector from p to the rectangle, uniform in solid angle (Urena, Fajardo & King 2013, "An
    /// area-preserving parametrization for spherical rectangles", 4). u1 chooses along half_x, u2 along
    /// half_y; both in [0, 1). A rectangle below 1e-8 sr is drawn uniformly in area instead, as its angles'
    /// excess has lost its digits.
    Vec3<double> sample(double u1, double u2) const;

    /// The density of sample, 1/sr, of the unit vector wi: 1 / solid angle (below 1e-8 sr d^2 / (cosine
    /// area)) where its ray meets the rectangle, else 0.
    double pdf(const Vec3<double>& wi) const;

    /// The (u1, u2) that sample turns into wi, which must meet the rectangle. u1 is a quotient of solid
    /// angles, good to 1e-15 / solid angle.
    Sample2 inverse(const Vec3<double>& wi) const;

  private:
    struct Point {
        double x, y;
    };
    /// Where the ray along wi meets the rectangle's plane, in the coordinates below; false if it doesn't.
    bool meets_plane(const Vec3<double>& wi, Point& point) const;

    Vec3<double> x_, y_,
        z_;  ///< Axes along half_x, half_y and from p to the plane, which lies at z_ = depth_.
    double depth_ = 0;
    double x0_ = 0, x1_ = 0, y0_ = 0, y1_ = 0;  ///< The sides' coordinates.
    double solid_angle_ = 0;
    bool by_area_ = false;
};

/// One draw of SphericalRectangle::sample.
template <class T>
Vec3<T> sample_rectangle_light(const RectangleLight<T>& light, const Vec3<T>& p, T u1, T u2) {
    const SphericalRectangle seen(in_double(light), Vec3<double>(p));
    return Vec3<T>(seen.sample(static_cast<double>(u1), static_cast<double>(u2)));
}

/// SphericalRectangle::pdf, 1/sr. In float a direction within its rounding of the outline may fall to either
/// side.
template <class T>
T pdf_solid_angle(const RectangleLight<T>& light, const Vec3<T>& p, const Vec3<T>& wi) {
    return static_cast<T>(SphericalRectangle(in_double(light), Vec3<double>(p)).pdf(Vec3<double>(wi)));
}

/// SphericalRectangle::inverse.
template <class T>
Sample2 inverse_rectangle_light(const RectangleLight<T>& light, const Vec3<T>& p, const Vec3<T>& wi) {
    return SphericalRectangle(in_double(light), Vec3<double>(p)).inverse(Vec3<double>(wi));
}

}  // namespace pbr

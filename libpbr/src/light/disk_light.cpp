#include "pbr/light/disk_light.hpp"

namespace pbr {
namespace {

using Vec = Vec3<double>;
using std::numbers::pi;

/// The integral over [0, pi/2] of (a cos^2 + b sin^2) / ((cos^2 + p sin^2) sqrt(cos^2 + kc^2 sin^2)) for kc,
/// p > 0 (Bulirsch 1969, "Numerical calculation of elliptic integrals and elliptic functions III", cel), by
/// Bartky's transformation, which moves p, kc and the means together until they meet.
double complete_elliptic(double kc, double p, double a, double b) {
    constexpr double kTolerance = 1e-8;  // convergence is quadratic: the result is good to its square
    double root_p = std::sqrt(p), mean = 1, k = kc, product = kc;
    b /= root_p;
    for (;;) {
        const double a_before = a, ratio = product / root_p, mean_before = mean;
        a += b / root_p;
        b = 2 * (b + a_before * ratio);
        root_p += ratio;
        mean += k;
        if (std::abs(mean_before - k) <= kTolerance * mean_before) break;
        k = 2 * std::sqrt(product);
        product = k * mean;
    }
    return pi / 2 * (b + a * mean) / (mean * (mean + root_p));
}

/// Solid angle of a disk of radius x seen from distance 1 at cosine c to its axis: on the axis it is the
/// series of 2 pi (1 - 1/sqrt(1 + x^2)), and off it each power x^2k carries the Legendre polynomial P_(2k-1),
/// as any harmonic function does that is symmetric about the axis.
double multipole_solid_angle(double x, double c) {
    constexpr int kTerms = 8;  // at x = 0.1 the next one is below 1e-16 of the first
    double sum = 0, coefficient = 0.5 * x * x, legendre = c, before = 1;
    for (int k = 1; k <= kTerms; ++k) {
        sum += coefficient * legendre;
        coefficient *= -x * x * (2 * k + 1) / (2 * k + 2);
        for (int l = 2 * k; l <= 2 * k + 1; ++l) {  // two steps of the recurrence from P_(l-1) to P_l
            const double next = ((2 * l - 1) * c * legendre - (l - 1) * before) / l;
            before = legendre;
            legendre = next;
        }
    }
    return 2 * pi * sum;
}

/// log(1 + x) / x, 1 at 0.
double log1p_ratio(double x) { return x == 0 ? 1 : std::log1p(x) / x; }

/// atan(x) / x, 1 at 0.
double atan_ratio(double x) { return x == 0 ? 1 : std::atan(x) / x; }

/// A circle seen from the origin: r(phi) = centre + radius (u cos phi + v sin phi), where u lies along the
/// centre's part in the circle's plane, so centre = cu u + cw w with w the axis away from the origin.
struct SeenCircle {
    Vec centre, u, v, w;
    double cu, cw, radius;

    SeenCircle(const DiskLight<double>& light, const Vec& p)
        : centre(light.centre - p), radius(light.radius) {
        w = glm::dot(centre, light.normal) > 0 ? light.normal : -light.normal;
        cw = glm::dot(centre, w);
        // On the axis, within a few roundings, any u will do: so little of a turn changes the result by as little.
        const AxisFrame<double> frame = frame_towards(w, glm::normalize(centre));
        u = frame.x;
        v = frame.y;
        cu = std::max(glm::dot(centre, u), 0.0);
    }

    Vec at(double phi) const { return centre + radius * (std::cos(phi) * u + std::sin(phi) * v); }

    double d0() const { return glm::dot(centre, centre) + radius * radius; }  ///< r^2 = d0 + d1 cos phi
    double d1() const { return 2 * radius * cu; }
    /// sqrt(d0^2 - d1^2), multiplied out so that nothing cancels beside the rim.
    double root() const {
        const double beside = (cu - radius) * (cu + radius), sum = cu * cu + radius * radius;
        return std::sqrt(cw * cw * (cw * cw + 2 * sum) + beside * beside);
    }
};

/// 1/2 n . contour integral over the whole circle: pi R^2/S [n_w - 2 cu (cu n_w - cw n_u)/(S + d0)], with S +
/// d0 - 2 cu^2 rewritten where cu > R, since it cancels for a disk seen edge on.
double whole_circle(const SeenCircle& c, const Vec& n) {
    const double S = c.root(), n_u = glm::dot(n, c.u), n_w = glm::dot(n, c.w);
    const double beside = (c.cu - c.radius) * (c.cu + c.radius), cw2 = c.cw * c.cw;
    const double sum = c.cu * c.cu + c.radius * c.radius;
    const double facing = beside > 0 ? cw2 + cw2 * (cw2 + 2 * sum) / (S + beside) : S + cw2 - beside;
    return pi * c.radius * c.radius * (n_w * facing + 2 * c.cu * c.cw * n_u) / (S * (S + c.d0()));
}

/// 1/2 n . contour integral over the arc from phi0 to phi1 = phi0 + sweep: half the integral of
/// (a0 + a1 cos phi + a2 sin phi)/(d0 + d1 cos phi). With t = d1/(d0 + S) its parts have branch-free
/// primitives: that of 1/(d0 + d1 cos phi) is (phi - 2 psi)/S, tan psi = t sin phi/(1 + t cos phi). Nothing
/// divides by d1, so the axis is no special case.
double arc(const SeenCircle& c, const Vec& n, double phi0, double sweep) {
    const double S = c.root(), d0 = c.d0(), d1 = c.d1(), t = d1 / (d0 + S), phi1 = phi0 + sweep;
    const double n_u = glm::dot(n, c.u), n_v = glm::dot(n, c.v), n_w = glm::dot(n, c.w);
    const double a0 = c.radius * c.radius * n_w, a1 = c.radius * (c.cu * n_w - c.cw * n_u);
    const double a2 = -c.radius * c.cw * n_v;
    // psi / d1 at an end of the arc.
    const auto psi_ratio = [&](double phi) {
        const double z_ratio = std::sin(phi) / ((d0 + S) * (1 + t * std::cos(phi)));
        return z_ratio * atan_ratio(z_ratio * d1);
    };
    const double psi = psi_ratio(phi1) - psi_ratio(phi0);
    const double constant = (sweep - 2 * d1 * psi) / S;
    const double cosine = (2 * d0 * psi - t * sweep) / S;
    const double change = (std::cos(phi1) - std::cos(phi0)) / (d0 + d1 * std::cos(phi0));
    const double sine = -change * log1p_ratio(d1 * change);
    return 0.5 * (a0 * constant + a1 * cosine + a2 * sine);
}

}  // namespace

double solid_angle_disk(double height, double offset, double radius) {
    if (!(height > 0) || !(radius > 0)) return 0;
    const double distance = std::hypot(height, offset);
    if (radius < 0.1 * distance) return multipole_solid_angle(radius / distance, height / distance);
    const double far_rim = std::hypot(radius + offset, height);
    const double kc = std::hypot(radius - offset, height) / far_rim;
    const double beta = (radius - offset) / (radius + offset);
    if (beta == 0) return pi - 2 * height / far_rim * complete_elliptic(kc, 1, 1, 1);
    const double integral = complete_elliptic(kc, beta * beta, 1 + beta, beta * (1 + beta));
    return std::max((beta > 0 ? 2 * pi : 0) - 2 * height / far_rim * integral, 0.0);
}

double projected_solid_angle(const DiskLight<double>& light, const Vec& p, const Vec& n) {
    if (!is_lit(light, p) || !(light.radius > 0)) return 0;
    const SeenCircle circle(light, p);
    const double n_u = glm::dot(n, circle.u), n_v = glm::dot(n, circle.v);
    const double middle = glm::dot(n, circle.centre), swing = circle.radius * std::hypot(n_u, n_v);
    if (middle >= swing) return std::clamp(whole_circle(circle, n), 0.0, pi);
    if (middle <= -swing) return 0;
    // Above the horizon lies the arc within `half` of the rim's highest point.
    const double highest = std::atan2(n_v, n_u);
    const double half = std::atan2(std::sqrt((swing - middle) * (swing + middle)), -middle);
    const Vec enter = circle.at(highest - half), leave = circle.at(highest + half);
    const double chord = 0.5 * std::atan2(glm::dot(n, glm::cross(leave, enter)), glm::dot(leave, enter));
    return std::clamp(arc(circle, n, highest - half, 2 * half) + chord, 0.0, pi);
}

}  // namespace pbr

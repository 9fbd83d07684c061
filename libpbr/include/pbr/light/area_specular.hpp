#pragma once
// Area lights in the GGX specular lobe by representative points, as Frostbite and Unreal do it. T is float or
// double.
//
// Known to be poor (Lagarde & de Rousiers 2014, 4.7.5: "none stand up to comparison with the reference"): the
// tests AreaSpecular.* integrate the lobe over the light and hold how far off this is. No 1/pi outside D_ggx.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "pbr/brdf/fresnel.hpp"
#include "pbr/brdf/ggx.hpp"
#include "pbr/ibl/dominant_direction.hpp"
#include "pbr/light/disk_light.hpp"
#include "pbr/light/rectangle_light.hpp"
#include "pbr/light/sphere_light.hpp"
#include "pbr/light/tube_light.hpp"

namespace pbr {

/// How fast a light's angular size widens the lobe in Karis' normalisation: alpha' = min(1, alpha + widening
/// * size / distance). The course notes print 1/3 (Karis 2013, "Real shading in Unreal Engine 4", section on
/// area lights) ...
inline constexpr double kCourseNotesWidening = 1.0 / 3.0;
/// ... and the engine's shader, which many copied, has 1/2.
inline constexpr double kShaderWidening = 0.5;

/// The unit vector about which the lobe is centred for area lights: R for a mirror, bent to the normal as it
/// gets rougher, normalize(lerp(n, R, 1 - alpha)) (Lagarde & de Rousiers 2014, 4.7.5, listing 16, whose
/// `roughness` is alpha as in listings 21 to 24, see ibl/dominant_direction.hpp: at alpha .1 to 1 and NoV .1 to
/// .9 it is on average 3.6 degrees from the mean of the GGX lobe, and 7.2 with perceptual roughness). wo and n
/// are unit vectors, n.wo > 0; alpha in [0, 1].
template <class T>
Vec3<T> dominant_direction_area(const Vec3<T>& n, const Vec3<T>& wo, T alpha) {
    return dominant_direction(n, T(2) * glm::dot(n, wo) * n - wo, T(1) - alpha);
}

/// The point of the ball nearest to the ray from p along the unit vector r; on the ray if it meets the ball
/// (Karis 2013, sphere lights).
template <class T>
Vec3<T> representative_point(const SphereLight<T>& light, const Vec3<T>& p, const Vec3<T>& r) {
    const Vec3<T> to_centre = light.centre - p;
    const Vec3<T> to_ray = glm::dot(to_centre, r) * r - to_centre;
    const T distance = glm::length(to_ray);
    return light.centre + to_ray * (distance > light.radius ? light.radius / distance : T(1));
}

/// The same for a tube: the axis' point nearest to the ray (Karis 2013, tube lights), then the ball about it.
/// The published point is that nearest to the ray's whole line; parallel to the axis it is the end nearer to
/// p.
template <class T>
Vec3<T> representative_point(const TubeLight<T>& light, const Vec3<T>& p, const Vec3<T>& r) {
    const Vec3<T> c0 = light.end0 - p, along = light.end1 - light.end0;
    const T across2 = glm::dot(along, along) - glm::dot(r, along) * glm::dot(r, along);
    const T t = across2 > T(0) ? (glm::dot(r, c0) * glm::dot(r, along) - glm::dot(c0, along)) / across2
                               : T(glm::dot(c0, c0) > glm::dot(light.end1 - p, light.end1 - p) ? 1 : 0);
    return representative_point(SphereLight<T>{light.end0 + std::clamp(t, T(0), T(1)) * along, light.radius},
                                p, r);
}

/// Where the ray from p along r meets the plane; far along its flat part if it leads away or along (the
/// cosine is held at 1e-4), so that clamping to an outline gives the rim on that side.
template <class T>
Vec3<T> point_on_plane(const Vec3<T>& p, const Vec3<T>& r, const Vec3<T>& centre, const Vec3<T>& normal) {
    const T height = glm::dot(p - centre, normal);
    const T descent = height > T(0) ? -glm::dot(r, normal) : glm::dot(r, normal);
    return p + r * (std::abs(height) / std::max(descent, T(1e-4)));
}

/// The point of the disk nearest to where the ray from p along r meets its plane (Lagarde & de Rousiers
/// 2014, 4.7.5).
template <class T>
Vec3<T> representative_point(const DiskLight<T>& light, const Vec3<T>& p, const Vec3<T>& r) {
    const Vec3<T> hit = point_on_plane(p, r, light.centre, light.normal) - light.centre;
    const Vec3<T> offset = hit - glm::dot(hit, light.normal) * light.normal;
    const T length = glm::length(offset);
    return light.centre + offset * (length > light.radius ? light.radius / length : T(1));
}

/// The same for a rectangle.
template <class T>
Vec3<T> representative_point(const RectangleLight<T>& light, const Vec3<T>& p, const Vec3<T>& r) {
    return closest_point(light, point_on_plane(p, r, light.centre, front_normal(light)));
}

/// (alpha / alpha')^dimensions: what a lobe that was cut off flat at the light's rim has gained, by Karis'
/// guess, which is independent of all directions. angular_size = size / distance >= 0, alpha in (0, 1]; in
/// (0, 1].
template <class T>
T widening_normalisation(T alpha, T angular_size, T widening) {
    return alpha / std::min(alpha + widening * std::min(angular_size, T(1)), T(1));
}

/// Normalisation of a sphere, (alpha / alpha')^2 with size its radius (Karis 2013, sphere lights). p is not
/// the centre.
template <class T>
T specular_normalisation(const SphereLight<T>& light, const Vec3<T>& p, T alpha, T widening) {
    const T ratio = widening_normalisation(alpha, light.radius / glm::length(light.centre - p), widening);
    return ratio * ratio;
}

/// Normalisation of a tube: that of its radius as a sphere times alpha / alpha' with size its length, both at
/// the distance of its middle (Karis 2013, tube lights).
template <class T>
T specular_normalisation(const TubeLight<T>& light, const Vec3<T>& p, T alpha, T widening) {
    const Vec3<T> along = light.end1 - light.end0, centre = light.end0 + T(0.5) * along;
    const T length_ratio =
        widening_normalisation(alpha, glm::length(along) / glm::length(centre - p), widening);
    return length_ratio * specular_normalisation(SphereLight<T>{centre, light.radius}, p, alpha, widening);
}

/// 1: Frostbite found no normalisation for disks (slides, "Area lights").
template <class T>
T specular_normalisation(const DiskLight<T>&, const Vec3<T>&, T, T) {
    return T(1);
}

/// 1: nor for rectangles.
template <class T>
T specular_normalisation(const RectangleLight<T>&, const Vec3<T>&, T, T) {
    return T(1);
}

/// The surface that reflects, at p: n its unit normal, wo the unit vector to the viewer, n.wo > 0.
template <class T>
struct SpecularSurface {
    Vec3<T> p;
    Vec3<T> n;
    Vec3<T> wo;
    T alpha;  ///< In (0, 1].
    T f0;     ///< Reflectance at normal incidence, in [0, 1]; f90 is 1.
};

/// The GGX BRDF D V F, 1/sr, for the unit vector wi; 0 below the horizon of either.
template <class T>
T f_specular(const SpecularSurface<T>& s, const Vec3<T>& wi) {
    const T NoL = glm::dot(s.n, wi), NoV = glm::dot(s.n, s.wo);
    if (!(NoL > T(0)) || !(NoV > T(0))) return T(0);
    const Vec3<T> wm = glm::normalize(s.wo + wi), flat = glm::cross(s.n, wm);
    return D_ggx(glm::dot(s.n, wm), glm::dot(flat, flat), s.alpha) *
           V_smith_ggx_correlated(NoL, NoV, s.alpha) * F_schlick(s.f0, T(1), glm::dot(s.wo, wm));
}

/// Reflected luminance over the light's luminance, >= 0, as Frostbite composes it: the BRDF at the
/// representative point of direction r times the normalisation times the exact projected solid angle (Lagarde
/// & de Rousiers 2014, 4.7.5, with Karis 2013). r: the mirror direction (Karis) or dominant_direction_area
/// (Frostbite). widening: kCourseNotesWidening or kShaderWidening. May exceed 1, which no mirror does. Ratio
/// to the integral over the light, for views at 10, 45 and 75 deg and lights within two of their radii of the
/// mirror direction, at radius / distance .2:
///   alpha                       .1            .25           .5
///   sphere, course notes        .72 - 4.6     .71 - 2.0     .80 - 1.4
///   sphere, shader              .50 - 3.2     .58 - 1.6     .71 - 1.2
///   tube, course notes          .37 - 2.2                   .61 - 1.1
///   tube, shader                .24 - 1.4                   .50 - .89
///   disk                        2.0 - 13      1.1 - 3.1     1.0 - 1.7
///   square                      2.2 - 15      1.2 - 3.4     1.0 - 1.8
template <class T, class Light>
T reflected_luminance_mrp(const Light& light, const SpecularSurface<T>& surface, const Vec3<T>& r,
                          T widening) {
    const Vec3<T> to_point = representative_point(light, surface.p, r) - surface.p;
    const T distance = glm::length(to_point);
    if (!(distance > T(0))) return T(0);
    return f_specular(surface, to_point / distance) * projected_solid_angle(light, surface.p, surface.n) *
           specular_normalisation(light, surface.p, surface.alpha, widening);
}

}  // namespace pbr

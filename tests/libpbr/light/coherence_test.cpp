// One frame of reference for all lights (Lagarde & de Rousiers 2014, 4.3): a light gives a matte plane the
// same lux whatever unit and whatever kind of light it is stated as. What the plane receives of a shape is
// integrated here over the shape's own surface.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/light/disk_light.hpp"
#include "pbr/light/emissive.hpp"
#include "pbr/light/luminous_efficacy.hpp"
#include "pbr/light/photometric_web.hpp"
#include "pbr/light/punctual.hpp"
#include "pbr/light/rectangle_light.hpp"
#include "pbr/light/solid_angle.hpp"
#include "pbr/light/sphere_light.hpp"
#include "pbr/light/sun.hpp"
#include "pbr/light/tube_light.hpp"
#include "pbr/light/unit_conversions.hpp"
#include "pbr/reference/reflected_texels.hpp"
#include "tests/libpbr/support/integrate.hpp"

namespace pbr {
namespace {

using Vec = Vec3<double>;
constexpr double kPi = std::numbers::pi, kNoWindow = std::numeric_limits<double>::infinity();

/// The side of a surface element that shines: its point and its area vector, which is the normal times area
/// over du dv.
struct Element {
    Vec point;
    Vec area;
};

/// Illuminance at a point with unit normal, of a surface (u, v in [0, 1] -> Element) of luminance 1: the sum
/// of cos cos / d^2 over n x n elements. Error of the order of n^-2.
double lux_of_surface(const auto& surface, const Vec& at, const Vec& normal, int n) {
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Element e = surface((i + .5) / n, (j + .5) / n);
            const Vec way = e.point - at;
            const double d2 = glm::dot(way, way);
            sum += std::max(glm::dot(normal, way), 0.0) * std::max(-glm::dot(e.area, way), 0.0) / (d2 * d2);
        }
    return sum / n / n;
}

/// A shape's place: its middle, the direction it faces, and its length across.
struct Frame {
    Vec middle, facing, along;
    Vec across() const { return glm::cross(facing, along); }
};

auto sphere_surface(const Frame& f, double r) {
    return [=](double u, double v) {
        const double theta = kPi * u, phi = 2 * kPi * v;
        const Vec out = std::cos(phi) * f.along + std::sin(phi) * f.across();
        const Vec n = std::cos(theta) * f.facing + std::sin(theta) * out;
        return Element{f.middle + r * n, 2 * kPi * kPi * r * r * std::sin(theta) * n};
    };
}

auto disk_surface(const Frame& f, double r) {
    return [=](double u, double v) {
        const double phi = 2 * kPi * v;
        return Element{f.middle + r * u * (std::cos(phi) * f.along + std::sin(phi) * f.across()),
                       2 * kPi * r * r * u * f.facing};
    };
}

auto rectangle_surface(const Frame& f, double width, double height) {
    return [=](double u, double v) {
        return Element{f.middle + (u - .5) * width * f.along + (v - .5) * height * f.across(),
                       width * height * f.facing};
    };
}

/// The meridian of a tube goes u = 0 … 1 round one cap, along the side and round the other.
auto tube_surface(const Frame& f, double r, double length) {
    return [=](double u, double v) {
        const double meridian = kPi * r + length, s = u * meridian - meridian / 2, phi = 2 * kPi * v;
        const double beyond = std::max(std::abs(s) - length / 2, 0.0), angle = std::copysign(beyond / r, s);
        const Vec out = std::cos(phi) * f.facing + std::sin(phi) * f.across();
        const Vec n = std::cos(angle) * out + std::sin(angle) * f.along;
        const double radius = r * std::cos(angle);
        return Element{f.middle + std::clamp(s, -length / 2, length / 2) * f.along + r * n,
                       meridian * 2 * kPi * radius * n};
    };
}

// The light of the table: 250 cd seen from a plane 200 m away, 40 degrees off the plane's normal.
constexpr Candelas<double> kIntensity(250);
constexpr double kDistance_m = 200, kSize_m = .1;
const double kNoL = std::cos(40 * kPi / 180);
const Vec kToLight(std::sin(40 * kPi / 180), 0, kNoL), kUp(0, 0, 1), kPlace = kDistance_m * kToLight;
const Frame kFrame{kPlace, -kToLight, Vec(0, 1, 0)};
const Lux<double> kFacingLux(kIntensity.value() / (kDistance_m * kDistance_m));

double point_lux(Candelas<double> I) { return illuminance_of_point(I, kPlace, kUp, kNoWindow).value(); }

double spot_lux(Candelas<double> I, const SpotCone<double>& cone) {
    return illuminance_of_spot(I, -kToLight, cone, kPlace, kUp, kNoWindow).value();
}

double surface_lux(Nits<double> L, const auto& surface) {
    return L.value() * lux_of_surface(surface, Vec(0), kUp, 800);
}

/// An area light by its closed form.
double area_light_lux(Candelas<double> I, const Emitter<double>& emitter, const auto& light) {
    return luminance_from_intensity(I, emitter).value() * projected_solid_angle(light, Vec(0), kUp);
}

/// The sun stated by its luminance: integrated over the directions of its disk, in its own frame.
double sky_disk_lux(Nits<double> L, double half_angle) {
    const Vec u(0, 1, 0), v = glm::cross(kToLight, u);
    const auto at = [&](const Vec& w) {
        return L.value() * glm::dot(kUp, w.x * u + w.y * v + w.z * kToLight);
    };
    return integrate_directions(at, std::cos(half_angle), 1);
}

/// An environment map, black but for the texel that holds the light, of luminance L: integrated over the
/// texel's square. The plane is turned so that the texel's middle stands 40 degrees off its normal.
double environment_lux(int size, const CubeTexel& texel) {
    const Nits<double> L(kFacingLux.value() / cubemap_texel_solid_angle(size, texel.x, texel.y));
    const Vec middle = cubemap_texel_direction(texel, size);
    const Vec side = glm::normalize(glm::cross(middle, Vec(.3, -.2, .9)));
    const Vec normal = kNoL * middle + std::sin(40 * kPi / 180) * side;
    constexpr int kSub = 32;
    double sum = 0;
    for (int i = 0; i < kSub; ++i)
        for (int j = 0; j < kSub; ++j) {
            const double s = 2 * (texel.x + (i + .5) / kSub) / size - 1,
                         t = 2 * (texel.y + (j + .5) / kSub) / size - 1;
            const Vec w = cube_vector(texel.face, s, t);
            sum +=
                glm::dot(normal, w) / std::pow(glm::dot(w, w), 2);  // cos / d^2 of the cube's plane, 1 away
        }
    return L.value() * sum * 4 / (double(size) * size * kSub * kSub);
}

/// The same by the reference for pictures: irradiance is pi times what white Lambert reflects, whose BRDF is
/// 1/pi.
double environment_lux_by_reference(const CubeTexel& texel) {
    constexpr int kSize = 512;
    std::vector<float> rgb(6 * kSize * kSize * 3);
    const double L = kFacingLux.value() / cubemap_texel_solid_angle(kSize, texel.x, texel.y);
    rgb[((texel.face * kSize + texel.y) * kSize + texel.x) * 3 + 1] = static_cast<float>(L);
    const PatchBlocks source(CubeView{rgb.data(), kSize}, std::span(&texel, 1));
    const Vec middle = cubemap_texel_direction(texel, kSize);
    const Vec side = glm::normalize(glm::cross(middle, Vec(.3, -.2, .9)));
    const AxisFrame<double> frame = frame_about(kNoL * middle + std::sin(40 * kPi / 180) * side);
    const auto one = [](const Vec&, const Vec&) { return 1.0; };
    return reflected_radiance_from_texels(one, Vec(0, 0, 1), source,
                                          glm::transpose(glm::dmat3(frame.x, frame.y, frame.z)))
        .value.y;
}

/// A photometric web that is alike all round, as measured candela or, given `power`, as the shape of a lamp
/// of other lumens.
double web_lux(Photometry type, double candela, std::optional<Lumens<double>> power) {
    const bool c = type == Photometry::type_c;
    const std::vector<double> vertical =
        c ? std::vector<double>{0, 90, 180} : std::vector<double>{-90, 0, 90};
    const std::vector<double> horizontal = c ? std::vector<double>{0} : std::vector<double>{-180, 0, 180};
    const bool b = type == Photometry::type_b;  // its elevation is the horizontal angle
    const PhotometricWeb web(type, c ? HorizontalCover::axial : HorizontalCover::range,
                             b ? horizontal : vertical, b ? vertical : horizontal,
                             std::vector<double>(vertical.size() * horizontal.size(), candela));
    const double scale = power ? power->value() / web.flux_lm() : 1;
    return point_lux(Candelas<double>(web.evaluate_cd({.3, -.2, -.7}) * scale));
}

/// A way to state the light, and the lux that the plane then gets.
struct Statement {
    std::string what;
    double lux;
};

/// Every way there is to state the same light. A new kind of light is one line: state it so that kIntensity
/// is seen from where it looks largest, and give the lux on a plane at the origin, normal kUp, with the light
/// at kPlace.
std::vector<Statement> statements() {
    const Candelas<double> I = kIntensity;
    const Steradians<double> all = solid_angle_whole_sphere<double>();
    const SpotCone<double> cone = spot_cone(.3, .5);
    const Emitter<double> sphere = emitter_sphere(kSize_m), disk = emitter_disk(kSize_m),
                          rectangle = emitter_rectangle(.2, .1), tube = emitter_tube(.02, .2);
    // Lumens and watts that the intensity stands for, worked out by hand from each shape's area: pi L A with
    // L = I / facing area, so 4 pi I of a sphere, pi I of what is flat, and so on.
    const auto from_lumens = [&](double power_lm, const Emitter<double>& shape) {
        return luminance_from_power(Lumens<double>(power_lm), shape);
    };
    const double sphere_lm = 250 * 4 * kPi, flat_lm = 250 * kPi;
    const double tube_lm =
        250 * kPi * (2 * kPi * .02 * (.2 + .04)) / (.2 * .04 + kPi * .0004);  // surface / largest shadow
    const double cone_lm = 250 * 2 * kPi * (1 - std::cos(.5));
    // Of the penumbra, a square of the cosine's share, a third is left.
    const double spot_lm = 250 * 2 * kPi * ((std::cos(.3) - std::cos(.5)) / 3 + 1 - std::cos(.3));
    const auto on_sphere = sphere_surface(kFrame, kSize_m);
    const auto on_disk = disk_surface(kFrame, kSize_m);
    const auto on_rectangle = rectangle_surface(kFrame, .2, .1);
    const auto on_tube = tube_surface(kFrame, .02, .2);

    const RectangleLight<double> rectangle_light{kPlace, .1 * kFrame.along, .05 * kFrame.across()};

    const DiskLight<double> two_sided_disk{kPlace, kToLight, kSize_m, Emission::two_sided};
    RectangleLight<double> two_sided_rectangle = rectangle_light;
    two_sided_rectangle.emission = Emission::two_sided;

    // The rectangle again, as the two triangles of an emissive mesh.
    const Vec a(0, 0, 0), b(.2, 0, 0), c(.2, .1, 0), d(0, .1, 0);
    const double mesh_area = triangle_area(a, b, c) + triangle_area(a, c, d);
    const Emitter<double> mesh{mesh_area, mesh_area};
    const Ev100<double> screen = ev100_from_luminance(luminance_from_intensity(I, rectangle));
    const LumensPerWatt<double> bulb(15);
    const Watts<double> plug(250 * 4 * kPi / 15);
    const double sun = kSunHalfAngle_rad;

    return {
        {"point, cd", point_lux(I)},
        {"point, lm", point_lux(intensity_from_power(Lumens<double>(sphere_lm), all))},
        {"point, W", point_lux(intensity_from_power(power_from_watts(plug, bulb), all))},
        {"spot, cd", spot_lux(I, cone)},
        {"spot, lm of its penumbra",
         spot_lux(intensity_from_power(Lumens<double>(spot_lm), solid_angle_of_spot(cone)), cone)},
        {"spot, lm of its cone",
         spot_lux(intensity_from_power(Lumens<double>(cone_lm), solid_angle_cone(.5)), cone)},
        {"spot, Frostbite's lm", spot_lux(intensity_of_frostbite_spot(Lumens<double>(flat_lm)), cone)},
        {"sphere, lm", surface_lux(from_lumens(sphere_lm, sphere), on_sphere)},
        {"sphere, nit", surface_lux(luminance_from_intensity(I, sphere), on_sphere)},
        {"disk, lm", surface_lux(from_lumens(flat_lm, disk), on_disk)},
        {"disk, nit", surface_lux(luminance_from_intensity(I, disk), on_disk)},
        {"rectangle, lm", surface_lux(from_lumens(flat_lm, rectangle), on_rectangle)},
        {"rectangle, EV", surface_lux(luminance_from_ev100(screen), on_rectangle)},
        {"tube, lm", surface_lux(from_lumens(tube_lm, tube), on_tube)},
        {"emissive mesh, lm", surface_lux(from_lumens(flat_lm, mesh), on_rectangle)},
        {"emissive, stops above the camera",
         surface_lux(emissive_luminance(Ev100<double>(9), screen - Ev100<double>(9)), on_rectangle)},
        {"emissive, exitance",
         surface_lux(luminance_from_exitance(exitance_from_luminance(luminance_from_intensity(I, disk))),
                     on_disk)},
        {"sphere light", area_light_lux(I, sphere, SphereLight<double>{kPlace, kSize_m})},
        {"disk light", area_light_lux(I, disk, DiskLight<double>{kPlace, -kToLight, kSize_m})},
        {"rectangle light", area_light_lux(I, rectangle, rectangle_light)},
        {"tube light",
         area_light_lux(I, tube,
                        TubeLight<double>{kPlace - .1 * kFrame.along, kPlace + .1 * kFrame.along, .02})},
        // Both faces shine: twice the lumens for the same intensity.
        {"two-sided disk light, lm", from_lumens(2 * flat_lm, emitter_of(two_sided_disk)).value() *
                                         projected_solid_angle(two_sided_disk, Vec(0), kUp)},
        {"two-sided rectangle light, lm", from_lumens(2 * flat_lm, emitter_of(two_sided_rectangle)).value() *
                                              projected_solid_angle(two_sided_rectangle, Vec(0), kUp)},
        {"sun, lx", kFacingLux.value() * glm::dot(kToLight, kUp)},
        {"sun, nit", sky_disk_lux(disk_luminance_from_illuminance(kFacingLux, sun), sun)},
        {"environment, texel at a face's middle", environment_lux(1024, {2, 511, 512})},
        {"environment, texel at a corner", environment_lux(1024, {5, 0, 1023})},
        {"web of type C, cd", web_lux(Photometry::type_c, 250, {})},
        {"web of type A, cd", web_lux(Photometry::type_a, 250, {})},
        {"web of type C, lm", web_lux(Photometry::type_c, 3, Lumens<double>(1000 * kPi))},
        {"web of type B, lm", web_lux(Photometry::type_b, .5, Lumens<double>(1000 * kPi))},
        {"environment, by the reference", environment_lux_by_reference({1, 300, 20})},
    };
}

TEST(Coherence, OneLightGivesTheSameLuxHoweverItIsStated) {
    const double expected = kFacingLux.value() * kNoL;
    // Far shapes differ from points by (size/distance)^2 = 2.5e-7, texels and the sums over shapes by about
    // 1e-6.
    for (const Statement& statement : statements())
        EXPECT_NEAR(statement.lux / expected, 1, 3e-6) << statement.what;
}

TEST(Coherence, AWhiteSkyOfTexelsGivesWhatAnEmissiveCeilingDoes) {
    // All around, 7 nit: from texels with their exact solid angles, from the sky as one disk, and from a
    // surface's own exitance.
    constexpr int kSize = 256;
    const Vec normal = glm::normalize(Vec(.2, .9, -.4));
    double lux = 0;
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x)
                lux += 7 * cubemap_texel_solid_angle(kSize, x, y) *
                       std::max(glm::dot(normal, cubemap_texel_direction({face, x, y}, kSize)), 0.0);
    EXPECT_NEAR(lux / exitance_from_luminance(Nits<double>(7)).value(), 1, 1e-4);
    EXPECT_NEAR(lux / illuminance_from_disk_luminance(Nits<double>(7), kPi / 2).value(), 1, 1e-4);
}

TEST(Coherence, AnEmitterIsWhatItsLightIs) {
    const auto same = [](const Emitter<double>& a, const Emitter<double>& b) {
        EXPECT_NEAR(a.area_m2 / b.area_m2, 1, 1e-15);
        EXPECT_NEAR(a.facing_area_m2 / b.facing_area_m2, 1, 1e-15);
    };
    same(emitter_of(SphereLight<double>{Vec(1), .3}), emitter_sphere(.3));
    same(emitter_of(TubeLight<double>{Vec(0, 0, 1), Vec(0, 0, 3), .3}), emitter_tube(.3, 2.0));
    DiskLight<double> disk{Vec(0), kUp, .3};
    RectangleLight<double> rectangle{Vec(0), Vec(.2, 0, 0), Vec(0, .5, 0)};
    same(emitter_of(disk), emitter_disk(.3));
    same(emitter_of(rectangle), emitter_rectangle(.4, 1.0));
    disk.emission = rectangle.emission = Emission::two_sided;
    same(emitter_of(disk), {2 * emitter_disk(.3).area_m2, emitter_disk(.3).facing_area_m2});
    same(emitter_of(rectangle), {.8, .4});
}

/// Flux through a sphere of radius R about the shape, as lux on its inside; the shape's luminance is 1. z in
/// [-1, 1] in two halves, as a one-sided light has an edge at 0.
double flux_through_enclosing_sphere(const auto& surface, double R, int directions, int elements) {
    double flux = 0;
    for (int i = 0; i < directions; ++i)
        for (int j = 0; j < directions; ++j) {
            const double z = 2 * (i + .5) / directions - 1, s = std::sqrt(1 - z * z),
                         phi = 2 * kPi * (j + .5) / directions;
            const Vec w(s * std::cos(phi), s * std::sin(phi), z);
            flux += lux_of_surface(surface, R * w, -w, elements);
        }
    return flux * 4 * kPi * R * R / directions / directions;
}

TEST(Coherence, AnEnclosingSphereCatchesTheLumensOfEveryShape) {
    // Near by, where no light is a point any more. Conversions must hold lumens to pi A L: 1000 lm in, 1000
    // lm out.
    const Lumens<double> power(1000);
    const Frame f{Vec(0), Vec(0, 0, 1), Vec(1, 0, 0)};
    const auto caught = [&](const Emitter<double>& shape, const auto& surface) {
        return luminance_from_power(power, shape).value() *
               flux_through_enclosing_sphere(surface, 2.5, 40, 40);
    };
    EXPECT_NEAR(caught(emitter_sphere(1.0), sphere_surface(f, 1)), 1000, 2);
    EXPECT_NEAR(caught(emitter_disk(1.0), disk_surface(f, 1)), 1000, 2);
    EXPECT_NEAR(caught(emitter_rectangle(1.5, .8), rectangle_surface(f, 1.5, .8)), 1000, 2);
    EXPECT_NEAR(caught(emitter_tube(.4, 1.2), tube_surface(f, .4, 1.2)), 1000, 2);
}

TEST(Coherence, NearLightsAgreeWithTheirKnownFormFactors) {
    // On the axis, sphere and disk that fill the same cone of half-angle s give pi L sin^2 s: as the sun
    // does.
    const double s = .6, L = 7;
    const double expected = illuminance_from_disk_luminance(Nits<double>(L), s).value();
    const auto frame = [](double distance) {
        return Frame{Vec(0, 0, distance), Vec(0, 0, -1), Vec(1, 0, 0)};
    };
    const double sphere = L * lux_of_surface(sphere_surface(frame(1 / std::sin(s)), 1), Vec(0), kUp, 800);
    const double disk = L * lux_of_surface(disk_surface(frame(1 / std::tan(s)), 1), Vec(0), kUp, 800);
    EXPECT_NEAR(sphere / expected, 1, 1e-5);
    EXPECT_NEAR(disk / expected, 1, 1e-5);
    const auto sky = [&](const Vec& w) { return L * w.z; };
    EXPECT_NEAR(integrate_directions(sky, std::cos(s), 1) / expected, 1, 1e-10);
}

}  // namespace
}  // namespace pbr

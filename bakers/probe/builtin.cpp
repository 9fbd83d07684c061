// Procedural environments in absolute luminance, so that everything can be tried without a file.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <string_view>

#include "bakers/probe/probe.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"
#include "pbr/numerics/sum.hpp"

namespace pbrbake::probe {
namespace {

constexpr int kWidth = 1024, kHeight = 512;

/// Linear Rec.709 of a tint, scaled to a luminance in cd/m^2.
glm::dvec3 light(double luminance_nit, const glm::dvec3& tint) {
    return tint * (luminance_nit / glm::dot(tint, glm::dvec3(0.2126, 0.7152, 0.0722)));
}

glm::dvec3 mix(const glm::dvec3& a, const glm::dvec3& b, double t) {
    return a + (b - a) * std::clamp(t, 0.0, 1.0);
}

// --- outdoor: a clear sky, the sun at 45 degrees, and ground of albedo .2
// ----------------------------------------------

constexpr double kSunHalfAngle = 0.00465;      // rad: .53 degrees across
constexpr double kSunIlluminance = 100'000.0;  // lx, on a plane facing it; 1.47e9 cd/m^2 over 6.79e-5 sr

/// 45 degrees high, in the middle of a texel, which then lies wholly inside the disk and shows its full
/// luminance.
glm::dvec3 sun_direction() { return pbr::equirect_direction(597.5 / kWidth, 127.5 / kHeight); }

glm::dvec3 clear_sky(const glm::dvec3& d) {
    if (d.y < 0)  // (100 klx sin 45 deg + about 15 klx of sky) * .2 / pi, darker straight below where things
                  // cast shadows
        return light(mix({5400, 0, 0}, {3600, 0, 0}, d.y * d.y).x, {1.05, 1.0, 0.85});
    const double height = std::sqrt(d.y);
    const glm::dvec3 gradient = mix(light(9000, {0.85, 1.0, 1.25}), light(2500, {0.45, 0.85, 1.9}), height);
    const double towards_sun = std::max(0.0, glm::dot(d, sun_direction()));
    const double towards2 = towards_sun * towards_sun, towards8 = towards2 * towards2 * towards2 * towards2;
    return gradient +
           light(12000, {1.1, 1.0, 0.85}) * (towards8 * towards8 * towards8 * 0.6 + towards8 * 0.15);
}

/// Adds the sun's disk: its flux shared among texels by how much of each it covers, and exact in sum.
void add_sun(Level& level) {
    constexpr int kGrid = 16;
    const glm::dvec3 sun = sun_direction();
    const double half = pbr::sin_cos_pi(kSunHalfAngle / 2 / std::numbers::pi).sin,
                 radius2 = 4 * half * half;  // squared chord of the disk's edge
    std::vector<double> covered(level.texels.size() / 3, 0.0);
    pbr::CompensatedSum total;
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 centre = pbr::equirect_direction((x + 0.5) / kWidth, (y + 0.5) / kHeight);
            if (glm::dot(centre, sun) < 0.999) continue;
            for (int k = 0; k < kGrid * kGrid; ++k) {
                const double u = x + (k % kGrid + 0.5) / kGrid, v = y + (k / kGrid + 0.5) / kGrid;
                const glm::dvec3 away = pbr::equirect_direction(u / kWidth, v / kHeight) - sun;
                if (glm::dot(away, away) < radius2)
                    covered[static_cast<std::size_t>(y) * kWidth + x] += pbr::sin_cos_pi(v / kHeight).sin;
            }
            total += covered[static_cast<std::size_t>(y) * kWidth + x];
        }
    // E of a small source facing the plane is the integral of L cos over its disk: pi sin^2(half angle) L.
    // and the flux of the disk is L times its solid angle, 4 pi sin^2(half angle / 2).
    const double sine = pbr::sin_cos_pi(kSunHalfAngle / std::numbers::pi).sin;
    const double flux = kSunIlluminance * 4 * half * half / (sine * sine);
    const glm::dvec3 colour = light(flux, {1.08, 1.0, 0.88});
    for (int y = 0; y < kHeight; ++y) {
        const double texel = pbr::equirect_texel_solid_angle(kWidth, kHeight, y);
        for (int x = 0; x < kWidth; ++x) {
            const std::size_t i = static_cast<std::size_t>(y) * kWidth + x;
            for (int c = 0; c < 3 && covered[i] > 0; ++c)
                level.texels[i * 3 + c] += static_cast<float>(colour[c] * covered[i] / total.value() / texel);
        }
    }
}

// --- indoor: a room of 7 x 3 x 5 m with a window, two lamps and a tiled floor, seen from 1.5 m above its
// middle --------

glm::dvec3 room(const glm::dvec3& d) {
    const glm::dvec3 half(3.5, 1.5, 2.5);
    const auto distance = [&](int axis) { return d[axis] == 0 ? 1e9 : half[axis] / std::abs(d[axis]); };
    int wall = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (distance(axis) < distance(wall)) wall = axis;
    const glm::dvec3 p = d * distance(wall);
    // The window's light falls off across the room.
    const double daylight = 0.35 + 0.65 / (1 + (3.5 - p.x) * (3.5 - p.x) / 6);
    if (wall == 0 && d.x > 0 && std::abs(p.z) < 1.4 && p.y > -0.5 && p.y < 1.1) {
        const bool frame = std::abs(p.z) < 0.05 || std::abs(p.y - 0.3) < 0.04;
        return frame ? light(90, {1, 1, 1}) : light(p.y > 0 ? 6000 : 3500, {0.85, 1.0, 1.2});
    }
    if (wall == 1 && d.y > 0) {
        for (const double x : {-1.5, 1.0})
            if ((p.x - x) * (p.x - x) + p.z * p.z < 0.12 * 0.12) return light(20000, {1.4, 1.0, 0.55});
        return light(110 * daylight, {1.05, 1, 0.9});
    }
    if (wall == 1) {
        const bool dark =
            (static_cast<int>(std::floor(p.x / 0.5)) + static_cast<int>(std::floor(p.z / 0.5))) % 2 != 0;
        return light((dark ? 25 : 80) * daylight, {1.1, 1, 0.85});
    }
    return light((wall == 2 ? 75 : 60) * daylight,
                 wall == 2 ? glm::dvec3(1, 1, 0.95) : glm::dvec3(0.8, 1, 0.9));
}

// --- for studies: what is simple to say and hard, or very easy, to filter
// ----------------------------------------

/// The same everywhere: whatever a method makes of it but this is its own.
glm::dvec3 grey() { return glm::dvec3(1000); }

/// Each texel's channels independent and even between 0 and 2,000: as much in high bands as in low ones.
glm::dvec3 noise(int x, int y) {
    const auto texel = static_cast<std::uint64_t>(y) * kWidth + static_cast<std::uint64_t>(x);
    const auto channel = [&](std::uint64_t c) { return 2000 * pbr::random_unit(0x6e6f697365u, texel, c); };
    return {channel(0), channel(1), channel(2)};
}

/// A night: ground and sky of .01 cd/m^2, and lamps of 1e6 cd/m^2, a texel each, even over the sphere.
constexpr int kLamps = 40;
constexpr double kDark = 0.01, kLamp = 1e6;

void add_lamps(Level& level) {
    constexpr std::uint64_t kStream = 0x6c616d70u;
    for (std::uint64_t i = 0; i < kLamps; ++i) {
        const double height =
            1 - 2 * (static_cast<double>(i) + .5) / kLamps;  // even in y: even in solid angle
        int y = 0;
        while (y + 1 < kHeight && pbr::equirect_direction(.5, (y + 1.0) / kHeight).y > height) ++y;
        const int x = static_cast<int>(pbr::random_unit(kStream, i) * kWidth);
        const glm::dvec3 colour = light(kLamp, i % 2 ? glm::dvec3(1.4, 1, .55) : glm::dvec3(.85, 1, 1.2));
        for (int c = 0; c < 3; ++c)
            level.texels[(static_cast<std::size_t>(y) * kWidth + x) * 3 + c] = static_cast<float>(colour[c]);
    }
}

glm::dvec3 radiance_of(const std::string& name, const glm::dvec3& d, int x, int y) {
    if (name == "outdoor") return clear_sky(d);
    if (name == "indoor") return room(d);
    if (name == "noise") return noise(x, y);
    return name == "contrast" ? light(kDark, {1, 1, 1}) : grey();
}

}  // namespace

SourceImage builtin_environment(const std::string& name) {
    constexpr std::array<std::string_view, 5> kNames{"outdoor", "indoor", "contrast", "noise", "constant"};
    if (std::ranges::find(kNames, name) == kNames.end())
        throw Error(ExitCode::unreadable_input, "builtin:" + name,
                    "there is no such environment; allowed: builtin:outdoor, builtin:indoor, "
                    "builtin:contrast, builtin:noise, builtin:constant");
    SourceImage source;
    source.image.channels = {"R", "G", "B"};
    source.image.levels.push_back({kWidth, kHeight, std::vector<float>(std::size_t{kWidth} * kHeight * 3)});
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const glm::dvec3 d = pbr::equirect_direction((x + 0.5) / kWidth, (y + 0.5) / kHeight);
            const glm::dvec3 radiance = radiance_of(name, d, x, y);
            for (int c = 0; c < 3; ++c) source.image.texel(0, 0, y, x)[c] = static_cast<float>(radiance[c]);
        }
    if (name == "outdoor") add_sun(source.image.levels[0]);
    if (name == "contrast") add_lamps(source.image.levels[0]);
    source.colour_space = "lin_rec709";
    source.units = "cd/m^2";
    source.hash = "procedural-1";  // raised when the pictures change
    return source;
}

}  // namespace pbrbake::probe

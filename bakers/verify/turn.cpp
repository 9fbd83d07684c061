#include "bakers/verify/turn.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/verify/face.hpp"
#include "bakers/verify/picture.hpp"
#include "pbr/ibl/cubemap.hpp"

namespace pbrbake::verify {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr int kAround = 64;  // directions of a ring
constexpr std::array<double, 5> kHeights{-0.6, -0.3, 0, 0.3, 0.6};

Image shrunk_cube(const Image& image, int level) {
    Image cube;
    cube.channels = image.channels;
    cube.faces = 6;
    Level all;
    for (int face = 0; face < 6; ++face) {
        const Face small = shrunk(face_of(image, level, face), kTurnedSide);
        all.width = small.width;
        all.height = small.height;
        all.texels.insert(all.texels.end(), small.texels.begin(), small.texels.end());
    }
    cube.levels.push_back(std::move(all));
    return cube;
}

/// A cube map on rings about the vertical, each value over itself and what is typical: no lamp outweighs the
/// rest.
class Rings {
  public:
    Rings(const Image& cube, const std::vector<double>& typical)
        : radiance_(radiance_of_level(cube, 0, 1)), typical_(typical[0], typical[1], typical[2]) {}

    std::vector<glm::dvec3> turned(double angle) const {
        std::vector<glm::dvec3> values;
        for (const double height : kHeights)
            for (int i = 0; i < kAround; ++i) {
                const glm::dvec3 rgb = radiance_(direction(height, kTurn * i / kAround + angle));
                values.push_back(rgb / (glm::abs(rgb) + typical_));
            }
        return values;
    }

  private:
    static glm::dvec3 direction(double height, double azimuth) {
        const double radius = std::sqrt(1 - height * height);
        return {radius * std::cos(azimuth), height, radius * std::sin(azimuth)};
    }
    Radiance radiance_;
    glm::dvec3 typical_;
};

/// Sum of squared differences of a and of b, moved on by some directions of a ring.
double apart(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b, int moved) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::size_t ring = i / kAround * kAround;
        const glm::dvec3 d = a[i] - b[ring + (i - ring + static_cast<std::size_t>(moved)) % kAround];
        sum += glm::dot(d, d);
    }
    return sum;
}

/// The angle of least distance: the nearest step of a ring, then a golden section between its neighbours.
double best_angle(const Rings& rings_a, const Rings& rings_b) {
    const std::vector<glm::dvec3> a = rings_a.turned(0), b = rings_b.turned(0);
    int nearest = 0;
    for (int moved = 1; moved < kAround; ++moved)
        if (apart(a, b, moved) < apart(a, b, nearest)) nearest = moved;
    double low = kTurn * (nearest - 1) / kAround, high = kTurn * (nearest + 1) / kAround;
    constexpr int kSections = 12;  // to a 300th of the interval
    for (int i = 0; i < kSections; ++i) {
        const double third = (high - low) * (2 - std::numbers::phi);
        const bool is_lower =
            apart(a, rings_b.turned(low + third), 0) < apart(a, rings_b.turned(high - third), 0);
        (is_lower ? high : low) = is_lower ? high - third : low + third;
    }
    return std::remainder((low + high) / 2, kTurn);
}

/// A face of a cube map that is turned by an angle.
Face turned_face(const Radiance& radiance, int face, int n, double angle) {
    Face turned{n, n, 3, std::vector<float>(static_cast<std::size_t>(n) * n * 3)};
    const double cosine = std::cos(angle), sine = std::sin(angle);
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const glm::dvec3 d = pbr::cubemap_texel_direction({face, x, y}, n);
            const glm::dvec3 rgb = radiance({cosine * d.x - sine * d.z, d.y, sine * d.x + cosine * d.z});
            for (int c = 0; c < 3; ++c) turned.at(x, y, c) = static_cast<float>(rgb[c]);
        }
    return turned;
}

}  // namespace

Turn vertical_turn(const Image& a, const Image& b, int level, const std::vector<double>& typical) {
    const Image small_a = shrunk_cube(a, level), small_b = shrunk_cube(b, level);
    const double angle = best_angle(Rings(small_a, typical), Rings(small_b, typical));
    const Radiance radiance = radiance_of_level(small_b, 0, 1);
    double left = 0, there = 0;
    for (int face = 0; face < 6; ++face) {
        const Face of_a = face_of(small_a, 0, face);
        there += distance(of_a, face_of(small_b, 0, face), typical);
        left += distance(of_a, turned_face(radiance, face, of_a.width, angle), typical);
    }
    return {angle * 180 / std::numbers::pi, there > 0 ? left / there : 1};
}

}  // namespace pbrbake::verify

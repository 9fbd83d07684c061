#include "bakers/verify/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

#include "bakers/io/io.hpp"
#include "bakers/verify/page.hpp"
#include "pbr/brdf/roughness.hpp"
#include "pbr/camera/exposure.hpp"
#include "pbr/ibl/cubemap.hpp"

namespace pbrbake::verify {
namespace {

/// Where the six faces lie in the unfolded cross, in faces: +X -X +Y -Y +Z -Z.
constexpr std::array<std::array<int, 2>, 6> kCrossPlaces{{{2, 1}, {0, 1}, {1, 0}, {1, 2}, {1, 1}, {3, 1}}};

constexpr int kGrid = 2;  // samples a side of a pixel

/// Calls colour(u, v) for the samples of every pixel, in pixels, and stores their means. Each sample is
/// clipped before: a highlight's edge is then as smooth as any other.
template <class Colour>
Picture rendered(int width, int height, const Colour& colour) {
    Picture picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::dvec3 sum(0);
            for (int k = 0; k < kGrid * kGrid; ++k)
                sum += glm::clamp(colour(x + (k % kGrid + 0.5) / kGrid, y + (k / kGrid + 0.5) / kGrid), 0.0,
                                  1.0);
            put(picture, x, y, sum / double{kGrid * kGrid});
        }
    return picture;
}

/// Normal of a ball at (u, v) of its unit disk, v upwards.
glm::dvec3 ball_normal(const View& view, double u, double v) {
    const double depth = std::sqrt(std::max(0.0, 1 - u * u - v * v));
    return u * view.right + v * view.up - depth * view.forward;
}

/// The same, of the nearest point of the disk for (u, v) beyond it.
glm::dvec3 rim_clamped_normal(const View& view, double u, double v) {
    constexpr double kRim = 0.9999;
    const double shrink = std::min(1.0, kRim / std::max(std::hypot(u, v), kRim));
    return ball_normal(view, u * shrink, v * shrink);
}

}  // namespace

std::string data_uri(const Picture& picture) {
    return "data:image/png;base64," + base64(io::encode_png8(picture.width, picture.height, picture.rgb));
}

double exposure_of_ev100(double ev100) { return pbr::exposure_by_saturation(pbr::Ev100<double>(ev100)); }

std::uint8_t srgb_byte(double linear) {
    if (!(linear > 0)) return 0;
    const double value = std::min(linear, 1.0);
    const double encoded = value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

glm::dvec3 linear_of_display(const glm::dvec3& encoded) {
    glm::dvec3 linear;
    for (int c = 0; c < 3; ++c)
        linear[c] = encoded[c] <= 0.04045 ? encoded[c] / 12.92 : std::pow((encoded[c] + 0.055) / 1.055, 2.4);
    return linear;
}

void put(Picture& picture, int x, int y, const glm::dvec3& linear) {
    for (int c = 0; c < 3; ++c) picture.pixel(x, y)[c] = srgb_byte(linear[c]);
}

glm::dvec3 false_colour(double value) {
    // Nine points of viridis (van der Walt & Smith 2015, matplotlib), linear between.
    static constexpr std::array<std::array<double, 3>, 9> kPoints{{{.267, .005, .329},
                                                                   {.279, .175, .483},
                                                                   {.230, .322, .546},
                                                                   {.173, .449, .558},
                                                                   {.128, .567, .551},
                                                                   {.158, .684, .502},
                                                                   {.369, .789, .383},
                                                                   {.678, .864, .190},
                                                                   {.993, .906, .144}}};
    const double at = (value > 0 ? std::min(value, 1.0) : 0.0) * (kPoints.size() - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(at), kPoints.size() - 2);
    const double t = at - static_cast<double>(i);
    glm::dvec3 colour;
    for (int c = 0; c < 3; ++c) {
        const auto channel = static_cast<std::size_t>(c);
        colour[c] = kPoints[i][channel] * (1 - t) + kPoints[i + 1][channel] * t;
    }
    return colour;
}

namespace {

/// The faces of a level, each with a border of one texel copied from its neighbours; at a corner, where three
/// texels meet, their mean.
class BorderedFaces {
  public:
    explicit BorderedFaces(const Level& level) : n_(level.width), texels_(6 * side() * side()) {
        for (int face = 0; face < 6; ++face) {
            for (int y = -1; y <= n_; ++y)
                for (int x = -1; x <= n_; ++x) {
                    const pbr::CubeTexel from = pbr::cubemap_texel(
                        pbr::cube_vector(face, pbr::cube_coordinate(x, n_), pbr::cube_coordinate(y, n_)), n_);
                    const float* rgb =
                        &level
                             .texels[((static_cast<std::size_t>(from.face) * n_ + from.y) * n_ + from.x) * 3];
                    at(face, x, y) = {rgb[0], rgb[1], rgb[2]};
                }
            for (const int x : {-1, n_})
                for (const int y : {-1, n_}) {
                    const int inner_x = x < 0 ? 0 : n_ - 1, inner_y = y < 0 ? 0 : n_ - 1;
                    at(face, x, y) =
                        (at(face, inner_x, inner_y) + at(face, x, inner_y) + at(face, inner_x, y)) / 3.f;
                }
        }
    }

    glm::dvec3 operator()(const glm::dvec3& direction) const {
        const pbr::CubePoint point = pbr::cube_point(direction);
        const double x = (point.s + 1) / 2 * n_ - 0.5, y = (point.t + 1) / 2 * n_ - 0.5;
        const int x0 = std::clamp(static_cast<int>(std::floor(x)), -1, n_ - 1),
                  y0 = std::clamp(static_cast<int>(std::floor(y)), -1, n_ - 1);
        const auto value = [&](int i, int j) { return glm::dvec3(at(point.face, x0 + i, y0 + j)); };
        return glm::mix(glm::mix(value(0, 0), value(1, 0), x - x0),
                        glm::mix(value(0, 1), value(1, 1), x - x0), y - y0);
    }

  private:
    std::size_t side() const { return static_cast<std::size_t>(n_) + 2; }
    std::size_t index(int face, int x, int y) const {
        return (static_cast<std::size_t>(face) * side() + static_cast<std::size_t>(y + 1)) * side() +
               static_cast<std::size_t>(x + 1);
    }
    const glm::vec3& at(int face, int x, int y) const { return texels_[index(face, x, y)]; }
    glm::vec3& at(int face, int x, int y) { return texels_[index(face, x, y)]; }

    int n_;
    std::vector<glm::vec3> texels_;
};

}  // namespace

Radiance radiance_of_level(const Image& cube, int level, double scale) {
    const auto faces = std::make_shared<BorderedFaces>(cube.levels[static_cast<std::size_t>(level)]);
    return [faces, scale](const glm::dvec3& direction) { return (*faces)(direction) / scale; };
}

ProbeLookup::ProbeLookup(const Image& cube, double scale) {
    for (int level = 0; level < static_cast<int>(cube.levels.size()); ++level)
        levels_.push_back(radiance_of_level(cube, level, scale));
}

glm::dvec3 ProbeLookup::operator()(const glm::dvec3& direction, double perceptual_roughness) const {
    const int count = static_cast<int>(levels_.size());
    const double at = pbr::level_from_perceptual_roughness(std::clamp(perceptual_roughness, 0.0, 1.0), count);
    const auto lower = static_cast<std::size_t>(at), upper = std::min(lower + 1, levels_.size() - 1);
    const double t = at - static_cast<double>(lower);
    if (t == 0) return levels_[lower](direction);
    return levels_[lower](direction) * (1 - t) + levels_[upper](direction) * t;
}

Picture cross_picture(const Image& cube, int level, double factor,
                      const std::array<std::uint8_t, 3>& background) {
    const int n = cube.levels[static_cast<std::size_t>(level)].width;
    Picture picture(4 * n, 3 * n);
    for (std::size_t i = 0; i < picture.rgb.size(); ++i) picture.rgb[i] = background[i % 3];
    for (int face = 0; face < 6; ++face) {
        const auto& [column, row] = kCrossPlaces[static_cast<std::size_t>(face)];
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const float* texel = cube.texel(level, face, y, x);
                put(picture, column * n + x, row * n + y, factor * glm::dvec3(texel[0], texel[1], texel[2]));
            }
    }
    return picture;
}

View::View(const glm::dvec3& towards) {
    forward = glm::normalize(towards);
    right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0)));
    up = glm::cross(right, forward);
}

glm::dvec3 reflected_at(const View& view, double u, double v) {
    return glm::reflect(view.forward, rim_clamped_normal(view, u, v));
}

Picture ball_picture(int size, const View& view, const BallShade& shade) {
    return rendered(size, size, [&](double x, double y) {
        const glm::dvec3 normal = rim_clamped_normal(view, 2 * x / size - 1, 1 - 2 * y / size);
        return shade(normal, glm::reflect(view.forward, normal));
    });
}

Picture strip_picture(const StripScene& scene) {
    const View& view = scene.view;
    const double pitch = static_cast<double>(scene.width) / scene.balls;
    const double radius = 0.42 * std::min(pitch, static_cast<double>(scene.height));
    const double half_width = std::tan(scene.width_deg * std::numbers::pi / 360);
    return rendered(scene.width, scene.height, [&](double x, double y) {
        const int ball = std::min(static_cast<int>(x / pitch), scene.balls - 1);
        const double u = (x - (ball + 0.5) * pitch) / radius, v = (0.5 * scene.height - y) / radius;
        if (u * u + v * v < 1) {
            const glm::dvec3 normal = ball_normal(view, u, v);
            return scene.shade(ball, normal, glm::reflect(view.forward, normal));
        }
        const double to_image = 2 * half_width / scene.width;
        return scene.background(glm::normalize(view.forward +
                                               (x - 0.5 * scene.width) * to_image * view.right +
                                               (0.5 * scene.height - y) * to_image * view.up));
    });
}

}  // namespace pbrbake::verify

#include "bakers/verify/demo_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "bakers/verify/page.hpp"
#include "pbr/light/colour.hpp"

namespace pbrbake::verify {
namespace {

constexpr int kBallSize = 160, kHeroWidth = 1200, kHeroHeight = 220, kHeroBalls = 6;
constexpr double kHeroWidthDeg = 100;
/// Roughness at which the hero's background is read: out of focus, so that the balls stand out.
constexpr double kBackgroundPerceptualRoughness = 0.12;

double mean_luminance(const BakedImage& probe, int level) {
    const std::vector<float>& texels = probe.image.levels[static_cast<std::size_t>(level)].texels;
    double sum = 0;
    for (std::size_t i = 0; i < texels.size(); i += 3)
        sum += pbr::luminance_of_rgb({texels[i], texels[i + 1], texels[i + 2]});
    return sum / (static_cast<double>(texels.size()) / 3) / probe.scale;
}

}  // namespace

glm::dvec3 look_up(const BakedImage& table, double NoV, double perceptual_roughness) {
    const Level& level = table.image.levels[0];
    const double x = std::clamp(std::sqrt(NoV), 0.0, 1.0) * (level.width - 1);
    const double y = std::clamp(perceptual_roughness, 0.0, 1.0) * (level.height - 1);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, level.width - 1), y1 = std::min(y0 + 1, level.height - 1);
    const auto at = [&](int row, int column) {
        const float* texel = table.image.texel(0, 0, row, column);
        return glm::dvec3(texel[0], texel[1], texel[2]) / table.scale;
    };
    const double tx = x - x0, ty = y - y0;
    return (1 - ty) * ((1 - tx) * at(y0, x0) + tx * at(y0, x1)) +
           ty * ((1 - tx) * at(y1, x0) + tx * at(y1, x1));
}

const std::vector<EnvironmentLook>& environment_looks() {
    static const std::vector<EnvironmentLook> looks{
        {"outdoor",
         "Outdoor",
         "A clear sky, ground of albedo 0.2, and the sun at 45°: 0.53° across, 100,000 lx, 1.47 × "
         "10<sup>9</sup> "
         "cd/m², on a few texels of the source.",
         15,
         {-0.2, -0.05, -1},
         {0.91, 0.92, 0.92}},
        {"indoor",
         "Indoor",
         "A room of 7 × 3 × 5 m with a window of 3,500 to 6,000 cd/m², two lamps of 20,000 cd/m² and a tiled "
         "floor.",
         8,
         {-0.8, -0.1, 0.6},
         {1, 0.77, 0.34}},
    };
    return looks;
}

Picture hero_picture(const EnvironmentLook& look, const BakedImage& probe, const BakedImage& table) {
    const double exposure = exposure_of_ev100(look.ev100);
    const ProbeLookup lookup(probe.image, probe.scale);
    const View view(look.camera);
    return strip_picture(
        {kHeroWidth, kHeroHeight, kHeroBalls, kHeroWidthDeg, view,
         [&](int ball, const glm::dvec3& normal, const glm::dvec3& reflected) {
             const double perceptual_roughness = static_cast<double>(ball) / (kHeroBalls - 1);
             const double NoV = std::clamp(-glm::dot(normal, view.forward), 0.0, 1.0);
             const glm::dvec3 dfg = look_up(table, NoV, perceptual_roughness);
             return exposure * lookup(reflected, perceptual_roughness) * (look.metal_f0 * dfg.x + dfg.y);
         },
         [&](const glm::dvec3& direction) {
             return exposure * lookup(direction, kBackgroundPerceptualRoughness);
         }});
}

Picture level_ball(const EnvironmentLook& look, const BakedImage& probe, int level) {
    const double exposure = exposure_of_ev100(look.ev100);
    const Radiance radiance = radiance_of_level(probe.image, level, probe.scale);
    return ball_picture(kBallSize, View(look.camera), [&](const glm::dvec3&, const glm::dvec3& reflected) {
        return exposure * radiance(reflected);
    });
}

Picture level_0_cross(const EnvironmentLook& look, const BakedImage& probe) {
    const Level& level = probe.image.levels[0];
    Image half;
    half.channels = probe.image.channels;
    half.faces = 6;
    const int n = level.width / 2;
    half.levels.push_back({n, n, std::vector<float>(static_cast<std::size_t>(n) * n * 18)});
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x)
                for (int c = 0; c < 3; ++c) {
                    float sum = 0;
                    for (int k = 0; k < 4; ++k)
                        sum += probe.image.texel(0, face, 2 * y + k / 2, 2 * x + k % 2)[c];
                    half.texel(0, face, y, x)[c] = sum / 4;
                }
    return cross_picture(half, 0, exposure_of_ev100(look.ev100) / probe.scale, {128, 128, 128});
}

Picture difference_ball(const EnvironmentLook& look, const BakedImage& a, const BakedImage& b, int level) {
    const Radiance of_a = radiance_of_level(a.image, level, a.scale),
                   of_b = radiance_of_level(b.image, level, b.scale);
    const double mean = mean_luminance(b, level),
                 decades = std::log(kMostDifferenceShown / kLeastDifferenceShown);
    return ball_picture(kBallSize, View(look.camera), [&](const glm::dvec3&, const glm::dvec3& reflected) {
        const double share = std::abs(pbr::luminance_of_rgb(of_a(reflected) - of_b(reflected))) / mean;
        return linear_of_display(
            false_colour(std::log(std::max(share / kLeastDifferenceShown, 1.0)) / decades));
    });
}

Picture channel_picture(const BakedImage& table, int channel, double& highest) {
    const Level& level = table.image.levels[0];
    const int channels = table.image.channel_count();
    highest = 0;
    for (std::size_t i = static_cast<std::size_t>(channel); i < level.texels.size();
         i += static_cast<std::size_t>(channels))
        highest = std::max(highest, level.texels[i] / table.scale);
    Picture picture(level.width, level.height);
    for (int y = 0; y < level.height; ++y)
        for (int x = 0; x < level.width; ++x)
            put(picture, x, y,
                linear_of_display(false_colour(table.image.texel(0, 0, y, x)[channel] / table.scale /
                                               std::max(highest, 1e-30))));
    return picture;
}

Picture rgb_picture(const BakedImage& table) {
    const Level& level = table.image.levels[0];
    Picture picture(level.width, level.height);
    for (int y = 0; y < level.height; ++y)
        for (int x = 0; x < level.width; ++x) {
            const float* texel = table.image.texel(0, 0, y, x);
            put(picture, x, y, linear_of_display(glm::dvec3(texel[0], texel[1], texel[2]) / table.scale));
        }
    return picture;
}

std::string false_colour_scale(const std::string& low, const std::string& high) {
    std::string stops;
    constexpr int kStops = 8;
    for (int i = 0; i <= kStops; ++i) {
        const glm::dvec3 colour = 255.0 * false_colour(static_cast<double>(i) / kStops);
        stops += ",rgb(" + std::to_string(std::lround(colour.x)) + "," +
                 std::to_string(std::lround(colour.y)) + "," + std::to_string(std::lround(colour.z)) + ")";
    }
    return "<div style=\"max-width:320px\"><div class=scale style=\"background:linear-gradient(90deg" +
           stops + ")\"></div><div class=ends><span>" + low + "</span><span>" + high +
           "</span></div></div>\n";
}

std::string scale_text(double scale) {
    if (scale == 1) return "1";
    return "2<sup>" + std::to_string(std::ilogb(scale)) + "</sup> = " + number(scale);
}

}  // namespace pbrbake::verify

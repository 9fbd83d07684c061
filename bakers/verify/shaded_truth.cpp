#include "bakers/verify/shaded_truth.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "bakers/workers.hpp"
#include "pbr/ibl/dominant_direction.hpp"
#include "pbr/ibl/split_sum.hpp"
#include "pbr/light/colour.hpp"
#include "pbr/numerics/frame.hpp"
#include "pbr/reference/reflected_texels.hpp"

namespace pbrbake::verify {
namespace {

constexpr double kTolerance = 1e-3;

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

}  // namespace

double VisiblePoint::NoV() const { return glm::dot(normal, view); }

ShadedScene sphere_scene(int size, const glm::dvec3& towards) {
    ShadedScene scene{size, size, {}, View(towards)};
    const View& camera = scene.camera;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = (2 * x + 1.0) / size - 1, v = 1 - (2 * y + 1.0) / size;
            const double depth2 = 1 - u * u - v * v;
            if (depth2 > 0)
                scene.points.push_back(VisiblePoint{
                    u * camera.right + v * camera.up - std::sqrt(depth2) * camera.forward, -camera.forward});
            else
                scene.points.push_back(std::nullopt);
        }
    return scene;
}

ShadedScene plane_scene(int width, int height, const glm::dvec3& towards) {
    constexpr double kSteepestDeg = 30, kGrazingDeg = 2, kAcrossDeg = 60;
    ShadedScene scene{width, height, {}, View({towards.x, 0, towards.z})};
    const View& camera = scene.camera;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double down = radians(kGrazingDeg + (kSteepestDeg - kGrazingDeg) * (y + 0.5) / height);
            const double turn = radians(kAcrossDeg * ((x + 0.5) / width - 0.5));
            const glm::dvec3 ray =
                std::cos(down) * (std::cos(turn) * camera.forward + std::sin(turn) * camera.right) -
                std::sin(down) * glm::dvec3(0, 1, 0);
            scene.points.push_back(VisiblePoint{{0, 1, 0}, -ray});
        }
    return scene;
}

ShadedTruth::ShadedTruth(const Level& environment, const BakedImage& probe, const BakedImage& table)
    : blocks_(pbr::EquirectView{environment.texels.data(), environment.width, environment.height}),
      probe_(probe.image, probe.scale),
      table_(table) {}

glm::dvec3 ShadedTruth::radiance(Shading shading, const pbr::Surface<double>& surface,
                                 const VisiblePoint& point) const {
    if (shading == Shading::exact) return exact(surface, point);
    return split_sum(shading == Shading::split_sum_dominant, surface, point);
}

glm::dvec3 ShadedTruth::exact(const pbr::Surface<double>& surface, const VisiblePoint& point) const {
    const auto frame = pbr::frame_towards(point.normal, point.view);
    const glm::dmat3 to_surface = glm::transpose(glm::dmat3(frame.x, frame.y, frame.z));
    const auto brdf = [&surface](const glm::dvec3& wo, const glm::dvec3& wi) {
        const auto r = pbr::reflection(wo, wi);
        const glm::dvec3 fresnel = pbr::F_schlick(surface.f0, glm::dvec3(surface.f90), r.LoH);
        return pbr::f_standard_diffuse(surface, r) + fresnel * pbr::DV_standard_specular(surface, r);
    };
    return pbr::reflected_radiance_from_texels(brdf, frame.to_local(point.view), blocks_, to_surface,
                                               kTolerance)
        .value;
}

glm::dvec3 ShadedTruth::split_sum(bool dominant, const pbr::Surface<double>& surface,
                                  const VisiblePoint& point) const {
    const glm::dvec3 mirrored = glm::reflect(-point.view, point.normal);
    const glm::dvec3 direction =
        dominant
            ? pbr::dominant_direction(point.normal, mirrored, pbr::dominant_factor_frostbite(surface.alpha))
            : mirrored;
    const glm::dvec3 dfg = look_up(table_, point.NoV(), surface.perceptual_roughness);
    return pbr::split_sum_specular(probe_(direction, surface.perceptual_roughness), surface.f0,
                                   glm::dvec3(surface.f90), dfg.x, dfg.y) +
           pbr::split_sum_diffuse(probe_(point.normal, 1), surface.diffuse_albedo, dfg.z);
}

LinearPicture ShadedTruth::render(Shading shading, const pbr::Surface<double>& surface,
                                  const ShadedScene& scene, int threads) const {
    LinearPicture picture(scene.width, scene.height);
    Workers(threads).for_each(scene.height, [&](std::int64_t y) {
        for (int x = 0; x < scene.width; ++x) {
            const auto& point = scene.points[static_cast<std::size_t>(y) * scene.width + x];
            if (point) picture.at(x, static_cast<int>(y)) = radiance(shading, surface, *point);
        }
    });
    return picture;
}

std::vector<ShadingError> shading_errors(const LinearPicture& picture, const LinearPicture& exact,
                                         const ShadedScene& scene) {
    std::vector<ShadingError> errors;
    for (const auto& [low, high] : {std::pair{0.0, 0.1}, {0.1, 0.3}, {0.3, 0.6}, {0.6, 2.0}, {0.0, 2.0}}) {
        double squared = 0, error = 0, sum = 0;
        int points = 0;
        for (std::size_t i = 0; i < scene.points.size(); ++i) {
            if (!scene.points[i] || scene.points[i]->NoV() < low || scene.points[i]->NoV() >= high) continue;
            const double truth = pbr::luminance_of_rgb(exact.rgb[i]),
                         difference = pbr::luminance_of_rgb(picture.rgb[i]) - truth;
            squared += difference * difference;
            error += difference;
            sum += truth;
            ++points;
        }
        const double mean = points ? sum / points : 0;
        errors.push_back({low, high, mean > 0 ? std::sqrt(squared / points) / mean : 0,
                          mean > 0 ? error / points / mean : 0, points});
    }
    return errors;
}

}  // namespace pbrbake::verify

#include "bakers/verify/legacy_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "bakers/verify/demo_pictures.hpp"
#include "bakers/verify/shaded_truth.hpp"
#include "bakers/verify/shading_study.hpp"
#include "pbr/brdf/multiscatter.hpp"
#include "pbr/ibl/dfg.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/legacy/energy.hpp"
#include "pbr/legacy/exponent.hpp"
#include "pbr/legacy/phong.hpp"
#include "pbr/light/colour.hpp"
#include "pbr/numerics/frame.hpp"

namespace pbrbake::verify {
namespace {

constexpr const char* kRoom = "indoor";
constexpr int kRepeats = 2;                           // of the texture around the sphere
constexpr double kLeastShown = 1e-3, kMostShown = 1;  // relative
constexpr double kLeastDeltaE = .1, kMostDeltaE = 10;
/// A lobe about as wide as the room's texels are apart.
constexpr double kNarrowestAlpha = .06;

const EnvironmentLook& room_look() {
    return *std::ranges::find(environment_looks(), kRoom, &EnvironmentLook::name);
}

/// Light from one texel of the room.
struct Ray {
    glm::dvec3 towards, irradiance;  ///< of a surface that faces it
};

/// The room's light, each a mean of 2 x 2 texels of the shading study's.
const std::vector<Ray>& room_rays() {
    static const std::vector<Ray> rays = [] {
        const Image room = study_environment(kRoom);
        const int width = room.levels[0].width / 2, height = room.levels[0].height / 2;
        std::vector<Ray> list;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                glm::dvec3 mean(0);
                for (int k = 0; k < 4; ++k) {
                    const float* rgb = room.texel(0, 0, 2 * y + k / 2, 2 * x + k % 2);
                    mean += 0.25 * glm::dvec3(rgb[0], rgb[1], rgb[2]);
                }
                list.push_back({pbr::equirect_direction((x + 0.5) / width, (y + 0.5) / height),
                                mean * pbr::equirect_texel_solid_angle(width, height, y)});
            }
        return list;
    }();
    return rays;
}

/// A lobe at a point of the texture, 1/sr.
using Lobe = std::function<glm::dvec3(const pbr::Reflection<double>&)>;

/// A point of a sphere, and where on the texture it is.
struct TexturedPoint {
    pbr::AxisFrame<double> frame;
    glm::dvec3 wo;
    double u, v;
};

std::optional<TexturedPoint> textured(const std::optional<VisiblePoint>& point) {
    if (!point) return {};
    const glm::dvec3& normal = point->normal;
    const auto frame = pbr::frame_towards(normal, point->view);
    const double u = kRepeats * (std::atan2(normal.x, normal.z) / (2 * std::numbers::pi) + 0.5);
    return TexturedPoint{frame, frame.to_local(point->view), u - std::floor(u),
                         std::acos(std::clamp(normal.y, -1.0, 1.0)) / std::numbers::pi};
}

LinearPicture shaded_sphere(int size, const std::function<Lobe(const TexturedPoint&)>& lobe_at,
                            Context& context) {
    const ShadedScene scene = sphere_scene(size, room_look().camera);
    LinearPicture picture(size, size);
    const auto shade = [&](std::size_t i) {
        const auto point = textured(scene.points[i]);
        if (!point) return;
        const Lobe lobe = lobe_at(*point);
        for (const Ray& ray : room_rays()) {
            const glm::dvec3 wi = point->frame.to_local(ray.towards);
            if (wi.z > 0) picture.rgb[i] += lobe(pbr::reflection(point->wo, wi)) * ray.irradiance * wi.z;
        }
    };
    context.parallel_for(size, 4, [&](std::int64_t begin, std::int64_t end) {
        for (auto i = static_cast<std::size_t>(begin * size); i < static_cast<std::size_t>(end * size); ++i)
            shade(i);
    });
    return picture;
}

Lobe phong(const texture::Appearance& texel) {
    const double narrowest = pbr::blinn_phong_from_alpha(kNarrowestAlpha);
    const bool is_blinn = texel.phong->lobe == pbr::PhongLobe::blinn;
    const double n = std::min(texel.phong->exponent, is_blinn ? narrowest : narrowest / 4);
    const glm::dvec3 peak = glm::dvec3(texel.phong->mean_albedo) /
                            pbr::phong_albedo(pbr::PhongNorm::none, texel.phong->lobe, n).mean;
    const glm::dvec3 diffuse = glm::dvec3(texel.diffuse) / std::numbers::pi;
    return [=](const pbr::Reflection<double>& r) {
        // The mirror direction's cosine with the light.
        const double c = is_blinn ? r.NoH : std::max(2 * r.NoV * r.NoL - r.LoV, 0.0);
        return diffuse + peak * std::pow(c, n);
    };
}

/// Directional albedo of GGX at one alpha, linear between views; exact to 1e-3 of it.
class AlbedoOfViews {
  public:
    explicit AlbedoOfViews(double alpha) {
        std::array<double, kViews> NoV{}, Fc{};
        for (std::size_t i = 0; i < kViews; ++i) NoV[i] = static_cast<double>(i) / (kViews - 1);
        pbr::dfg_ggx_row(NoV, alpha, pbr::DfgMethod::quadrature(1e-3), E_, Fc);
    }
    double operator()(double NoV) const {
        const double at = std::clamp(NoV, 0.0, 1.0) * (kViews - 1);
        const auto i = std::min(static_cast<std::size_t>(at), kViews - 2);
        return glm::mix(E_[i], E_[i + 1], at - static_cast<double>(i));
    }

  private:
    static constexpr std::size_t kViews = 33;
    std::array<double, kViews> E_{};
};

/// Of the nearest of 129 roughnesses.
const AlbedoOfViews& albedo_at(double perceptual_roughness) {
    constexpr int kSteps = 128;
    static const std::vector<AlbedoOfViews> rows = [] {
        std::vector<AlbedoOfViews> list;
        for (int i = 0; i <= kSteps; ++i)
            list.emplace_back(pbr::alpha_from_perceptual_roughness(static_cast<double>(i) / kSteps));
        return list;
    }();
    return rows[static_cast<std::size_t>(std::clamp(perceptual_roughness, 0.0, 1.0) * kSteps + .5)];
}

Lobe ggx(const texture::Appearance& texel, bool multiscatter, double NoV) {
    const double alpha =
        std::max(kNarrowestAlpha,
                 pbr::alpha_from_perceptual_roughness(static_cast<double>(texel.perceptual_roughness)));
    const double perceptual_roughness = pbr::perceptual_roughness_from_alpha(alpha);
    const glm::dvec3 f0(texel.f0);
    const pbr::Surface<double> surface{glm::dvec3(texel.diffuse), f0, static_cast<double>(texel.f90),
                                       perceptual_roughness, alpha};
    const glm::dvec3 diffuse = surface.diffuse_albedo / std::numbers::pi;
    const AlbedoOfViews& E = albedo_at(perceptual_roughness);
    const double E_avg = pbr::mean_albedo_ggx(perceptual_roughness).E, E_o = E(NoV);
    const glm::dvec3 bounced =
        multiscatter ? pbr::multiscatter_colour(pbr::average_schlick(f0, glm::dvec3(surface.f90)), E_avg)
                     : glm::dvec3(0);
    return [=, &E](const pbr::Reflection<double>& r) {
        return diffuse +
               pbr::F_schlick(surface.f0, glm::dvec3(surface.f90), r.LoH) *
                   pbr::DV_standard_specular(surface, r) +
               bounced * pbr::f_multiscatter(E_o, E(r.NoL), E_avg);
    };
}

Lobe lobe_of(const texture::Appearance& texel, bool multiscatter, double NoV) {
    return texel.phong ? phong(texel) : ggx(texel, multiscatter, NoV);
}

/// Dark below what is shown, then towards the colour of its sign.
glm::dvec3 signed_colour(double change) {
    constexpr glm::dvec3 kNone(.17, .17, .19), kLost(.36, .66, 1), kGained(1, .62, .2);
    const double at =
        std::log(std::max(std::abs(change) / kLeastShown, 1.0)) / std::log(kMostShown / kLeastShown);
    return glm::mix(kNone, change < 0 ? kLost : kGained, std::min(at, 1.0));
}

}  // namespace

SetSpheres set_spheres(const texture::BeforeAndAfter& set, int size, Context& context) {
    using Texel = texture::Appearance (texture::BeforeAndAfter::*)(int x, int y) const;
    const auto sphere = [&](Texel texel) {
        return shaded_sphere(
            size,
            [&](const TexturedPoint& point) {
                const int x = std::min(static_cast<int>(point.u * set.width()), set.width() - 1),
                          y = std::min(static_cast<int>(point.v * set.height()), set.height() - 1);
                return lobe_of((set.*texel)(x, y), set.params().multiscatter, point.wo.z);
            },
            context);
    };
    return {sphere(&texture::BeforeAndAfter::as_read),
            set.is_calibrated() ? sphere(&texture::BeforeAndAfter::calibrated) : LinearPicture(0, 0),
            sphere(&texture::BeforeAndAfter::stored)};
}

ChangeMaps change_maps(const texture::BeforeAndAfter& set, int most, Context& context) {
    const int longer = std::max(set.width(), set.height());
    const auto side = [&](int texels) { return std::max(1, texels * std::min(most, longer) / longer); };
    ChangeMaps maps{{side(set.width()), side(set.height())}, {side(set.width()), side(set.height())}};
    const auto put_pixel = [&](int x, int y) {
        texture::Change largest{0, 0};
        for (int k = 0; k < 4; ++k) {
            const texture::Change change =
                set.change((4 * x + 1 + k % 2 * 2) * set.width() / (4 * maps.delta_e.width),
                           (4 * y + 1 + k / 2 * 2) * set.height() / (4 * maps.delta_e.height));
            largest.delta_e = std::max(largest.delta_e, change.delta_e);
            if (std::abs(change.energy) > std::abs(largest.energy)) largest.energy = change.energy;
        }
        put(maps.delta_e, x, y,
            linear_of_display(false_colour(std::log(std::max(largest.delta_e / kLeastDeltaE, 1.0)) /
                                           std::log(kMostDeltaE / kLeastDeltaE))));
        put(maps.energy, x, y, linear_of_display(signed_colour(largest.energy)));
    };
    context.parallel_for(maps.delta_e.height, 4, [&](std::int64_t begin, std::int64_t end) {
        for (auto y = static_cast<int>(begin); y < end; ++y)
            for (int x = 0; x < maps.delta_e.width; ++x) put_pixel(x, y);
    });
    return maps;
}

LinearPicture as_seen(LinearPicture sphere) {
    for (glm::dvec3& rgb : sphere.rgb) rgb *= exposure_of_ev100(room_look().ev100);
    return sphere;
}

Picture sphere_difference(const LinearPicture& a, const LinearPicture& b) {
    double mean = 0;
    std::size_t lit = 0;
    for (const glm::dvec3& rgb : b.rgb) {
        mean += pbr::luminance_of_rgb(rgb);
        lit += rgb != glm::dvec3(0);
    }
    mean /= static_cast<double>(std::max<std::size_t>(lit, 1));
    Picture picture(a.width, a.height);
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            const double share =
                std::abs(pbr::luminance_of_rgb(a.at(x, y) - b.at(x, y))) / std::max(mean, 1e-30);
            put(picture, x, y,
                linear_of_display(false_colour(std::log(std::max(share / kLeastShown, 1.0)) /
                                               std::log(kMostShown / kLeastShown))));
        }
    return picture;
}

double sphere_flip(const LinearPicture& a, const LinearPicture& b) {
    return ldr_flip(as_seen(b), as_seen(a)).mean();
}

}  // namespace pbrbake::verify

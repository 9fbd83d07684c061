#include "bakers/verify/legacy_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "bakers/verify/demo_pictures.hpp"
#include "bakers/verify/product_file.hpp"
#include "bakers/verify/shaded_truth.hpp"
#include "bakers/verify/shading_study.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/legacy/phong.hpp"
#include "pbr/light/colour.hpp"
#include "pbr/numerics/frame.hpp"

namespace pbrbake::verify {
namespace {

constexpr const char* kRoom = "indoor";
constexpr int kRepeats = 2;  // of the texture around the sphere
constexpr double kLeastShown = 1e-3, kMostShown = 1;

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

LinearPicture shaded_sphere(int size, const std::function<Lobe(double u, double v)>& lobe_at) {
    const ShadedScene scene = sphere_scene(size, room_look().camera);
    LinearPicture picture(size, size);
    for (std::size_t i = 0; i < scene.points.size(); ++i) {
        if (!scene.points[i]) continue;
        const glm::dvec3 &normal = scene.points[i]->normal, &view = scene.points[i]->view;
        const auto frame = pbr::frame_towards(normal, view);
        const glm::dvec3 wo = frame.to_local(view);
        const double u = kRepeats * (std::atan2(normal.x, normal.z) / (2 * std::numbers::pi) + 0.5);
        const Lobe lobe =
            lobe_at(u - std::floor(u), std::acos(std::clamp(normal.y, -1.0, 1.0)) / std::numbers::pi);
        for (const Ray& ray : room_rays()) {
            const glm::dvec3 wi = frame.to_local(ray.towards);
            if (wi.z > 0) picture.rgb[i] += lobe(pbr::reflection(wo, wi)) * ray.irradiance * wi.z;
        }
    }
    return picture;
}

Lobe blinn_phong(const LegacyTexel& texel) {
    const double n = legacy_exponent(texel.gloss);
    const double norm = pbr::phong_norm(pbr::PhongNorm::energy, pbr::PhongLobe::blinn, n);
    return [=](const pbr::Reflection<double>& r) {
        return texel.diffuse / std::numbers::pi + texel.specular * norm * std::pow(r.NoH, n);
    };
}

Lobe ggx(const glm::dvec3& diffuse, const glm::dvec3& f0, double perceptual_roughness) {
    const double alpha = pbr::alpha_from_perceptual_roughness(perceptual_roughness);
    const pbr::Surface<double> surface{diffuse, f0, pbr::f90_from_f0(f0), perceptual_roughness, alpha};
    return [=](const pbr::Reflection<double>& r) {
        return surface.diffuse_albedo / std::numbers::pi +
               pbr::F_schlick(surface.f0, glm::dvec3(surface.f90), r.LoH) *
                   pbr::DV_standard_specular(surface, r);
    };
}

/// Products of a bake with packing `separate`, by what they hold.
std::map<std::string, ProductFile> separate_images(const std::vector<std::filesystem::path>& files) {
    std::map<std::string, ProductFile> images;
    for (const std::filesystem::path& file : files)
        for (const char* held : {"metallic", "roughness", "reflectance"})
            if (file.stem().string().ends_with(std::string("_") + held))
                images[held] = read_product_file(file, nullptr);
    if (images.size() == 3) images["base_color"] = read_product_file(files.front(), nullptr);
    return images;
}

}  // namespace

LinearPicture legacy_sphere(const LegacySet& set, int size) {
    return shaded_sphere(size, [&](double u, double v) {
        const LegacyTexel texel = legacy_texel(set, u, v);
        if (set.is_blinn_phong) return blinn_phong(texel);
        // As KHR_materials_pbrSpecularGlossiness: diffuse gets what the strongest channel leaves.
        const double left = 1 - std::max({texel.specular.x, texel.specular.y, texel.specular.z});
        return ggx(texel.diffuse * left, texel.specular,
                   pbr::perceptual_roughness_from_smoothness(texel.gloss));
    });
}

LinearPicture converted_sphere(const std::vector<std::filesystem::path>& files, int size) {
    const std::map<std::string, ProductFile> images = separate_images(files);
    if (images.size() < 4) return {0, 0};
    /// The first channels at (u, v), the nearest texel.
    const auto read = [&](const char* held, double u, double v) {
        const ProductFile& product = images.at(held);
        const Level& level = product.image.levels[0];
        const float* texel = product.image.texel(0, 0, static_cast<int>(v * level.height) % level.height,
                                                 static_cast<int>(u * level.width) % level.width);
        const int last = product.image.channel_count() - 1;
        return glm::dvec3(texel[0], texel[std::min(1, last)], texel[std::min(2, last)]) / product.scale;
    };
    return shaded_sphere(size, [&](double u, double v) {
        const glm::dvec3 colour = read("base_color", u, v);
        const double metallic = read("metallic", u, v).x, reflectance = read("reflectance", u, v).x;
        const glm::dvec3 f0 = glm::mix(glm::dvec3(pbr::f0_from_reflectance(reflectance)), colour, metallic);
        return ggx(colour * (1 - metallic), f0, read("roughness", u, v).x);
    });
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

// What each target's shader makes of what is stored, decoded and shaded by code of this file's own.

#include <gtest/gtest.h>

#include <glm/common.hpp>
#include <numbers>

#include "tests/bakers/texture/fixtures.hpp"

namespace pbrbake::texture::test {
namespace {

using Colour = pbr::Vec3<float>;

/// Cosine-weighted means over views of GGX with correlated Smith, single scattering: of the whole lobe, and
/// of what of it is light at grazing incidence, by (1 - VoH)^5.
struct Lobe {
    double whole = 0, grazing = 0;
    double albedo(double f0, double f90) const { return f0 * (whole - grazing) + f90 * grazing; }
};

/// Half vectors by the distribution of normals, over a grid: within 2e-3 of the means.
Lobe ggx_lobe(double perceptual_roughness) {
    constexpr int kSteps = 64;
    const double a2 = std::pow(perceptual_roughness, 4);
    const auto lambda = [&](double c) { return (std::sqrt(1 + a2 * (1 - c * c) / (c * c)) - 1) / 2; };
    Lobe sum;
    for (int view = 0; view < kSteps; ++view) {
        const double mu = std::sqrt((view + .5) / kSteps), sine = std::sqrt(1 - mu * mu);
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const double u = (i + .5) / kSteps, phi = 2 * std::numbers::pi * (j + .5) / kSteps;
                const double NoH = std::sqrt((1 - u) / (1 + (a2 - 1) * u));
                const double VoH = mu * NoH + sine * std::sqrt(1 - NoH * NoH) * std::cos(phi);
                const double NoL = 2 * VoH * NoH - mu;
                if (VoH <= 0 || NoL <= 0) continue;
                const double light = VoH / (NoH * mu * (1 + lambda(mu) + lambda(NoL)));
                sum.whole += light;
                sum.grazing += light * std::pow(1 - VoH, 5);
            }
    }
    constexpr double kAll = kSteps * kSteps * kSteps;
    return {sum.whole / kAll, sum.grazing / kAll};
}

/// 4 ks / (n + 4): ks / pi cos^n of the half vector, integrated exactly.
double blinn_phong_albedo(double ks, double n) { return 4 * ks / (n + 4); }

TextureParams blinn_phong() {
    TextureParams params = defaults();
    params.model = Model::blinn_phong;
    params.norm = Norm::over_pi;
    params.calibrate = Calibrate::none;
    params.surface = SurfaceIs::dielectric;
    params.multiscatter = false;  // as appendix B
    return params;
}

/// A dielectric without pictures as glTF 2.0, KHR_materials_ior and KHR_materials_specular have it.
struct Surface {
    double f0, f90, perceptual_roughness;
};
Surface read_factors(const Json& material) {
    const Json extensions = material.value("extensions", Json::object());
    const double ior = extensions.value("/KHR_materials_ior/ior"_json_pointer, 1.5),
                 factor = extensions.value("/KHR_materials_specular/specularFactor"_json_pointer, 1.),
                 colour = extensions.value("/KHR_materials_specular/specularColorFactor/0"_json_pointer, 1.);
    const double root = (ior - 1) / (ior + 1);
    return {std::min(root * root * colour, 1.) * factor, factor,
            material["/pbrMetallicRoughness/roughnessFactor"_json_pointer].get<double>()};
}

TEST(GltfLobes, OfFactorsReflectWhatTheLegacyLobeDid) {
    for (const double n : {1., 10., 96.08, 250., 1000., 1e5})
        for (const double ks : {.001, .1, .2, .5}) {
            TextureParams params = blinn_phong();
            params.diffuse = params.specular = "";
            params.power = n;
            params.diffuse_factor = {.1, .1, .1};  // dark enough for all of it to be left by glTF's coupling
            params.specular_factor = {ks, ks, ks};
            Context context(1, {});
            context.set_product_file("lobe.gltf");
            const Product product = bake(params, {}, context);
            const Surface surface = read_factors(product.documents[0].json["materials"][0]);
            const double found = ggx_lobe(surface.perceptual_roughness).albedo(surface.f0, surface.f90),
                         wanted = blinn_phong_albedo(ks, n);
            EXPECT_NEAR(found / wanted, 1, .02) << n << " " << ks << " " << product.documents[0].json;
            EXPECT_LT(certify(params, {}, product, context).headline->value, 1e-4);
        }
}

TEST(GltfLobes, OfPicturesReflectWhatTheLegacyLobeDid) {
    constexpr std::array kPowers{10., 96.08, 250., 1000.};
    TextureParams params = blinn_phong();
    Inputs inputs;
    inputs["diffuse"] = source(16, 4, 3, 0, [](int, int) { return Rgba{.3f, .3f, .3f, 1}; });
    const auto ks = [](int x) { return .05 * (x + 1); };
    inputs["specular"] = source(16, 4, 3, 0, [&](int x, int) {
        const auto k = static_cast<float>(ks(x));
        return Rgba{k, k, k, 1};
    });
    for (const double n : kPowers) {
        const Lobe lobe = ggx_lobe(std::pow(2 / (n + 2), .25));
        for (const PixelType pixel : {PixelType::float32, PixelType::unorm8}) {
            params.power = n;
            const Baked baked = bake_set(params, inputs, pixel);
            const double unit = baked.set()["dielectric_f0_unit"].get<double>();
            ASSERT_EQ(baked.image("specular").channel_count(), 4);
            for (int x = 0; x < 16; ++x) {
                const float* texel = baked.image("specular").texel(0, 0, 1, x);
                const double f90 = static_cast<double>(texel[3]);
                const double found = lobe.albedo(static_cast<double>(texel[0]) * unit * f90, f90),
                             wanted = blinn_phong_albedo(ks(x), n);
                // Half a code of f90, times the mean of Schlick's weight, and of f0.
                const double codes = pixel == PixelType::unorm8 ? .5 / 255 / 21 + .012 * wanted : 0;
                EXPECT_NEAR(found, wanted, .02 * wanted + codes) << n << " " << x;
            }
        }
    }
}

TEST(GltfLobes, OfSetsThatAreNotDimStayRgb) {
    TextureParams params = blinn_phong();
    params.power = 10;
    Inputs inputs;
    inputs["diffuse"] = source(4, 4, 3, 8, [](int, int) { return Rgba{.3f, .3f, .3f, 1}; });
    inputs["specular"] = source(4, 4, 3, 8, [](int, int) { return Rgba{.5f, .5f, .5f, 1}; });
    for (const PixelType pixel : {PixelType::float32, PixelType::unorm8}) {
        const Baked baked = bake_set(params, inputs, pixel);
        EXPECT_EQ(baked.image("specular").channel_count(), 3);
        EXPECT_EQ(baked.set()["images"]["specular"].size(), 3u);
        EXPECT_LT(baked.figure("energy_error"), 4e-3);
    }
}

/// Levels below average what is reflected at grazing incidence too: half a dim lobe and half a bright one.
TEST(GltfLobes, OfLevelsAreMeans) {
    TextureParams params = blinn_phong();
    params.power = 50;
    params.levels = 0;
    Inputs inputs;
    inputs["diffuse"] = source(4, 4, 3, 0, [](int, int) { return Rgba{.3f, .3f, .3f, 1}; });
    inputs["specular"] = source(4, 4, 3, 0, [](int x, int) {
        const float ks = x % 2 ? 0 : .9f;
        return Rgba{ks, ks, ks, 1};
    });
    for (const PixelType pixel : {PixelType::float32, PixelType::unorm8}) {
        const Baked baked = bake_set(params, inputs, pixel);
        const double unit = baked.set()["dielectric_f0_unit"].get<double>();
        const float* bright = baked.image("specular").texel(0, 0, 0, 0);
        const float* mean = baked.image("specular").texel(1, 0, 0, 0);
        EXPECT_EQ(bright[3], 1);
        EXPECT_NEAR(mean[3], .5, pixel == PixelType::unorm8 ? .501 / 255 : 1e-5);
        EXPECT_NEAR(static_cast<double>(mean[0] * mean[3]) * unit, static_cast<double>(bright[0]) * unit / 2,
                    pixel == PixelType::unorm8 ? 6e-4 : 1e-6);
    }
}

/// What the texels of one row of kTexels are.
struct Kind {
    const char* name;
    Colour diffuse, f0;
};
const std::array<Kind, 5> kKinds{{{"dielectric", {.4f, .3f, .2f}, Colour(.04f)},
                                  {"gem", Colour(.3f), Colour(.07f)},
                                  {"metal", Colour(0), {.95f, .64f, .54f}},
                                  {"coloured dielectric", {.3f, .3f, .28f}, {.05f, .045f, .04f}},
                                  {"dark", {.2f, .2f, .2f}, Colour(.025f)}}};
constexpr double kRoughness = .4;

/// Diffuse albedo, f0 and f90 as the shader of a packing has them of what is stored: written from the
/// engines' published shaders, knowing nothing of the baker's own reading.
struct Shaded {
    Colour diffuse, f0;
    double f90;
};
Shaded shade(Packing packing, const Baked& baked, int y) {
    const auto at = [&](const char* image, int channel) {
        return baked.image(image).texel(0, 0, y, 0)[channel];
    };
    const auto colour = [&](const char* image) { return Colour(at(image, 0), at(image, 1), at(image, 2)); };
    const auto metallic_shader = [&](float metallic, const Colour& dielectric, bool is_gltf) {
        const Colour base = colour("base_color");
        const float left = is_gltf ? 1 - std::max({dielectric.x, dielectric.y, dielectric.z}) : 1;
        const Colour f0 = dielectric * (1 - metallic) + base * metallic;
        const float sum = packing == Packing::unreal ? f0.y : .33f * (f0.x + f0.y + f0.z);
        return Shaded{base * (left * (1 - metallic)), f0,
                      is_gltf ? 1 : std::min(1., 50 * static_cast<double>(sum))};
    };
    switch (packing) {
        case Packing::gltf:
            return metallic_shader(at("orm", 2),
                                   colour("specular") * baked.set()["dielectric_f0_unit"].get<float>(), true);
        case Packing::unity:
            return metallic_shader(at("mask", 0), Colour(.04f), false);
        case Packing::unreal:
            return metallic_shader(at("orm", 2), Colour(.08f * at("specular", 0)), false);
        case Packing::frostbite:
            return metallic_shader(at("mask", 1), Colour(.16f * at("mask", 2) * at("mask", 2)), false);
        case Packing::separate:
            return metallic_shader(at("metallic", 0),
                                   Colour(.16f * at("reflectance", 0) * at("reflectance", 0)), false);
        case Packing::specular_gloss:
            break;
    }
    const Colour f0 = colour("specular_gloss");
    return {colour("diffuse") * (1 - std::max({f0.x, f0.y, f0.z})), f0, 1};
}

double largest(const Colour& a, const Colour& b) {
    const Colour difference = glm::abs(a - b);
    return static_cast<double>(std::max({difference.x, difference.y, difference.z}));
}

Inputs set_of_kinds() {
    const auto rows = static_cast<int>(kKinds.size());
    Inputs inputs;
    inputs["diffuse"] = source(2, rows, 3, 0, [](int, int y) {
        const Kind& kind = kKinds[static_cast<std::size_t>(y)];
        const Colour d = kind.diffuse / (1 - std::max({kind.f0.x, kind.f0.y, kind.f0.z}));
        return Rgba{d.x, d.y, d.z, 1};
    });
    inputs["specular"] = source(2, rows, 4, 0, [](int, int y) {
        const Colour& f0 = kKinds[static_cast<std::size_t>(y)].f0;
        return Rgba{f0.x, f0.y, f0.z, static_cast<float>(1 - kRoughness)};
    });
    return inputs;
}

/// What a packing loses of diffuse albedo and of f0, a kind: of f0 at least nine tenths of it.
using Allowed = std::array<std::array<double, 2>, kKinds.size()>;

TEST(Packings, HoldWhatTheirShadersCan) {
    // A gem's f0 ends at .08 in Unreal's and isn't held in Unity's, which has .04 always; a grey f0 is the
    // mean of a coloured one.
    constexpr Allowed kAll{}, kUnity{{{0, 0}, {.001, .03}, {0, 0}, {0, .01}, {0, .015}}},
        kGrey{{{0, 0}, {0, 0}, {0, 0}, {0, .005}, {0, 0}}};
    for (const auto& [packing, allowed] : {std::pair(Packing::gltf, kAll),
                                           {Packing::specular_gloss, kAll},
                                           {Packing::unity, kUnity},
                                           {Packing::unreal, kGrey},
                                           {Packing::frostbite, kGrey},
                                           {Packing::separate, kGrey}})
        for (const PixelType pixel : {PixelType::float32, PixelType::unorm8}) {
            TextureParams params = defaults();
            params.packing = packing;
            params.regularise = false;  // rows have nothing to do with each other
            const Baked baked = bake_set(params, set_of_kinds(), pixel);
            double worst_diffuse = 0, worst_f0 = 0;
            for (std::size_t y = 0; y < kKinds.size(); ++y) {
                SCOPED_TRACE(std::string(enum_name(packing)) + " " + kKinds[y].name);
                const Shaded shaded = shade(packing, baked, static_cast<int>(y));
                const double diffuse = largest(shaded.diffuse, kKinds[y].diffuse),
                             f0 = largest(shaded.f0, kKinds[y].f0);
                const double slack = pixel == PixelType::unorm8 ? 1.14 / 255 : 1e-4;
                EXPECT_LE(diffuse, allowed[y][0] + slack);
                EXPECT_LE(f0, allowed[y][1] + slack);
                EXPECT_GE(f0, .9 * allowed[y][1] - slack);
                worst_diffuse = std::max(worst_diffuse, diffuse);
                worst_f0 = std::max(worst_f0, f0);
            }
            // The certificate knows it.
            EXPECT_NEAR(baked.figure("diffuse_max_error"), worst_diffuse, 1e-6);
            EXPECT_NEAR(baked.figure("f0_max_error"), worst_f0, 1e-6);
        }
}

/// Energy of a dim set, which no packing but glTF's can hold: an f0 of .002 in each shader's own lobe.
TEST(Packings, AreCertifiedWithTheLobesOfTheirShaders) {
    constexpr double kDim = .002;
    const Lobe lobe = ggx_lobe(std::pow(2 / 98., .25));
    for (const Packing packing : {Packing::gltf, Packing::unity, Packing::unreal, Packing::frostbite,
                                  Packing::separate, Packing::specular_gloss}) {
        SCOPED_TRACE(enum_name(packing));
        TextureParams params = blinn_phong();
        params.packing = packing;
        params.power = 96;
        const Colour ks(.15f, .1f, .05f);
        Inputs inputs;
        inputs["diffuse"] = source(2, 2, 3, 0, [](int, int) { return Rgba{0, 0, 0, 1}; });
        inputs["specular"] = source(2, 2, 3, 0, [&](int, int) { return Rgba{ks.x, ks.y, ks.z, 1}; });
        const Baked baked = bake_set(params, inputs, PixelType::float32);
        const double wanted = blinn_phong_albedo(.1, 96);
        double found = 0;
        Shaded shaded = shade(packing, baked, 0);
        if (packing == Packing::gltf) {
            const float* texel = baked.image("specular").texel(0, 0, 0, 0);
            shaded.f90 = static_cast<double>(texel[3]);
            shaded.f0 *= texel[3];
        }
        for (int c = 0; c < 3; ++c)
            found += lobe.albedo(static_cast<double>(shaded.f0[c]), shaded.f90) / 3 +
                     static_cast<double>(shaded.diffuse[c]) / 3;
        EXPECT_NEAR(baked.figure("energy_error"), std::abs(found / wanted - 1), .01 * found / wanted);
        EXPECT_LT(static_cast<double>(shaded.f0.x), packing == Packing::unity ? 1 : 3 * kDim);
    }
}

TEST(Packings, WithoutAnF0AreCertifiedWithTheTargetsOwn) {
    TextureParams params = defaults();
    params.packing = Packing::unity;
    params.dielectric_f0 = .15;
    Inputs inputs;
    inputs["diffuse"] = source(4, 4, 3, 0, [](int, int) { return Rgba{.2f, .2f, .2f, 1}; });
    inputs["specular"] = source(4, 4, 4, 0, [](int, int) { return Rgba{.15f, .15f, .15f, .5f}; });
    const Baked baked = bake_set(params, inputs, PixelType::float32);
    EXPECT_NEAR(baked.figure("f0_max_error"), .11, 1e-5);
    EXPECT_GT(baked.figure("energy_error"), .2);
    params.packing = Packing::gltf;
    EXPECT_LT(bake_set(params, inputs, PixelType::float32).figure("energy_error"), 1e-6);
}

}  // namespace
}  // namespace pbrbake::texture::test

#pragma once
// Parameters of a texture set; schemas/job.schema.json, definitions/texture, says what each means.

#include <array>
#include <string>
#include <vector>

#include "bakers/params.hpp"

namespace pbrbake {
namespace texture {

enum class Model { specular_gloss, blinn_phong, phong, metallic_roughness };
enum class Coupling { automatic, none, fresnel };
enum class Norm { energy, n_plus_8, none, over_pi };
enum class Fit { slope, l2, cumulative, half_width };
enum class GlossIn {
    automatic,
    none,
    gloss,
    specular_alpha,
    diffuse_alpha,
    normal_alpha,
    metallic_alpha,
    constant
};
enum class GlossIs { automatic, smoothness, perceptual_roughness, alpha, power, power_log2 };
/// One channel of a picture; automatic: the usual one of its field.
enum class Channel { automatic, r, g, b, a };
constexpr int index_of(Channel channel) { return static_cast<int>(channel) - 1; }
enum class GlossSpace { linear, srgb };
enum class NormalIn { xyz, xy, ag };
enum class Green { automatic, up, down };
enum class AlphaIs { automatic, opacity, nothing };
enum class SurfaceIs { automatic, any, dielectric, metal };
enum class Calibrate { automatic, none, library };
enum class Packing { gltf, unity, unreal, frostbite, separate, specular_gloss };
enum class Wrap { repeat, clamp };
enum class AlphaMode { automatic, opaque, mask, blend };
enum class ExtraMap { confidence, difference, energy };

struct TextureParams {
    std::string source, material;  ///< what filled in the other fields, if anything did
    std::string diffuse, specular, gloss, normal, occlusion, opacity, emissive;  ///< paths; "": none
    std::string base_color, metallic_roughness, metallic;                        ///< paths
    std::string rules;                                                           ///< path
    std::string colour_space;
    Channel specular_channel, gloss_channel, metallic_channel, occlusion_channel, opacity_channel;
    Model model;
    Coupling diffuse_coupling;
    Norm norm;
    Fit fit;
    GlossIn gloss_in;
    GlossIs gloss_is;
    GlossSpace gloss_space;
    double power_scale;
    double power;  ///< 0: none
    std::vector<double> diffuse_factor, specular_factor;
    double gloss_factor, opacity_factor;
    std::vector<double> emissive_factor;
    double normal_scale, occlusion_strength;
    AlphaMode alpha_mode;
    double alpha_cutoff;
    bool double_sided;
    std::vector<double> uv_offset, uv_scale;
    double uv_rotation;
    NormalIn normal_in;
    Green normal_green;
    AlphaIs alpha_is;
    SurfaceIs surface;
    Calibrate calibrate;
    double dielectric_f0;
    double f0_tolerance;
    bool regularise;
    bool multiscatter;
    Packing packing;
    bool residual;
    Wrap wrap;
    int levels;  ///< 0: down to 1 x 1
    bool dither;
    std::int64_t seed;
    std::vector<ExtraMap> maps;

    template <class Visit>
    static void fields(Visit&& visit) {
        visit("source", &TextureParams::source);
        visit("material", &TextureParams::material);
        visit("diffuse", &TextureParams::diffuse);
        visit("specular", &TextureParams::specular);
        visit("gloss", &TextureParams::gloss);
        visit("normal", &TextureParams::normal);
        visit("occlusion", &TextureParams::occlusion);
        visit("opacity", &TextureParams::opacity);
        visit("emissive", &TextureParams::emissive);
        visit("base_color", &TextureParams::base_color);
        visit("metallic_roughness", &TextureParams::metallic_roughness);
        visit("metallic", &TextureParams::metallic);
        visit("rules", &TextureParams::rules);
        visit("colour_space", &TextureParams::colour_space);
        visit("specular_channel", &TextureParams::specular_channel);
        visit("gloss_channel", &TextureParams::gloss_channel);
        visit("metallic_channel", &TextureParams::metallic_channel);
        visit("occlusion_channel", &TextureParams::occlusion_channel);
        visit("opacity_channel", &TextureParams::opacity_channel);
        visit("model", &TextureParams::model);
        visit("diffuse_coupling", &TextureParams::diffuse_coupling);
        visit("norm", &TextureParams::norm);
        visit("fit", &TextureParams::fit);
        visit("gloss_in", &TextureParams::gloss_in);
        visit("gloss_is", &TextureParams::gloss_is);
        visit("gloss_space", &TextureParams::gloss_space);
        visit("power_scale", &TextureParams::power_scale);
        visit("power", &TextureParams::power);
        visit("diffuse_factor", &TextureParams::diffuse_factor);
        visit("specular_factor", &TextureParams::specular_factor);
        visit("gloss_factor", &TextureParams::gloss_factor);
        visit("opacity_factor", &TextureParams::opacity_factor);
        visit("emissive_factor", &TextureParams::emissive_factor);
        visit("normal_scale", &TextureParams::normal_scale);
        visit("occlusion_strength", &TextureParams::occlusion_strength);
        visit("alpha_mode", &TextureParams::alpha_mode);
        visit("alpha_cutoff", &TextureParams::alpha_cutoff);
        visit("double_sided", &TextureParams::double_sided);
        visit("uv_offset", &TextureParams::uv_offset);
        visit("uv_scale", &TextureParams::uv_scale);
        visit("uv_rotation", &TextureParams::uv_rotation);
        visit("normal_in", &TextureParams::normal_in);
        visit("normal_green", &TextureParams::normal_green);
        visit("alpha_is", &TextureParams::alpha_is);
        visit("surface", &TextureParams::surface);
        visit("calibrate", &TextureParams::calibrate);
        visit("dielectric_f0", &TextureParams::dielectric_f0);
        visit("f0_tolerance", &TextureParams::f0_tolerance);
        visit("regularise", &TextureParams::regularise);
        visit("multiscatter", &TextureParams::multiscatter);
        visit("packing", &TextureParams::packing);
        visit("residual", &TextureParams::residual);
        visit("wrap", &TextureParams::wrap);
        visit("levels", &TextureParams::levels);
        visit("dither", &TextureParams::dither);
        visit("seed", &TextureParams::seed);
        visit("maps", &TextureParams::maps);
    }
};

}  // namespace texture

template <>
struct EnumNames<texture::Model> {
    static constexpr std::array<std::string_view, 4> names{"specular_gloss", "blinn_phong", "phong",
                                                           "metallic_roughness"};
};
template <>
struct EnumNames<texture::Coupling> {
    static constexpr std::array<std::string_view, 3> names{"auto", "none", "fresnel"};
};
template <>
struct EnumNames<texture::Norm> {
    static constexpr std::array<std::string_view, 4> names{"energy", "n_plus_8", "none", "over_pi"};
};
template <>
struct EnumNames<texture::Fit> {
    static constexpr std::array<std::string_view, 4> names{"slope", "l2", "cumulative", "half_width"};
};
template <>
struct EnumNames<texture::GlossIn> {
    static constexpr std::array<std::string_view, 8> names{"auto",           "none",          "gloss",
                                                           "specular_alpha", "diffuse_alpha", "normal_alpha",
                                                           "metallic_alpha", "constant"};
};
template <>
struct EnumNames<texture::GlossIs> {
    static constexpr std::array<std::string_view, 6> names{"auto",  "smoothness", "perceptual_roughness",
                                                           "alpha", "power",      "power_log2"};
};
template <>
struct EnumNames<texture::Channel> {
    static constexpr std::array<std::string_view, 5> names{"auto", "r", "g", "b", "a"};
};
template <>
struct EnumNames<texture::GlossSpace> {
    static constexpr std::array<std::string_view, 2> names{"linear", "srgb"};
};
template <>
struct EnumNames<texture::NormalIn> {
    static constexpr std::array<std::string_view, 3> names{"xyz", "xy", "ag"};
};
template <>
struct EnumNames<texture::Green> {
    static constexpr std::array<std::string_view, 3> names{"auto", "up", "down"};
};
template <>
struct EnumNames<texture::AlphaIs> {
    static constexpr std::array<std::string_view, 3> names{"auto", "opacity", "nothing"};
};
template <>
struct EnumNames<texture::SurfaceIs> {
    static constexpr std::array<std::string_view, 4> names{"auto", "any", "dielectric", "metal"};
};
template <>
struct EnumNames<texture::Calibrate> {
    static constexpr std::array<std::string_view, 3> names{"auto", "none", "library"};
};
template <>
struct EnumNames<texture::Packing> {
    static constexpr std::array<std::string_view, 6> names{"gltf",      "unity",    "unreal",
                                                           "frostbite", "separate", "specular_gloss"};
};
template <>
struct EnumNames<texture::Wrap> {
    static constexpr std::array<std::string_view, 2> names{"repeat", "clamp"};
};
template <>
struct EnumNames<texture::AlphaMode> {
    static constexpr std::array<std::string_view, 4> names{"auto", "opaque", "mask", "blend"};
};
template <>
struct EnumNames<texture::ExtraMap> {
    static constexpr std::array<std::string_view, 3> names{"confidence", "difference", "energy"};
};

}  // namespace pbrbake

// Files to legacy texels: channels, sizes, exponents, and the f0 that keeps a lobe's energy.

#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/texture/maps.hpp"
#include "pbr/brdf/roughness.hpp"
#include "pbr/legacy/exponent.hpp"
#include "pbr/legacy/phong.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::texture {
namespace {

Colour colour_of(const std::vector<double>& factor) {
    return {static_cast<float>(factor[0]), static_cast<float>(factor[1]), static_cast<float>(factor[2])};
}

pbr::PhongNorm norm_of(Norm norm) { return static_cast<pbr::PhongNorm>(norm); }
pbr::LobeFit fit_of(Fit fit) { return static_cast<pbr::LobeFit>(fit); }
static_assert(static_cast<int>(Norm::over_pi) == static_cast<int>(pbr::PhongNorm::over_pi) &&
              static_cast<int>(Fit::half_width) == static_cast<int>(pbr::LobeFit::half_width));

}  // namespace

const std::array<float, 257> kSrgbSlopes = [] {
    std::array<float, 257> slopes{};
    for (std::size_t i = 0; i < slopes.size(); ++i) {
        const double root = static_cast<double>(i) / 256, linear = root * root;
        slopes[i] = static_cast<float>(
            linear <= .0031308 ? 1 / 12.92
                               : 2.4 / 1.055 * pbr::exp_exact(1.4 / 2.4 * pbr::log_exact(linear)));
    }
    return slopes;
}();

Sources::Sources(const TextureParams& params, const Inputs& inputs)
    : rules_(apply_rules(params, inputs)),
      inputs_(inputs),
      diffuse_factor_(colour_of(params.diffuse_factor)),
      specular_factor_(colour_of(params.specular_factor)),
      gloss_reading_(find_gloss(rules_.params, inputs)) {
    for (const auto& [field, source] : inputs) {
        const Picture picture = picture_of(inputs, field);
        if (!picture) continue;
        if (source.image.faces != 1)
            throw Error(ExitCode::unreadable_input, "",
                        field + ": is a cube map; a texture set is of flat pictures");
        width_ = std::max(width_, picture.width());
        height_ = std::max(height_, picture.height());
    }
    const bool is_metallic = rules_.params.model == Model::metallic_roughness;
    const bool is_told =
        rules_.params.surface == SurfaceIs::dielectric || rules_.params.surface == SurfaceIs::metal;
    if (is_metallic && is_told)
        warnings_.push_back("surface: is stated as " + std::string(enum_name(rules_.params.surface)) +
                            ", but the set has a metallic mask, which is believed");
    diffuse_ = map_of(is_metallic ? "base_color" : "diffuse", 0);
    specular_ = map_of("specular", 0);
    occlusion_ = map_of("occlusion", 0);
    emissive_ = map_of("emissive", 0);
    metallic_ = params.metallic.empty() ? map_of("metallic_roughness", 2) : map_of("metallic", 0);
    gloss_ = map_of(gloss_reading_.field, gloss_reading_.channel);
    choose_normal();
    choose_opacity();
    tabulate_gloss();
    const bool is_coupled = rules_.params.diffuse_coupling == Coupling::fresnel ||
                            (rules_.params.diffuse_coupling == Coupling::automatic &&
                             rules_.params.model == Model::specular_gloss);
    coupling_ = is_coupled ? pbr::DiffuseCoupling::fresnel : pbr::DiffuseCoupling::none;
    if (!gloss_reading_.warning.empty()) warnings_.push_back(gloss_reading_.warning);
    warn_of_sizes(inputs);
}

void Sources::warn_of_sizes(const Inputs& inputs) {
    const auto size = [](int width, int height) {
        return std::to_string(width) + " x " + std::to_string(height);
    };
    for (const auto& [field, source] : inputs)
        if (const Picture picture = picture_of(inputs, field);
            picture && (picture.width() != width_ || picture.height() != height_))
            warnings_.push_back(field + ": is " + size(picture.width(), picture.height()) +
                                ", interpolated to the set's " + size(width_, height_));
}

/// No map where the set has no such file, or that no such channel.
Sources::Map Sources::map_of(const std::string& field, int channel) const {
    const Picture picture = picture_of(inputs_, field);
    if (picture.channels() <= channel) return {};
    Map map{picture,
            channel,
            picture.width() == width_ && picture.height() == height_,
            channel < 3 && picture.is_srgb(),
            {}};
    for (std::size_t code = 0; code < map.half_steps.size(); ++code)
        map.half_steps[code] = half_step(picture.linear(static_cast<std::uint8_t>(code)), 8, map.is_srgb);
    return map;
}

/// Tangent-space normals point up, so they are blue.
void Sources::choose_normal() {
    normal_ = map_of("normal", 0);
    if (!normal_.picture || !normal_.picture.is_grey()) return;
    normal_ = {};
    warnings_.push_back("normal: is grey, so it holds heights and no normals; left out");
}

void Sources::choose_opacity() {
    const TextureParams& params = rules_.params;
    opacity_ = map_of("opacity", 0);
    if (opacity_.picture || params.alpha_is == AlphaIs::nothing) return;
    const Picture& colours = diffuse_.picture;
    const bool is_gloss = gloss_.picture && gloss_.picture.is_same(colours);
    if (colours.channels() < 4 || is_gloss) return;
    if (params.alpha_is != AlphaIs::opacity && !colours.varies(3)) return;
    opacity_ = {colours, 3, diffuse_.is_full, false, {}};
}

void Sources::fetch(const Map& map, int x, int y, float* values, int count) const {
    const Picture& picture = map.picture;
    if (map.is_full) return picture.read(x, y, map.channel, count, values);
    const double u = (x + .5) * picture.width() / width_ - .5, v = (y + .5) * picture.height() / height_ - .5;
    const double left = std::floor(u), top = std::floor(v);
    const auto place = [&](double at, int size) {
        const int i = static_cast<int>(at);
        return rules_.params.wrap == Wrap::repeat ? (i % size + size) % size : std::clamp(i, 0, size - 1);
    };
    const int x0 = place(left, picture.width()), x1 = place(left + 1, picture.width());
    const int y0 = place(top, picture.height()), y1 = place(top + 1, picture.height());
    const auto fx = static_cast<float>(u - left), fy = static_cast<float>(v - top);
    std::array<std::array<float, 3>, 4> corners;
    picture.read(x0, y0, map.channel, count, corners[0].data());
    picture.read(x1, y0, map.channel, count, corners[1].data());
    picture.read(x0, y1, map.channel, count, corners[2].data());
    picture.read(x1, y1, map.channel, count, corners[3].data());
    for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c) {
        const float upper = corners[0][c] + (corners[1][c] - corners[0][c]) * fx;
        const float lower = corners[2][c] + (corners[3][c] - corners[2][c]) * fx;
        values[c] = upper + (lower - upper) * fy;
    }
}

float Sources::unit_value(const Map& map, int x, int y) const {
    float value = 1;
    fetch(map, x, y, &value, 1);
    return std::clamp(value, 0.f, 1.f);
}

/// The Blinn-Phong or Phong exponent that a gloss value stands for; < 0 where it stands for none.
float Sources::exponent(float gloss) const {
    if (gloss_reading_.is == GlossIs::power) return gloss * static_cast<float>(rules_.params.power_scale);
    if (gloss_reading_.is == GlossIs::power_log2)
        return static_cast<float>(
            pbr::exp_exact(std::numbers::ln2 *
                           std::clamp(static_cast<double>(gloss) * rules_.params.power_scale, -30., 30.)));
    return -1;
}

float Sources::exponent_at(int x, int y) const {
    float gloss = 0;
    fetch(gloss_, x, y, &gloss, 1);
    return exponent(gloss * static_cast<float>(rules_.params.gloss_factor));
}

/// Of a gloss value times its factor; `n` becomes the exponent.
float Sources::perceptual_roughness(float gloss, float& n) const {
    const bool is_phong = rules_.params.model == Model::phong;
    const auto of_exponent = [&](float power) {
        const float blinn = is_phong ? pbr::blinn_phong_from_phong(power) : power;
        return pbr::perceptual_roughness_from_alpha(
            pbr::alpha_from_blinn_phong(blinn, fit_of(rules_.params.fit)));
    };
    constexpr float kAssumed = .5f;  // of a set that says nothing
    const bool has_value = gloss_.picture || gloss_reading_.in == GlossIn::constant;
    n = has_value ? exponent(gloss) : rules_.params.power > 0 ? static_cast<float>(rules_.params.power) : -1;
    if (n >= 0) return of_exponent(n);
    const float value = std::clamp(gloss, 0.f, 1.f);
    const float p = !has_value                                           ? kAssumed
                    : gloss_reading_.is == GlossIs::perceptual_roughness ? value
                    : gloss_reading_.is == GlossIs::alpha ? pbr::perceptual_roughness_from_alpha(value)
                                                          : pbr::perceptual_roughness_from_smoothness(value);
    n = pbr::blinn_phong_from_alpha(pbr::alpha_from_perceptual_roughness(p), fit_of(rules_.params.fit)) /
        (is_phong ? 4.f : 1.f);
    return p;
}

Sources::Lobe Sources::lobe_of(float gloss) const {
    Lobe lobe;
    float n = 0;
    lobe.perceptual_roughness =
        perceptual_roughness(gloss * static_cast<float>(rules_.params.gloss_factor), n);
    if (!has_legacy_lobe()) return lobe;
    const auto kind = rules_.params.model == Model::phong ? pbr::PhongLobe::mirror : pbr::PhongLobe::blinn;
    lobe.mean = pbr::phong_albedo(norm_of(rules_.params.norm), kind, n).mean;
    lobe.ggx = pbr::mean_albedo_ggx(static_cast<double>(lobe.perceptual_roughness));
    return lobe;
}

bool Sources::has_legacy_lobe() const {
    const Model model = rules_.params.model;
    return (model == Model::blinn_phong || model == Model::phong) && has_specular();
}

void Sources::tabulate_gloss() {
    if (!gloss_.picture)
        lobes_.push_back(lobe_of(1));
    else if (gloss_.picture.bits() == 8 && !gloss_.is_srgb)
        for (int code = 0; code < 256; ++code) lobes_.push_back(lobe_of(static_cast<float>(code / 255.)));
}

Sources::Lobe Sources::lobe_at(int x, int y) const {
    if (!gloss_.picture) return lobes_.front();
    float gloss = 0;
    fetch(gloss_, x, y, &gloss, 1);
    if (!lobes_.empty() && gloss >= 0 && gloss <= 1) {
        const auto code = static_cast<std::size_t>(gloss * 255 + .5f);
        if (static_cast<float>(static_cast<double>(code) / 255.) == gloss) return lobes_[code];
    }
    return lobe_of(gloss);
}

void Sources::row(int y, LegacyTexel* texels) const {
    for (int x = 0; x < width_; ++x) texels[x] = texel(x, y);
}

/// Without a map, white times its factor.
Colour Sources::colour(const Map& map, const Colour& factor, int x, int y, Colour& half_steps) const {
    if (!map.picture) return glm::min(factor, Colour(1));
    Colour result;
    if (const std::uint8_t* codes = map.is_full ? map.picture.codes(x, y) : nullptr) {
        for (int c = 0; c < 3; ++c) {
            result[c] = std::min(map.picture.linear(codes[c]) * factor[c], 1.f);
            half_steps[c] = map.half_steps[codes[c]] * factor[c];
        }
        return result;
    }
    fetch(map, x, y, &result.x, 3);
    for (int c = 0; c < 3; ++c) {
        half_steps[c] = factor[c] * half_step(result[c], map.picture.bits(), map.is_srgb);
        result[c] = std::clamp(result[c] * factor[c], 0.f, 1.f);
    }
    return result;
}

LegacyTexel Sources::texel(int x, int y) const {
    LegacyTexel texel{};
    const Colour diffuse = colour(diffuse_, diffuse_factor_, x, y, texel.quantisation.diffuse);
    const Lobe lobe = lobe_at(x, y);
    texel.perceptual_roughness = lobe.perceptual_roughness;
    if (rules_.params.model == Model::metallic_roughness) {
        reflect_metallic(diffuse, x, y, texel);
        return texel;
    }
    Colour specular = colour(specular_, specular_factor_, x, y, texel.quantisation.f0);
    if (!has_specular()) specular = Colour(static_cast<float>(rules_.params.dielectric_f0));
    if (has_legacy_lobe()) {
        reflect_phong(diffuse, specular, lobe, texel);
        return texel;
    }
    texel.reflected = pbr::reflected_from_specular(diffuse, specular, coupling_);
    if (coupling_ == pbr::DiffuseCoupling::fresnel)
        texel.quantisation.diffuse *= 1 - pbr::max_channel(specular);
    return texel;
}

/// As glTF couples them, whatever the target.
void Sources::reflect_metallic(const Colour& base, int x, int y, LegacyTexel& texel) const {
    const auto f = static_cast<float>(rules_.params.dielectric_f0);
    texel.metallic = metallic_.picture ? unit_value(metallic_, x, y) : 0;
    texel.reflected =
        pbr::reflected_from_metallic<float>({base, texel.metallic, Colour(f)}, pbr::DiffuseCoupling::fresnel);
    texel.quantisation.diffuse *= (1 - texel.metallic) * (1 - f);
}

void Sources::reflect_phong(const Colour& diffuse, const Colour& specular, const Lobe& lobe,
                            LegacyTexel& texel) const {
    texel.specular_albedo = specular * lobe.mean;
    const auto scattering = rules_.params.multiscatter ? pbr::Scattering::multiple : pbr::Scattering::single;
    const float grey = pbr::mean_channel(texel.specular_albedo);
    const pbr::SolvedF0 solved = pbr::f0_from_mean_albedo(static_cast<double>(grey), lobe.ggx, scattering);
    const float scale = grey > 0 ? static_cast<float>(solved.f0) / grey : 0;
    texel.reflected = {diffuse, glm::min(texel.specular_albedo * scale, Colour(1))};
    texel.quantisation.f0 *= lobe.mean * scale;
    texel.f0_clamped = solved.clamped || pbr::max_channel(texel.specular_albedo) * scale > 1;
}

Colour Sources::normal(int x, int y) const {
    Colour n;
    fetch(normal_, x, y, &n.x, 3);
    // 8-bit maps put level at code 128 or 127.5; 255/2 is what most writers mean.
    return n * 2.f - 1.f;
}

Colour Sources::emissive(int x, int y) const {
    Colour value;
    fetch(emissive_, x, y, &value.x, 3);
    return glm::clamp(value, Colour(0), Colour(1));
}

}  // namespace pbrbake::texture

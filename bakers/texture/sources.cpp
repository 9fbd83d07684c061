// Files to legacy texels: channels, sizes, exponents, and the f0 that keeps a lobe's energy.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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

/// IEC 61966-2-1, of a code over its largest.
float from_srgb(float code) {
    const double c = std::clamp(static_cast<double>(code), 0., 1.);
    return static_cast<float>(c <= .04045 ? c / 12.92
                                          : pbr::exp_exact(2.4 * pbr::log_exact((c + .055) / 1.055)));
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
    diffuse_ =
        colour_map_of(map_of(is_metallic ? "base_color" : "diffuse", 0), colour_of(params.diffuse_factor));
    const Channel grey = rules_.params.specular_channel;
    specular_ = colour_map_of(map_of("specular", 0, grey, grey == Channel::automatic ? 1 : 0),
                              colour_of(params.specular_factor));
    occlusion_ = map_of("occlusion", 0, rules_.params.occlusion_channel);
    choose_emissive();
    metallic_ = params.metallic.empty() ? map_of("metallic_roughness", 2, rules_.params.metallic_channel)
                                        : map_of("metallic", 0, rules_.params.metallic_channel);
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
SizedMap Sources::map_of(const std::string& field, int channel, int step) const {
    const Picture picture = picture_of(inputs_, field);
    if (picture.channels() <= channel) return {};
    return {picture, channel, step, width_, height_, rules_.params.wrap};
}

/// Of the channel that is stated, which must be there if the map is.
SizedMap Sources::map_of(const std::string& field, int usual, Channel stated, int step) const {
    if (stated == Channel::automatic) return map_of(field, usual, step);
    const std::string name = field.substr(0, field.find("_roughness"));
    require_channel(inputs_, field, index_of(stated), name + "_channel", enum_name(stated));
    return map_of(field, index_of(stated), step);
}

Sources::ColourMap Sources::colour_map_of(const SizedMap& map, const Colour& factor) const {
    ColourMap colours{map, factor, {}, {}};
    if (!map.codes(0, 0, 0)) return colours;
    for (int c = 0; c < 3; ++c)
        for (std::size_t code = 0; code < 256; ++code) {
            const float linear = map.picture().linear(map.channel(c), static_cast<std::uint8_t>(code));
            const auto channel = static_cast<std::size_t>(c);
            colours.values[channel][code] = linear * factor[c];
            colours.half_steps[channel][code] = half_step(linear, 8, map.is_srgb()) * factor[c];
        }
    return colours;
}

/// Tangent-space normals point up, so they are blue.
void Sources::choose_normal() {
    const NormalIn in = rules_.params.normal_in;
    if (in == NormalIn::ag) {
        constexpr int kAlpha = 3, kBackToGreen = -2;
        require_channel(inputs_, "normal", kAlpha, "normal_in", enum_name(in));
        normal_ = map_of("normal", kAlpha, kBackToGreen);
        return;
    }
    normal_ = map_of("normal", 0);
    if (!normal_) return;
    if (normal_.picture().is_grey()) {
        normal_ = {};
        warnings_.push_back("normal: is grey, so it holds heights and no normals; left out");
    } else if (in == NormalIn::xyz && normal_.picture().varies(0) && !normal_.picture().varies(2)) {
        warnings_.push_back(
            "normal: blue is the same everywhere, as where two channels hold normals; if they do, state "
            "normal_in xy (red and green) or ag (alpha and green)");
    }
}

void Sources::choose_opacity() {
    const TextureParams& params = rules_.params;
    opacity_ = map_of("opacity", 0, params.opacity_channel);
    if (opacity_ || params.alpha_is == AlphaIs::nothing) return;
    const Picture& colours = diffuse_.map.picture();
    const bool has_alpha = colours.channels() > 3;
    const bool is_gloss = gloss_ && gloss_.picture().is_same(colours);
    if (has_alpha && !is_gloss && (params.alpha_is == AlphaIs::opacity || colours.varies(3)))
        opacity_ = {colours, 3, 1, width_, height_, params.wrap};
    // A material says it of every picture; without alpha, that is opaque.
    else if (params.alpha_is == AlphaIs::opacity && params.material.empty())
        warnings_.push_back(std::string("alpha_is: is stated as opacity, but the alpha of diffuse is ") +
                            (has_alpha ? "gloss" : "absent"));
}

void Sources::choose_emissive() {
    emissive_ = map_of("emissive", 0);
    if (!emissive_) return;
    if (const double share = emissive_.picture().share_above_one(); share > 0)
        warnings_.push_back(
            "emissive: " + percent(share) +
            " of texels are above 1, and stored as 1; divide the map by its largest value and "
            "multiply emissive_factor by it");
}

void Sources::unit_values(const SizedMap& map, int x, int y, std::span<float> values) const {
    map.read(0, x, y, values);
    for (float& value : values) value = std::clamp(value, 0.f, 1.f);
}

float Sources::occlusion(int x, int y) const {
    float value = 1;
    unit_values(occlusion_, x, y, {&value, 1});
    return value;
}

/// What a map's number is times gloss_factor.
float Sources::gloss_value(float stored) const {
    const float value = rules_.params.gloss_space == GlossSpace::srgb ? from_srgb(stored) : stored;
    return value * static_cast<float>(rules_.params.gloss_factor);
}

/// The Blinn-Phong or Phong exponent that a gloss value stands for, a float at most, which is a mirror's; < 0
/// where it stands for none.
float Sources::exponent(float gloss) const {
    if (gloss_reading_.is == GlossIs::power)
        return std::min(gloss * static_cast<float>(rules_.params.power_scale),
                        std::numeric_limits<float>::max());
    if (gloss_reading_.is == GlossIs::power_log2)
        return static_cast<float>(
            pbr::exp_exact(std::numbers::ln2 *
                           std::clamp(static_cast<double>(gloss) * rules_.params.power_scale, -30., 30.)));
    return -1;
}

float Sources::exponent_at(int x, int y) const {
    float gloss = 0;
    gloss_.read(0, x, y, {&gloss, 1});
    return exponent(gloss_value(gloss));
}

float Sources::lobe_exponent(int x, int y) const {
    float gloss = 1, n = 0;
    if (gloss_) gloss_.read(0, x, y, {&gloss, 1});
    perceptual_roughness(gloss_value(gloss), n);
    return n;
}

/// Of a gloss value times its factor; `n` becomes the exponent where it has one, or a legacy lobe needs it.
float Sources::perceptual_roughness(float gloss, float& n) const {
    const bool is_phong = rules_.params.model == Model::phong;
    const auto of_exponent = [&](float power) {
        const float blinn = is_phong ? pbr::blinn_phong_from_phong(power) : power;
        return pbr::perceptual_roughness_from_alpha(
            pbr::alpha_from_blinn_phong(blinn, fit_of(rules_.params.fit)));
    };
    constexpr float kAssumed = .5f;  // of a set that says nothing
    const bool has_value = gloss_ || gloss_reading_.in == GlossIn::constant;
    n = has_value ? exponent(gloss) : rules_.params.power > 0 ? static_cast<float>(rules_.params.power) : -1;
    if (n >= 0) return of_exponent(n);
    const float value = std::clamp(gloss, 0.f, 1.f);
    const float p = !has_value                                           ? kAssumed
                    : gloss_reading_.is == GlossIs::perceptual_roughness ? value
                    : gloss_reading_.is == GlossIs::alpha ? pbr::perceptual_roughness_from_alpha(value)
                                                          : pbr::perceptual_roughness_from_smoothness(value);
    if (has_legacy_lobe())
        n = pbr::blinn_phong_from_alpha(pbr::alpha_from_perceptual_roughness(p), fit_of(rules_.params.fit)) /
            (is_phong ? 4.f : 1.f);
    return p;
}

Sources::Lobe Sources::lobe_of(float gloss) const {
    Lobe lobe{gloss};
    float n = 0;
    lobe.perceptual_roughness = perceptual_roughness(gloss_value(gloss), n);
    if (!has_legacy_lobe()) return lobe;
    const auto kind = rules_.params.model == Model::phong ? pbr::PhongLobe::mirror : pbr::PhongLobe::blinn;
    lobe.mean = pbr::phong_albedo(norm_of(rules_.params.norm), kind, n).mean;
    return lobe;
}

float Sources::visible_error() const {
    constexpr float kNearly = .9f;  // what is left is for rounding
    const auto is_coarse = [](const ColourMap& colours) {
        return colours.map && colours.map.picture().bits() == 8;
    };
    return kNearly * (is_coarse(diffuse_) || is_coarse(specular_) ? 1.f / 255 : 1e-4f);
}

bool Sources::has_legacy_lobe() const {
    const Model model = rules_.params.model;
    return (model == Model::blinn_phong || model == Model::phong) && has_specular();
}

void Sources::tabulate_gloss() {
    if (!gloss_) {
        lobes_.push_back(lobe_of(1));
        return;
    }
    const int bits = gloss_.picture().bits();
    // Many more texels than codes, or a table isn't worth its making.
    const bool is_large = static_cast<std::size_t>(width_) * height_ > std::size_t{1} << 18;
    if (bits == 8 && !gloss_.is_srgb())
        for (int code = 0; code < 256; ++code) lobes_.push_back(lobe_of(static_cast<float>(code / 255.)));
    else if (bits == 16 && is_large && has_legacy_lobe())
        for (int code = 0; code < 65536; ++code)
            lobes_.push_back(lobe_of(static_cast<float>(code) * (1.f / 65535)));
}

void Sources::read_lobes(int x, int y, LegacyRow& row) const {
    const auto set = [&row](std::size_t i, const Lobe& lobe) {
        row.perceptual_roughness[i] = lobe.perceptual_roughness;
        row.lobe_albedo[i] = lobe.mean;
    };
    if (!gloss_) {
        for (std::size_t i = 0; i < row.texels(); ++i) set(i, lobes_.front());
        return;
    }
    const std::uint8_t* codes = lobes_.empty() ? nullptr : gloss_.codes(0, x, y);
    const auto step = static_cast<std::size_t>(gloss_.picture().channels());
    if (codes) {
        for (std::size_t i = 0; i < row.texels(); ++i) set(i, lobes_[codes[i * step]]);
        return;
    }
    std::vector<float> gloss(row.texels());
    gloss_.read(0, x, y, gloss);
    for (std::size_t i = 0; i < gloss.size(); ++i) {
        const Lobe* known = tabulated(gloss[i]);
        set(i, known ? *known : lobe_of(gloss[i]));
    }
}

const Sources::Lobe* Sources::tabulated(float gloss) const {
    if (lobes_.empty()) return nullptr;
    const auto last = static_cast<float>(lobes_.size() - 1);
    const Lobe& lobe = lobes_[static_cast<std::uint32_t>(std::clamp(gloss, 0.f, 1.f) * last + .5f)];
    return lobe.gloss == gloss ? &lobe : nullptr;
}

void Sources::read_colours(const ColourMap& colours, int x, int y, Planes& values, Planes& half_steps) const {
    const std::size_t count = values.channels[0].size();
    const SizedMap& map = colours.map;
    if (!map) {
        values.fill(colours.factor);
        return half_steps.fill(Colour(0));
    }
    if (map.codes(0, x, y)) {
        const auto step = static_cast<std::size_t>(map.picture().channels());
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint8_t* codes = map.codes(static_cast<int>(c), x, y);
            for (std::size_t i = 0; i < count; ++i) {
                const std::uint8_t code = codes[i * step];
                values.channels[c][i] = colours.values[c][code];
                half_steps.channels[c][i] = colours.half_steps[c][code];
            }
        }
        return;
    }
    const int bits = map.picture().bits();
    const bool is_srgb = map.is_srgb(), is_half = map.picture().is_half();
    for (std::size_t c = 0; c < 3; ++c) {
        const float factor = colours.factor[static_cast<int>(c)];
        map.read(static_cast<int>(c), x, y, values.channels[c]);
        for (std::size_t i = 0; i < count; ++i) {
            float& value = values.channels[c][i];
            half_steps.channels[c][i] =
                factor * (is_half ? half_float_step(value) : half_step(value, bits, is_srgb));
            value *= factor;
        }
    }
}

/// Colours that are 1 at most, as nothing reflects more.
void Sources::read_albedos(const ColourMap& colours, int x, int y, Planes& values, Planes& half_steps,
                           std::vector<std::uint8_t>& above_one) const {
    read_colours(colours, x, y, values, half_steps);
    const bool has_codes = !colours.map || colours.map.codes(0, x, y);
    if (has_codes && pbr::max_channel(colours.factor) <= 1) return;
    for (auto& channel : values.channels)
        for (std::size_t i = 0; i < channel.size(); ++i) {
            if (channel[i] > kAllLight) above_one[i] = 1;
            channel[i] = std::min(channel[i], 1.f);
        }
}

LegacyTexel Sources::texel(int x, int y) const {
    LegacyRow row(1);
    read(x, y, row);
    return row[0];
}

void Sources::read(int x, int y, LegacyRow& row) const {
    std::ranges::fill(row.above_one, std::uint8_t{0});
    read_albedos(diffuse_, x, y, row.diffuse, row.diffuse_step, row.above_one);
    read_lobes(x, y, row);
    if (rules_.params.model == Model::metallic_roughness) return reflect_metallic(x, y, row);
    if (has_legacy_lobe()) {  // ks may be any number
        read_colours(specular_, x, y, row.f0, row.f0_step);
        return reflect_phong(row);
    }
    read_albedos(specular_, x, y, row.f0, row.f0_step, row.above_one);
    if (!has_specular()) row.f0.fill(Colour(static_cast<float>(rules_.params.dielectric_f0)));
    reflect_specular(row);
}

/// pbr::reflected_from_specular of colours that were read in place.
void Sources::reflect_specular(LegacyRow& row) const {
    if (coupling_ == pbr::DiffuseCoupling::none) return;
    const auto& f0 = row.f0.channels;
    for (std::size_t i = 0; i < row.texels(); ++i) {
        const float left = 1 - std::max(f0[0][i], std::max(f0[1][i], f0[2][i]));
        for (std::size_t c = 0; c < 3; ++c) {
            row.diffuse.channels[c][i] *= left;
            row.diffuse_step.channels[c][i] *= left;
        }
    }
}

/// As glTF couples them, whatever the target.
void Sources::reflect_metallic(int x, int y, LegacyRow& row) const {
    const auto f = static_cast<float>(rules_.params.dielectric_f0);
    if (metallic_)
        unit_values(metallic_, x, y, row.metallic);
    else
        std::ranges::fill(row.metallic, 0.f);
    for (std::size_t i = 0; i < row.texels(); ++i) {
        const float metallic = row.metallic[i];
        const auto reflected = pbr::reflected_from_metallic<float>({row.diffuse[i], metallic, Colour(f)},
                                                                   pbr::DiffuseCoupling::fresnel);
        row.diffuse.set(i, reflected.diffuse);
        row.f0.set(i, reflected.f0);
        row.diffuse_step.set(i, row.diffuse_step[i] * ((1 - metallic) * (1 - f)));
    }
}

/// The lobe takes specular's colour: its energy is kept in the mean channel.
void Sources::reflect_phong(LegacyRow& row) const {
    const std::size_t count = row.texels();
    const auto scattering = rules_.params.multiscatter ? pbr::Scattering::multiple : pbr::Scattering::single;
    const float* mean = row.lobe_albedo.data();
    for (std::size_t c = 0; c < 3; ++c) {
        const float* ks = row.f0.channels[c].data();
        float* albedo = row.specular_albedo.channels[c].data();
        for (std::size_t i = 0; i < count; ++i) albedo[i] = ks[i] * mean[i];
    }
    const auto [r, g, b] = std::as_const(row.specular_albedo).from(0);
    constexpr float kRough = .5f;
    std::vector<float> grey(count), scale(count);
    for (std::size_t i = 0; i < count; ++i) grey[i] = (r[i] + g[i] + b[i]) / 3.f;
    pbr::f0_from_mean_albedo(grey.data(), row.perceptual_roughness.data(), scattering, count, scale.data(),
                             row.f0_clamped.data());
    for (std::size_t i = 0; i < count; ++i) scale[i] = grey[i] > 0 ? scale[i] / grey[i] : 0;
    for (std::size_t i = 0; i < count; ++i) {
        const Colour albedo(r[i], g[i], b[i]);
        const float p = row.perceptual_roughness[i];
        // Where little light is lost between facets, all of it is as good as grey.
        if (p > kRough && scattering == pbr::Scattering::multiple && pbr::max_channel(albedo) > grey[i])
            scale[i] *= static_cast<float>(pbr::coloured_f0_scale(
                pbr::Vec3<double>(albedo) * static_cast<double>(scale[i]), static_cast<double>(grey[i]),
                pbr::mean_albedo_ggx(static_cast<double>(p)), scattering));
        row.f0_clamped[i] |= pbr::max_channel(albedo) * scale[i] > 1;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        const float* albedo = row.specular_albedo.channels[c].data();
        float* f0 = row.f0.channels[c].data();
        float* step = row.f0_step.channels[c].data();
        for (std::size_t i = 0; i < count; ++i) {
            f0[i] = std::min(albedo[i] * scale[i], 1.f);
            step[i] *= mean[i] * scale[i];
        }
    }
}

void Sources::read_normals(int y, std::size_t to, Planes& normals) const {
    const bool has_z = rules_.params.normal_in == NormalIn::xyz;
    const auto count = static_cast<std::size_t>(width_);
    for (std::size_t c = 0; c < (has_z ? 3u : 2u); ++c) {
        const std::span values(normals.channels[c].data() + to, count);
        normal_.read(static_cast<int>(c), 0, y, values);
        // 8-bit maps put level at code 128 or 127.5; 255/2 is what most writers mean.
        for (float& value : values) value = value * 2.f - 1.f;
    }
    const auto [nx, ny, nz] = normals.from(to);
    for (std::size_t i = 0; !has_z && i < count; ++i)
        nz[i] = std::sqrt(std::max(0.f, 1 - nx[i] * nx[i] - ny[i] * ny[i]));
}

void Sources::read_emissive(int y, std::size_t to, Planes& light) const {
    for (std::size_t c = 0; c < 3; ++c) {
        const std::span values(light.channels[c].data() + to, static_cast<std::size_t>(width_));
        emissive_.read(static_cast<int>(c), 0, y, values);
        for (float& value : values) value = std::clamp(value, 0.f, 1.f);
    }
}

LegacyRow::LegacyRow(int texels)
    : perceptual_roughness(static_cast<std::size_t>(texels)), lobe_albedo(perceptual_roughness.size()) {
    const std::size_t count = perceptual_roughness.size();
    for (Planes* planes : {&diffuse, &f0, &specular_albedo, &diffuse_step, &f0_step}) planes->resize(count);
    metallic.assign(count, -1.f);
    f0_clamped.resize(count);
    above_one.resize(count);
}

LegacyTexel LegacyRow::operator[](std::size_t i) const {
    return {{diffuse[i], f0[i]}, specular_albedo[i], perceptual_roughness[i],
            metallic[i],         f0_clamped[i] != 0, {diffuse_step[i], f0_step[i]}};
}

}  // namespace pbrbake::texture

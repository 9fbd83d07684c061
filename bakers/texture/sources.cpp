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
    Map specular = map_of("specular", 0, rules_.params.specular_channel);
    if (rules_.params.specular_channel != Channel::automatic) specular.step = 0;
    specular_ = colour_map_of(specular, colour_of(params.specular_factor));
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
Sources::Map Sources::map_of(const std::string& field, int channel) const {
    const Picture picture = picture_of(inputs_, field);
    if (picture.channels() <= channel) return {};
    Map map{picture,
            channel,
            1,
            picture.width() == width_ && picture.height() == height_,
            channel < 3 && picture.is_srgb(),
            false};
    map.is_coded = map.is_full && picture.codes(0, 0);
    return map;
}

/// Of the channel that is stated, which must be there if the map is.
Sources::Map Sources::map_of(const std::string& field, int usual, Channel stated) const {
    if (stated == Channel::automatic) return map_of(field, usual);
    const std::string name = field.substr(0, field.find("_roughness"));
    require_channel(inputs_, field, index_of(stated), name + "_channel", enum_name(stated));
    return map_of(field, index_of(stated));
}

Sources::ColourMap Sources::colour_map_of(const Map& map, const Colour& factor) const {
    ColourMap colours{map, factor, {}, {}};
    if (!colours.map.is_coded) return colours;
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t code = 0; code < 256; ++code) {
            const float linear = map.picture.linear(map.channel, static_cast<std::uint8_t>(code));
            const float scale = factor[static_cast<int>(c)];
            colours.values[c][code] = linear * scale;
            colours.half_steps[c][code] = half_step(linear, 8, colours.map.is_srgb) * scale;
        }
    return colours;
}

/// Tangent-space normals point up, so they are blue.
void Sources::choose_normal() {
    const NormalIn in = rules_.params.normal_in;
    if (in == NormalIn::ag) {
        constexpr int kAlpha = 3, kBackToGreen = -2;
        require_channel(inputs_, "normal", kAlpha, "normal_in", enum_name(in));
        normal_ = map_of("normal", kAlpha);
        normal_.step = kBackToGreen;
        return;
    }
    normal_ = map_of("normal", 0);
    if (!normal_.picture) return;
    if (normal_.picture.is_grey()) {
        normal_ = {};
        warnings_.push_back("normal: is grey, so it holds heights and no normals; left out");
    } else if (in == NormalIn::xyz && normal_.picture.varies(0) && !normal_.picture.varies(2)) {
        warnings_.push_back(
            "normal: blue is the same everywhere, as where two channels hold normals; if they do, state "
            "normal_in xy (red and green) or ag (alpha and green)");
    }
}

void Sources::choose_opacity() {
    const TextureParams& params = rules_.params;
    opacity_ = map_of("opacity", 0, params.opacity_channel);
    if (opacity_.picture || params.alpha_is == AlphaIs::nothing) return;
    const Picture& colours = diffuse_.map.picture;
    const bool has_alpha = colours.channels() > 3;
    const bool is_gloss = gloss_.picture && gloss_.picture.is_same(colours);
    if (has_alpha && !is_gloss && (params.alpha_is == AlphaIs::opacity || colours.varies(3)))
        opacity_ = {colours, 3, 1, diffuse_.map.is_full, false, diffuse_.map.is_coded};
    // A material says it of every picture; without alpha, that is opaque.
    else if (params.alpha_is == AlphaIs::opacity && params.material.empty())
        warnings_.push_back(std::string("alpha_is: is stated as opacity, but the alpha of diffuse is ") +
                            (has_alpha ? "gloss" : "absent"));
}

void Sources::choose_emissive() {
    emissive_ = map_of("emissive", 0);
    if (!emissive_.picture) return;
    if (const double share = emissive_.picture.share_above_one(); share > 0)
        warnings_.push_back(
            "emissive: " + percent(share) +
            " of texels are above 1, and stored as 1; divide the map by its largest value and "
            "multiply emissive_factor by it");
}

void Sources::fetch(const Map& map, int x, int y, float* values, int count) const {
    const Picture& picture = map.picture;
    if (map.is_full) return picture.read(x, y, map.channel, map.step, count, values);
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
    picture.read(x0, y0, map.channel, map.step, count, corners[0].data());
    picture.read(x1, y0, map.channel, map.step, count, corners[1].data());
    picture.read(x0, y1, map.channel, map.step, count, corners[2].data());
    picture.read(x1, y1, map.channel, map.step, count, corners[3].data());
    for (std::size_t c = 0; c < static_cast<std::size_t>(count); ++c) {
        const float upper = corners[0][c] + (corners[1][c] - corners[0][c]) * fx;
        const float lower = corners[2][c] + (corners[3][c] - corners[2][c]) * fx;
        values[c] = upper + (lower - upper) * fy;
    }
}

void Sources::unit_values(const Map& map, int x, int y, int count, float* values) const {
    for (int i = 0; i < count; ++i) {
        values[i] = 1;
        fetch(map, x + i, y, &values[i], 1);
        values[i] = std::clamp(values[i], 0.f, 1.f);
    }
}

float Sources::occlusion(int x, int y) const {
    float value = 1;
    unit_values(occlusion_, x, y, 1, &value);
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
    fetch(gloss_, x, y, &gloss, 1);
    return exponent(gloss_value(gloss));
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
    lobe.perceptual_roughness = perceptual_roughness(gloss_value(gloss), n);
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

/// The lobes of a row; those that aren't tabulated are kept in `own`.
void Sources::read_lobes(int x, int y, std::vector<const Lobe*>& lobes, std::vector<Lobe>& own) const {
    if (!gloss_.picture) {
        std::ranges::fill(lobes, &lobes_.front());
        return;
    }
    const bool has_codes = gloss_.is_coded && !lobes_.empty();
    for (std::size_t i = 0; i < lobes.size(); ++i) {
        const int column = x + static_cast<int>(i);
        if (has_codes) {
            lobes[i] = &lobes_[gloss_.picture.codes(column, y)[gloss_.channel]];
            continue;
        }
        float gloss = 0;
        fetch(gloss_, column, y, &gloss, 1);
        const auto code = static_cast<std::size_t>(std::clamp(gloss, 0.f, 1.f) * 255 + .5f);
        if (!lobes_.empty() && static_cast<float>(static_cast<double>(code) / 255.) == gloss) {
            lobes[i] = &lobes_[code];
            continue;
        }
        own.push_back(lobe_of(gloss));
        lobes[i] = &own.back();
    }
}

void Sources::read_colours(const ColourMap& colours, int x, int y, Planes& values, Planes& half_steps) const {
    const std::size_t count = values.channels[0].size();
    const Map& map = colours.map;
    if (!map.picture) {
        values.fill(colours.factor);
        return half_steps.fill(Colour(0));
    }
    if (map.is_coded) {
        const std::uint8_t* codes = map.picture.codes(x, y);
        const auto step = static_cast<std::size_t>(map.picture.channels()),
                   first = static_cast<std::size_t>(map.channel), next = static_cast<std::size_t>(map.step);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t i = 0; i < count; ++i) {
                const std::uint8_t code = codes[i * step + first + c * next];
                values.channels[c][i] = colours.values[c][code];
                half_steps.channels[c][i] = colours.half_steps[c][code];
            }
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        Colour value, step;
        fetch(map, x + static_cast<int>(i), y, &value.x, 3);
        for (int c = 0; c < 3; ++c)
            step[c] = colours.factor[c] * (map.picture.is_half()
                                               ? half_float_step(value[c])
                                               : half_step(value[c], map.picture.bits(), map.is_srgb));
        values.set(i, value * colours.factor);
        half_steps.set(i, step);
    }
}

/// Colours that are 1 at most, as nothing reflects more.
void Sources::read_albedos(const ColourMap& colours, int x, int y, Planes& values, Planes& half_steps,
                           std::vector<std::uint8_t>& above_one) const {
    read_colours(colours, x, y, values, half_steps);
    const bool has_codes = !colours.map.picture || colours.map.is_coded;
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
    std::vector<const Lobe*> lobes(row.texels());
    std::vector<Lobe> own;
    own.reserve(row.texels());  // lobes point to them
    read_lobes(x, y, lobes, own);
    for (std::size_t i = 0; i < lobes.size(); ++i)
        row.perceptual_roughness[i] = lobes[i]->perceptual_roughness;
    if (rules_.params.model == Model::metallic_roughness) return reflect_metallic(x, y, row);
    if (has_legacy_lobe()) {  // ks may be any number
        read_colours(specular_, x, y, row.f0, row.f0_step);
        return reflect_phong(lobes, row);
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
    if (metallic_.picture)
        unit_values(metallic_, x, y, static_cast<int>(row.texels()), row.metallic.data());
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

void Sources::reflect_phong(const std::vector<const Lobe*>& lobes, LegacyRow& row) const {
    const auto scattering = rules_.params.multiscatter ? pbr::Scattering::multiple : pbr::Scattering::single;
    for (std::size_t i = 0; i < row.texels(); ++i) {
        const Lobe& lobe = *lobes[i];
        const Colour albedo = row.f0[i] * lobe.mean;
        const float grey = pbr::mean_channel(albedo);
        const pbr::SolvedF0 solved =
            pbr::f0_from_mean_albedo(static_cast<double>(grey), lobe.ggx, scattering);
        const float scale = grey > 0 ? static_cast<float>(solved.f0) / grey : 0;
        row.specular_albedo.set(i, albedo);
        row.f0.set(i, glm::min(albedo * scale, Colour(1)));
        row.f0_step.set(i, row.f0_step[i] * (lobe.mean * scale));
        row.f0_clamped[i] = solved.clamped || pbr::max_channel(albedo) * scale > 1;
    }
}

void Sources::read_normals(int y, std::size_t to, Planes& normals) const {
    const bool has_z = rules_.params.normal_in == NormalIn::xyz;
    for (int x = 0; x < width_; ++x) {
        Colour n;
        fetch(normal_, x, y, &n.x, has_z ? 3 : 2);
        // 8-bit maps put level at code 128 or 127.5; 255/2 is what most writers mean.
        n = n * 2.f - 1.f;
        if (!has_z) n.z = std::sqrt(std::max(0.f, 1 - n.x * n.x - n.y * n.y));
        normals.set(to + static_cast<std::size_t>(x), n);
    }
}

void Sources::read_emissive(int y, std::size_t to, Planes& light) const {
    for (int x = 0; x < width_; ++x) {
        Colour value;
        fetch(emissive_, x, y, &value.x, 3);
        light.set(to + static_cast<std::size_t>(x), glm::clamp(value, Colour(0), Colour(1)));
    }
}

LegacyRow::LegacyRow(int texels) : perceptual_roughness(static_cast<std::size_t>(texels)) {
    const auto count = static_cast<std::size_t>(texels);
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

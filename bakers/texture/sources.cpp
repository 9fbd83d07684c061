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

bool varies(const Image& image, int channel) {
    const std::vector<float>& texels = image.levels.front().texels;
    const std::size_t channels = image.channels.size();
    for (std::size_t i = static_cast<std::size_t>(channel); i < texels.size(); i += channels)
        if (texels[i] != texels[static_cast<std::size_t>(channel)]) return true;
    return false;
}

/// Heights and the like: tangent-space normals point up, so they are blue.
bool is_grey(const Image& image) {
    const std::size_t channels = image.channels.size();
    const std::vector<float>& texels = image.levels.front().texels;
    if (channels < 3) return true;
    for (std::size_t i = 0; i + 2 < texels.size(); i += channels)
        if (texels[i] != texels[i + 1] || texels[i] != texels[i + 2]) return false;
    return true;
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

Sources::Sources(const TextureParams& params, const Inputs& inputs) : params_(params), inputs_(inputs) {
    for (const auto& [field, source] : inputs) {
        if (source.image.levels.empty()) continue;  // the text of materials
        if (source.image.faces != 1)
            throw Error(ExitCode::unreadable_input, "",
                        field + ": is a cube map; a texture set is of flat pictures");
        width_ = std::max(width_, source.image.levels.front().width);
        height_ = std::max(height_, source.image.levels.front().height);
    }
    diffuse_ = map_of("diffuse", 0);
    specular_ = map_of("specular", 0);
    occlusion_ = map_of("occlusion", 0);
    emissive_ = map_of("emissive", 0);
    choose_normal();
    choose_gloss();
    choose_opacity();
    tabulate_gloss();
    const bool coupled =
        params.diffuse_coupling == Coupling::fresnel ||
        (params.diffuse_coupling == Coupling::automatic && params.model == Model::specular_gloss);
    coupling_ = coupled ? pbr::DiffuseCoupling::fresnel : pbr::DiffuseCoupling::none;
    for (const auto& [field, source] : inputs) {
        if (source.image.levels.empty()) continue;
        const Level& level = source.image.levels.front();
        if (level.width != width_ || level.height != height_)
            warnings_.push_back(field + ": is " + std::to_string(level.width) + " x " +
                                std::to_string(level.height) + ", interpolated to the set's " +
                                std::to_string(width_) + " x " + std::to_string(height_));
    }
}

/// No map where the set has no such file, or that no such channel.
Sources::Map Sources::map_of(const std::string& field, int channel) const {
    const auto found = inputs_.find(field);
    if (found == inputs_.end() || found->second.image.channel_count() <= channel) return {};
    const SourceImage& source = found->second;
    return {&source.image, channel, source.bits,
            channel < 3 && source.colour_space.find("srgb") != std::string::npos};
}

void Sources::choose_normal() {
    normal_ = map_of("normal", 0);
    if (!normal_.image || !is_grey(*normal_.image)) return;
    normal_ = {};
    warnings_.push_back("normal: is grey, so it holds heights and no normals; left out");
}

void Sources::choose_gloss() {
    const bool is_auto = params_.gloss_in == GlossIn::automatic;
    const auto take = [&](GlossIn where, const char* field, int channel) {
        if (gloss_.image || (!is_auto && params_.gloss_in != where)) return;
        const Map map = map_of(field, channel);
        // An alpha that is the same everywhere was added by a file format.
        if (map.image && (!is_auto || channel == 0 || varies(*map.image, channel))) gloss_ = map;
        // Nor does a picture whose alpha is 1 need to store it.
        is_gloss_constant_ |= !is_auto && !map.image && channel == 3 && inputs_.contains(field);
    };
    take(GlossIn::gloss, "gloss", 0);
    take(GlossIn::specular_alpha, "specular", 3);
    if (!is_auto) {
        take(GlossIn::diffuse_alpha, "diffuse", 3);
        take(GlossIn::normal_alpha, "normal", 3);
    }
    is_gloss_constant_ |= params_.gloss_in == GlossIn::constant;
    if (gloss_.image || is_gloss_constant_) return;
    if (!is_auto)
        throw Error(ExitCode::unreadable_input, "",
                    "gloss_in: found \"" + std::string(enum_name(params_.gloss_in)) +
                        "\", but that map is absent or has no such channel");
    if (params_.power <= 0)
        warnings_.push_back("there is no gloss map and no power; perceptual roughness .5 is assumed");
}

void Sources::choose_opacity() {
    opacity_ = map_of("opacity", 0);
    if (opacity_.image || params_.alpha_is == AlphaIs::nothing) return;
    const Map alpha = map_of("diffuse", 3);
    if (!alpha.image || alpha.image == gloss_.image) return;
    if (params_.alpha_is == AlphaIs::opacity || varies(*alpha.image, 3)) opacity_ = alpha;
}

void Sources::fetch(const Map& map, int x, int y, float* values, int count) const {
    const Image& image = *map.image;
    const Level& level = image.levels.front();
    if (level.width == width_ && level.height == height_) {
        const float* texel = image.texel(0, 0, y, x) + map.channel;
        std::copy(texel, texel + count, values);
        return;
    }
    const double u = (x + .5) * level.width / width_ - .5, v = (y + .5) * level.height / height_ - .5;
    const double left = std::floor(u), top = std::floor(v);
    const auto place = [&](double at, int size) {
        const int i = static_cast<int>(at);
        return params_.wrap == Wrap::repeat ? (i % size + size) % size : std::clamp(i, 0, size - 1);
    };
    const int x0 = place(left, level.width), x1 = place(left + 1, level.width);
    const int y0 = place(top, level.height), y1 = place(top + 1, level.height);
    const auto fx = static_cast<float>(u - left), fy = static_cast<float>(v - top);
    for (int c = 0; c < count; ++c) {
        const auto at = [&](int column, int row) { return image.texel(0, 0, row, column)[map.channel + c]; };
        const float upper = at(x0, y0) + (at(x1, y0) - at(x0, y0)) * fx;
        const float lower = at(x0, y1) + (at(x1, y1) - at(x0, y1)) * fx;
        values[c] = upper + (lower - upper) * fy;
    }
}

/// The Blinn-Phong or Phong exponent that a gloss value stands for; < 0 where it stands for none.
float Sources::exponent(float gloss) const {
    if (params_.gloss_is == GlossIs::power) return gloss * static_cast<float>(params_.power_scale);
    if (params_.gloss_is == GlossIs::power_log2)
        return static_cast<float>(pbr::exp_exact(
            std::numbers::ln2 * std::clamp(static_cast<double>(gloss) * params_.power_scale, -30., 30.)));
    return -1;
}

float Sources::exponent_at(int x, int y) const {
    float gloss = 0;
    fetch(gloss_, x, y, &gloss, 1);
    return exponent(gloss * static_cast<float>(params_.gloss_factor));
}

/// Of a gloss value times its factor; `n` becomes the exponent.
float Sources::perceptual_roughness(float gloss, float& n) const {
    const bool is_phong = params_.model == Model::phong;
    const auto of_exponent = [&](float power) {
        const float blinn = is_phong ? pbr::blinn_phong_from_phong(power) : power;
        return pbr::perceptual_roughness_from_alpha(pbr::alpha_from_blinn_phong(blinn, fit_of(params_.fit)));
    };
    constexpr float kAssumed = .5f;  // of a set that says nothing
    const bool has_value = gloss_.image || is_gloss_constant_;
    n = has_value ? exponent(gloss) : params_.power > 0 ? static_cast<float>(params_.power) : -1;
    if (n >= 0) return of_exponent(n);
    const float value = std::clamp(gloss, 0.f, 1.f);
    const float p = !has_value                                          ? kAssumed
                    : params_.gloss_is == GlossIs::perceptual_roughness ? value
                    : params_.gloss_is == GlossIs::alpha ? pbr::perceptual_roughness_from_alpha(value)
                                                         : pbr::perceptual_roughness_from_smoothness(value);
    n = pbr::blinn_phong_from_alpha(pbr::alpha_from_perceptual_roughness(p), fit_of(params_.fit)) /
        (is_phong ? 4.f : 1.f);
    return p;
}

Sources::Lobe Sources::lobe_of(float gloss) const {
    Lobe lobe;
    float n = 0;
    lobe.perceptual_roughness = perceptual_roughness(gloss * static_cast<float>(params_.gloss_factor), n);
    if (!has_legacy_lobe()) return lobe;
    const auto kind = params_.model == Model::phong ? pbr::PhongLobe::mirror : pbr::PhongLobe::blinn;
    lobe.mean = pbr::phong_albedo(norm_of(params_.norm), kind, n).mean;
    lobe.ggx = pbr::mean_albedo_ggx(static_cast<double>(lobe.perceptual_roughness));
    return lobe;
}

void Sources::tabulate_gloss() {
    if (!gloss_.image)
        lobes_.push_back(lobe_of(1));
    else if (gloss_.bits == 8 && !gloss_.is_srgb)
        for (int code = 0; code < 256; ++code) lobes_.push_back(lobe_of(static_cast<float>(code / 255.)));
}

Sources::Lobe Sources::lobe_at(int x, int y) const {
    if (!gloss_.image) return lobes_.front();
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

LegacyTexel Sources::texel(int x, int y) const {
    LegacyTexel texel{};
    const auto colour = [&](const Map& map, const std::vector<double>& factor, Colour& half_steps) {
        float values[3] = {1, 1, 1};
        if (map.image) fetch(map, x, y, values, 3);
        Colour result;
        for (int c = 0; c < 3; ++c) {
            const auto f = static_cast<float>(factor[static_cast<std::size_t>(c)]);
            half_steps[c] = map.image ? f * half_step(values[c], map.bits, map.is_srgb) : 0;
            result[c] = std::clamp(values[c] * f, 0.f, 1.f);
        }
        return result;
    };
    const Colour diffuse = colour(diffuse_, params_.diffuse_factor, texel.quantisation.diffuse);
    Colour specular = colour(specular_, params_.specular_factor, texel.quantisation.f0);
    if (!has_specular()) specular = Colour(static_cast<float>(params_.dielectric_f0));
    const Lobe lobe = lobe_at(x, y);
    texel.perceptual_roughness = lobe.perceptual_roughness;
    if (!has_legacy_lobe()) {
        texel.reflected = pbr::reflected_from_specular(diffuse, specular, coupling_);
        if (coupling_ == pbr::DiffuseCoupling::fresnel)
            texel.quantisation.diffuse *= 1 - pbr::max_channel(specular);
        return texel;
    }
    texel.specular_albedo = specular * lobe.mean;
    const auto scattering = params_.multiscatter ? pbr::Scattering::multiple : pbr::Scattering::single;
    const float grey = pbr::mean_channel(texel.specular_albedo);
    const pbr::SolvedF0 solved = pbr::f0_from_mean_albedo(static_cast<double>(grey), lobe.ggx, scattering);
    const float scale = grey > 0 ? static_cast<float>(solved.f0) / grey : 0;
    texel.reflected = {diffuse, glm::min(texel.specular_albedo * scale, Colour(1))};
    texel.quantisation.f0 *= lobe.mean * scale;
    texel.f0_clamped = solved.clamped || pbr::max_channel(texel.specular_albedo) * scale > 1;
    return texel;
}

Colour Sources::normal(int x, int y) const {
    Colour n;
    fetch(normal_, x, y, &n.x, 3);
    // 8-bit maps put level at code 128 or 127.5; 255/2 is what most writers mean.
    return n * 2.f - 1.f;
}

float Sources::occlusion(int x, int y) const {
    float value = 1;
    fetch(occlusion_, x, y, &value, 1);
    return std::clamp(value, 0.f, 1.f);
}

float Sources::opacity(int x, int y) const {
    float value = 1;
    fetch(opacity_, x, y, &value, 1);
    return std::clamp(value, 0.f, 1.f);
}

Colour Sources::emissive(int x, int y) const {
    Colour value;
    fetch(emissive_, x, y, &value.x, 3);
    return glm::clamp(value, Colour(0), Colour(1));
}

}  // namespace pbrbake::texture

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

/// Slope of IEC 61966-2-1's decoding curve over the square root of the linear value, in 256 steps.
const std::array<float, 257>& srgb_slopes() {
    static const std::array<float, 257> table = [] {
        std::array<float, 257> slopes{};
        for (std::size_t i = 0; i < slopes.size(); ++i) {
            const double root = static_cast<double>(i) / 256, linear = root * root;
            slopes[i] = static_cast<float>(
                linear <= .0031308 ? 1 / 12.92
                                   : 2.4 / 1.055 * pbr::exp_exact(1.4 / 2.4 * pbr::log_exact(linear)));
        }
        return slopes;
    }();
    return table;
}

bool varies(const Image& image, int channel) {
    const std::vector<float>& texels = image.levels.front().texels;
    const std::size_t channels = image.channels.size();
    for (std::size_t i = static_cast<std::size_t>(channel); i < texels.size(); i += channels)
        if (texels[i] != texels[static_cast<std::size_t>(channel)]) return true;
    return false;
}

pbr::PhongNorm norm_of(Norm norm) { return static_cast<pbr::PhongNorm>(norm); }
pbr::LobeFit fit_of(Fit fit) { return static_cast<pbr::LobeFit>(fit); }
static_assert(static_cast<int>(Norm::over_pi) == static_cast<int>(pbr::PhongNorm::over_pi) &&
              static_cast<int>(Fit::half_width) == static_cast<int>(pbr::LobeFit::half_width));

}  // namespace

float half_step(float linear, int bits, bool is_srgb) {
    if (bits == 0) return 0;
    const float step = .5f / static_cast<float>((1 << std::min(bits, 16)) - 1);
    if (!is_srgb) return step;
    const float root = std::sqrt(std::clamp(linear, 0.f, 1.f));
    return step * srgb_slopes()[static_cast<std::size_t>(root * 256)];
}

Sources::Sources(const TextureParams& params, const Inputs& inputs) : params_(params), inputs_(inputs) {
    for (const auto& [field, source] : inputs) {
        if (source.image.levels.empty()) continue;  // a material
        if (source.image.faces != 1)
            throw Error(ExitCode::unreadable_input, "",
                        field + ": is a cube map; a texture set is of flat pictures");
        width_ = std::max(width_, source.image.levels.front().width);
        height_ = std::max(height_, source.image.levels.front().height);
    }
    diffuse_ = map_of("diffuse", 0);
    specular_ = map_of("specular", 0);
    normal_ = map_of("normal", 0);
    occlusion_ = map_of("occlusion", 0);
    choose_gloss();
    choose_opacity();
    const bool coupled =
        params.diffuse_coupling == Coupling::fresnel ||
        (params.diffuse_coupling == Coupling::automatic && params.model == Model::specular_gloss);
    coupling_ = coupled ? pbr::DiffuseCoupling::fresnel : pbr::DiffuseCoupling::none;
    for (const auto& [field, source] : inputs)
        if (!source.image.levels.empty() &&
            (source.image.levels.front().width != width_ || source.image.levels.front().height != height_))
            warnings_.push_back(field + ": is " + std::to_string(source.image.levels.front().width) + " x " +
                                std::to_string(source.image.levels.front().height) +
                                ", interpolated to the set's " + std::to_string(width_) + " x " +
                                std::to_string(height_));
}

/// No map where the set has no such file, or that no such channel.
Sources::Map Sources::map_of(const std::string& field, int channel) const {
    const auto found = inputs_.find(field);
    if (found == inputs_.end() || found->second.image.channel_count() <= channel) return {};
    const SourceImage& source = found->second;
    return {&source.image, channel, source.bits,
            channel < 3 && source.colour_space.find("srgb") != std::string::npos};
}

void Sources::choose_gloss() {
    const bool is_auto = params_.gloss_in == GlossIn::automatic;
    const auto take = [&](GlossIn where, const char* field, int channel) {
        if (gloss_.image || (!is_auto && params_.gloss_in != where)) return;
        const Map map = map_of(field, channel);
        // An alpha that is the same everywhere was added by a file format.
        if (map.image && (!is_auto || channel == 0 || varies(*map.image, channel))) gloss_ = map;
    };
    take(GlossIn::gloss, "gloss", 0);
    take(GlossIn::specular_alpha, "specular", 3);
    if (!is_auto) {
        take(GlossIn::diffuse_alpha, "diffuse", 3);
        take(GlossIn::normal_alpha, "normal", 3);
    }
    if (gloss_.image || params_.gloss_in == GlossIn::constant) return;
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

float Sources::perceptual_roughness(int x, int y, float& n) const {
    const bool is_phong = params_.model == Model::phong;
    const auto of_exponent = [&](float power) {
        const float blinn = is_phong ? pbr::blinn_phong_from_phong(power) : power;
        return pbr::perceptual_roughness_from_alpha(pbr::alpha_from_blinn_phong(blinn, fit_of(params_.fit)));
    };
    n = static_cast<float>(params_.power);
    if (!gloss_.image && params_.gloss_in != GlossIn::constant) return n > 0 ? of_exponent(n) : .5f;
    float gloss = 1;
    if (gloss_.image) fetch(gloss_, x, y, &gloss, 1);
    gloss *= static_cast<float>(params_.gloss_factor);
    n = exponent(gloss);
    if (n >= 0) return of_exponent(n);
    const float value = std::clamp(gloss, 0.f, 1.f);
    const float p = params_.gloss_is == GlossIs::perceptual_roughness ? value
                    : params_.gloss_is == GlossIs::alpha ? pbr::perceptual_roughness_from_alpha(value)
                                                         : pbr::perceptual_roughness_from_smoothness(value);
    n = pbr::blinn_phong_from_alpha(pbr::alpha_from_perceptual_roughness(p), fit_of(params_.fit)) /
        (is_phong ? 4.f : 1.f);
    return p;
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
    float n = 0;
    texel.perceptual_roughness = perceptual_roughness(x, y, n);
    if (params_.model == Model::specular_gloss || !has_specular()) {
        texel.reflected = pbr::reflected_from_specular(diffuse, specular, coupling_);
        if (coupling_ == pbr::DiffuseCoupling::fresnel)
            texel.quantisation.diffuse *= 1 - pbr::max_channel(specular);
        return texel;
    }
    const auto lobe = params_.model == Model::phong ? pbr::PhongLobe::mirror : pbr::PhongLobe::blinn;
    const float mean = pbr::phong_albedo(norm_of(params_.norm), lobe, n).mean;
    texel.specular_albedo = specular * mean;
    const auto scattering = params_.multiscatter ? pbr::Scattering::multiple : pbr::Scattering::single;
    const float grey = pbr::mean_channel(texel.specular_albedo);
    const pbr::SolvedF0 solved = pbr::f0_from_mean_albedo(
        static_cast<double>(grey), pbr::mean_albedo_ggx(static_cast<double>(texel.perceptual_roughness)),
        scattering);
    const float scale = grey > 0 ? static_cast<float>(solved.f0) / grey : 0;
    texel.reflected = {diffuse, glm::min(texel.specular_albedo * scale, Colour(1))};
    texel.quantisation.f0 *= mean * scale;
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

}  // namespace pbrbake::texture

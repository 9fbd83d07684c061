#pragma once
// A set's maps between its files and its packing: what surfaces reflect, texel by texel, linear and in float.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <vector>

#include "bakers/texture/gloss.hpp"
#include "bakers/texture/picture.hpp"
#include "bakers/texture/rules.hpp"
#include "bakers/texture/sized_map.hpp"
#include "pbr/legacy/energy.hpp"
#include "pbr/legacy/texel_planes.hpp"

namespace pbrbake::texture {

using Colour = pbr::Vec3<float>;

/// A colour a texel, a plane a channel.
struct Planes {
    std::array<std::vector<float>, 3> channels;

    bool empty() const { return channels[0].empty(); }
    void resize(std::size_t texels) {
        for (auto& channel : channels) channel.resize(texels);
    }
    Colour operator[](std::size_t i) const { return {channels[0][i], channels[1][i], channels[2][i]}; }
    void set(std::size_t i, const Colour& colour) {
        for (std::size_t c = 0; c < 3; ++c) channels[c][i] = colour[static_cast<int>(c)];
    }
    void fill(const Colour& colour) {
        for (std::size_t c = 0; c < 3; ++c) std::ranges::fill(channels[c], colour[static_cast<int>(c)]);
    }
    /// From texel i on.
    pbr::ColourPlanes from(std::size_t i) const {
        return {channels[0].data() + i, channels[1].data() + i, channels[2].data() + i};
    }
    std::array<float*, 3> from(std::size_t i) {
        return {channels[0].data() + i, channels[1].data() + i, channels[2].data() + i};
    }
};

/// One texel as its legacy model has it.
struct LegacyTexel {
    pbr::Reflected<float> reflected;  ///< diffuse albedo, and f0 that keeps the lobe's energy
    /// Of a Phong lobe, the cosine-weighted mean over views.
    Colour specular_albedo;
    float perceptual_roughness = 0;
    float metallic = -1;      ///< where the set states it; else < 0
    bool f0_clamped = false;  ///< the PBR lobe can't reflect that much
    pbr::Quantisation<float> quantisation;
};

/// Texels of a row as their legacy model has them: LegacyTexel's members.
struct LegacyRow {
    explicit LegacyRow(int texels);
    std::size_t texels() const { return perceptual_roughness.size(); }
    LegacyTexel operator[](std::size_t i) const;

    Planes diffuse, f0, specular_albedo;
    Planes diffuse_step, f0_step;  ///< quantisation
    std::vector<float> perceptual_roughness, metallic;
    std::vector<float> lobe_albedo;  ///< of legacy lobes of ks = 1
    std::vector<std::uint8_t> f0_clamped;
    std::vector<std::uint8_t> above_one;  ///< whose diffuse or f0 was stored above 1, and is 1
};

/// Rows of one level of a converted set: `rows` of them from row `first` on, perhaps all.
struct MapLevel {
    int width = 0, height = 0;  ///< of the level
    int first = 0, rows = 0;
    Planes diffuse, f0;
    std::vector<float> f90;  ///< grazing reflectance; empty where it is 1
    std::vector<float> metallic, perceptual_roughness;
    Planes normal;                          ///< y up; empty without a normal map
    Planes emissive;                        ///< empty without a map
    std::vector<float> occlusion, opacity;  ///< empty without a map
    /// Where row y begins, a row that is held.
    std::size_t at(int y) const { return static_cast<std::size_t>(y - first) * width; }
    std::size_t texels() const { return static_cast<std::size_t>(rows) * width; }
};

/// Shares of texels and means over a set, for the record.
struct Findings {
    double f0_clamped = 0, above_one = 0, over_unity = 0, low_confidence = 0, metallic = 0, confidence = 0;

    Findings& operator+=(const Findings& other) {
        f0_clamped += other.f0_clamped;
        above_one += other.above_one;
        over_unity += other.over_unity;
        low_confidence += other.low_confidence;
        metallic += other.metallic;
        confidence += other.confidence;
        return *this;
    }
};

/// Reads texels of a set at any resolution: maps of other sizes are interpolated bilinearly.
class Sources {
  public:
    Sources(const TextureParams& params, const Inputs& inputs);

    int width() const { return width_; }
    int height() const { return height_; }
    const TextureParams& params() const { return rules_.params; }  ///< as the set's rules leave them
    const RuledSet& rules() const { return rules_; }
    const GlossReading& gloss() const { return gloss_reading_; }

    /// The texel of column x, row y, before calibration.
    LegacyTexel texel(int x, int y) const;
    /// Those of row y from column x on, as many as `row` has.
    void read(int x, int y, LegacyRow& row) const;
    /// The other maps' of whole rows, from texel `to` of the planes on.
    void read_normals(int y, std::size_t to, Planes& normals) const;  ///< y as stored
    void read_occlusion(int y, float* values) const {
        unit_values(occlusion_, 0, y, {values, static_cast<std::size_t>(width_)});
    }
    void read_opacity(int y, float* values) const {
        unit_values(opacity_, 0, y, {values, static_cast<std::size_t>(width_)});
    }
    void read_emissive(int y, std::size_t to, Planes& light) const;
    float occlusion(int x, int y) const;
    /// The exponent that gloss stands for, where it holds one; else < 0. Needs has_gloss().
    float exponent_at(int x, int y) const;
    /// The exponent of the lobe as it is read, whatever gloss holds, or the one that stands for a roughness.
    float lobe_exponent(int x, int y) const;
    bool has_normal() const { return bool(normal_); }
    bool has_occlusion() const { return bool(occlusion_); }
    bool has_opacity() const { return bool(opacity_); }
    bool has_gloss() const { return bool(gloss_); }
    bool has_emissive() const { return bool(emissive_); }
    /// Whether the set says what it reflects: a map, or a factor.
    bool has_specular() const { return bool(specular_.map) || specular_.factor != Colour(1); }
    /// Whether the set has a Phong lobe, whose albedo is known without an f0.
    bool has_legacy_lobe() const;
    /// Whether texels may reflect less than all light at grazing incidence: Phong's lobes, and a specular
    /// factor of 0.
    bool may_be_dim() const { return has_legacy_lobe() || specular_.factor == Colour(0); }
    pbr::DiffuseCoupling coupling() const { return coupling_; }
    /// How far a material's diffuse albedo may be from its texel's: nearly a code of 8-bit colours, else
    /// 1e-4.
    float visible_error() const;
    const std::vector<std::string>& warnings() const { return warnings_; }

  private:
    /// A map of colours, and what multiplies it; without a map, white.
    struct ColourMap {
        SizedMap map;
        Colour factor{1};
        /// Of codes: what they stand for, and half their intervals, times the factor.
        std::array<std::array<float, 256>, 3> values{}, half_steps{};
    };
    /// What a gloss value stands for.
    struct Lobe {
        float gloss;
        float perceptual_roughness = .5f;
        float mean = 0;  ///< albedo of the legacy lobe
    };

    SizedMap map_of(const std::string& field, int channel, int step = 1) const;
    SizedMap map_of(const std::string& field, int usual, Channel stated, int step = 1) const;
    ColourMap colour_map_of(const SizedMap& map, const Colour& factor) const;
    void choose_normal();
    void choose_opacity();
    void choose_emissive();
    void tabulate_gloss();
    void warn_of_sizes(const Inputs& inputs);
    void unit_values(const SizedMap& map, int x, int y, std::span<float> values) const;
    void read_colours(const ColourMap& colours, int x, int y, Planes& values, Planes& half_steps) const;
    void read_albedos(const ColourMap& colours, int x, int y, Planes& values, Planes& half_steps,
                      std::vector<std::uint8_t>& above_one) const;
    float gloss_value(float stored) const;
    void read_lobes(int x, int y, LegacyRow& row) const;
    float exponent(float gloss) const;
    float perceptual_roughness(float gloss, float& exponent) const;
    Lobe lobe_of(float gloss) const;
    const Lobe* tabulated(float gloss) const;
    void reflect_specular(LegacyRow& row) const;
    void reflect_metallic(int x, int y, LegacyRow& row) const;
    void reflect_phong(LegacyRow& row) const;

    RuledSet rules_;
    const Inputs& inputs_;
    int width_ = 1, height_ = 1;  ///< of factors alone
    ColourMap diffuse_, specular_;
    SizedMap gloss_, normal_, occlusion_, opacity_, emissive_, metallic_;
    GlossReading gloss_reading_;
    pbr::DiffuseCoupling coupling_;
    std::vector<Lobe> lobes_;  ///< of a gloss map's codes, 0 to 1 evenly, or the one lobe without a map
    std::vector<std::string> warnings_;
};

/// What may be reflected of light: a code's rounding is no sin.
inline constexpr float kAllLight = 1.001f;

/// "12 %" of a share; of less than one, "under 1 %".
inline std::string percent(double share) {
    return share < .01 ? "under 1 %" : std::to_string(static_cast<int>(share * 100 + .5)) + " %";
}

/// Slope of IEC 61966-2-1's decoding curve over the square root of the linear value, in 256 steps.
extern const std::array<float, 257> kSrgbSlopes;

/// Half the interval of a 16-bit float at a value: half a unit in the last of 11 places; of subnormals 2^-25.
inline float half_float_step(float value) {
    constexpr std::uint32_t kExponent = 0x7F800000;
    const auto power_of_two = std::bit_cast<float>(std::bit_cast<std::uint32_t>(value) & kExponent);
    return std::max(power_of_two * 0x1p-11f, 0x1p-25f);
}

/// Half the linear interval of a code of `bits` (0: float) at a linear value.
inline float half_step(float linear, int bits, bool is_srgb) {
    if (bits == 0) return 0;
    const float step = .5f / static_cast<float>((1 << std::min(bits, 16)) - 1);
    if (!is_srgb) return step;
    const float root = std::sqrt(std::clamp(linear, 0.f, 1.f));
    return step * kSrgbSlopes[static_cast<std::size_t>(root * 256)];
}

}  // namespace pbrbake::texture

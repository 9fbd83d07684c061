#pragma once
// A set's maps between its files and its packing: what surfaces reflect, texel by texel, linear and in float.

#include <optional>
#include <vector>

#include "bakers/texture/texture.hpp"
#include "pbr/legacy/energy.hpp"
#include "pbr/legacy/specular_gloss.hpp"

namespace pbrbake::texture {

using Colour = pbr::Vec3<float>;

/// One texel as its legacy model has it.
struct LegacyTexel {
    pbr::Reflected<float> reflected;  ///< diffuse albedo, and f0 that keeps the lobe's energy
    Colour
        specular_albedo;  ///< of the legacy lobe, the cosine-weighted mean over views; not of specular_gloss
    float perceptual_roughness = 0;
    bool f0_clamped = false;  ///< the PBR lobe can't reflect that much
    pbr::Quantisation<float> quantisation;
};

/// The texels of one level of a converted set.
struct MapLevel {
    int width = 0, height = 0;
    std::vector<Colour> diffuse, f0;
    std::vector<float> metallic, perceptual_roughness;
    std::vector<Colour> normal;             ///< y up; empty without a normal map
    std::vector<float> occlusion, opacity;  ///< empty without a map
    std::size_t texels() const { return static_cast<std::size_t>(width) * height; }
};

/// What was found out about a set, for the record.
struct Findings {
    double specular_scale = 1;  ///< that calibration put on f0
    std::string calibration = "none";
    std::string surface = "any", surface_word;
    std::string alpha = "nothing";
    bool green_down = false;
    double green_correlation = 0;  ///< > 0: y up; in [-1, 1]
    double f0_clamped = 0, over_unity = 0, low_confidence = 0, metallic = 0,
           confidence = 0;  ///< shares and means
};

/// Reads texels of a set at any resolution: maps of other sizes are interpolated bilinearly.
class Sources {
  public:
    Sources(const TextureParams& params, const Inputs& inputs);

    int width() const { return width_; }
    int height() const { return height_; }
    const TextureParams& params() const { return params_; }

    /// The texel of column x, row y, before calibration.
    LegacyTexel texel(int x, int y) const;
    Colour normal(int x, int y) const;  ///< y as stored
    float occlusion(int x, int y) const;
    float opacity(int x, int y) const;
    bool has_normal() const { return normal_.image != nullptr; }
    bool has_occlusion() const { return occlusion_.image != nullptr; }
    bool has_opacity() const { return opacity_.image != nullptr; }
    bool has_gloss() const { return gloss_.image != nullptr; }
    /// Whether the set says what it reflects: a map, or a factor.
    bool has_specular() const {
        return specular_.image || params_.specular_factor != std::vector<double>{1, 1, 1};
    }
    pbr::DiffuseCoupling coupling() const { return coupling_; }
    const std::vector<std::string>& warnings() const { return warnings_; }

  private:
    /// One channel, or three from `channel` on, of a source.
    struct Map {
        const Image* image = nullptr;
        int channel = 0;
        int bits = 0;
        bool is_srgb = false;
    };
    void fetch(const Map& map, int x, int y, float* values, int count) const;
    void choose_gloss();
    void choose_opacity();
    float exponent(float gloss) const;
    float perceptual_roughness(int x, int y, float& exponent) const;
    Map map_of(const std::string& field, int channel) const;

    const TextureParams& params_;
    const Inputs& inputs_;
    int width_ = 1, height_ = 1;  ///< of factors alone
    Map diffuse_, specular_, gloss_, normal_, occlusion_, opacity_;
    pbr::DiffuseCoupling coupling_;
    std::vector<std::string> warnings_;
};

/// Half the linear interval of a code of `bits` (0: float) at a linear value.
float half_step(float linear, int bits, bool is_srgb);

}  // namespace pbrbake::texture

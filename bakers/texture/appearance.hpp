#pragma once
// A set as shaders read it, texel by texel: as its files have it, as it was calibrated, and as it was stored.

#include <optional>

#include "bakers/texture/calibrate.hpp"
#include "bakers/texture/pack.hpp"
#include "pbr/legacy/phong.hpp"

namespace pbrbake::texture {

/// A Phong lobe, by the mean albedo that it has whatever its norm.
struct PhongTerm {
    pbr::PhongLobe lobe;
    double exponent;  ///< may be +Inf
    Colour mean_albedo;
};

/// What a shader makes of a texel: Lambert's diffuse beside one lobe.
struct Appearance {
    Colour diffuse;
    Colour f0;                       ///< of GGX
    float f90;                       ///< of GGX, in every channel
    float perceptual_roughness;      ///< of GGX
    std::optional<PhongTerm> phong;  ///< in place of GGX
};

/// What a bake changed of a texel under an even white sky, as certificates count it.
struct Change {
    double delta_e;  ///< CIE 1976
    double energy;   ///< relative, > 0 where more is returned; 0 of black
};

/// A set before its bake and after. `inputs` must outlive it.
class BeforeAndAfter {
  public:
    /// `images` are the product's as read back, of which those of the packing are used, in its order; `set`
    /// is the record's, which holds the material where there are no images. Looks at all texels where the job
    /// asks for a calibration.
    BeforeAndAfter(const TextureParams& params, const Inputs& inputs, std::vector<Image> images, double scale,
                   const Json& set, Context& context);

    int width() const { return sources_.width(); }
    int height() const { return sources_.height(); }
    const TextureParams& params() const { return sources_.params(); }  ///< as the set's rules leave them
    bool is_calibrated() const { return calibration_.kind != Calibration::Kind::none; }

    Appearance as_read(int x, int y) const;
    Appearance calibrated(int x, int y) const;
    Appearance stored(int x, int y) const;
    /// From calibrated to stored.
    Change change(int x, int y) const;

  private:
    Appearance of_source(const pbr::Reflected<float>& reflected, float perceptual_roughness) const;
    Unpacked unpacked(int x, int y) const;

    Sources sources_;
    Calibration calibration_;
    Layout layout_;
    std::vector<Image> images_;
    double scale_;
    Json set_;
};

}  // namespace pbrbake::texture

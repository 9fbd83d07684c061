#pragma once
// How far a PBR texel is from the legacy one: what both lobes reflect, and how that looks.

#include "bakers/texture/calibrate.hpp"
#include "bakers/texture/maps.hpp"

namespace pbrbake::texture {

/// What a surface returns of an even white sky, a colour: diffuse, and the specular lobe's mean albedo.
struct Albedo {
    Colour diffuse, specular;
    Colour total() const { return diffuse + specular; }
};

/// Of a GGX lobe with a grazing reflectance of f90 in every channel: its mean albedo per channel.
Albedo pbr_albedo(const pbr::Reflected<float>& reflected, float f90, float perceptual_roughness,
                  pbr::Scattering scattering);

/// Grazing reflectance of a set's texel of that f0. The lobe that stands for Phong's has Frostbite's f90,
/// which lets it be dim; the other models are glTF's, and have 1.
float source_f90(const Sources& sources, const Colour& f0);

/// Of a texel of the set whose reflected light is as calibrated. A Phong lobe's specular albedo comes from
/// its closed form, not from the f0 that was solved for it; a calibrated one's from that f0.
Albedo source_albedo(const Sources& sources, const Calibration& calibration, const LegacyTexel& calibrated);

pbr::Scattering scattering_of(const TextureParams& params);

/// CIE 1976 colour difference of two linear Rec. 709 colours under D65, 0 to about 100; 1 is just seen.
double delta_e(const Colour& a, const Colour& b);

}  // namespace pbrbake::texture

#pragma once
// The f0 with which a GGX lobe reflects as much as a legacy lobe did: energy kept in the cosine-weighted mean
// over views, which is what a surface returns under an even sky.
//
// The PBR lobe meant here is GGX with correlated Smith, Schlick's Fresnel with Frostbite's f90 =
// min(1, 50 * .33 * 3 f0) (f90_from_f0 of grey), and, where asked, Kulla-Conty's lobe for what bounces
// between facets. Without Frostbite's f90 a lobe never reflects less than 1/21, which dim legacy lobes do.

#include <cstddef>
#include <cstdint>

#include "pbr/numerics/vector.hpp"

namespace pbr {

/// Cosine-weighted means of DirectionalAlbedo over the hemisphere, 2 integral E mu dmu and the same of Fc.
struct MeanAlbedo {
    double E;
    double Fc;
};

/// Both means at a perceptual roughness in [0, 1]: 1 and 1/21 at 0, .4091 and .0028 at 1. Polynomials of
/// degree 10 through the quadrature of dfg_ggx. Absolute error below 5e-6.
MeanAlbedo mean_albedo_ggx(double perceptual_roughness);

/// Whether the renderer gives back what single scattering loses (pbr/brdf/multiscatter.hpp).
enum class Scattering { single, multiple };

/// Mean albedo of the grey lobe, f0 (E - Fc) + f90 Fc, and with multiple scattering F_avg^2 E (1 - E) / (1 -
/// F_avg (1 - E)) besides (Kulla & Conty 2017). f0 in [0, 1]: 0 at 0, rising; at 1, E alone or 1. Absolute
/// error below 1e-5.
double mean_specular_albedo(double f0, const MeanAlbedo& lobe, Scattering scattering);

/// The same of a lobe that reflects f90 in [0, 1] at grazing incidence: at f0 = 0 and f90 = 1 still Fc, and
/// what bounces.
double mean_specular_albedo(double f0, double f90, const MeanAlbedo& lobe, Scattering scattering);

/// An f0 that was solved for.
struct SolvedF0 {
    double f0;
    bool clamped;  ///< the lobe can't reflect that much: f0 is 1
};

/// The f0 in [0, 1] of mean_specular_albedo. mean_albedo <= 0 and NaN give 0. Closed form (a quadratic on
/// either side of the f0 where f90 reaches 1). mean_specular_albedo of it is within 1e-6 relative of
/// mean_albedo, unless clamped.
SolvedF0 f0_from_mean_albedo(double mean_albedo, const MeanAlbedo& lobe, Scattering scattering);

/// What the f0 of a coloured lobe, solved as a grey one's, is multiplied by so that the mean of its channels'
/// albedos is `mean_albedo`, at most 1: between facets a saturated lobe gets brighter than a grey one. f90 is
/// Frostbite's of the colour. f0 >= 0; channels above 1 count as 1, and what can't be reached then is left.
/// Relative error of the albedo below 1e-3.
double coloured_f0_scale(const Vec3<double>& f0, double mean_albedo, const MeanAlbedo& lobe,
                         Scattering scattering);

/// The same of `count` lobes, each with its mean albedo and perceptual roughness, in float: bit for bit, on
/// every CPU, what f0_from_mean_albedo of mean_albedo_ggx gives. clamped is 0 or 1. Outputs may not overlap
/// inputs.
void f0_from_mean_albedo(const float* mean_albedo, const float* perceptual_roughness, Scattering scattering,
                         std::size_t count, float* f0, std::uint8_t* clamped);

}  // namespace pbr

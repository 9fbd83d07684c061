#pragma once
// Before and after: spheres with a texture set as its renderer had it and as it was stored, and maps of what
// changed.

#include "bakers/context.hpp"
#include "bakers/texture/appearance.hpp"
#include "bakers/verify/flip.hpp"
#include "bakers/verify/picture.hpp"

namespace pbrbake::verify {

/// A set on spheres under the built-in room, luminance in cd/m², black beyond the rim. All are the same sum
/// over the texels of 64 x 32 of the room, so that lobes alone tell them apart; those narrower than an alpha
/// of .06, which such lights can't show, are widened to it at the same albedo. Normal maps are left out. A
/// point takes the nearest texel; the set goes twice around.
struct SetSpheres {
    LinearPicture as_read;     ///< Lambert and a Phong lobe or GGX, as the files have it
    LinearPicture calibrated;  ///< 0 x 0 of a set that was taken at its word
    LinearPicture stored;      ///< Lambert and GGX, with multiple scattering unless the bake left it out

    /// What `stored` is to look like.
    const LinearPicture& aim() const { return calibrated.rgb.empty() ? as_read : calibrated; }
};
SetSpheres set_spheres(const texture::BeforeAndAfter& set, int size, Context& context);

/// A sphere as the room's camera exposes it: 1 saturates the sensor.
LinearPicture as_seen(LinearPicture sphere);
/// |a - b| in luminance over b's mean luminance, in false colour from .1 % (dark) to 100 %, logarithmic.
Picture sphere_difference(const LinearPicture& a, const LinearPicture& b);
/// Mean LDR-FLIP of both as_seen().
double sphere_flip(const LinearPicture& a, const LinearPicture& b);

/// Maps of texture::Change, `most` pixels at the longer side, each the largest of up to four texels.
struct ChangeMaps {
    Picture delta_e;  ///< in false colour from .1 (dark) to 10, logarithmic
    Picture energy;   ///< dark below .1 %; towards blue what is lost, towards orange what is gained, to 100 %
};
ChangeMaps change_maps(const texture::BeforeAndAfter& set, int most, Context& context);

}  // namespace pbrbake::verify

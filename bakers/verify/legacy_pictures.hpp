#pragma once
// Before and after: a sphere with a legacy texture set as its renderer had it beside what it became.

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/baker.hpp"
#include "bakers/verify/flip.hpp"
#include "bakers/verify/legacy_sets.hpp"
#include "bakers/verify/picture.hpp"

namespace pbrbake::verify {

/// Spheres under the built-in room, by the same sum over the texels of 64 x 32 of it: lobes alone tell them
/// apart. Luminance in cd/m², black beyond the rim.
///
/// The legacy one: Lambert's diffuse, and a Blinn-Phong lobe that is normalised at normal view, or GGX, of
/// the map's 8-bit codes.
LinearPicture legacy_sphere(const LegacySet& set, int size);
/// The converted one: Lambert's diffuse and GGX, scattered once, of the files of a bake with packing
/// `separate`; empty if they are of another packing.
LinearPicture converted_sphere(const std::vector<std::filesystem::path>& files, int size);

/// A sphere as the room's camera exposes it: 1 saturates the sensor.
LinearPicture as_seen(LinearPicture sphere);
/// |a - b| in luminance over b's mean luminance, in false colour from .1 % (dark) to 100 %, logarithmic.
Picture sphere_difference(const LinearPicture& a, const LinearPicture& b);
/// Mean LDR-FLIP of both as_seen().
double sphere_flip(const LinearPicture& a, const LinearPicture& b);

}  // namespace pbrbake::verify

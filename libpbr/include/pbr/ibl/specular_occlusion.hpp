#pragma once
// How much of a probe's reflection baked or screen-space ambient occlusion takes away.

#include <algorithm>
#include <cmath>

namespace pbr {

/// Frostbite's specular occlusion, sat((NoV + AO)^(2^(-16 alpha - 1)) - 1 + AO), which multiplies the
/// specular split sum (Lagarde & de Rousiers 2014, 4.10.2, listing 26, whose `roughness` is alpha). NoV,
/// alpha in [0, 1]; ambient_visibility, AO, in [0, 1] is the share of the cosine-weighted hemisphere that is
/// open. In [0, 1], rising with NoV and AO; 1 at AO 1 and 0 at AO 0 whatever the rest, AO itself for alpha 1
/// within 1e-5 where NoV + AO >= .3. An artist's fit without a derivation: against GGX under a sky that is
/// open in a cone about the normal of that AO it is off by up to .55 of the lobe (.78 for .24 at alpha .1,
/// NoV .1, AO .8). T is float or double; absolute error below 8 ulp of 1.
template <class T>
T specular_occlusion_frostbite(T NoV, T ambient_visibility, T alpha) {
    const T open = std::pow(NoV + ambient_visibility, std::exp2(T(-16) * alpha - T(1)));
    return std::clamp(open - T(1) + ambient_visibility, T(0), T(1));
}

}  // namespace pbr

#pragma once
// Lambert's diffuse reflection. T is float or double.

#include <numbers>

namespace pbr {

/// The BRDF of a white Lambertian surface, 1/pi, 1/sr (multiply by the diffuse colour). Its albedo is 1 from
/// every direction. Exact to one rounding.
template <class T>
constexpr T f_lambert() {
    return std::numbers::inv_pi_v<T>;
}

}  // namespace pbr

#pragma once
// Photometric quantities as types: a number of lumens cannot be taken for one of candela. T is float or
// double.
//
// A quantity is one T and costs what a T costs. It is made explicitly, Lumens<double>(1000), and gives its
// number back explicitly, value(). Quantities of one unit add, scale and have a ratio; going from one unit to
// another takes a function that says by which shape (light/unit_conversions.hpp) or which spectrum
// (light/luminous_efficacy.hpp). Frostbite's one frame of reference for all lights is this (Lagarde & de
// Rousiers 2014, "Moving Frostbite to physically based rendering", 4.3).

#include <compare>

namespace pbr {

/// A number of T in a unit. Unit is a tag: nothing of it is stored.
template <class T, class Unit>
class Quantity {
  public:
    /// Zero.
    constexpr Quantity() = default;

    /// `value` units.
    constexpr explicit Quantity(T value) : value_(value) {}

    /// The number of units.
    constexpr T value() const { return value_; }

    /// Sum and difference; one rounding.
    friend constexpr Quantity operator+(Quantity a, Quantity b) { return Quantity(a.value_ + b.value_); }
    friend constexpr Quantity operator-(Quantity a, Quantity b) { return Quantity(a.value_ - b.value_); }
    friend constexpr Quantity operator-(Quantity a) { return Quantity(-a.value_); }

    /// Adds to or takes from this quantity.
    constexpr Quantity& operator+=(Quantity other) { return *this = *this + other; }
    constexpr Quantity& operator-=(Quantity other) { return *this = *this - other; }

    /// The quantity `factor` times, or divided by `divisor`; one rounding.
    friend constexpr Quantity operator*(Quantity a, T factor) { return Quantity(a.value_ * factor); }
    friend constexpr Quantity operator*(T factor, Quantity a) { return Quantity(factor * a.value_); }
    friend constexpr Quantity operator/(Quantity a, T divisor) { return Quantity(a.value_ / divisor); }

    /// How many times b goes into a: a plain number. b = 0 gives what T's division gives.
    friend constexpr T operator/(Quantity a, Quantity b) { return a.value_ / b.value_; }

    /// Order and equality of the numbers; NaN is unordered.
    friend constexpr auto operator<=>(const Quantity&, const Quantity&) = default;

  private:
    T value_{};
};

namespace unit {
struct Lumen;
struct Candela;
struct Nit;
struct Lux;
struct Stop;
struct Steradian;
struct Watt;
struct LumenPerWatt;
}  // namespace unit

/// Luminous power: all the light that a source emits, lm. What lamps are sold by.
template <class T>
using Lumens = Quantity<T, unit::Lumen>;

/// Luminous intensity: power a solid angle, cd = lm/sr. Point and spot lights.
template <class T>
using Candelas = Quantity<T, unit::Candela>;

/// Luminance: intensity a projected area, nit = cd/m^2. Surfaces, skies, pixels.
template <class T>
using Nits = Quantity<T, unit::Nit>;

/// Illuminance: power that arrives a unit of area, lx = lm/m^2. Also luminous exitance, power that leaves it.
template <class T>
using Lux = Quantity<T, unit::Lux>;

/// A difference of exposure values; +1 is twice the light.
template <class T>
using Stops = Quantity<T, unit::Stop>;

/// Solid angle, sr.
template <class T>
using Steradians = Quantity<T, unit::Steradian>;

/// Radiant power, W.
template <class T>
using Watts = Quantity<T, unit::Watt>;

/// Luminous efficacy, lm/W.
template <class T>
using LumensPerWatt = Quantity<T, unit::LumenPerWatt>;

/// Exposure value at ISO 100: a logarithm to base 2, so that it is a place on a scale and not an amount.
/// Stops move it, two of them are stops apart, and it has neither sum nor multiple. -Inf stands for no light.
template <class T>
class Ev100 {
  public:
    /// EV 0: f/1, 1 s.
    constexpr Ev100() = default;

    /// EV `value` at ISO 100.
    constexpr explicit Ev100(T value) : value_(value) {}

    /// The number of the exposure value.
    constexpr T value() const { return value_; }

    /// The exposure value some stops up or down; one rounding.
    friend constexpr Ev100 operator+(Ev100 a, Stops<T> b) { return Ev100(a.value_ + b.value()); }
    friend constexpr Ev100 operator-(Ev100 a, Stops<T> b) { return Ev100(a.value_ - b.value()); }

    /// How many stops a lies above b. NaN if both are -Inf.
    friend constexpr Stops<T> operator-(Ev100 a, Ev100 b) { return Stops<T>(a.value_ - b.value_); }

    /// Order and equality of the numbers; NaN is unordered.
    friend constexpr auto operator<=>(const Ev100&, const Ev100&) = default;

  private:
    T value_{};
};

}  // namespace pbr

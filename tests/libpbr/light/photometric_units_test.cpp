#include "pbr/light/photometric_units.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <type_traits>

namespace pbr {
namespace {

template <class A, class B>
concept Addable = requires(A a, B b) {
    a + b;
};
template <class A, class B>
concept Subtractable = requires(A a, B b) {
    a - b;
};
template <class A, class B>
concept Multipliable = requires(A a, B b) {
    a* b;
};
template <class A, class B>
concept Divisible = requires(A a, B b) {
    a / b;
};
template <class A, class B>
concept Comparable = requires(A a, B b) {
    a < b;
};

template <class Q, class T>
constexpr bool costs_nothing() {
    return sizeof(Q) == sizeof(T) && alignof(Q) == alignof(T) && std::is_trivially_copyable_v<Q> &&
           std::is_standard_layout_v<Q>;
}

TEST(PhotometricUnits, CostWhatTheirNumberCosts) {
    static_assert(costs_nothing<Lumens<float>, float>() && costs_nothing<Lumens<double>, double>());
    static_assert(costs_nothing<Nits<float>, float>() && costs_nothing<Candelas<double>, double>());
    static_assert(costs_nothing<Ev100<float>, float>() && costs_nothing<Ev100<double>, double>());
}

TEST(PhotometricUnits, AreMadeAndReadExplicitly) {
    static_assert(!std::is_convertible_v<double, Lumens<double>> &&
                  std::is_constructible_v<Lumens<double>, double>);
    static_assert(!std::is_convertible_v<Lumens<double>, double> &&
                  !std::is_constructible_v<double, Lumens<double>>);
    static_assert(!std::is_convertible_v<double, Ev100<double>> &&
                  std::is_constructible_v<Ev100<double>, double>);
    static_assert(!std::is_constructible_v<Lumens<double>, Candelas<double>>);
    static_assert(!std::is_constructible_v<Nits<double>, Ev100<double>>);
}

TEST(PhotometricUnits, AddScaleAndHaveARatioWithinOneUnitOnly) {
    using Lm = Lumens<double>;
    static_assert(Addable<Lm, Lm> && Subtractable<Lm, Lm> && Multipliable<Lm, double> &&
                  Multipliable<double, Lm> && Divisible<Lm, double> && Divisible<Lm, Lm> &&
                  Comparable<Lm, Lm>);
    static_assert(!Addable<Lm, Candelas<double>> && !Addable<Lm, double> && !Subtractable<Lm, Nits<double>> &&
                  !Multipliable<Lm, Lm> && !Multipliable<Lm, Steradians<double>> && !Divisible<double, Lm> &&
                  !Divisible<Lm, Candelas<double>> && !Comparable<Lm, Lux<double>>);
    static_assert(std::is_same_v<decltype(Lm(1) / Lm(2)), double>);

    constexpr Lm lamp(800), two = lamp + lamp;
    static_assert(two == 2 * lamp && two / lamp == 2 && two - lamp == lamp && two / 4 == Lm(400) &&
                  lamp < two);
    static_assert((-lamp).value() == -800 && Lm().value() == 0);
    Lm sum;
    sum += lamp;
    sum += lamp;
    sum -= Lm(100);
    EXPECT_EQ(sum.value(), 1500);
}

TEST(PhotometricUnits, ExposureValuesArePlacesAndStopsAreWays) {
    using Ev = Ev100<double>;
    static_assert(!Addable<Ev, Ev> && !Multipliable<Ev, double> && !Divisible<Ev, Ev>);
    static_assert(Addable<Ev, Stops<double>> && Subtractable<Ev, Stops<double>> && Subtractable<Ev, Ev>);
    static_assert(std::is_same_v<decltype(Ev(1) - Ev(2)), Stops<double>>);
    static_assert(std::is_same_v<decltype(Ev(1) - Stops<double>(2)), Ev>);
    static_assert(Ev(15) - Ev(12) == Stops<double>(3) && Ev(15) - Stops<double>(3) == Ev(12));
    static_assert(Ev(15) < Ev(15.5) && Ev() == Ev(0));
    constexpr double kInf = std::numeric_limits<double>::infinity();
    EXPECT_LT(Ev(-kInf), Ev(-100));
    EXPECT_EQ(Ev(-kInf) + Stops<double>(5), Ev(-kInf));
}

}  // namespace
}  // namespace pbr

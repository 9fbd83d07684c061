#include "pbr/ibl/mip_mapping.hpp"

#include <gtest/gtest.h>

#include "tests/libpbr/support/property.hpp"

namespace pbr {
namespace {

template <class T>
struct Mapping {
    const char* name;
    T (*level)(T, T);
    T (*inverse)(T, T);
    T tolerance;
};

template <class T>
constexpr T kRoot = T(4) *
                    (sizeof(T) == 4 ? T(1e-4) : T(5e-9));  // the stated error where Filament's slope vanishes

template <class T>
const Mapping<T> kMappings[] = {
    {"frostbite", level_frostbite<T>, perceptual_roughness_frostbite<T>,
     T(8) * std::numeric_limits<T>::epsilon()},
    {"filament", level_filament<T>, perceptual_roughness_filament<T>, kRoot<T>},
    {"unity", level_unity<T>, perceptual_roughness_unity<T>, T(8) * std::numeric_limits<T>::epsilon()},
};

template <class T>
void round_trips(double roughness, double top) {
    const T p = static_cast<T>(roughness), top_level = static_cast<T>(top);
    for (const Mapping<T>& mapping : kMappings<T>) {
        const T level = mapping.level(p, top_level);
        RC_ASSERT(level >= 0);
        RC_ASSERT(level <= top_level * (1 + 2 * std::numeric_limits<T>::epsilon()));
        RC_ASSERT(std::abs(mapping.inverse(level, top_level) - p) <= mapping.tolerance);
        if (p < T(0.9))
            RC_ASSERT(std::abs(mapping.inverse(level, top_level) - p) <=
                      16 * std::numeric_limits<T>::epsilon());
    }
}

RC_GTEST_PROP(MipMapping, RoundTrips, ()) {
    const double p = *unit_interval(), top = *rc::gen::element(1.0, 4.0, 6.0, 8.0);
    round_trips<double>(p, top);
    round_trips<float>(p, top);
}

TEST(MipMapping, HasItsEndsExactly) {
    for (const Mapping<double>& mapping : kMappings<double>) {
        EXPECT_EQ(mapping.level(0, 6), 0) << mapping.name;
        EXPECT_NEAR(mapping.level(1, 6), 6, 1e-15) << mapping.name;
        EXPECT_EQ(mapping.inverse(0, 6), 0) << mapping.name;
        EXPECT_NEAR(mapping.inverse(6, 6), 1, 3e-8) << mapping.name;
        for (int i = 0; i < 100; ++i)
            EXPECT_LT(mapping.level(i / 100.0, 6), mapping.level((i + 1) / 100.0, 6));
    }
}

TEST(MipMapping, InversesAreThoseThatEnginesPrint) {
    for (int i = 0; i <= 60; ++i) {
        const double level = i / 10.0, x = level / 6;
        EXPECT_NEAR(perceptual_roughness_unity(level, 6.0),
                    1.7 / 1.4 - std::sqrt(2.89 / 1.96 - 2.8 / 1.96 * x), 1e-14);
        EXPECT_NEAR(perceptual_roughness_filament(level, 6.0), (std::sqrt(4 - 4 * x) - 2) / -2, 1e-14);
    }
}

TEST(MipMapping, UnrealCountsFromTheCoarseEnd) {
    EXPECT_EQ(level_unreal(1.0, 7.0), 5);             // 4x4 texels of a 128 cube
    EXPECT_EQ(level_unreal(1.0, 10.0), 8);            // and of a 1024 cube
    EXPECT_NEAR(level_unreal(0.5, 7.0), 3.8, 1e-15);  // 7 - 1 - (1 - 1.2 log2(1/2))
    EXPECT_EQ(level_unreal(0.0, 7.0), 0);
    EXPECT_EQ(level_unreal(0.01, 7.0), 0);
    EXPECT_NEAR(perceptual_roughness_unreal(0.0, 7.0), .0557, 5e-5);
}

RC_GTEST_PROP(MipMapping, UnrealRoundTripsAboveTheClamp, ()) {
    const double p = *uniform(.06, 1), max_mip = 7;
    RC_ASSERT(std::abs(perceptual_roughness_unreal(level_unreal(p, max_mip), max_mip) - p) < 1e-14);
    const float single = static_cast<float>(p);
    RC_ASSERT(std::abs(perceptual_roughness_unreal(level_unreal(single, 7.f), 7.f) - single) < 2e-6f);
}

}  // namespace
}  // namespace pbr

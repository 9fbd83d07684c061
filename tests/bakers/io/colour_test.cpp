// Colour conversion against matrices and curves made here from the standards' numbers.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bakers/io/display.hpp"
#include "bakers/io/matrix3.hpp"
#include "tests/bakers/io/fixtures.hpp"

namespace pbrbake::io::test {
namespace {

/// ITU-R BT.709-6 linear RGB to ACEScg by Bradford, as the ACES project publishes it to ten digits
/// (aces-dev, "Rec709 to ACEScg").
constexpr Matrix3 kRec709ToAp1{{{.6130974024, .3395231462, .0473794514},
                                {.0701937225, .9163538791, .0134523985},
                                {.0206155929, .1095697729, .8698146342}}};

class Colour : public testing::Test {
  protected:
    /// One texel of an EXR in float, read as `space` into `working`.
    Vector3 convert(const Vector3& rgb, const std::string& space, const std::string& working,
                    std::vector<double> chromaticities = {}) {
        write_exr(dir_ / "a.exr", {.width = 1,
                                   .height = 1,
                                   .type = "float",
                                   .chromaticities = std::move(chromaticities),
                                   .value = [&](const std::string& name, int, int) {
                                       return static_cast<float>(rgb[name == "R" ? 0 : name == "G" ? 1 : 2]);
                                   }});
        const SourceImage source = read_source({dir_ / "a.exr", space, working});
        const float* texel = source.image.texel(0, 0, 0, 0);
        return {texel[0], texel[1], texel[2]};
    }
    TempDir dir_;
};

void expect_near(const Vector3& actual, const Vector3& expected, double tolerance) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(actual[c], expected[c], tolerance) << "channel " << c;
}

double srgb_to_linear(double v) { return v <= .04045 ? v / 12.92 : std::pow((v + .055) / 1.055, 2.4); }

TEST_F(Colour, SrgbIsExactToAMillionth) {
    std::vector<float> samples;
    for (int i = 0; i <= 3000; ++i) samples.push_back(static_cast<float>(i) / 3000.f);
    samples.resize(3003);
    write_file(dir_ / "a.tif", tiff(1001, 1, 4, float_samples(samples)));
    const SourceImage source = read_source({dir_ / "a.tif", "srgb"});
    for (std::size_t i = 0; i <= 3000; ++i)
        EXPECT_NEAR(source.image.levels[0].texels[i], srgb_to_linear(static_cast<double>(samples[i])), 1e-6)
            << i;
}

TEST_F(Colour, Rec709ToAcescgIsTheAcademysMatrix) {
    for (const Vector3& rgb : {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}, Vector3{.2, .5, .9}})
        expect_near(convert(rgb, "lin_rec709", "acescg"), kRec709ToAp1 * rgb, 2e-6);
}

TEST_F(Colour, AcescgSurvivesTheWayToRec709AndBack) {
    const Vector3 rgb{.25, .5, .125};
    const Vector3 back = convert(convert(rgb, "acescg", "lin_rec709"), "lin_rec709", "acescg");
    expect_near(back, rgb, 1e-6);
    expect_near(convert(rgb, "acescg", "lin_rec709"), inverse(kRec709ToAp1) * rgb, 2e-6);
}

TEST_F(Colour, EveryGamutKeepsWhiteAndAgreesWithItsPrimaries) {
    const std::vector<std::pair<std::string, Chromaticities>> gamuts{{"lin_rec2020", kRec2020},
                                                                     {"lin_p3d65", kP3D65},
                                                                     {"lin_adobergb", kAdobeRgb},
                                                                     {"aces2065_1", kAp0},
                                                                     {"acescg", kAp1}};
    for (const auto& [name, primaries] : gamuts) {
        SCOPED_TRACE(name);
        expect_near(convert({1, 1, 1}, name, "lin_rec709"), {1, 1, 1}, 1e-5);
        const Matrix3 matrix =
            inverse(rgb_to_xyz(kRec709)) * bradford(primaries.white, kD65) * rgb_to_xyz(primaries);
        const Vector3 rgb{.4, .5, .45};  // inside Rec. 709: nothing is clipped
        expect_near(convert(rgb, name, "lin_rec709"), matrix * rgb, 1e-5);
    }
}

TEST_F(Colour, StatedPrimariesAreConvertedAndAdapted) {
    const Chromaticities c{{.6, .35}, {.31, .59}, {.15, .07}, {.3457, .3585}};  // white D50
    const Vector3 rgb{.4, .5, .45};
    const Matrix3 matrix = inverse(rgb_to_xyz(kRec709)) * bradford(c.white, kD65) * rgb_to_xyz(c);
    expect_near(convert(rgb, "auto", "lin_rec709", {.6, .35, .31, .59, .15, .07, .3457, .3585}), matrix * rgb,
                1e-5);
    // A colour space that the job states wins.
    expect_near(convert(rgb, "lin_rec709", "lin_rec709", {.6, .35, .31, .59, .15, .07, .3457, .3585}), rgb,
                1e-7);
}

TEST_F(Colour, PowerCurves) {
    expect_near(convert({.5, .25, 1}, "g22_rec709", "lin_rec709"), {std::pow(.5, 2.2), std::pow(.25, 2.2), 1},
                1e-6);
    expect_near(convert({.5, .25, 1}, "g18_rec709", "lin_rec709"), {std::pow(.5, 1.8), std::pow(.25, 1.8), 1},
                1e-6);
}

TEST_F(Colour, RawAndEqualSpacesKeepEveryBit) {
    const Vector3 rgb{.1f, 1e-30f, 3e38f};
    EXPECT_EQ(convert(rgb, "raw", "acescg"), rgb);
    EXPECT_EQ(convert(rgb, "lin_rec709", "lin_rec709"), rgb);
    EXPECT_EQ(convert(rgb, "acescg", "acescg"), rgb);
}

/// ACES 1's SDR transform of a neutral as Hill fitted it (S. Hill, BakingLab, ACES.hlsl), sRGB-encoded.
double hills_fit(double neutral) {
    const double v =
        (neutral * (neutral + .0245786) - .000090537) / (neutral * (.983729 * neutral + .432951) + .238081);
    return v <= .0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - .055;
}

TEST(Display, IsAcesToItsFit) {
    float before = -1;
    for (const float neutral : {0.f, .01f, .05f, .18f, .5f, 1.f, 4.f, 1e4f}) {
        std::array<float, 3> rgb{neutral, neutral, neutral};
        to_display("lin_rec709", rgb);
        EXPECT_NEAR(rgb[0], std::clamp(hills_fit(neutral), 0., 1.), .03) << neutral;
        EXPECT_NEAR(rgb[1], rgb[0], 2e-3) << neutral;  // neutrals stay neutral
        EXPECT_NEAR(rgb[2], rgb[0], 2e-3) << neutral;
        EXPECT_GE(rgb[0], before);
        before = rgb[0];
    }
    std::array<float, 3> red{1, 0, 0};
    to_display("lin_rec709", red);
    EXPECT_GT(red[0], 4 * red[2]);
    EXPECT_THROW(to_display("cmyk", red), Error);
}

TEST(ColourSpaces, AutoIsFirstAndEveryNameCanBeRead) {
    TempDir dir;
    ASSERT_EQ(colour_spaces().front(), "auto");
    write_exr(dir / "a.exr", {});
    for (const std::string& name : colour_spaces())
        for (const char* working : {"lin_rec709", "acescg"})
            EXPECT_NO_THROW(read_source({dir / "a.exr", name, working})) << name << " to " << working;
}

}  // namespace
}  // namespace pbrbake::io::test

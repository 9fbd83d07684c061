// Mistakes planted in copies of real products: compare finds each with its default thresholds, and names it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "bakers/verify/compare.hpp"
#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/zonal_harmonics.hpp"
#include "pbr/ibl/zonal_kernel.hpp"
#include "tests/bakers/verify/baked_folder.hpp"

namespace pbrbake::verify {
namespace {

using pbrbake::test::baked_folder;
using pbrbake::test::Change;
using pbrbake::test::each_texel;
using pbrbake::test::each_value;
using pbrbake::test::TemporaryFolder;
using pbrbake::test::write_changed;
using testing::HasSubstr;
using testing::StartsWith;

const char* const kTable = "table.exr";
const char* const kProbe = "room.ktx2";

Thresholds defaults() { return read_thresholds({}, {}); }

/// The comparison of a changed copy with the product.
ProductComparison changed(const char* name, const Change& change) {
    const TemporaryFolder folder;
    write_changed(baked_folder() / name, folder / name, change);
    const Comparison comparison = compare(folder / name, baked_folder() / name, defaults());
    EXPECT_EQ(comparison.products.size(), 1u);
    EXPECT_EQ(comparison.code == ExitCode::done, comparison.products.front().passed());
    return comparison.products.front();
}

std::string verdict(const char* name, const Change& change) {
    const std::string line = verdict_line(changed(name, change));
    EXPECT_EQ(std::ranges::count(line, '\n'), 0);
    return line;
}

/// Copies the texel at (face, x, y) of the old image, coordinates clamped to the face.
Change copied_from(const std::function<void(int& face, int& y, int& x, int n)>& place) {
    return each_texel([place](const Image& old, int level, int face, int y, int x, float* texel) {
        place(face, y, x, old.levels[static_cast<std::size_t>(level)].width);
        std::copy_n(old.texel(level, face, y, x), old.channels.size(), texel);
    });
}

Change shifted_by_half() {
    return each_texel([](const Image& old, int level, int face, int y, int x, float* texel) {
        const int n = old.levels[static_cast<std::size_t>(level)].width;
        for (std::size_t c = 0; c < old.channels.size(); ++c)
            texel[c] = 0.5f * (old.texel(level, face, y, x)[c] +
                               old.texel(level, face, y, std::min(x + 1, n - 1))[c]);
    });
}

TEST(PlantedChange, OfNothingPasses) {
    for (const char* name : {kTable, kProbe}) {
        const ProductComparison same = changed(name, [](Image&) {});
        EXPECT_TRUE(same.passed()) << verdict_line(same);
        EXPECT_LE(same.verdict, Verdict::within_ulp);
    }
    EXPECT_EQ(compare(baked_folder() / kProbe, baked_folder() / kProbe, defaults()).products[0].verdict,
              Verdict::identical);
}

TEST(PlantedChange, OfOneStepPasses) {
    const Change step = each_texel([](const Image& old, int level, int face, int y, int x, float* texel) {
        for (std::size_t c = 0; c < old.channels.size(); ++c) {
            const float value = old.texel(level, face, y, x)[c];
            // The next half away from zero.
            if ((x + y) % 2 == 0 && value > 1e-4f) texel[c] = value + std::ldexp(1.f, std::ilogb(value) - 10);
        }
    });
    for (const char* name : {kTable, kProbe}) {
        const ProductComparison one = changed(name, step);
        EXPECT_EQ(one.verdict, Verdict::within_ulp) << verdict_line(one);
        EXPECT_THAT(verdict_line(one), HasSubstr("equal within 1 ulp"));
        EXPECT_GT(one.worst.differing, one.worst.values / 4);
    }
}

TEST(PlantedChange, HalfATexelIsNamed) {
    EXPECT_THAT(verdict(kTable, shifted_by_half()), HasSubstr("shifted by -1/2 in u (half a texel)"));
    EXPECT_THAT(verdict(kProbe, shifted_by_half()), HasSubstr("shifted by -1/2 in u (half a texel)"));
}

TEST(PlantedChange, MissingOneOverPiIsNamed) {
    const Change times_pi = each_value([](double v) { return v * std::numbers::pi; });
    for (const char* name : {kTable, kProbe})
        EXPECT_THAT(verdict(name, times_pi), HasSubstr("3.14 times the reference's (pi; a 1/pi is missing)"));
}

TEST(PlantedChange, SwappedFacesAreNamed) {
    EXPECT_THAT(verdict(kProbe, copied_from([](int& face, int&, int&, int) {
                            if (face < 2) face = 1 - face;
                        })),
                HasSubstr("looks like: faces +X and -X are swapped"));
    EXPECT_THAT(verdict(kProbe, copied_from([](int& face, int&, int&, int) {
                            if (face == 2 || face == 4) face = 6 - face;
                        })),
                HasSubstr("looks like: faces +Y and +Z are swapped"));
}

TEST(PlantedChange, FlippedRowsAreNamed) {
    const Change flip = copied_from([](int&, int& y, int&, int n) { y = n - 1 - y; });
    EXPECT_THAT(verdict(kTable, flip), HasSubstr("the picture is flipped in v"));
    EXPECT_THAT(verdict(kProbe, flip), HasSubstr("every face is flipped in v"));
}

TEST(PlantedChange, AMirroredEnvironmentIsNamed) {
    EXPECT_THAT(verdict(kProbe, copied_from([](int& face, int&, int& x, int n) {
                            x = n - 1 - x;
                            if (face < 2) face = 1 - face;
                        })),
                HasSubstr("every face is mirrored in u (columns flipped), and faces +X and -X are swapped"));
}

TEST(PlantedChange, OneTurnedFaceIsNamed) {
    EXPECT_THAT(verdict(kProbe, copied_from([](int& face, int& y, int& x, int n) {
                            if (face != 3) return;
                            x = n - 1 - x;
                            y = n - 1 - y;
                        })),
                HasSubstr("face -Y is turned by 180"));
}

TEST(PlantedChange, ATurnOfTheEnvironmentIsNamedAsABakeHasIt) {
    const auto file = [](int degrees) { return "turned_" + std::to_string(degrees) + ".ktx2"; };
    Json bakes = Json::array();
    for (const int degrees : {0, 3, -40})
        bakes.push_back({{"kind", "probe"},
                         {"name", "turned_" + std::to_string(degrees)},
                         {"source", "builtin:indoor"},
                         {"size", 32},
                         {"levels", 4},
                         {"format", "ktx2"},
                         {"rotate_deg", degrees},
                         {"certify", "none"}});
    const TemporaryFolder folder;
    const job::Job job = job::load(
        folder.write("job.json", Json{{"version", 1}, {"output", "baked"}, {"bakes", bakes}}.dump()));
    ASSERT_EQ(run::run(std::span(&job, 1), {}).code, ExitCode::done);
    const auto line = [&](int degrees) {
        const auto baked = folder / "baked";
        return verdict_line(compare(baked / file(degrees), baked / file(0), defaults()).products.front());
    };
    EXPECT_THAT(line(3), HasSubstr("the environment is turned by 3.0° about its vertical axis"));
    EXPECT_THAT(line(-40), HasSubstr("the environment is turned by -40.0° about its vertical axis"));
}

TEST(PlantedChange, RoughnessSquaredTwiceInATableIsNamed) {
    const auto remapped = [](const std::function<double(double)>& map) {
        return each_texel([map](const Image& old, int level, int face, int y, int x, float* texel) {
            const int rows = old.levels[0].height;
            const double at = map(static_cast<double>(y) / (rows - 1)) * (rows - 1);
            const int row = std::min(static_cast<int>(at), rows - 2);
            for (std::size_t c = 0; c < old.channels.size(); ++c)
                texel[c] = static_cast<float>((1 - (at - row)) * old.texel(level, face, row, x)[c] +
                                              (at - row) * old.texel(level, face, row + 1, x)[c]);
        });
    };
    EXPECT_THAT(verdict(kTable, remapped([](double p) { return p * p; })),
                HasSubstr("squared once too often"));
    EXPECT_THAT(verdict(kTable, remapped([](double p) { return std::sqrt(p); })),
                HasSubstr("is not squared"));
}

/// A probe of an environment of a few zonal harmonics, whose convolution is known exactly.
Image harmonic_probe(const std::function<double(double)>& alpha_of) {
    const glm::dvec3 axes[] = {{0, 0, 1}, {0.6, 0.8, 0}, {0.48, -0.6, 0.64}};
    Image image;
    image.channels = {"R", "G", "B"};
    image.faces = 6;
    for (int level = 0; level < 6; ++level) {
        const int n = 64 >> level;
        image.levels.push_back({n, n, std::vector<float>(static_cast<std::size_t>(n) * n * 18)});
        const double alpha = alpha_of(level / 5.0);
        const std::vector<double> k = pbr::zonal_ggx(pbr::GgxZonalKernel(std::max(alpha, 1e-4)), 9);
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x)
                    for (int c = 0; c < 3; ++c) {
                        const double mu = glm::dot(axes[c], pbr::cubemap_texel_direction({face, x, y}, n));
                        const auto degree = static_cast<unsigned>(2 * c + 2);
                        image.texel(level, face, y, x)[c] = static_cast<float>(
                            2 + k[degree] * std::legendre(degree, mu) + k[8] * std::legendre(8, mu));
                    }
    }
    return image;
}

void write_probe(const std::filesystem::path& file, Image image) {
    std::vector<Image> images{std::move(image)};
    io::quantise(images, PixelType::half);
    const auto bytes = io::encode("ktx2", images.front(), {});
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

TEST(PlantedChange, RoughnessSquaredTwiceInAProbeIsNamed) {
    const TemporaryFolder folder;
    write_probe(folder / "right.ktx2", harmonic_probe([](double p) { return p * p; }));
    write_probe(folder / "wrong.ktx2", harmonic_probe([](double p) { return p * p * p * p; }));
    write_probe(folder / "linear.ktx2", harmonic_probe([](double p) { return p; }));
    const auto line = [&](const char* name) {
        return verdict_line(compare(folder / name, folder / "right.ktx2", defaults()).products.front());
    };
    EXPECT_THAT(line("wrong.ktx2"), HasSubstr("roughness is squared once too often"));
    EXPECT_THAT(line("linear.ktx2"), HasSubstr("roughness is not squared"));
}

TEST(PlantedChange, OneNanFails) {
    for (const char* name : {kTable, kProbe}) {
        const std::string line = verdict(
            name, [](Image& image) { image.texel(0, 0, 3, 5)[1] = std::numeric_limits<float>::quiet_NaN(); });
        EXPECT_THAT(line, StartsWith("FAIL"));
        EXPECT_THAT(line, HasSubstr("1 value is NaN or infinite"));
        EXPECT_THAT(line, HasSubstr("channel G"));
    }
}

TEST(PlantedChange, NanInBothFailsThoughTheBytesAreEqual) {
    const TemporaryFolder folder;
    write_changed(baked_folder() / kProbe, folder / "a.ktx2",
                  [](Image& image) { image.texel(2, 4, 0, 0)[0] = std::numeric_limits<float>::infinity(); });
    const Comparison comparison = compare(folder / "a.ktx2", folder / "a.ktx2", defaults());
    EXPECT_EQ(comparison.code, ExitCode::comparison_failed);
    EXPECT_THAT(verdict_line(comparison.products[0]), HasSubstr("level 2, face +Z, channel R"));
}

TEST(PlantedChange, OneLevelMissingIsNamed) {
    const std::string line = verdict(kProbe, [](Image& image) { image.levels.pop_back(); });
    EXPECT_THAT(line, HasSubstr("has 4 instead of 5 levels: level 4 (4 x 4) is missing"));
    EXPECT_THAT(verdict(kProbe, [](Image& image) { image.levels.erase(image.levels.begin()); }),
                HasSubstr("level 0 (64 x 64) is missing"));
}

TEST(PlantedChange, OnePercentOfEnergyIsNamed) {
    const Change loss = each_value([](double v) { return v * 0.99; });
    for (const char* name : {kTable, kProbe}) {
        const ProductComparison product = changed(name, loss);
        EXPECT_NEAR(product.worst.energy_change, 0.01, 2e-4);  // a half's rounding
        EXPECT_THAT(verdict_line(product), HasSubstr("energy change 0.0"));
        EXPECT_THAT(verdict_line(product),
                    HasSubstr("looks like: values are 0.9900 times the reference's ("));
    }
}

TEST(PlantedChange, OfOneLevelNamesTheLevel) {
    EXPECT_THAT(verdict(kProbe,
                        [](Image& image) {
                            for (float& value : image.levels[2].texels) value *= 0.5f;
                        }),
                HasSubstr("looks like: level 2: values are 0.5 times"));
}

TEST(PlantedChange, OfOneTexelFails) {
    EXPECT_THAT(verdict(kProbe, [](Image& image) { image.texel(0, 2, 30, 31)[2] *= 1.0625f; }),
                HasSubstr("level 0, face +Y, channel B: largest relative error"));
}

TEST(PlantedChange, OfScaleOrContainerIsFormat) {
    const TemporaryFolder folder;
    const io::ReadBack table = io::read_product(baked_folder() / kTable);
    const auto bytes = io::encode("ktx2", table.image, table.info);
    std::ofstream(folder / "table.ktx2", std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    const auto held = [&](const Thresholds& thresholds) {
        return compare(folder / "table.ktx2", baked_folder() / kTable, thresholds).products.front();
    };
    EXPECT_THAT(verdict_line(held(defaults())), HasSubstr("is a ktx2 instead of exr file"));
    Thresholds any = defaults();
    any.any_format = true;
    EXPECT_TRUE(held(any).passed()) << verdict_line(held(any));
}

}  // namespace
}  // namespace pbrbake::verify

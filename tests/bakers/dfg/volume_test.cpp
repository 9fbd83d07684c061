#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "bakers/dfg/dfg.hpp"
#include "bakers/dfg/layout.hpp"
#include "bakers/io/io.hpp"
#include "pbr/brdf/fresnel.hpp"
#include "pbr/ibl/dfg_anisotropic.hpp"

namespace pbrbake::dfg {
namespace {

DfgParams volume(std::vector<int> size) {
    DfgParams params{};
    params.size = std::move(size);
    params.terms = {Term::ggx_anisotropic};
    params.min_perceptual_roughness = 0.05;
    return params;
}

Product bake_table(const DfgParams& params, int threads = 1) {
    Context context(threads, {});
    return bake(params, {}, context);
}

TEST(DfgVolume, TheMiddleSliceIsTheRoundLobe) {
    const DfgParams params = settled(volume({9, 12, 5}));
    const Product product = bake_table(params);
    const Image& image = product.images[0];
    ASSERT_TRUE(image.is_volume);
    ASSERT_EQ(image.faces, 5);
    EXPECT_DOUBLE_EQ(value_of_slice(params, 2), 1);
    for (int y = 0; y < 12; ++y) {
        const double alpha = std::pow(value_of_row(params, y), 2);
        if (alpha > 1) break;
        for (int x = 0; x < 9; ++x) {
            const pbr::DirectionalAlbedo round =
                pbr::dfg_ggx(value_of_column(params, x), alpha, pbr::DfgMethod::quadrature(1e-8));
            EXPECT_NEAR(image.texel(0, 2, y, x)[0], round.E - round.Fc, 1e-6);
            EXPECT_NEAR(image.texel(0, 2, y, x)[1], round.Fc, 1e-6);
        }
    }
}

TEST(DfgVolume, SlicesRunFromAcrossTheViewToAlongItAndLookUpAsTheySay) {
    const DfgParams params = settled(volume({4, 4, 9}));
    EXPECT_NEAR(value_of_slice(params, 0), 10, 1e-12);
    EXPECT_NEAR(value_of_slice(params, 8), 0.1, 1e-12);
    for (int z = 0; z < 9; ++z) EXPECT_NEAR(slice_of_value(params, value_of_slice(params, z)), z, 1e-12);
    for (int y = 0; y < 4; ++y) EXPECT_NEAR(row_of_value(params, value_of_row(params, y)), y, 1e-12);
    EXPECT_NEAR(std::pow(value_of_row(params, 3), 2), std::sqrt(10.0), 1e-12);
    const Product product = bake_table(params);
    const double along = std::pow(value_of_row(params, 2), 2);
    const pbr::DirectionalAlbedo texel =
        pbr::dfg_ggx_anisotropic(value_of_column(params, 1), {}, {along, along * value_of_slice(params, 6)},
                                 pbr::dfg_anisotropic_rule(1e-7));
    EXPECT_NEAR(product.images[0].texel(0, 6, 2, 1)[1], texel.Fc, 1e-6);
    EXPECT_NEAR(product.images[0].texel(0, 6, 2, 1)[0], texel.E - texel.Fc, 1e-6);
    EXPECT_EQ(product.images[0].texel(0, 3, 0, 1)[1],
              static_cast<float>(pbr::schlick_weight(value_of_column(params, 1))));
}

TEST(DfgVolume, SameBytesAtAnyThreadCount) {
    const DfgParams params = volume({11, 7, 5});
    EXPECT_EQ(bake_table(params, 1).images[0].levels[0].texels,
              bake_table(params, 3).images[0].levels[0].texels);
}

TEST(DfgVolume, CertificateStatesTheReductionBesideTheOthers) {
    const DfgParams params = volume({16, 16, 5});
    Context context(1, {});
    const Product product = bake(params, {}, context);
    const Certificate certificate = certify(params, {}, product, context);
    double reduction = 0, half = 0, texels = 1, between = 0;
    for (const Figure& figure : certificate.figures) {
        if (figure.metric == "reduction_error") reduction = figure.value;
        if (figure.metric == "reduction_error_half") half = figure.value;
        if (figure.metric == "max_abs_error") texels = figure.value;
        if (figure.metric == "interpolation_error") between = figure.value;
    }
    EXPECT_LE(texels, 2e-6);
    EXPECT_GT(between, texels);
    EXPECT_GT(reduction, half);
    EXPECT_GT(half, 1e-3);
    EXPECT_LT(reduction, 0.15);
}

TEST(DfgVolume, MistakesAreNamedWhereTheyAre) {
    const auto pointer = [](const DfgParams& params, const std::string& format) {
        const std::vector<Mistake> mistakes = check(params, format);
        return mistakes.size() == 1 ? mistakes[0].pointer : std::to_string(mistakes.size());
    };
    DfgParams params = volume({8, 8, 5});
    EXPECT_TRUE(check(params, "ktx2").empty());
    EXPECT_EQ(pointer(params, "exr"), "/format");
    params.integrator = Integrator::is;
    EXPECT_EQ(pointer(params, "dds"), "/integrator");
    params = volume({4096, 4096, 64});
    EXPECT_EQ(pointer(params, "ktx2"), "/size");
    params = volume({8, 8, 5});
    params.terms = {Term::ggx};
    EXPECT_EQ(pointer(params, "ktx2"), "/size");
    params.terms = {Term::ggx_anisotropic, Term::ggx};
    EXPECT_EQ(pointer(params, "ktx2"), "/terms");
}

TEST(DfgVolume, ContainersGiveItBack) {
    Product product = bake_table(volume({6, 5, 3}));
    io::quantise(product.images, PixelType::half);
    io::FileInfo info;
    info.name = "t";
    for (const std::string format : {"ktx2", "dds"}) {
        const std::vector<std::byte> bytes = io::encode(format, product.images[0], info);
        const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / ("volume." + format);
        std::ofstream(path, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        const io::ReadBack back = io::read_product(path);
        EXPECT_TRUE(back.image.is_volume) << format;
        EXPECT_EQ(back.image.faces, 3) << format;
        EXPECT_EQ(back.image.levels[0].texels, product.images[0].levels[0].texels) << format;
    }
    const std::vector<std::byte> header = io::encode("h", product.images[0], info);
    const std::string text(reinterpret_cast<const char*>(header.data()), header.size());
    EXPECT_NE(text.find("t_depth = 3"), std::string::npos);
    EXPECT_NE(text.find("t_texels[((z * t_height + y) * t_width + x) * t_channels + c]"), std::string::npos);
    EXPECT_THROW(io::encode("exr", product.images[0], info), Error);
}

}  // namespace
}  // namespace pbrbake::dfg

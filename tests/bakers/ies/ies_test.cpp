#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "bakers/parse/grid.hpp"
#include "tests/bakers/ies/fixtures.hpp"

namespace pbrbake::ies::test {
namespace {

using parse::test::read_table;
using parse::test::read_text;
using parse::test::real_files;

/// Asymmetric, with a beam off the axis, light above, and a rim that isn't dark.
const char* const kLamp =
    "IESNA:LM-63-2002\n[TEST] 1\n[LAMP] LED 3000K\nTILT=NONE\n1 900 1 7 5 1 2 -.1 -.1 0 1 1 10\n0 15 30 45 "
    "60 90 120\n0 90 180 270 360\n"
    "100 150 400 120 60 20 10\n100 120 180 90 50 20 5\n100 90 80 60 40 20 8\n100 120 180 90 50 20 5\n100 150 "
    "400 120 60 20 10\n";

const char* const kNarrow =
    "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 9 1 1 2 0 0 0 1 1 5\n0 1.3 2.6 3.9 5.7 8.1 12 20 90\n0\n90000 70000 "
    "30000 9000 2000 300 60 20 0\n";

double exact_flux(const std::string& text) {
    std::vector<parse::Diagnostic> unused;
    return parse::make_web(parse::test::parse(text), 0, unused).flux_lm();
}

constexpr std::array<Projection, 5> kProjections{
    Projection::latlong, Projection::axial, Projection::octahedral, Projection::cube, Projection::cookie};

/// The product's picture after a way through its file.
Image through_file(const Baked& baked, const std::string& format, PixelType pixel) {
    const auto path =
        std::filesystem::temp_directory_path() / ("pbrbake_ies_test_" + std::to_string(::getpid()));
    io::FileInfo info;
    info.pixel = pixel;
    const auto bytes = io::encode(format, baked.product.images[0], info);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    Image image = io::read_product(path).image;
    std::filesystem::remove(path);
    // HDR spreads the one channel to three.
    const std::size_t channels = image.channels.size();
    std::vector<float> first;
    for (std::size_t i = 0; i < image.levels[0].texels.size(); i += channels)
        first.push_back(image.levels[0].texels[i]);
    image.levels[0].texels = std::move(first);
    image.channels.resize(1);
    return image;
}

TEST(Ies, CertificateIsWhatAShaderFindsInTheFile) {
    const std::array<std::pair<std::string, PixelType>, 5> kFiles{{{"exr", PixelType::half},
                                                                   {"hdr", PixelType::rgbe},
                                                                   {"png", PixelType::unorm16},
                                                                   {"dds", PixelType::float32},
                                                                   {"ktx2", PixelType::unorm16}}};
    for (const char* text : {kLamp, kNarrow})
        for (const Projection projection : kProjections) {
            SCOPED_TRACE(std::string(enum_name(projection)));
            IesParams params = defaults();
            params.projection = projection;
            const auto& [format, pixel] = kFiles[static_cast<std::size_t>(projection)];
            const Baked baked = bake_text(text, params, pixel);
            const double found =
                baked.unit_cd() * integrate_shaded(through_file(baked, format, pixel), baked.texture(), 2048);
            // The fixture's midpoint rule is good to 3e-4 at these beams.
            EXPECT_NEAR(found / baked.figure("decoded_flux_lm"), 1, 3e-4);
        }
}

TEST(Ies, DefaultSizeKeepsFluxAndPeakInEveryProjectionAndPixelType) {
    for (const char* text : {kLamp, kNarrow})
        for (const Projection projection : kProjections) {
            IesParams params = defaults();
            params.projection = projection;
            const Inputs inputs = inputs_of(text);
            Context context(1, {});
            const Product exact = bake(params, inputs, context);
            for (const PixelType pixel :
                 {PixelType::half, PixelType::float32, PixelType::unorm16, PixelType::rgbe}) {
                SCOPED_TRACE(std::string(enum_name(projection)) + " " + std::string(pixel_name(pixel)));
                Baked baked{exact, {}};
                baked.product.scale = io::quantise(baked.product.images, pixel);
                baked.certificate = certify(params, inputs, baked.product, context);
                EXPECT_LE(baked.figure("flux_error"), 1e-3) << baked.texture();
                // The mean of an asymmetric lamp has another peak.
                if (projection == Projection::axial && text == kLamp) continue;
                EXPECT_LE(baked.figure("peak_error"), 1e-2) << baked.texture();
            }
        }
}

TEST(Ies, LatlongKeepsTheFilesOwnGrid) {
    const Baked baked = bake_text(kLamp, defaults(), PixelType::float32);
    EXPECT_EQ(baked.texture()["size"][0], 5);
    EXPECT_EQ(baked.texture()["size"][1], 13);
    EXPECT_EQ(*baked.product.images[0].texel(0, 0, 2, 0), 1);
    EXPECT_EQ(baked.figure("peak_error"), 0);
    EXPECT_NEAR(baked.unit_cd(), 400, 1e-9);
}

TEST(Ies, FoldedTextureSpansWhatTheFileHas) {
    IesParams params = defaults();
    params.fold = true;
    const std::string quadrant =
        "IESNA91\nTILT=NONE\n1 900 1 4 3 1 2 0 0 0 1 1 10\n0 30 60 90\n0 45 90\n100 80 60 20\n100 90 50 "
        "10\n100 60 40 5\n";
    const Baked baked = bake_text(quadrant, params, PixelType::float32);
    EXPECT_EQ(baked.texture()["size"], Json({3, 4}));
    EXPECT_LE(baked.figure("flux_error"), 1e-6);
    EXPECT_EQ(baked.product.images[0].levels[0].texels[11], .05f);
}

TEST(Ies, EveryNormalisationReturnsToCandela) {
    for (const Normalise normalise : {Normalise::max, Normalise::mean, Normalise::flux, Normalise::candela}) {
        IesParams params = defaults();
        params.normalise = normalise;
        const Baked baked = bake_text(kLamp, params, PixelType::float32);
        const double top = static_cast<double>(*baked.product.images[0].texel(0, 0, 2, 0));
        EXPECT_NEAR(top * baked.unit_cd(), 400, 1e-4);
        const double integral = integrate_shaded(baked.product.images[0], baked.texture());
        if (normalise == Normalise::max) {
            EXPECT_EQ(top, 1);
        }
        if (normalise == Normalise::mean) {
            EXPECT_NEAR(integral, 4 * kPi, 4 * kPi * 2e-3);
        }
        if (normalise == Normalise::flux) {
            EXPECT_NEAR(integral, 1, 2e-3);
        }
        if (normalise == Normalise::candela) {
            EXPECT_EQ(top, 400);
        }
    }
    IesParams params = defaults();
    params.normalise = Normalise::candela;
    const Baked narrow = bake_text(kNarrow, params);  // 90,000 cd don't fit into a half
    EXPECT_EQ(narrow.product.scale, .5);
    EXPECT_LE(narrow.figure("peak_error"), 5e-4);
}

TEST(Ies, FluxExactAndLumensAreMet) {
    IesParams params = defaults();
    params.size = {16, 16};
    EXPECT_GT(bake_text(kLamp, params, PixelType::float32).figure("flux_error"), 1e-3);
    params.flux_exact = true;
    EXPECT_LE(bake_text(kLamp, params, PixelType::float32).figure("flux_error"), 1e-6);
    params = defaults();
    params.lumens = 1234;
    const Baked baked = bake_text(kLamp, params);
    EXPECT_NEAR(baked.product.properties["flux_lm"].get<double>(), 1234, 1e-9);
    EXPECT_NEAR(baked.figure("decoded_flux_lm"), 1234, 1.234);
}

TEST(Ies, RotationAndAimTurnTheLight) {
    IesParams params = defaults();
    params.projection = Projection::octahedral;
    params.size = {1023};
    const auto towards = [&](double azimuth_deg) {
        const Baked baked = bake_text(kLamp, params, PixelType::float32);
        const double a = azimuth_deg * kPi / 180, s = .5, c = std::sqrt(.75);
        return shade(baked.product.images[0], baked.texture(), s * std::cos(a), s * std::sin(a), -c) *
               baked.unit_cd();
    };
    EXPECT_NEAR(towards(0), 400, 6);
    params.rotate_deg = 30;
    EXPECT_NEAR(towards(30), 400, 6);
    params.rotate_deg = 0;
    params.c0 = C0::y;
    EXPECT_NEAR(towards(90), 400, 6);
    params = defaults();
    params.projection = Projection::cube;
    params.size = {128};
    params.aim = Aim::minus_y;
    const Baked cube = bake_text(kLamp, params, PixelType::float32);
    EXPECT_NEAR(shade(cube.product.images[0], cube.texture(), 0, -1, 0) * cube.unit_cd(), 100, 2);
    EXPECT_NEAR(shade(cube.product.images[0], cube.texture(), .5, -std::sqrt(.75), 0) * cube.unit_cd(), 400,
                8);
}

TEST(Ies, SquashNarrowsTheBeam) {
    IesParams params = defaults();
    params.squash = .5;
    const Baked baked = bake_text(kNarrow, params, PixelType::float32);
    const Baked plain = bake_text(kNarrow, defaults(), PixelType::float32);
    const Json &narrow = baked.product.documents[0].json, &wide = plain.product.documents[0].json;
    EXPECT_NEAR(narrow["beam_angle_deg"][0].get<double>(), wide["beam_angle_deg"][0].get<double>() / 2, 1e-9);
    EXPECT_EQ(narrow["max_cd"], wide["max_cd"]);
}

TEST(Ies, CookieSaysWhatItLeavesOut) {
    IesParams params = defaults();
    params.projection = Projection::cookie;
    params.cone_deg = 60;
    const Baked baked = bake_text(kLamp, params);
    EXPECT_EQ(baked.texture()["cone_deg"], 60);
    EXPECT_GT(baked.figure("flux_outside"), .3);
    EXPECT_NEAR(baked.figure("decoded_flux_lm") / exact_flux(kLamp), 1 - baked.figure("flux_outside"), 1e-3);
}

TEST(Ies, AxialTextureOfAnAsymmetricFileKeepsTheFlux) {
    IesParams params = defaults();
    params.projection = Projection::axial;
    const Baked baked = bake_text(kLamp, params);
    EXPECT_LE(baked.figure("flux_error"), 1e-3);
    EXPECT_GT(baked.figure("peak_error"), .1);
    EXPECT_NE(baked.product.warnings.back().find("mean over azimuth"), std::string::npos);
}

TEST(Ies, TypesAAndBKeepFluxInEveryProjection) {
    const std::string body =
        " 2 0 0 0 1 1 9\n-90 -30 0 30 90\n-90 -20 0 20 90\n0 0 0 0 0\n0 5 30 5 0\n0 30 100 30 0\n0 5 30 5 "
        "0\n0 0 0 0 0\n";
    for (const char* type : {"2", "3"})
        for (const Projection projection : kProjections) {
            SCOPED_TRACE(std::string(type) + std::string(enum_name(projection)));
            IesParams params = defaults();
            params.projection = projection;
            const Baked baked =
                bake_text("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 5 5 " + std::string(type) + body, params);
            EXPECT_LE(baked.figure("flux_error"), 1e-3);
            EXPECT_LE(baked.figure("peak_error"), 1e-2);
        }
}

TEST(Ies, LightTellsWhatARendererNeeds) {
    IesParams params = defaults();
    params.documents = {DocumentKind::light, DocumentKind::gltf, DocumentKind::polar, DocumentKind::sphere,
                        DocumentKind::page};
    const Baked baked = bake_text(kLamp, params);
    const Json& light = baked.product.documents[0].json;
    EXPECT_NEAR(light["flux_lm"].get<double>(), exact_flux(kLamp), 1e-9);
    EXPECT_EQ(light["max_cd"], 400);
    EXPECT_EQ(light["opening"]["shape"], "disk");
    EXPECT_EQ(light["colour_temperature_k"], 3000);
    EXPECT_NEAR(light["uses"]["mask"]["point_lm"].get<double>(), 1600 * kPi, 1e-9);
    EXPECT_NEAR(light["power"]["efficiency"].get<double>(), exact_flux(kLamp) / 900, 1e-12);
    const Json& gltf = baked.product.documents[1].json;
    EXPECT_EQ(gltf["extensions"]["EXT_lights_ies"]["lights"][0]["uri"].get<std::string>().find(
                  "data:application/x-ies-lm-63;base64,SUVTOkxNLTYzLTIwMTk"),
              0u);
    for (std::size_t i = 2; i < 5; ++i)
        EXPECT_NE(baked.product.documents[i].text.find("<svg"), std::string::npos);
    EXPECT_EQ(documents(params),
              (std::vector<std::string>{"light.json", "gltf", "polar.svg", "sphere.svg", "html"}));
}

TEST(Ies, ReviewFindsKnownMistakes) {
    const auto codes = [](const std::string& text) {
        const Baked baked = bake_text(text, defaults());
        std::string list;
        for (const Json& diagnostic : baked.product.properties["diagnostics"])
            list += diagnostic["code"].get<std::string>() + " ";
        return list;
    };
    const auto lamp = [](const std::string& head, const std::string& counts, const std::string& factors,
                         const std::string& rest) {
        return "IESNA:LM-63-2002\n" + head + "TILT=NONE\n" + counts + factors + rest;
    };
    const std::string grid = "0 90\n0\n100 100\n";  // 628 lm
    EXPECT_EQ(codes(lamp("", "1 700 1 2 1 1 2 0 0 0 ", "1 1 10\n", grid)), "");
    EXPECT_EQ(codes(lamp("", "1 400 1 2 1 1 2 0 0 0 ", "1 1 10\n", grid)), "efficiency ");
    EXPECT_EQ(codes(lamp("", "1 700 1.5 2 1 1 2 0 0 0 ", "1 1 10\n", grid)), "efficiency double_multiplier ");
    EXPECT_EQ(codes(lamp("", "1 -1 1.06 2 1 1 2 0 0 0 ", "1.06 1 10\n", grid)), "double_multiplier ");
    EXPECT_EQ(codes(lamp("[TEST] candela-> mW/sr\n", "1 -1 1 2 1 1 2 0 0 0 ", "1 1 10\n", grid)),
              "radiometric_units ");
    EXPECT_EQ(codes(lamp("", "1 -1 1 2 1 1 2 0 0 0 ", "1 1 10\n", "0 90\n0\n0 0\n")), "dark ");
}

TEST(Ies, TiltFactorScalesAndAMissingTableIsSaid) {
    const std::string start = "IESNA:LM-63-2002\nTILT=",
                      rest = "1 -1 1 2 1 1 2 0 0 0 1 1 10\n0 90\n0\n100 100\n";
    IesParams params = defaults();
    params.tilt_deg = 90;
    const auto max_cd = [&](const Inputs& inputs) {
        Context context(1, {});
        return bake(params, inputs, context).properties["max_cd"].get<double>();
    };
    EXPECT_NEAR(max_cd(inputs_of(start + "INCLUDE\n1\n2\n0 90\n1 .8\n" + rest)), 80, 1e-12);
    Inputs inputs = inputs_of(start + "lamp.tlt\n" + rest);
    EXPECT_EQ(follow(inputs).at(0).path, "lamp.tlt");
    EXPECT_EQ(max_cd(inputs), 100);
    const std::string table = "1\n2\n0 90\n1 .7\n";
    const auto bytes = parse::test::bytes_of(table);
    inputs["tilt"].bytes.assign(bytes.begin(), bytes.end());
    EXPECT_NEAR(max_cd(inputs), 70, 1e-12);
}

TEST(Ies, SameBytesAtAnyThreadCount) {
    IesParams params = defaults();
    params.projection = Projection::cube;
    const Inputs inputs = inputs_of(kLamp);
    Context one(1, {}), four(4, {});
    EXPECT_EQ(bake(params, inputs, one).images[0].levels[0].texels,
              bake(params, inputs, four).images[0].levels[0].texels);
}

/// Every real file at the size that is chosen by default, the square projections of one file in four unless
/// PBRBAKE_ALL_REAL_FILES is set. The cap of 1024 is all a narrow beam may fail by.
TEST(RealProfiles, DecodeToTheirFluxAndPeakInEveryProjection) {
    const auto folder = real_files();
    if (folder.empty()) GTEST_SKIP() << "no shared data: set PBRBAKE_SHARED_DATA to its folder";
    int baked_files = 0;
    for (const auto& cells : read_table(folder / "expected.tsv")) {
        const std::string text = read_text(folder / cells[0]);
        if (!parse::test::error_of(text).empty()) continue;
        for (const Projection projection : kProjections) {
            const bool is_square = projection != Projection::latlong && projection != Projection::axial;
            if (is_square && baked_files % 4 != 0 && !std::getenv("PBRBAKE_ALL_REAL_FILES")) continue;
            SCOPED_TRACE(cells[0] + " " + std::string(enum_name(projection)));
            IesParams params = defaults();
            params.projection = projection;
            const Baked baked = bake_text(text, params);
            const bool capped = baked.texture()["size"][0] > 1000 || baked.texture()["size"][1] > 1000;
            if (!capped) {
                EXPECT_LE(baked.figure("flux_error"), 1e-3) << baked.texture();
            }
            if (!capped && projection != Projection::axial) {
                EXPECT_LE(baked.figure("peak_error"), 1e-2) << baked.texture();
            }
            if (capped || baked.figure("flux_error") > 1e-3)
                std::printf("[ capped   ] %s %s %s: flux %.1e, peak %.1e\n", cells[0].c_str(),
                            enum_name(projection).data(), baked.texture()["size"].dump().c_str(),
                            baked.figure("flux_error"), baked.figure("peak_error"));
        }
        ++baked_files;
    }
    EXPECT_EQ(baked_files, 37);
}

}  // namespace
}  // namespace pbrbake::ies::test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bakers/parse/grid.hpp"
#include "tests/bakers/parse/fixtures.hpp"

namespace pbrbake::parse::test {
namespace {

struct Fixture {
    int symmetry = 0;
    std::vector<double> planes{0, 90, 180, 270};
    std::vector<std::vector<double>> rows{{100, 80, 10}, {100, 60, 5}, {100, 40, 0}, {100, 60, 5}};
    std::string lamps = "1\n2\nLED\n2000\n3000\n80\n20\n";
    std::string factor = "1";
    std::string line_end = "\r\n";

    std::string text() const {
        std::string fields =
            "Maker\n1\n" + std::to_string(symmetry) + "\n" + std::to_string(planes.size()) +
            "\n90\n3\n45\nR1\nLamp\nL1\nlamp.ldt\n2020\n600\n300\n50\n500\n250\n0\n0\n0\n0\n100\n100\n" +
            factor + "\n0\n" + lamps + "0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n";
        for (const double plane : planes) fields += std::to_string(static_cast<int>(plane)) + "\n";
        fields += "0\n45\n90\n";
        for (const auto& row : rows)
            for (const double value : row) fields += std::to_string(static_cast<int>(value)) + "\n";
        std::string out;
        for (const char c : fields) out += c == '\n' ? line_end : std::string(1, c);
        return out;
    }
};

pbr::PhotometricWeb web_of(const PhotometricFile& file, std::size_t lamp_set = 0) {
    std::vector<Diagnostic> unused;
    return make_web(file, lamp_set, unused);
}

TEST(Eulumdat, EverySymmetryShowsTheSameLamp) {
    // Mirrored in C0-C180 and, but for 90 planes, in nothing else: rows 90 and 270 are equal.
    Fixture full, half;
    half.symmetry = 2;
    half.rows = {full.rows[0], full.rows[1], full.rows[2]};
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        full.line_end = half.line_end = end;
        const pbr::PhotometricWeb a = web_of(parse(full.text())), b = web_of(parse(half.text()));
        for (double c = 0; c < 360; c += 15)
            for (double g = 0; g <= 90; g += 15) EXPECT_NEAR(a.at_cd(g, c), b.at_cd(g, c), 1e-9);
        EXPECT_NEAR(a.flux_lm(), b.flux_lm(), 1e-9);
    }
    Fixture side;  // mirrored in C90-C270: stored from C270 over C0 to C90
    side.symmetry = 3;
    side.rows = {{100, 1, 0}, {100, 2, 0}, {100, 3, 0}};
    const pbr::PhotometricWeb web = web_of(parse(side.text()));
    EXPECT_NEAR(web.at_cd(45, 270), 2, 1e-12);
    EXPECT_NEAR(web.at_cd(45, 0), 4, 1e-12);
    EXPECT_NEAR(web.at_cd(45, 180), 4, 1e-12);
    EXPECT_NEAR(web.at_cd(45, 90), 6, 1e-12);
    Fixture quarter;
    quarter.symmetry = 4;
    quarter.rows = {{100, 1, 0}, {100, 2, 0}};
    EXPECT_NEAR(web_of(parse(quarter.text())).at_cd(45, 225), 3, 1e-12);
    Fixture round;
    round.symmetry = 1;
    round.rows = {{100, 1, 0}};
    EXPECT_NEAR(web_of(parse(round.text())).at_cd(45, 225), 2, 1e-12);
}

TEST(Eulumdat, ScalesByLampSetAndFactor) {
    Fixture file;
    file.lamps = "2\n1\nA\n1000\n3000\n80\n10\n-1\nB\n500\n4000\n90\n6\n";
    file.factor = "2";
    const PhotometricFile parsed = parse(file.text());
    EXPECT_EQ(web_of(parsed, 0).max_cd(), 200);
    EXPECT_EQ(web_of(parsed, 1).max_cd(), 100);
    EXPECT_EQ(*declared_flux_lm(parsed, 0), 1000);
    EXPECT_FALSE(declared_flux_lm(parsed, 1).has_value());
    EXPECT_EQ(watts(parsed, 1), 6);
}

TEST(Eulumdat, TakesDecimalCommasAndEmptyLengths) {
    Fixture file;
    file.factor = "1,5";
    PhotometricFile parsed = parse(file.text());
    EXPECT_EQ(parsed.eulumdat()->factor, 1.5);
    EXPECT_TRUE(has(parsed.diagnostics, "decimal_comma"));
    std::string text = Fixture().text();
    text.replace(text.find("600\r\n300"), 3, "");
    parsed = parse(text);
    EXPECT_EQ(parsed.eulumdat()->length_mm, 0);
    EXPECT_TRUE(has(parsed.diagnostics, "no_number"));
}

TEST(Eulumdat, RefusesDangerWithOneLineThatSaysWhere) {
    Fixture file;
    file.rows.pop_back();
    EXPECT_EQ(error_of(file.text()),
              "4 lamp.ies:58: has 9 lines left where 12 intensities should be; it may be truncated");
    file = {};
    file.lamps = "1\n1\nA\n0\n\n\n10\n";
    EXPECT_EQ(error_of(file.text()).substr(0, 60),
              "4 lamp.ies:29: found 0 as total flux of lamps; intensities a");
    file = {};
    file.factor = "-1";
    EXPECT_EQ(error_of(file.text()).substr(0, 50), "4 lamp.ies:24: found -1 as conversion factor; allo");
    file = {};
    file.symmetry = 2;
    file.planes = {0, 100, 190, 280};
    EXPECT_NE(error_of(file.text()).find("Isym 2 needs C-planes from 0 to 180"), std::string::npos);
    std::string nan = Fixture().text();
    nan.replace(nan.rfind("60\r\n"), 2, "nan");
    EXPECT_NE(error_of(nan).find("found 'nan'"), std::string::npos);
    const std::string text = Fixture().text();
    for (std::size_t size = 0; size + 3 < text.size(); ++size)
        EXPECT_EQ(error_of(text.substr(0, size)).substr(0, 2), "4 ") << size;
}

TEST(Convert, EulumdatToLm63AndBackKeepsEverything) {
    Fixture file;
    file.lamps = "2\n1\nA\n1000\n3000\n80\n10\n-1\nB\n500\n4000\n90\n6\n";
    for (const int symmetry : {0, 1, 2, 3, 4}) {
        SCOPED_TRACE(symmetry);
        file.symmetry = symmetry;
        file.rows = {{100, 80, 10}, {100, 60, 5}, {100, 40, 0}, {100, 60, 5}};
        file.rows.resize(symmetry == 0 ? 4 : symmetry == 1 ? 1 : symmetry == 4 ? 2 : 3);
        const PhotometricFile ldt = parse(file.text());
        const std::string as_ies = write_lm63(ldt);
        const PhotometricFile ies = parse(as_ies);
        ASSERT_EQ(ies.lm63()->edition, 2019);
        EXPECT_NEAR(web_of(ies).flux_lm(), web_of(ldt).flux_lm(), 1e-9 * web_of(ldt).flux_lm());
        for (double c = 0; c < 360; c += 15)
            EXPECT_NEAR(web_of(ies).at_cd(30, c), web_of(ldt).at_cd(30, c), 1e-9);
        std::vector<std::string> lost;
        EXPECT_EQ(write_eulumdat(ies, lost), write_eulumdat(ldt, lost));
        EXPECT_TRUE(lost.empty());
        EXPECT_EQ(write_eulumdat(ldt, lost), file.text());
    }
}

TEST(Convert, Lm63ToEulumdatKeepsTheLight) {
    const std::string tail = " 1 2 .3 .6 0 1 1 30\n0 45 90\n";
    const std::vector<std::string> grids{
        "0 90\n100 80 10\n100 60 0\n",
        "0 180\n100 80 10\n100 60 0\n",
        "0 90 180 270 360\n100 80 10\n100 60 0\n100 8 1\n100 6 0\n100 80 10\n",
        "90 180 270\n100 80 10\n100 60 0\n100 8 1\n",
        "0\n100 80 10\n",
        "0 120 240\n100 80 10\n100 60 0\n100 8 1\n"};
    for (const std::string& grid : grids) {
        SCOPED_TRACE(grid);
        const auto count =
            std::count(grid.begin(), grid.begin() + static_cast<std::ptrdiff_t>(grid.find('\n')), ' ') + 1;
        for (const char* lumens : {"-1", "700"}) {
            const PhotometricFile ies =
                parse("IESNA:LM-63-2002\n[MANUFAC] Maker\n[OTHER] x\nTILT=NONE\n1 " + std::string(lumens) +
                      " 1.5 3 " + std::to_string(count) + tail + grid);
            std::vector<std::string> lost;
            const PhotometricFile ldt = parse(write_eulumdat(ies, lost));
            ASSERT_TRUE(ldt.eulumdat());
            EXPECT_EQ(ldt.eulumdat()->company, "Maker");
            EXPECT_EQ(lost, std::vector<std::string>{"[OTHER] x"});
            EXPECT_NEAR(web_of(ldt).flux_lm(), web_of(ies).flux_lm(), 1e-9 * web_of(ies).flux_lm());
            for (double c = 0; c < 360; c += 15)
                EXPECT_NEAR(web_of(ies).at_cd(30, c), web_of(ldt).at_cd(30, c), 1e-7);
            EXPECT_NEAR(luminous_opening(ldt).along_c0_m, luminous_opening(ies).along_c0_m, 1e-12);
        }
    }
    EXPECT_THROW(
        {
            std::vector<std::string> lost;
            write_eulumdat(
                parse("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 2 2 2 0 0 0 1 1 0\n0 90\n0 90\n1 1 1 1\n"),
                lost);
        },
        Error);
}

TEST(Convert, Lm63ToItselfKeepsEveryNumber) {
    const std::string text =
        "IESNA91\n[TEST] T\n[TESTLAB] L\n[ISSUEDATE] D\n[MANUFAC] M\n[LAMP] a\n[MORE] "
        "b\nTILT=INCLUDE\n1\n2\n0 90\n1 0.5\n2 500 1.5 3 2 1 1 0.25 -0.5 0.125 0.75 0.5 30\n"
        "0 45 90\n0 90\n100.123456789 80 10\n100 60 0\n";
    const PhotometricFile first = parse(text), second = parse(write_lm63(first));
    EXPECT_EQ(second.values, first.values);
    EXPECT_EQ(second.lm63()->keywords, first.lm63()->keywords);
    EXPECT_EQ(candela_scale(second), candela_scale(first));  // field 12 went into the multiplier
    EXPECT_EQ(second.lm63()->tilt->factors, first.lm63()->tilt->factors);
    EXPECT_EQ(second.lm63()->width, .25);
    EXPECT_EQ(second.lm63()->units, 1);
    EXPECT_EQ(write_lm63(second), write_lm63(first));
}

TEST(RealPhotometry, ConvertsWithItsFlux) {
    const auto folder = real_files();
    if (folder.empty()) GTEST_SKIP() << "no shared data: set PBRBAKE_SHARED_DATA to its folder";
    int converted = 0;
    for (const auto& cells : read_table(folder / "expected.tsv")) {
        SCOPED_TRACE(cells[0]);
        const std::string text = read_text(folder / cells[0]);
        if (!error_of(text).empty()) continue;
        const PhotometricFile file = parse(text);
        const double flux = web_of(file).flux_lm();
        EXPECT_NEAR(web_of(parse(write_lm63(file))).flux_lm(), flux, 1e-9 * flux);
        if (file.type != pbr::Photometry::type_c) continue;
        std::vector<std::string> lost;
        const std::string ldt = write_eulumdat(file, lost);
        EXPECT_NEAR(web_of(parse(ldt)).flux_lm(), flux, 1e-9 * flux);
        EXPECT_EQ(write_eulumdat(parse(write_lm63(parse(ldt))), lost), ldt);
        ++converted;
    }
    EXPECT_GE(converted, 33);
}

TEST(RealPhotometry, TwinsOfOneLuminaireAgree) {
    const auto folder = real_files();
    if (folder.empty()) GTEST_SKIP() << "no shared data: set PBRBAKE_SHARED_DATA to its folder";
    for (const char* twin : {"ksmet197_Testlamp_Isym1_007cfb11e343e2f42e3b476be4ab684e",
                             "ksmet197_Testlamp_Isym3_symmetryOverC90C270axis"}) {
        SCOPED_TRACE(twin);
        const pbr::PhotometricWeb ies = web_of(parse(read_text(folder / (std::string(twin) + ".ies"))));
        const pbr::PhotometricWeb ldt = web_of(parse(read_text(folder / (std::string(twin) + ".ldt"))));
        // The IES twins print intensities to .1 (337.2 cd) and .01 cd (3517.01).
        const double printed =
            std::string(twin).find("Isym1_") != std::string::npos ? .05 / 337 : .005 / 3517;
        EXPECT_NEAR(ies.max_cd() / ldt.max_cd(), 1, printed);
        EXPECT_NEAR(ies.flux_lm() / ldt.flux_lm(), 1, printed);
    }
}

}  // namespace
}  // namespace pbrbake::parse::test

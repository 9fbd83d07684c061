#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "bakers/parse/grid.hpp"
#include "tests/bakers/parse/fixtures.hpp"

namespace pbrbake::parse::test {
namespace {

/// A small sound file whose parts tests replace.
struct Fixture {
    std::string head = "IESNA:LM-63-2002\n[TEST] T1\n[MANUFAC] Maker\n";
    std::string tilt = "TILT=NONE\n";
    std::string counts = "1 1000 2 3 2 1 2 0.5 0.25 0\n";
    std::string factors = "0.5 1 30\n";
    std::string angles = "0 45 90\n0 90\n";
    std::string candela = "100 80 10\n100 60 0\n";

    std::string text() const { return head + tilt + counts + factors + angles + candela; }
};

void expect_sound(const std::string& text) {
    const PhotometricFile file = parse(text);
    EXPECT_EQ(file.vertical_deg, (std::vector<double>{0, 45, 90}));
    EXPECT_EQ(file.horizontal_deg, (std::vector<double>{0, 90}));
    EXPECT_EQ(file.values, (std::vector<double>{100, 80, 10, 100, 60, 0}));
    std::vector<Diagnostic> diagnostics;
    EXPECT_EQ(make_web(file, 0, diagnostics).max_cd(), 100);
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += with.size())
        text.replace(at, what.size(), with);
    return text;
}

TEST(Lm63, ReadsEverySeparatorInUse) {
    const Fixture sound;
    expect_sound(sound.text());
    expect_sound(replaced(sound.text(), "\n", "\r\n"));
    expect_sound(replaced(sound.text(), "\n", "\r"));
    expect_sound(sound.head + sound.tilt +
                 replaced(sound.counts + sound.factors + sound.angles + sound.candela, " ", ","));
    expect_sound(sound.head + sound.tilt +
                 replaced(sound.counts + sound.factors + sound.angles + sound.candela, " ", "\n"));
    expect_sound(sound.head + sound.tilt +
                 replaced(sound.counts + sound.factors + sound.angles + sound.candela, "\n", " "));
    expect_sound(sound.head + sound.tilt +
                 replaced(sound.counts + sound.factors + sound.angles + sound.candela, " ", "\t , "));
    expect_sound(sound.text().substr(0, sound.text().size() - 1));  // no last line end
}

TEST(Lm63, TellsEditionsApart) {
    Fixture file;
    const auto edition = [&](const std::string& tag) {
        file.head = tag;
        return parse(file.text()).lm63()->edition;
    };
    EXPECT_EQ(edition(""), 1986);
    EXPECT_EQ(edition("A luminaire\nBy its maker\n"), 1986);
    EXPECT_EQ(edition("IESNA91\n"), 1991);
    EXPECT_EQ(edition("IESNA:LM-63-1995\n[TEST] a\n"), 1995);
    EXPECT_EQ(edition("  iesna:lm-63-2002 \n"), 2002);
    EXPECT_EQ(edition("IES:LM-63-2019\n"), 2019);
    EXPECT_TRUE(has((file.head = "IESNA:LM-63-2010\n", parse(file.text()).diagnostics), "edition"));
}

TEST(Lm63, Field12ScalesOnlyOldFiles) {
    Fixture file;
    file.factors = "0.5 1.25 30\n";
    const auto scale = [&](const std::string& tag) {
        file.head = tag;
        return candela_scale(parse(file.text()));
    };
    EXPECT_EQ(scale(""), 2 * .5 * 1.25);
    EXPECT_EQ(scale("IESNA91\n"), 2 * .5 * 1.25);
    EXPECT_EQ(scale("IESNA:LM-63-1995\n"), 1);
    EXPECT_EQ(scale("IESNA:LM-63-2002\n"), 1);
    EXPECT_EQ(scale("IES:LM-63-2019\n"), 1);
    file.head = "IESNA:LM-63-2002\n";
    EXPECT_TRUE(has(parse(file.text()).diagnostics, "field_12"));
}

TEST(Lm63, KeepsKeywordsAndJoinsMore) {
    Fixture file;
    file.head = "IESNA:LM-63-2002\n[TEST] T1\n[LAMP]one\n[MORE] two\n[more]three\nno keyword\n[_OWN] x\n";
    const PhotometricFile parsed = parse(file.text());
    EXPECT_EQ(parsed.lm63()->keywords,
              (std::vector<Keyword>{
                  {"TEST", "T1"}, {"LAMP", "one\ntwo\nthree"}, {"", "no keyword"}, {"_OWN", "x"}}));
    EXPECT_TRUE(has(parsed.diagnostics, "no_keyword"));
    EXPECT_EQ(parsed.lm63()->value_of("_OWN"), "x");
}

TEST(Lm63, ReadsTilt) {
    Fixture file;
    file.tilt = "TILT=INCLUDE\n2\n3\n0 45 90\n1 .95 .5\n";
    expect_sound(file.text());
    const TiltTable table = *parse(file.text()).lm63()->tilt;
    EXPECT_EQ(table.geometry, 2);
    EXPECT_EQ(tilt_factor(table, 0), 1);
    EXPECT_NEAR(tilt_factor(table, 22.5), .975, 1e-15);
    EXPECT_EQ(tilt_factor(table, 120), .5);
    file.tilt = " tilt = lamp.tlt \n";
    expect_sound(file.text());
    EXPECT_EQ(parse(file.text()).lm63()->tilt_file, "lamp.tlt");
    EXPECT_EQ(parse_tilt(bytes_of("1\n2\n0,90\n1,.9\n"), "lamp.tlt").factors, (std::vector<double>{1, .9}));
}

TEST(Lm63, ReadsEncodings) {
    Fixture file;
    file.head =
        "IESNA:LM-63-2002\n[MANUFAC] Stra\xDF"
        "e \x80\n";
    const PhotometricFile latin = parse(file.text());
    EXPECT_EQ(latin.lm63()->value_of("MANUFAC"), "Straße €");
    EXPECT_TRUE(has(latin.diagnostics, "encoding"));
    file.head = "\xEF\xBB\xBFIESNA:LM-63-2002\n[MANUFAC] Straße\n";
    const PhotometricFile marked = parse(file.text());
    EXPECT_EQ(marked.lm63()->edition, 2002);
    EXPECT_EQ(marked.lm63()->value_of("MANUFAC"), "Straße");
    EXPECT_TRUE(has(marked.diagnostics, "byte_order_mark"));
    std::string utf16 = "\xFF\xFE";
    for (const char c : file.text()) utf16 += {c, '\0'};
    EXPECT_EQ(error_of(utf16), "4 lamp.ies: is UTF-16; save it as UTF-8 or Latin-1");
    EXPECT_NE(error_of(utf16.substr(2)).find("UTF-16 or no text"), std::string::npos);
}

TEST(Lm63, ReadsTypesAndCovers) {
    using pbr::HorizontalCover;
    const auto cover = [](const std::string& type, const std::string& horizontal,
                          std::vector<Diagnostic>& diagnostics) {
        const auto count = std::count(horizontal.begin(), horizontal.end(), ' ') + 1;
        std::string text = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 " + std::to_string(count) + " " + type +
                           " 2 0 0 0 1 1 0\n0 90\n" + horizontal + "\n";
        for (int i = 0; i < 2 * count; ++i) text += " 1";
        const PhotometricFile file = parse(text);
        diagnostics = file.diagnostics;
        return make_web(file, 0, diagnostics).cover();
    };
    std::vector<Diagnostic> said;
    EXPECT_EQ(cover("1", "0", said), HorizontalCover::axial);
    EXPECT_EQ(cover("1", "0 90", said), HorizontalCover::mirrored);
    EXPECT_EQ(cover("1", "0 180", said), HorizontalCover::mirrored);
    EXPECT_EQ(cover("1", "90 180 270", said), HorizontalCover::mirrored);
    EXPECT_TRUE(said.empty());
    EXPECT_EQ(cover("1", "180 270 360", said), HorizontalCover::mirrored);
    EXPECT_TRUE(has(said, "unusual_span"));
    EXPECT_EQ(cover("1", "0 180 360", said), HorizontalCover::ring);
    EXPECT_TRUE(said.empty());
    EXPECT_EQ(cover("1", "0 90 180 270", said), HorizontalCover::ring);
    EXPECT_TRUE(has(said, "open_ring"));
    EXPECT_EQ(cover("1", "0 15 30 45", said), HorizontalCover::range);
    EXPECT_TRUE(has(said, "illegal_span"));
    EXPECT_EQ(cover("2", "0 90", said), HorizontalCover::mirrored);
    EXPECT_EQ(cover("3", "-90 0 90", said), HorizontalCover::range);
}

TEST(Lm63, DiagnosesWhatItTolerates) {
    Fixture file;
    file.counts = "1. 1000 2 3.0 2 1 2 0.5 0.25 0\n";
    file.candela = "100 80 10\n100 -60 0\n7 8\n";
    std::vector<Diagnostic> said = parse(file.text()).diagnostics;
    EXPECT_EQ(make_web(parse(file.text()), 0, said).at_cd(45, 90), 0);
    EXPECT_TRUE(has(said, "negative_intensity"));
    EXPECT_TRUE(has(said, "trailing_data"));
}

TEST(Lm63, RefusesDangerWithOneLineThatSaysWhere) {
    const auto expect = [](const Fixture& file, const std::string& error) {
        EXPECT_EQ(error_of(file.text()), error);
        EXPECT_EQ(error.find('\n'), std::string::npos);
    };
    Fixture file;
    file.candela = "100 80 10\n100 nan 0\n";
    expect(file, "4 lamp.ies:10: found 'nan' as candela values; allowed: a finite number up to 1e10");
    file.candela = "100 80 10\n100 inf 0\n";
    expect(file, "4 lamp.ies:10: found 'inf' as candela values; allowed: a finite number up to 1e10");
    file.candela = "100 80 10\n100 1e999 0\n";
    expect(file, "4 lamp.ies:10: found '1e999' as candela values; allowed: a finite number up to 1e10");
    file.candela = "100 80 10\n100 1e11 0\n";  // products of larger ones would not stay finite
    expect(file, "4 lamp.ies:10: found '1e11' as candela values; allowed: a finite number up to 1e10");
    file.candela = "100 80 10\n100";
    expect(file, "4 lamp.ies:10: ends where candela values should be; it may be truncated");
    file = {};
    file.counts = "1 1000 2 2147483648 2 1 2 0 0 0\n";
    expect(file,
           "4 lamp.ies:5: found 2147483648 as the number of vertical angles; allowed: a whole number from 1 "
           "to 1000000");
    file.counts = "1 1000 2 900000 900000 1 2 0 0 0\n";
    expect(file,
           "4 lamp.ies:6: claims 900000 x 900000 angles, but only 32 bytes follow; it may be truncated");
    file.counts = "1 1000 2 -3 2 1 2 0 0 0\n";
    expect(
        file,
        "4 lamp.ies:5: found -3 as the number of vertical angles; allowed: a whole number from 1 to 1000000");
    file.counts = "1 1000 -2 3 2 1 2 0 0 0\n";
    expect(file, "4 lamp.ies:5: found -2 as the candela multiplier; allowed: a number above 0");
    file.counts = "1 1000 2 3 2 4 2 0 0 0\n";
    expect(file, "4 lamp.ies:5: found 4 as the photometric type; allowed: a whole number from 1 to 3");
    file = {};
    file.angles = "0 45 45\n0 90\n";
    expect(file, "4 lamp.ies:7: vertical angles must ascend; found 45 after 45");
    file.angles = "0 45 190\n0 90\n";
    expect(file, "4 lamp.ies:7: vertical angles run from 0 to 190; allowed: 0 to 180");
    file = {};
    file.tilt = "";
    expect(file, "4 lamp.ies: has no line that begins TILT=, which every LM-63 file has");
    EXPECT_EQ(error_of(""), "4 lamp.ies: is empty");
    EXPECT_NE(error_of("hello\n").find("neither IES LM-63"), std::string::npos);
}

TEST(Lm63, EveryTruncationIsAnErrorOrCompletesANumber) {
    Fixture file;
    file.tilt = "TILT=INCLUDE\n1\n2\n0 90\n1 .5\n";
    const std::string text = file.text();
    const std::size_t last_number = text.rfind('0');
    for (std::size_t size = 0; size < last_number; ++size)
        EXPECT_EQ(error_of(text.substr(0, size)).substr(0, 2), "4 ") << size;
    EXPECT_EQ(error_of(text.substr(0, last_number + 1)), "");
}

TEST(Lm63, LuminousOpeningsFollowTheEdition) {
    const auto opening = [](int edition, double width, double length, double height, int units = 2) {
        PhotometricFile file;
        Lm63Header header;
        header.edition = edition;
        header.width = width, header.length = length, header.height = height, header.units = units;
        file.header = header;
        return luminous_opening(file);
    };
    EXPECT_EQ(opening(2002, 0, 0, 0).shape, "point");
    EXPECT_EQ(opening(2002, .3, 1.2, 0).shape, "rectangle");
    EXPECT_EQ(opening(2002, .3, 1.2, 0).along_c0_m, 1.2);
    EXPECT_NEAR(opening(2002, 1, 2, 0, 1).along_c90_m, .3048, 1e-15);
    EXPECT_EQ(opening(2002, .3, 1.2, .1).shape, "box");
    EXPECT_EQ(opening(2002, -.2, -.2, 0).shape, "disk");
    EXPECT_EQ(opening(1991, -.2, 0, 0).shape, "disk");
    EXPECT_EQ(opening(1991, -.2, 0, 0).along_c0_m, .2);
    EXPECT_EQ(opening(2002, -.2, -.3, 0).shape, "ellipse");
    EXPECT_EQ(opening(2002, -.2, -.2, .1).shape, "vertical_cylinder");
    EXPECT_EQ(opening(2002, -.2, -.2, -.2).shape, "sphere");
    EXPECT_EQ(opening(1995, -.2, 0, -.2).shape, "sphere");
    EXPECT_EQ(opening(2002, -.2, 0, -.2).shape, "vertical_disk");
    EXPECT_EQ(opening(1995, 0, 1.2, -.03).shape, "horizontal_cylinder");
    EXPECT_EQ(opening(2019, -.03, 1.2, -.03).shape, "horizontal_cylinder");
    EXPECT_EQ(opening(1995, -.03, 1.2, -.03).shape, "ellipsoid");
}

}  // namespace
}  // namespace pbrbake::parse::test

// Real IES and LDT files, where they are at hand, against figures from another reader.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bakers/parse/grid.hpp"
#include "tests/bakers/parse/fixtures.hpp"

namespace pbrbake::parse::test {
namespace {

struct Expected {
    std::vector<std::string> cells;

    const std::string& file() const { return cells[0]; }
    bool is_ldt() const { return cells[1] == "LDT"; }
    bool is_refused() const {
        return cells[21].find("PARSE-FAIL") != std::string::npos ||
               cells[21].find("not-increasing") != std::string::npos;
    }
    double number(std::size_t column) const { return std::stod(cells[column]); }
    /// Half a unit of the last digit printed, or 1e-6 of the value.
    double tolerance(std::size_t column) const {
        const std::string& text = cells[column];
        const std::size_t point = text.find('.');
        const double digit =
            point == std::string::npos ? 1 : std::pow(10., -static_cast<double>(text.size() - point - 1));
        return std::max(.5001 * digit, 1e-6 * std::abs(number(column)));
    }
};

std::string range_of(const std::vector<double>& angles) {
    const auto text = [](double angle) { return std::to_string(static_cast<int>(std::lround(angle))); };
    return text(angles.front()) + ".." + text(angles.back());
}

/// As the table has it: "quadrant 0-90", "H 0..90 V -90..90", "Isym=2".
std::string symmetry_of(const PhotometricFile& file, const pbr::PhotometricWeb& web) {
    if (const EulumdatHeader* header = file.eulumdat()) return "Isym=" + std::to_string(header->symmetry);
    const std::string h = range_of(file.horizontal_deg);
    if (file.type != pbr::Photometry::type_c) return "H " + h + " V " + range_of(file.vertical_deg);
    switch (web.cover()) {
        case pbr::HorizontalCover::axial:
            return "axial";
        case pbr::HorizontalCover::ring:
            return "none 0-360";
        case pbr::HorizontalCover::range:
            return "none";
        case pbr::HorizontalCover::mirrored:
            break;
    }
    return h == "0..90" ? "quadrant 0-90" : h == "0..180" ? "bilateral 0-180" : "bilateral 90-270";
}

void expect_header(const Expected& expected, const PhotometricFile& file) {
    if (const Lm63Header* header = file.lm63()) {
        EXPECT_EQ(header->edition, expected.number(2));
        EXPECT_EQ(header->tilt                ? "INCLUDE"
                  : header->tilt_file.empty() ? "NONE"
                                              : header->tilt_file,
                  expected.cells[9]);
        EXPECT_EQ(header->units == 1 ? "ft" : "m", expected.cells[10]);
        EXPECT_EQ(header->multiplier, expected.number(11));
        EXPECT_EQ(header->ballast_factor, expected.number(12));
        EXPECT_EQ(header->field_12, expected.number(13));
        EXPECT_EQ(header->lamps, expected.number(14));
        EXPECT_EQ(header->lumens_per_lamp, expected.number(15));
    } else {
        const EulumdatHeader& ldt = *file.eulumdat();
        EXPECT_EQ("Ityp=" + std::to_string(ldt.type), expected.cells[2]);
        EXPECT_EQ(ldt.tilt_deg, expected.number(9));
        EXPECT_EQ(ldt.factor, expected.number(11));
        EXPECT_EQ(ldt.lamp_sets[0].count, expected.number(14));
        EXPECT_EQ(ldt.lamp_sets[0].flux_lm, expected.number(16));
    }
    EXPECT_EQ(watts(file), expected.number(17));
}

TEST(RealPhotometry, AgreesWithAnotherReaderOnEveryFile) {
    const auto folder = real_files();
    if (folder.empty()) GTEST_SKIP() << "no shared data: set PBRBAKE_SHARED_DATA to its folder";
    int read = 0, refused = 0;
    for (const auto& cells : read_table(folder / "expected.tsv")) {
        const Expected expected{cells};
        SCOPED_TRACE(expected.file());
        const std::string text = read_text(folder / expected.file());
        if (expected.is_refused()) {
            EXPECT_EQ(error_of(text).substr(0, 2), "4 ") << error_of(text);
            ++refused;
            continue;
        }
        const PhotometricFile file = parse(text, expected.file());
        std::vector<Diagnostic> diagnostics;
        const pbr::PhotometricWeb web = make_web(file, 0, diagnostics);
        EXPECT_EQ(static_cast<int>(file.vertical_deg.size()), std::stoi(cells[4]));
        EXPECT_EQ(static_cast<int>(file.horizontal_deg.size()), std::stoi(cells[5]));
        EXPECT_EQ(range_of(file.vertical_deg), cells[6]);
        EXPECT_EQ(range_of(file.horizontal_deg), cells[7]);
        EXPECT_EQ(std::string(1, "ABC"[static_cast<int>(file.type)]), cells[3]);
        EXPECT_EQ(symmetry_of(file, web), cells[8]);
        expect_header(expected, file);
        EXPECT_NEAR(web.max_cd(), expected.number(18), expected.tolerance(18));
        EXPECT_NEAR(web.flux_lm(pbr::FluxRule::exact), expected.number(19), expected.tolerance(19));
        if (!cells[20].empty()) {
            EXPECT_NEAR(web.flux_lm(pbr::FluxRule::zonal), expected.number(20), expected.tolerance(20));
        }
        EXPECT_EQ(!declared_flux_lm(file).has_value(), cells[21].find("absolute") != std::string::npos);
        ++read;
    }
    EXPECT_EQ(read, 37);
    EXPECT_EQ(refused, 2);
}

TEST(RealPhotometry, ExactFluxIsTheMakersLumens) {
    const auto folder = real_files();
    if (folder.empty()) GTEST_SKIP() << "no shared data: set PBRBAKE_SHARED_DATA to its folder";
    std::vector<double> differences;
    for (const auto& cells : read_table(folder / "vendor_lumens" / "expected.tsv")) {
        const PhotometricFile file = parse(read_text(folder / "vendor_lumens" / cells[0]), cells[0]);
        std::vector<Diagnostic> diagnostics;
        const double stated = std::stod(cells[6]);
        differences.push_back(std::abs(make_web(file, 0, diagnostics).flux_lm() - stated) / stated);
    }
    ASSERT_EQ(differences.size(), 26u);
    std::sort(differences.begin(), differences.end());
    EXPECT_LE((differences[12] + differences[13]) / 2, 1e-4);
    RecordProperty("median", std::to_string((differences[12] + differences[13]) / 2));
}

}  // namespace
}  // namespace pbrbake::parse::test

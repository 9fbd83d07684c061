#include "bakers/parse/grid.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr double kSlack_deg = 1e-3;  // files print angles to a few digits

bool near(double a, double b) { return std::abs(a - b) <= kSlack_deg; }

struct Range {
    double low, high;
};

void check_list(const std::vector<double>& angles, Range allowed, const char* which, std::string_view name,
                int line) {
    const auto fault = std::adjacent_find(angles.begin(), angles.end(), std::greater_equal<>());
    if (fault != angles.end())
        throw malformed(name, line,
                        std::string(which) + " angles must ascend; found " + number_text(fault[1]) +
                            " after " + number_text(fault[0]));
    if (angles.front() < allowed.low || angles.back() > allowed.high)
        throw malformed(name, line,
                        std::string(which) + " angles run from " + number_text(angles.front()) + " to " +
                            number_text(angles.back()) + std::string("; allowed: ") +
                            number_text(allowed.low) + " to " + number_text(allowed.high));
}

double meters_per_unit(const Lm63Header& header) { return header.units == 1 ? .3048 : 1; }

/// Shapes by the signs of width, length, height: LM-63-2002 and -19, table 1, and for what these leave out
/// the tables of 1986 to 1995, where a dimension of 0 takes over the one that carries a diameter.
std::string_view lm63_shape(const Lm63Header& header) {
    const auto sign = [](double x) { return x > 0 ? '+' : x < 0 ? '-' : '0'; };
    const std::string signs{sign(header.width), sign(header.length), sign(header.height)};
    const bool round = header.width == header.length, is_old = header.edition < 2002;
    if (signs == "000") return "point";
    if (signs == "--0") return round ? "disk" : "ellipse";
    if (signs == "-00" || signs == "0-0") return "disk";
    if (signs == "--+") return round ? "vertical_cylinder" : "vertical_elliptic_cylinder";
    if (signs == "-0+" || signs == "0-+") return "vertical_cylinder";
    if (signs == "---") return round && header.width == header.height ? "sphere" : "ellipsoid";
    if (signs == "-0-" || signs == "0--") return is_old ? "sphere" : "vertical_disk";
    if (signs == "0+-" || signs == "+0-") return "horizontal_cylinder";
    if (signs == "-+-" || signs == "+--") return is_old ? "ellipsoid" : "horizontal_cylinder";
    if (signs == "-++" || signs == "+-+" || signs == "-+0" || signs == "+-0") return "ellipse";
    if (signs.find('-') != signs.npos) return "unknown";
    return signs[2] == '+' ? "box" : "rectangle";
}

LuminousOpening opening_of(const Lm63Header& header) {
    LuminousOpening opening;
    opening.shape = lm63_shape(header);
    const double unit = meters_per_unit(header);
    opening.along_c0_m = std::abs(header.length) * unit;
    opening.along_c90_m = std::abs(header.width) * unit;
    opening.height_m = std::abs(header.height) * unit;
    // A dimension of 0 stands for the diameter that another one carries.
    const double diameter =
        std::max(header.width < 0 ? opening.along_c90_m : 0, header.length < 0 ? opening.along_c0_m : 0);
    if (opening.shape == "disk" || opening.shape == "vertical_cylinder" || opening.shape == "sphere")
        opening.along_c0_m = opening.along_c90_m = diameter;
    if (opening.shape == "horizontal_cylinder") {
        if (header.width == 0) opening.along_c90_m = opening.height_m;
        if (header.length == 0) opening.along_c0_m = opening.height_m;
    }
    return opening;
}

LuminousOpening opening_of(const EulumdatHeader& header) {
    constexpr double kMeter_mm = 1000;
    LuminousOpening opening;
    opening.along_c0_m = header.opening_width_mm / kMeter_mm;
    opening.along_c90_m = header.opening_length_mm / kMeter_mm;
    opening.height_m =
        *std::max_element(header.opening_height_mm.begin(), header.opening_height_mm.end()) / kMeter_mm;
    const bool round =
        opening.along_c0_m == 0 && opening.along_c90_m > 0;  // a width of 0: length is the diameter
    if (round) opening.along_c0_m = opening.along_c90_m;
    if (opening.along_c90_m > 0)
        opening.shape = round                  ? (opening.height_m > 0 ? "vertical_cylinder" : "disk")
                        : opening.height_m > 0 ? "box"
                                               : "rectangle";
    return opening;
}

}  // namespace

void check_angles(const PhotometricFile& file, std::string_view name, int vertical_line,
                  int horizontal_line) {
    const bool is_c = file.type == pbr::Photometry::type_c;
    const Range elevation{-90, 90}, azimuth{-180, 180};
    const Range vertical = is_c ? Range{0, 180} : file.type == pbr::Photometry::type_a ? elevation : azimuth;
    const Range horizontal = is_c                                   ? Range{-360, 720}
                             : file.type == pbr::Photometry::type_a ? azimuth
                                                                    : elevation;
    check_list(file.vertical_deg, vertical, "vertical", name, vertical_line);
    check_list(file.horizontal_deg, horizontal, "horizontal", name, horizontal_line);
    if (file.horizontal_deg.back() - file.horizontal_deg.front() > 360 + kSlack_deg)
        throw malformed(name, horizontal_line, "horizontal angles run over more than a full turn");
    if (file.vertical_deg.size() < 2)
        throw malformed(name, vertical_line, "has one vertical angle; at least 2 enclose light");
    if (!is_c && file.horizontal_deg.size() < 2)
        throw malformed(name, horizontal_line, "has one horizontal angle; types A and B need at least 2");
}

pbr::HorizontalCover horizontal_cover(const PhotometricFile& file, std::vector<Diagnostic>& diagnostics) {
    using pbr::HorizontalCover;
    const std::vector<double>& angles = file.horizontal_deg;
    const double first = angles.front(), span = angles.back() - first;
    if (file.type != pbr::Photometry::type_c)
        return near(first, 0) ? HorizontalCover::mirrored : HorizontalCover::range;
    if (angles.size() == 1) {
        if (!near(first, 0))
            diagnostics.push_back({Severity::note, "axial_angle", 0,
                                   std::string("has one horizontal angle, ") + number_text(first) +
                                       "; taken as axially symmetric"});
        return HorizontalCover::axial;
    }
    if (near(span, 360)) return HorizontalCover::ring;
    const bool from_quarter = near(std::remainder(first, 90), 0);
    if (from_quarter && (near(span, 90) || near(span, 180))) {
        const bool is_usual = near(first, 0) || (near(first, 90) && near(span, 180)) || file.eulumdat();
        if (!is_usual)
            diagnostics.push_back({Severity::warning, "unusual_span", 0,
                                   std::string("horizontal angles run from ") + number_text(first) + " to " +
                                       number_text(angles.back()) +
                                       "; taken as mirrored in both of these planes"});
        return HorizontalCover::mirrored;
    }
    double widest = 0;
    for (std::size_t i = 1; i < angles.size(); ++i) widest = std::max(widest, angles[i] - angles[i - 1]);
    const double gap = 360 - span;
    if (gap <= 1.5 * widest) {  // a ring that leaves out the plane it began with, evenly stepped or nearly so
        if (file.lm63())
            diagnostics.push_back({Severity::warning, "open_ring", 0,
                                   std::string("horizontal angles end at ") + number_text(angles.back()) +
                                       "; the ring is closed by wrapping"});
        return HorizontalCover::ring;
    }
    diagnostics.push_back({Severity::suspicion, "illegal_span", 0,
                           std::string("horizontal angles run from ") + number_text(first) + " to " +
                               number_text(angles.back()) + ", which no edition allows; dark outside"});
    return HorizontalCover::range;
}

double candela_scale(const PhotometricFile& file, std::size_t lamp_set) {
    if (const Lm63Header* header = file.lm63())
        return header->multiplier * header->ballast_factor * (header->edition <= 1991 ? header->field_12 : 1);
    const EulumdatHeader& header = *file.eulumdat();
    return header.lamp_sets[lamp_set].flux_lm / 1000 * header.factor;
}

std::optional<double> declared_flux_lm(const PhotometricFile& file, std::size_t lamp_set) {
    if (const Lm63Header* header = file.lm63()) {
        if (header->lumens_per_lamp < 0) return {};
        return std::abs(header->lamps) * header->lumens_per_lamp;
    }
    const LampSet& set = file.eulumdat()->lamp_sets[lamp_set];
    if (set.count < 0) return {};
    return set.flux_lm;
}

double watts(const PhotometricFile& file, std::size_t lamp_set) {
    return file.lm63() ? file.lm63()->watts : file.eulumdat()->lamp_sets[lamp_set].watts;
}

pbr::PhotometricWeb make_web(const PhotometricFile& file, std::size_t lamp_set,
                             std::vector<Diagnostic>& diagnostics) {
    const double scale = candela_scale(file, lamp_set);
    std::vector<double> candela = file.values;
    std::size_t negative = 0;
    double lowest = 0;
    for (double& value : candela) {
        value *= scale;
        if (value >= 0) continue;
        ++negative;
        lowest = std::min(lowest, value);
        value = 0;
    }
    if (negative > 0)
        diagnostics.push_back({Severity::suspicion, "negative_intensity", file.values_line,
                               std::string("has ") + std::to_string(negative) +
                                   std::string(" negative intensities, the lowest ") + number_text(lowest) +
                                   " cd; they became 0"});
    // Angles that round to a quarter turn are one, so that symmetry planes and poles close.
    std::vector<double> vertical = file.vertical_deg, horizontal = file.horizontal_deg;
    for (std::vector<double>* list : {&vertical, &horizontal})
        for (double* end : {&list->front(), &list->back()})
            if (const double quarter = 90 * std::round(*end / 90); near(*end, quarter)) *end = quarter;
    const pbr::HorizontalCover cover = horizontal_cover(file, diagnostics);
    if (cover == pbr::HorizontalCover::ring && near(horizontal.back() - horizontal.front(), 360))
        horizontal.back() = horizontal.front() + 360;
    return {file.type, cover, std::move(vertical), std::move(horizontal), std::move(candela)};
}

double tilt_factor(const TiltTable& table, double deg) {
    const std::vector<double>& angles = table.angles_deg;
    if (deg <= angles.front()) return table.factors.front();
    for (std::size_t i = 1; i < angles.size(); ++i)
        if (deg <= angles[i] && angles[i] > angles[i - 1])
            return table.factors[i - 1] + (table.factors[i] - table.factors[i - 1]) * (deg - angles[i - 1]) /
                                              (angles[i] - angles[i - 1]);
    return table.factors.back();
}

LuminousOpening luminous_opening(const PhotometricFile& file) {
    return file.lm63() ? opening_of(*file.lm63()) : opening_of(*file.eulumdat());
}

}  // namespace pbrbake::parse

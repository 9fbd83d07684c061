#include "bakers/ies/review.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "bakers/parse/grid.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::ies {
namespace {

using parse::Diagnostic;
using parse::number_text;
using parse::PhotometricFile;
using parse::Severity;

/// Two digits after the point are enough for messages.
std::string rounded(double value) { return number_text(std::round(value * 100) / 100); }

void review_efficiency(const PhotometricFile& file, std::size_t lamp_set, double flux,
                       std::vector<Diagnostic>& diagnostics) {
    constexpr double kSlack = 1.005;  // what printed digits and the flux rule may make
    const auto declared = parse::declared_flux_lm(file, lamp_set);
    const parse::Lm63Header* header = file.lm63();
    if (!declared) return;
    if (*declared <= 0) {
        diagnostics.push_back(
            {Severity::warning, "no_lamp_flux", 0,
             "declares a lamp flux of " + number_text(*declared) + " lm; efficiency can't be told"});
        return;
    }
    if (flux <= *declared * kSlack) return;
    diagnostics.push_back({Severity::suspicion, "efficiency", 0,
                           "emits " + rounded(flux) + " lm of the " + rounded(*declared) +
                               " lm its lamps have, " + rounded(100 * flux / *declared) + " %"});
    const double multiplier = header ? header->multiplier : 1;
    if (multiplier > 1 && flux / multiplier <= *declared * kSlack)
        diagnostics.push_back({Severity::suspicion, "double_multiplier", 0,
                               "would be below 100 % without its candela multiplier of " +
                                   number_text(multiplier) + ", which may have been applied before"});
}

/// The same factor in two fields, or in the multiplier and the lamp's lumens.
void review_factors(const PhotometricFile& file, std::vector<Diagnostic>& diagnostics) {
    const parse::Lm63Header* header = file.lm63();
    if (header && header->multiplier != 1 && header->multiplier == header->ballast_factor)
        diagnostics.push_back({Severity::suspicion, "double_multiplier", 0,
                               "has " + number_text(header->multiplier) +
                                   " both as candela multiplier and as ballast factor; both are applied, as "
                                   "the standard has it"});
}

void review_units(const PhotometricFile& file, std::vector<Diagnostic>& diagnostics) {
    const parse::Lm63Header* header = file.lm63();
    if (!header) return;
    constexpr std::array<std::string_view, 9> kRadiometric{"w/sr", "mw/sr",   "uw/",        "µw",   "w/m^2",
                                                           "mw/m", "radiant", "irradiance", "-> mw"};
    constexpr std::array<std::string_view, 5> kUltraviolet{"uvc", "uv-c", "uvb", "uva", "ultraviolet"};
    for (const parse::Keyword& keyword : header->keywords) {
        std::string text = keyword.value;
        std::transform(text.begin(), text.end(), text.begin(),
                       [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
        const auto holds = [&](std::string_view word) { return text.find(word) != text.npos; };
        if (std::any_of(kRadiometric.begin(), kRadiometric.end(), holds) ||
            std::any_of(kUltraviolet.begin(), kUltraviolet.end(), holds)) {
            diagnostics.push_back({Severity::suspicion, "radiometric_units", 0,
                                   "says " + parse::quoted(keyword.value) + " in [" + keyword.name +
                                       "]: its numbers may be no candela; they are taken as candela"});
            return;
        }
    }
}

/// All planes of type C meet in the poles, so they agree there.
void review_pole(const pbr::PhotometricWeb& web, std::vector<Diagnostic>& diagnostics) {
    if (web.type() != pbr::Photometry::type_c || web.vertical_deg().front() > 0) return;
    double low = web.grid_cd(0, 0), high = low;
    for (int h = 1; h < static_cast<int>(web.horizontal_deg().size()); ++h) {
        low = std::min(low, web.grid_cd(0, h));
        high = std::max(high, web.grid_cd(0, h));
    }
    if (high - low > .02 * web.max_cd())
        diagnostics.push_back(
            {Severity::warning, "nadir", 0,
             "planes disagree at the nadir: " + rounded(low) + " to " + rounded(high) + " cd; kept"});
}

void review_ring(const pbr::PhotometricWeb& web, std::vector<Diagnostic>& diagnostics) {
    const auto& angles = web.horizontal_deg();
    if (web.cover() != pbr::HorizontalCover::ring || angles.back() - angles.front() < 360) return;
    const int last = static_cast<int>(angles.size()) - 1;
    double difference = 0;
    for (int v = 0; v < static_cast<int>(web.vertical_deg().size()); ++v)
        difference = std::max(difference, std::abs(web.grid_cd(v, 0) - web.grid_cd(v, last)));
    if (difference > .02 * web.max_cd())
        diagnostics.push_back(
            {Severity::warning, "seam", 0,
             "planes 0 and 360 differ by up to " + rounded(difference) + " cd; kept, there is a seam"});
}

void review_eulumdat(const PhotometricFile& file, std::size_t lamp_set, double flux,
                     std::vector<Diagnostic>& diagnostics) {
    const parse::EulumdatHeader* header = file.eulumdat();
    if (!header || header->output_ratio_percent <= 0) return;
    const double found = 100 * flux / header->lamp_sets[lamp_set].flux_lm;
    if (std::abs(found - header->output_ratio_percent) > .02 * header->output_ratio_percent)
        diagnostics.push_back({Severity::warning, "output_ratio", 0,
                               "states a light output ratio of " + rounded(header->output_ratio_percent) +
                                   " %; its intensities make " + rounded(found) + " %"});
}

}  // namespace

void review(const PhotometricFile& file, std::size_t lamp_set, const pbr::PhotometricWeb& web,
            std::vector<Diagnostic>& diagnostics) {
    const double flux = web.flux_lm();
    if (flux <= 0) diagnostics.push_back({Severity::suspicion, "dark", 0, "has no light in any direction"});
    review_efficiency(file, lamp_set, flux, diagnostics);
    review_factors(file, diagnostics);
    review_units(file, diagnostics);
    review_pole(web, diagnostics);
    review_ring(web, diagnostics);
    review_eulumdat(file, lamp_set, flux, diagnostics);
}

}  // namespace pbrbake::ies

#include "bakers/ies/profile.hpp"

#include <algorithm>
#include <cmath>

#include "bakers/ies/review.hpp"
#include "bakers/parse/grid.hpp"
#include "bakers/parse/text.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::ies {
namespace {

constexpr double kRim_deg = 1e-6;

/// The share of its light that a web's sample on the rim of a range has: half, unless the range ends at a
/// pole.
double share_on_rim(double deg, double first, double last, double low_pole, double high_pole) {
    const bool on_first = std::abs(deg - first) < kRim_deg && first > low_pole + kRim_deg;
    const bool on_last = std::abs(deg - last) < kRim_deg && last < high_pole - kRim_deg;
    return on_first || on_last ? .5 : 1;
}

std::vector<double> scaled(std::vector<double> values, double factor) {
    for (double& value : values) value *= factor;
    return values;
}

/// The web with angles from the axis times `squash`, and intensities times `factor`.
pbr::PhotometricWeb reshaped(const pbr::PhotometricWeb& web, double squash, double factor) {
    std::vector<double> candela;
    candela.reserve(web.vertical_deg().size() * web.horizontal_deg().size());
    for (int h = 0; h < static_cast<int>(web.horizontal_deg().size()); ++h)
        for (int v = 0; v < static_cast<int>(web.vertical_deg().size()); ++v)
            candela.push_back(web.grid_cd(v, h) * factor);
    const double horizontal = web.type() == pbr::Photometry::type_c ? 1 : squash;
    return {web.type(), web.cover(), scaled(web.vertical_deg(), squash),
            scaled(web.horizontal_deg(), horizontal), std::move(candela)};
}

/// The file's lamp-tilt factor at the angle it hangs at. The table of TILT=FILE may be absent.
double lamp_tilt_factor(const IesParams& params, const Inputs& inputs, parse::PhotometricFile& file) {
    const parse::Lm63Header* header = file.lm63();
    if (!header) return 1;
    if (header->tilt) return parse::tilt_factor(*header->tilt, params.tilt_deg);
    if (header->tilt_file.empty()) return 1;
    if (const auto found = inputs.find("tilt"); found != inputs.end())
        return parse::tilt_factor(parse::parse_tilt(found->second.bytes, found->second.name),
                                  params.tilt_deg);
    file.diagnostics.push_back({parse::Severity::warning, "tilt_file", 0,
                                "names the tilt file " + parse::quoted(header->tilt_file) +
                                    ", which is not beside it; its factors are taken as 1"});
    return 1;
}

}  // namespace

Profile::Profile(pbr::PhotometricWeb web, double rotate_deg)
    : web_(web.type() == pbr::Photometry::type_c ? web.turned(rotate_deg) : std::move(web)),
      rotate_deg_(rotate_deg) {}

double Profile::sample_cd(double polar_deg, double azimuth_deg) const {
    if (!is_polar()) return sample_cd(direction_of(polar_deg, azimuth_deg));
    double share = rim_share(polar_deg);
    if (web_.cover() == pbr::HorizontalCover::range) {
        const double first = web_.horizontal_deg().front();
        const double along = azimuth_deg - 360 * std::floor((azimuth_deg - first + kRim_deg) / 360);
        share *= share_on_rim(along, first, web_.horizontal_deg().back(), -1e9, 1e9);
    }
    return share * web_.at_cd(polar_deg, azimuth_deg);
}

double Profile::rim_share(double polar_deg) const {
    return is_polar()
               ? share_on_rim(polar_deg, web_.vertical_deg().front(), web_.vertical_deg().back(), 0, 180)
               : 1;
}

double Profile::sample_cd(const pbr::Vec3<double>& direction) const {
    if (is_polar()) {
        const pbr::PhotometricAngles angles = pbr::photometric_angles(pbr::Photometry::type_c, direction);
        return sample_cd(angles.vertical_deg, angles.horizontal_deg);
    }
    const pbr::SinCos turn = pbr::sin_cos_pi(-rotate_deg_ / 180);
    const pbr::Vec3<double> turned(turn.cos * direction.x - turn.sin * direction.y,
                                   turn.sin * direction.x + turn.cos * direction.y, direction.z);
    const pbr::PhotometricAngles angles = pbr::photometric_angles(web_.type(), turned);
    const auto &v = web_.vertical_deg(), &h = web_.horizontal_deg();
    const double folded = web_.cover() == pbr::HorizontalCover::mirrored ? std::abs(angles.horizontal_deg)
                                                                         : angles.horizontal_deg;
    const double first = web_.cover() == pbr::HorizontalCover::mirrored ? -1e9 : h.front();
    // An elevation of +-90 is a pole, an azimuth never is.
    const bool is_a = web_.type() == pbr::Photometry::type_a;
    const double pole_v = is_a ? 90 : 1e9, pole_h = is_a ? 1e9 : 90;
    return share_on_rim(angles.vertical_deg, v.front(), v.back(), -pole_v, pole_v) *
           share_on_rim(folded, first, h.back(), first == -1e9 ? -1e9 : -pole_h, pole_h) *
           web_.at_cd(angles.vertical_deg, angles.horizontal_deg);
}

double Profile::lit_polar_deg() const {
    double lit = 0;
    for (int h = 0; h < static_cast<int>(web_.horizontal_deg().size()); ++h)
        for (int v = 0; v < static_cast<int>(web_.vertical_deg().size()); ++v) {
            // Light falls to 0 at the next grid point, so its neighbours count too.
            const int last = static_cast<int>(web_.vertical_deg().size()) - 1;
            const bool near_light = web_.grid_cd(v, h) > 0 || web_.grid_cd(std::max(v - 1, 0), h) > 0 ||
                                    web_.grid_cd(std::min(v + 1, last), h) > 0;
            if (!near_light) continue;
            const auto direction =
                pbr::photometric_direction(web_.type(), {web_.vertical_deg()[static_cast<std::size_t>(v)],
                                                         web_.horizontal_deg()[static_cast<std::size_t>(h)]});
            lit = std::max(lit, pbr::photometric_angles(pbr::Photometry::type_c, direction).vertical_deg);
        }
    return lit;
}

double Profile::max_within_cd(double polar_deg) const {
    double peak = 0;
    for (int h = 0; h < static_cast<int>(web_.horizontal_deg().size()); ++h)
        for (int v = 0; v < static_cast<int>(web_.vertical_deg().size()); ++v) {
            const auto direction =
                pbr::photometric_direction(web_.type(), {web_.vertical_deg()[static_cast<std::size_t>(v)],
                                                         web_.horizontal_deg()[static_cast<std::size_t>(h)]});
            if (pbr::photometric_angles(pbr::Photometry::type_c, direction).vertical_deg <=
                polar_deg + kRim_deg)
                peak = std::max(peak, web_.grid_cd(v, h));
        }
    return peak;
}

pbr::Vec3<double> direction_of(double polar_deg, double azimuth_deg) {
    return pbr::photometric_direction(pbr::Photometry::type_c, {polar_deg, azimuth_deg});
}

Luminaire read_luminaire(const IesParams& params, const Inputs& inputs) {
    const SourceImage& source = inputs.at("source");
    parse::PhotometricFile file = parse::parse_photometry(source.bytes, source.name);
    const auto set = static_cast<std::size_t>(params.lamp_set - 1);
    const std::size_t sets = file.eulumdat() ? file.eulumdat()->lamp_sets.size() : 1;
    if (set >= sets)
        throw Error(ExitCode::unreadable_input, source.name,
                    "has " + std::to_string(sets) + " lamp sets, and lamp_set asks for number " +
                        std::to_string(params.lamp_set));
    double factor = lamp_tilt_factor(params, inputs, file);
    std::vector<parse::Diagnostic> diagnostics = file.diagnostics;
    pbr::PhotometricWeb filed = parse::make_web(file, set, diagnostics);
    review(file, set, filed, diagnostics);
    const double flux = filed.flux_lm();
    if (params.lumens > 0) {
        if (flux <= 0)
            throw Error(ExitCode::unreadable_input, source.name,
                        "is dark, so it can't be scaled to " + parse::number_text(params.lumens) + " lm");
        factor = params.lumens / flux;
    }
    pbr::PhotometricWeb web = reshaped(filed, params.squash, factor);
    const double turn = params.rotate_deg + (params.c0 == C0::y ? 90 : 0);
    return {std::move(file), std::move(diagnostics), std::move(filed), Profile(std::move(web), turn), factor};
}

}  // namespace pbrbake::ies

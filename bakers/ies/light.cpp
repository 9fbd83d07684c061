#include "bakers/ies/light.hpp"

#include <cctype>
#include <cmath>
#include <numbers>

#include "bakers/parse/grid.hpp"
#include "bakers/parse/text.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::ies {
namespace {

constexpr double kPi = std::numbers::pi;

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kDigits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

/// The first number in a text that may be a colour temperature; where `needs_unit`, only one before a K.
std::optional<double> kelvin_in(std::string_view text, bool needs_unit) {
    const auto is_digit = [&](std::size_t i) {
        return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i]));
    };
    for (std::size_t i = 0; i < text.size();) {
        if (!is_digit(i)) {
            ++i;
            continue;
        }
        std::size_t end = i;
        while (is_digit(end)) ++end;
        const auto value = parse::number_of(text.substr(i, end - i));
        std::size_t after = end;
        while (after < text.size() && text[after] == ' ') ++after;
        const bool has_unit =
            after < text.size() && text[after] == 'K' &&
            !(after + 1 < text.size() && std::isalpha(static_cast<unsigned char>(text[after + 1])));
        // 1000 K (embers) to 25,000 K (blue sky).
        if (value && *value >= 1000 && *value <= 25000 && (has_unit || !needs_unit)) return value;
        i = end;
    }
    return {};
}

std::string format_name(const parse::PhotometricFile& file) {
    return file.lm63() ? "LM-63-" + std::to_string(file.lm63()->edition) : "EULUMDAT";
}

const char* cover_name(const pbr::PhotometricWeb& web) {
    switch (web.cover()) {
        case pbr::HorizontalCover::axial:
            return "axial";
        case pbr::HorizontalCover::mirrored:
            if (web.type() != pbr::Photometry::type_c) return "bilateral";
            return web.horizontal_deg().back() - web.horizontal_deg().front() > 135 ? "bilateral"
                                                                                    : "quadrant";
        case pbr::HorizontalCover::ring:
            return "none";
        case pbr::HorizontalCover::range:
            break;
    }
    return "part";
}

Json angles_json(const pbr::PhotometricWeb& web, double fraction) {
    return {pbr::beam_angle_deg(web, pbr::AxialPlane::c0, fraction),
            pbr::beam_angle_deg(web, pbr::AxialPlane::c90, fraction)};
}

/// Frostbite's two uses of a profile (Lagarde & de Rousiers 2014, "Photometric lights"): a mask over a
/// light whose power an artist sets, or the light's own intensity.
Json uses_json(double max_cd) {
    return {{"mask",
             {{"point_lm", 4 * kPi * max_cd},
              {"spot_lm", kPi * max_cd},
              {"meaning",
               "the power at which a point light (I = lm / 4 pi) or a spot light (I = lm / pi) times the "
               "texture over its largest value is this luminaire"}}},
            {"absolute",
             {{"intensity_cd", max_cd},
              {"meaning", "the texture over its largest value times this is the intensity in candela"}}}};
}

Json power_json(const parse::PhotometricFile& file, std::size_t set, double flux) {
    Json json = Json::object();
    if (const auto declared = parse::declared_flux_lm(file, set)) {
        json["lamp_lm"] = *declared;
        if (*declared > 0) json["efficiency"] = flux / *declared;
    }
    const double watts = parse::watts(file, set);
    if (watts > 0) {
        json["watts"] = watts;
        json["efficacy_lm_per_w"] = flux / watts;
    }
    return json;
}

Json keywords_json(const parse::PhotometricFile& file) {
    Json list = Json::array();
    if (const parse::Lm63Header* header = file.lm63())
        for (const parse::Keyword& keyword : header->keywords) list.push_back({keyword.name, keyword.value});
    if (const parse::EulumdatHeader* header = file.eulumdat())
        for (const auto& [name, value] :
             {std::pair<const char*, const std::string&>{"MANUFAC", header->company},
              {"TEST", header->report},
              {"LUMINAIRE", header->name},
              {"LUMCAT", header->number},
              {"ISSUEDATE", header->date}})
            if (!value.empty()) list.push_back({name, value});
    return list;
}

/// About the axis by `rotate`, then from -Z to the aim.
Json rotation_json(const IesParams& params) {
    const double turn = params.rotate_deg + (params.c0 == C0::y ? 90 : 0);
    const pbr::SinCos half = pbr::sin_cos_pi(turn / 360);  // +z is C's axis, seen from above
    if (params.aim == Aim::minus_z) return {0, 0, half.sin, half.cos};
    const double tilt =
        std::numbers::sqrt2 / 2;  // -90 degrees about x: (-tilt, 0, 0, tilt) times (0, 0, sin, cos)
    return {-tilt * half.cos, tilt * half.sin, tilt * half.sin, tilt * half.cos};
}

}  // namespace

std::optional<double> colour_temperature_k(const parse::PhotometricFile& file, std::size_t lamp_set) {
    if (const parse::EulumdatHeader* header = file.eulumdat()) {
        const parse::LampSet& set = header->lamp_sets[lamp_set];
        if (const auto kelvin = kelvin_in(set.colour, false)) return kelvin;
        return kelvin_in(set.type, true);
    }
    for (const parse::Keyword& keyword : file.lm63()->keywords) {
        const bool is_colour = keyword.name.find("COLORTEMP") != std::string::npos ||
                               keyword.name.find("CCT") != std::string::npos;
        if (is_colour)
            if (const auto kelvin = kelvin_in(keyword.value, false)) return kelvin;
    }
    for (const char* name : {"LAMP", "LAMPCAT", "LUMINAIRE", "LUMCAT", "OTHER"})
        if (const auto kelvin = kelvin_in(file.lm63()->value_of(name), true)) return kelvin;
    return {};
}

Json light_json(const IesParams& params, const Luminaire& luminaire, const std::string& source) {
    const pbr::PhotometricWeb& web = luminaire.profile.web();
    const auto set = static_cast<std::size_t>(params.lamp_set - 1);
    const double flux = web.flux_lm();
    const pbr::PhotometricAngles peak = web.max_angles();
    const parse::LuminousOpening opening = parse::luminous_opening(luminaire.file);
    Json json{{"version", 1},
              {"source", source},
              {"format", format_name(luminaire.file)},
              {"photometry", std::string(1, "ABC"[static_cast<std::size_t>(web.type())])},
              {"symmetry", cover_name(web)},
              {"flux_lm", flux},
              {"flux_zonal_lm", web.flux_lm(pbr::FluxRule::zonal)},
              {"max_cd", web.max_cd()},
              {"max_at", {{"vertical_deg", peak.vertical_deg}, {"horizontal_deg", peak.horizontal_deg}}},
              {"mean_cd", web.mean_cd()},
              {"beam_angle_deg", angles_json(web, .5)},
              {"field_angle_deg", angles_json(web, .1)},
              {"opening",
               {{"shape", opening.shape},
                {"along_c0_m", opening.along_c0_m},
                {"along_c90_m", opening.along_c90_m},
                {"height_m", opening.height_m}}},
              {"power", power_json(luminaire.file, set, flux / luminaire.lumen_factor)}};
    if (const auto kelvin = colour_temperature_k(luminaire.file, set)) json["colour_temperature_k"] = *kelvin;
    json["uses"] = uses_json(web.max_cd());
    json["orientation"] = {
        {"aim", enum_name(params.aim)}, {"c0", enum_name(params.c0)}, {"rotate_deg", params.rotate_deg}};
    json["keywords"] = keywords_json(luminaire.file);
    return json;
}

Json gltf_json(const IesParams& params, const Luminaire& luminaire, const std::string& source) {
    Json light{{"name", source},
               {"uri", "data:application/x-ies-lm-63;base64," +
                           base64(parse::write_lm63(luminaire.file,
                                                    static_cast<std::size_t>(params.lamp_set - 1)))}};
    Json node{{"name", source}, {"rotation", rotation_json(params)}};
    node["extensions"]["EXT_lights_ies"]["light"] = 0;
    if (luminaire.lumen_factor != 1)
        node["extensions"]["EXT_lights_ies"]["multiplier"] = luminaire.lumen_factor;
    Json document{{"asset", {{"version", "2.0"}, {"generator", "pbrbake"}}},
                  {"extensionsUsed", Json::array({"EXT_lights_ies"})}};
    document["extensions"]["EXT_lights_ies"]["lights"] = Json::array({light});
    document["nodes"] = Json::array({node});
    document["scenes"] = Json::array({Json{{"nodes", Json::array({0})}}});
    document["scene"] = 0;
    return document;
}

}  // namespace pbrbake::ies

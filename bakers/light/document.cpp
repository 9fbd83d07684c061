#include "bakers/light/document.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>

#include "bakers/parse/text.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::light {
namespace {

using parse::LightType;
using parse::number_text;

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kCurvePoints = 17;

const char* severity_name(parse::Severity severity) {
    return severity == parse::Severity::note      ? "note"
           : severity == parse::Severity::warning ? "warning"
                                                  : "suspicion";
}

const char* type_name(LightType type) {
    constexpr std::array kNames{"point", "spot", "directional", "ambient", "sphere", "rectangle"};
    return kNames[static_cast<std::size_t>(type)];
}

const char* shape_name(const ConvertedLight& light) {
    if (light.type == LightType::rectangle) return "rectangle";
    constexpr std::array kNames{"point", "sphere", "disk", "rectangle"};
    return kNames[static_cast<std::size_t>(light.fit->light.shape)];
}

Json vector_json(const glm::dvec3& v) { return {rounded(v.x), rounded(v.y), rounded(v.z)}; }

Json diagnostics_json(const std::vector<parse::Diagnostic>& list) {
    Json json = Json::array();
    for (const parse::Diagnostic& d : list) {
        Json entry{{"severity", severity_name(d.severity)}, {"code", d.code}};
        if (d.line > 0) entry["line"] = d.line;
        entry["message"] = d.message;
        json.push_back(std::move(entry));
    }
    return json;
}

Json colour_json(const ConvertedLight& light) {
    Json json{{"rgb_linear", vector_json(light.rgb)}};
    if (light.temperature) {
        constexpr double kMeaningful = .05;  // CIE 15:2004, 9.5
        json["temperature_k"] = rounded(light.temperature->temperature_k);
        json["tint_duv"] = rounded(light.temperature->duv);
        json["temperature_is_meaningful"] = std::abs(light.temperature->duv) <= kMeaningful;
    }
    return json;
}

Json end_json(double radius) { return std::isfinite(radius) ? Json(rounded(radius)) : Json(nullptr); }

Json error_json(const pbr::StopsError& error) {
    return {{"rms", rounded(error.rms)}, {"max", rounded(error.max)}, {"max_at_m", rounded(error.max_at)}};
}

/// Illuminance before and after over the span, in equal steps of the logarithm of distance.
Json curve_json(const ConvertedLight& light) {
    Json curve = Json::array();
    const double ratio = pbr::log_exact(light.span_m.far / light.span_m.near);
    for (int i = 0; i < kCurvePoints; ++i) {
        const double d = light.span_m.near * pbr::exp_exact(ratio * i / (kCurvePoints - 1));
        const double legacy = light.law_lx * pbr::falloff_at(light.law, d),
                     fitted = pbr::illuminance_at(light.fit->light, d);
        Json point{rounded(d), rounded(legacy), rounded(fitted)};
        point.push_back(legacy > 0 && fitted > 0 ? Json(rounded(pbr::log2_exact(fitted / legacy)))
                                                 : Json(nullptr));
        curve.push_back(std::move(point));
    }
    return curve;
}

Json fit_json(const ConvertedLight& light) {
    Json json{{"law", law_text(light.law)},
              {"kind", law_kind(light.law)},
              {"law_illuminance_lx", rounded(light.law_lx)},
              {"exact", light.fit->is_exact},
              {"near_m", rounded(light.span_m.near)},
              {"far_m", rounded(light.span_m.far)},
              {"stops", error_json(light.fit->error)},
              {"stops_as_point", error_json(light.point->error)},
              {"stops_in_gltf", error_json(light.gltf->error)}};
    json["curve"] = {{"columns", {"distance_m", "legacy_lx", "fitted_lx", "stops"}},
                     {"rows", curve_json(light)}};
    return json;
}

Json spot_json(const ConvertedLight& light) {
    return {{"inner_half_angle_deg", rounded(light.spot->inner_rad / kDegree)},
            {"outer_half_angle_deg", rounded(light.spot->outer_rad / kDegree)},
            {"exact", light.spot->is_exact},
            {"rms_share_of_axis", rounded(light.spot->rms_share)},
            {"max_share_of_axis", rounded(light.spot->max_share)},
            {"flux_stops", rounded(light.spot->flux_stops)}};
}

double headroom_stops(const ConvertedLight& light) {
    double peak = light.illuminance_lx;
    if (light.fit)
        peak = std::max({peak, light.fit->light.intensity, light.luminance_nit,
                         pbr::illuminance_at(light.fit->light, light.span_m.near)});
    return peak > 0 ? pbr::log2_exact(kHalfMax / peak) : 0;
}

Json light_json(const ConvertedLight& light) {
    Json json{{"name", light.name}, {"type", type_name(light.type)}};
    if (light.line > 0) json["line"] = light.line;
    json["fill"] = light.is_fill;
    json["negative"] = light.is_negative;
    json["colour"] = colour_json(light);
    if (light.type != LightType::directional && light.type != LightType::ambient)
        json["position_m"] = vector_json(light.position_m);
    if (light.type == LightType::spot || light.type == LightType::directional ||
        light.type == LightType::rectangle)
        json["direction"] = vector_json(light.direction);
    if (light.fit) {
        const pbr::PhysicalLight& fitted = light.fit->light;
        json["shape"] = shape_name(light);
        json["intensity_cd"] = rounded(fitted.intensity);
        json["flux_lm"] = rounded(light.flux_lm);
        json["source_radius_m"] = rounded(fitted.radius);
        if (light.luminance_nit > 0) json["luminance_cd_m2"] = rounded(light.luminance_nit);
        if (light.width_m > 0) json["size_m"] = {rounded(light.width_m), rounded(light.height_m)};
        json["attenuation_radius_m"] = end_json(fitted.attenuation_radius);
        json["window"] = fitted.window == pbr::LightWindow::quartic ? "quartic" : "quartic_squared";
        json["reach_m"] = rounded(light.span_m.far / .9);
    } else {
        json["illuminance_lx"] = rounded(light.illuminance_lx);
    }
    if (light.spot) json["spot"] = spot_json(light);
    if (light.fit) json["falloff"] = fit_json(light);
    json["headroom_stops"] = rounded(headroom_stops(light));
    json["flags"] = diagnostics_json(light.flags);
    return json;
}

/// Turns -Z to a unit vector: the half-way quaternion, normalised.
Json rotation_json(const glm::dvec3& to) {
    const double w = 1 - to.z;  // 1 + dot(-Z, to)
    if (w < 1e-12) return {0, 1, 0, 0};
    // cross(-Z, to)
    const double x = to.y, y = -to.x, length = std::sqrt(x * x + y * y + w * w);
    return {rounded(x / length), rounded(y / length), 0, rounded(w / length)};
}

Json gltf_light(const ConvertedLight& light) {
    const double largest = std::max({light.rgb.x, light.rgb.y, light.rgb.z});
    Json json{{"name", light.name}};
    // A colour's components end at 1, and the intensity is times the colour, so that it grows as they shrink.
    json["color"] = vector_json(light.rgb / largest);
    if (light.type == LightType::directional) {
        json["type"] = "directional";
        json["intensity"] = rounded(light.illuminance_lx * largest);
        return json;
    }
    const pbr::PhysicalLight& fitted = light.gltf->light;
    json["type"] = light.spot ? "spot" : "point";
    json["intensity"] = rounded(fitted.intensity * largest);
    if (std::isfinite(fitted.attenuation_radius)) json["range"] = rounded(fitted.attenuation_radius);
    if (light.spot) {
        // glTF wants the inner angle below the outer one,
        // and the outer one at most pi / 2, which nine digits would round up.
        const double outer = std::clamp(light.spot->outer_rad, 1e-6, 1.5707963);
        json["spot"] = {{"innerConeAngle", rounded(std::min(light.spot->inner_rad, outer * (1 - 1e-6)))},
                        {"outerConeAngle", rounded(outer)}};
    }
    Json extras{{"shape", shape_name(light)},
                {"source_radius_m", rounded(light.fit->light.radius)},
                {"intensity_cd", rounded(light.fit->light.intensity)},
                {"attenuation_radius_m", end_json(light.fit->light.attenuation_radius)},
                {"stops_rms", rounded(light.fit->error.rms)},
                {"gltf_stops_rms", rounded(light.gltf->error.rms)}};
    if (light.temperature) {
        extras["temperature_k"] = rounded(light.temperature->temperature_k);
        extras["tint_duv"] = rounded(light.temperature->duv);
    }
    json["extras"] = std::move(extras);
    return json;
}

}  // namespace

double rounded(double value) {
    if (value == 0 || !std::isfinite(value)) return value == 0 ? 0 : value;
    std::array<char, 40> buffer;
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::scientific, 8)
            .ptr;
    double back = value;
    std::from_chars(buffer.data(), end, back);
    return back;
}

std::string law_kind(const pbr::Falloff& law) {
    std::string base;
    if (law.power > 0) {
        base = law.power == 2 ? "inverse square" : law.power == 1 ? "inverse" : "power";
    } else {
        const bool c = law.constant > 0, l = law.linear > 0, q = law.quadratic > 0;
        base = q && !l && !c   ? "inverse square"
               : l && !q && !c ? "inverse"
               : q && !l       ? "constant and quadratic"
               : l && !q       ? "constant and linear"
               : l             ? "sum of all three"
                               : "constant";
    }
    if (!pbr::has_range(law)) return base;
    constexpr std::array kWindows{
        "", "cut", "ramp", "smoothstep", "smootherstep", "quartic window", "squared quartic window"};
    const std::string window = kWindows[static_cast<std::size_t>(law.window)];
    const std::string power =
        law.window == pbr::FalloffWindow::ramp && law.exponent != 1 ? "power of a " : "";
    return (base == "constant" ? "" : base + ", ") + power + (window == "ramp" ? "linear ramp" : window);
}

std::string law_text(const pbr::Falloff& law) {
    const auto n = [](double value) { return number_text(rounded(value)); };
    std::string text;
    if (law.power > 0) {
        const std::string power = "d^" + n(law.power);
        text = "1 / " + (law.floor > 0 ? "max(" + power + ", " + n(law.floor) + ")" : power);
    } else {
        std::string sum;
        const auto add = [&](double value, const char* of) {
            if (value <= 0) return;
            const bool is_plain = value == 1 && *of != 0;
            sum += sum.empty() ? "" : " + ";
            sum += is_plain ? of : n(value) + (*of == 0 ? "" : " ") + of;
        };
        add(law.constant, "");
        add(law.linear, "d");
        add(law.quadratic, "d^2");
        const bool is_sum = sum.find(' ') != sum.npos;
        text = sum.empty() || sum == "1" ? "1" : is_sum ? "1 / (" + sum + ")" : "1 / " + sum;
    }
    if (!pbr::has_range(law)) return text;
    const std::string range = n(law.range);
    const std::string ramp = law.begin > 0 ? "sat((" + range + " - d) / " + n(law.range - law.begin) + ")"
                                           : "sat(1 - d / " + range + ")";
    std::string window;
    switch (law.window) {
        case pbr::FalloffWindow::none:
            break;
        case pbr::FalloffWindow::cut:
            window = "(d < " + range + ")";
            break;
        case pbr::FalloffWindow::ramp:
            window = ramp + (law.exponent == 1 ? "" : "^" + n(law.exponent));
            break;
        case pbr::FalloffWindow::smoothstep:
            window = "smoothstep(" + ramp + ")";
            break;
        case pbr::FalloffWindow::smootherstep:
            window = "smootherstep(" + ramp + ")";
            break;
        case pbr::FalloffWindow::quartic:
            window = "sat(1 - (d / " + range + ")^4)";
            break;
        case pbr::FalloffWindow::quartic_squared:
            window = "sat(1 - (d / " + range + ")^4)^2";
            break;
    }
    return text == "1" ? window : text + " " + window;
}

Json lights_json(const ConvertedFile& file) {
    Json json{{"version", 1}, {"source", file.source}, {"format", file.format}};
    json["units"] = {{"meaning_of_1", file.meaning},
                     {"length_m", rounded(file.anchor.unit_m)},
                     {"length_is_stated", file.unit_is_stated},
                     {"axes", "right-handed, y up"}};
    json["anchor"] = {{"applies", file.is_anchored},
                      {"ev100", rounded(file.ev100)},
                      {"reference_illuminance_lx", rounded(file.anchor.reference_lx)},
                      {"meaning",
                       "a relative 1 is the illuminance under which a white Lambertian surface comes out at "
                       "pixel value 1 at this EV, exposed by saturation"}};
    json["lights"] = Json::array();
    for (const ConvertedLight& light : file.lights) json["lights"].push_back(light_json(light));
    json["diagnostics"] = diagnostics_json(file.diagnostics);
    return json;
}

Json gltf_json(const ConvertedFile& file) {
    Json document{{"asset", {{"version", "2.0"}, {"generator", "pbrbake"}}}};
    Json lights = Json::array(), nodes = Json::array(), roots = Json::array(), left_out = Json::array();
    for (const ConvertedLight& light : file.lights) {
        if (!light.is_punctual()) {
            left_out.push_back(light.name);
            continue;
        }
        Json node{{"name", light.name}};
        if (light.type != LightType::directional) node["translation"] = vector_json(light.position_m);
        if (light.spot || light.type == LightType::directional || light.type == LightType::rectangle)
            node["rotation"] = rotation_json(light.direction);
        node["extensions"]["KHR_lights_punctual"]["light"] = lights.size();
        roots.push_back(nodes.size());
        lights.push_back(gltf_light(light));
        nodes.push_back(std::move(node));
    }
    Json scene = Json::object();
    if (!lights.empty()) {
        document["extensionsUsed"] = {"KHR_lights_punctual"};
        document["extensions"]["KHR_lights_punctual"]["lights"] = std::move(lights);
        document["nodes"] = std::move(nodes);
        scene["nodes"] = std::move(roots);
    }
    if (!left_out.empty()) scene["extras"]["left_out"] = std::move(left_out);
    document["scenes"] = Json::array({std::move(scene)});
    document["scene"] = 0;
    return document;
}

}  // namespace pbrbake::light

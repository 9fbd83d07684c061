#include <algorithm>
#include <cmath>

#include "bakers/formats.hpp"
#include "bakers/ies/ies.hpp"
#include "bakers/ies/light.hpp"
#include "bakers/ies/pictures.hpp"
#include "bakers/ies/resolution.hpp"
#include "bakers/ies/unit.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::ies {
namespace {

const char* severity_name(parse::Severity severity) {
    return severity == parse::Severity::note      ? "note"
           : severity == parse::Severity::warning ? "warning"
                                                  : "suspicion";
}

Json diagnostics_json(const std::vector<parse::Diagnostic>& diagnostics) {
    Json list = Json::array();
    for (const parse::Diagnostic& diagnostic : diagnostics) {
        Json entry{{"severity", severity_name(diagnostic.severity)}, {"code", diagnostic.code}};
        if (diagnostic.line > 0) entry["line"] = diagnostic.line;
        entry["message"] = diagnostic.message;
        list.push_back(std::move(entry));
    }
    return list;
}

Json texture_json(const IesParams& params, const Rendered& rendered, const Profile& profile, double unit_cd) {
    const Layout& layout = rendered.layout;
    Json json{{"projection", enum_name(params.projection)},
              {"size", {layout.x.count, layout.y.count}},
              {"align", layout.x.ends ? "ends" : "center"},
              {"normalise", enum_name(params.normalise)},
              {"candela_per_unit", unit_cd}};
    if (layout.projection == Projection::cookie) json["cone_deg"] = 2 * layout.half_cone_deg;
    json["folded"] = layout.is_folded;
    json["lookup"] = lookup_text(layout, profile);
    return json;
}

void warn(const Luminaire& luminaire, const std::string& name, Product& product) {
    for (const parse::Diagnostic& diagnostic : luminaire.diagnostics) {
        if (diagnostic.severity == parse::Severity::note) continue;
        std::string text = name;
        if (diagnostic.line > 0) text.append(":").append(std::to_string(diagnostic.line));
        product.warnings.push_back(text + ": " + diagnostic.message);
    }
}

/// Two digits: "1.3 %".
std::string percent(double share) { return parse::number_text(std::round(share * 1000) / 10) + " %"; }

Document document_of(DocumentKind kind, const IesParams& params, const Luminaire& luminaire,
                     const std::string& name) {
    const std::string suffix = document_suffix(kind);
    switch (kind) {
        case DocumentKind::light:
            return {suffix, light_json(params, luminaire, name), ""};
        case DocumentKind::gltf:
            return {suffix, gltf_json(params, luminaire, name), ""};
        case DocumentKind::polar:
            return {suffix, nullptr, polar_svg(luminaire.profile)};
        case DocumentKind::sphere:
            return {suffix, nullptr, sphere_svg(luminaire.profile)};
        case DocumentKind::page:
            break;
    }
    return {suffix, nullptr, page_html(params, luminaire, name)};
}

}  // namespace

std::string document_suffix(DocumentKind kind) {
    switch (kind) {
        case DocumentKind::light:
            return "light.json";
        case DocumentKind::gltf:
            return "gltf";
        case DocumentKind::polar:
            return "polar.svg";
        case DocumentKind::sphere:
            return "sphere.svg";
        case DocumentKind::page:
            break;
    }
    return "html";
}

double unit_candela(Normalise normalise, const pbr::PhotometricWeb& web) {
    switch (normalise) {
        case Normalise::max:
            return web.max_cd();
        case Normalise::mean:
            return web.mean_cd();
        case Normalise::flux:
            return web.flux_lm();
        case Normalise::candela:
            break;
    }
    return 1;
}

std::vector<Mistake> check(const IesParams& params, const std::string& format) {
    std::vector<Mistake> mistakes;
    const Format* container = find_format(format);
    if (params.projection == Projection::cube && container && !container->is_chain)
        mistakes.push_back(
            {"/format", "found \"" + format + "\", which holds no cube map; allowed: exr, ktx2, dds"});
    const bool is_square = params.projection == Projection::cube ||
                           params.projection == Projection::octahedral ||
                           params.projection == Projection::cookie;
    if (params.size.size() > 1 && params.size[0] != params.size[1] && is_square)
        mistakes.push_back({"/size", std::string("found two sizes; allowed for ") +
                                         std::string(enum_name(params.projection)) + ": one, its side"});
    if (params.size.size() > 1 && (params.size[0] == 0) != (params.size[1] == 0))
        mistakes.push_back({"/size", "found one size of 0; allowed: both 0, chosen by error, or none"});
    return mistakes;
}

std::vector<Read> reads(const IesParams& params) { return {{"source", params.source, "", Read::As::text}}; }

std::vector<Read> follow(const Inputs& inputs) {
    const SourceImage& source = inputs.at("source");
    const parse::PhotometricFile file = parse::parse_photometry(source.bytes, source.name);
    if (!file.lm63() || file.lm63()->tilt_file.empty()) return {};
    return {{"tilt", file.lm63()->tilt_file, "", Read::As::text}};
}

std::vector<std::string> documents(const IesParams& params) {
    std::vector<std::string> suffixes;
    for (const DocumentKind kind : params.documents) suffixes.push_back(document_suffix(kind));
    return suffixes;
}

Product bake(const IesParams& params, const Inputs& inputs, Context& context) {
    const Luminaire luminaire = read_luminaire(params, inputs);
    const std::string& name = inputs.at("source").name;
    Rendered rendered = render_at_best_size(params, luminaire.profile, context);

    const pbr::PhotometricWeb& web = luminaire.profile.web();
    const double unit_cd = unit_candela(params.normalise, web);
    if (unit_cd > 0)
        for (float& texel : rendered.image.levels.front().texels) texel = static_cast<float>(texel / unit_cd);
    // The texels' own scale stays as the normalisation says; the factor makes up for what interpolation
    // changes.
    const double correction =
        params.flux_exact && rendered.decoded.flux > 0 ? rendered.truth.flux / rendered.decoded.flux : 1;

    Product product;
    product.properties["flux_lm"] = web.flux_lm();
    product.properties["flux_zonal_lm"] = web.flux_lm(pbr::FluxRule::zonal);
    product.properties["max_cd"] = web.max_cd();
    product.properties["texture"] = texture_json(params, rendered, luminaire.profile, unit_cd * correction);
    product.properties["diagnostics"] = diagnostics_json(luminaire.diagnostics);
    const std::string base = name.substr(name.find_last_of("/\\") + 1);  // products hold no folders
    for (const DocumentKind kind : params.documents)
        product.documents.push_back(document_of(kind, params, luminaire, base));
    warn(luminaire, name, product);
    if (params.projection == Projection::axial && web.cover() != pbr::HorizontalCover::axial)
        product.warnings.push_back(
            name +
            ": is not axially symmetric; the texture holds the mean over azimuth, which keeps the flux");
    if (!rendered.is_within)
        product.warnings.push_back(name + ": max_size " + std::to_string(params.max_size) +
                                   " leaves the decoded flux off by " + percent(rendered.flux_error()) +
                                   " and the peak by " + percent(rendered.peak_error()));
    product.units = params.normalise == Normalise::candela ? "cd" : "relative";
    product.images.push_back(std::move(rendered.image));
    return product;
}

}  // namespace pbrbake::ies

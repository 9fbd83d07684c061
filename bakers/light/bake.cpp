#include <algorithm>
#include <set>

#include "bakers/light/converted_file.hpp"
#include "bakers/light/light.hpp"

namespace pbrbake::light {
namespace {

std::string place_of(const std::string& source, const ConvertedLight& light) {
    std::string place = source;
    if (light.line > 0) place.append(":").append(std::to_string(light.line));
    return place.append(": \"").append(light.name).append("\" ");
}

/// One warning a kind and file: the first light's, and how many others have it too.
void warn_of_lights(const ConvertedFile& file, const std::string& source, Product& product) {
    struct Kind {
        std::string code, first;
        std::size_t lights = 0;
    };
    std::vector<Kind> kinds;
    for (const ConvertedLight& light : file.lights) {
        std::set<std::string_view> told;
        for (const parse::Diagnostic& d : light.flags) {
            if (d.severity == parse::Severity::note || !told.insert(d.code).second) continue;
            auto kind = std::ranges::find(kinds, d.code, &Kind::code);
            if (kind == kinds.end())
                kind = kinds.insert(kind, {d.code, place_of(source, light) + d.message, 0});
            ++kind->lights;
        }
    }
    for (const Kind& kind : kinds) {
        const std::size_t others = kind.lights - 1;
        product.warnings.push_back(kind.first +
                                   (others > 1   ? " (" + std::to_string(others) + " other lights likewise)"
                                    : others > 0 ? " (1 other light likewise)"
                                                 : ""));
    }
}

void warn(const ConvertedFile& file, const std::string& source, Product& product) {
    for (const parse::Diagnostic& d : file.diagnostics)
        if (d.severity != parse::Severity::note) product.warnings.push_back(source + ": " + d.message);
    warn_of_lights(file, source, product);
    if (file.lights.empty()) product.warnings.push_back(source + ": holds no lights");
}

Json summary_json(const ConvertedFile& file) {
    const auto count = [&](const auto& is) {
        return std::count_if(file.lights.begin(), file.lights.end(), is);
    };
    return {{"format", file.format},
            {"count", file.lights.size()},
            {"fitted", count([](const ConvertedLight& l) { return l.fit.has_value(); })},
            {"fill", count([](const ConvertedLight& l) { return l.is_fill; })},
            {"dark", count([](const ConvertedLight& l) { return l.is_dark; })},
            {"reference_illuminance_lx", rounded(file.anchor.reference_lx)}};
}

}  // namespace

std::vector<Mistake> check(const LightParams& params, const std::string& format) {
    std::vector<Mistake> mistakes;
    if (params.unit_cd > 0 && params.reference_illuminance_lx > 0)
        mistakes.push_back(
            {"/unit_cd", "found one beside reference_illuminance_lx; allowed: one of the two"});
    if (params.near_m > 0 && params.far_m > 0 && params.near_m >= params.far_m)
        mistakes.push_back({"/near_m", "found one that isn't below far_m"});
    const std::vector<std::string> written = documents(params);
    if (std::find(written.begin(), written.end(), format) == written.end())
        mistakes.push_back({"/documents", "found none of the bake's format, \"" + format +
                                              "\"; allowed: those that hold it, as it is the product"});
    return mistakes;
}

std::vector<Read> reads(const LightParams& params) { return {{"source", params.source, "", Read::As::text}}; }

std::vector<std::string> documents(const LightParams& params) {
    std::vector<std::string> suffixes;
    for (const DocumentKind kind : params.documents) suffixes.emplace_back(enum_name(kind));
    return suffixes;
}

Product bake(const LightParams& params, const Inputs& inputs, Context& context) {
    const SourceImage& source = inputs.at("source");
    const ConvertedFile file = convert_file(params, source, context, Fits::made);
    context.count("lights", file.lights.size());
    Product product;
    product.units = "photometric";
    product.properties["lights"] = summary_json(file);
    for (const DocumentKind kind : params.documents)
        product.documents.push_back({std::string(enum_name(kind)),
                                     kind == DocumentKind::json ? lights_json(file) : gltf_json(file), ""});
    warn(file, source.name, product);
    return product;
}

}  // namespace pbrbake::light

// What is known of a conversion's error: the numbers as written, read back from the product, against the laws
// of the source, in stops over distance.

#include <algorithm>
#include <cmath>
#include <map>

#include "bakers/light/converted_file.hpp"
#include "bakers/light/light.hpp"

namespace pbrbake::light {
namespace {

/// A light as a document tells it.
pbr::PhysicalLight written_light(const Json& light) {
    pbr::PhysicalLight written;
    const std::string shape = light["shape"];
    written.shape = shape == "disk"                                     ? pbr::EmitterShape::disk
                    : shape == "sphere"                                 ? pbr::EmitterShape::sphere
                    : shape == "rectangle" && !light.contains("size_m") ? pbr::EmitterShape::rectangle
                                                                        : pbr::EmitterShape::point;
    written.window =
        light["window"] == "quartic" ? pbr::LightWindow::quartic : pbr::LightWindow::quartic_squared;
    written.intensity = light["intensity_cd"];
    written.radius = light["source_radius_m"];
    if (!light["attenuation_radius_m"].is_null()) written.attenuation_radius = light["attenuation_radius_m"];
    return written;
}

pbr::PhysicalLight written_gltf(const Json& light, const glm::dvec3& rgb) {
    pbr::PhysicalLight written;
    written.window = pbr::LightWindow::quartic;
    // Its colour's largest component is 1: the intensity is that component's.
    written.intensity = light["intensity"].get<double>() / std::max({rgb.x, rgb.y, rgb.z});
    if (light.contains("range")) written.attenuation_radius = light["range"];
    return written;
}

struct Worst {
    double rms = 0, max = 0;
    std::string name;
    std::size_t lights = 0;

    void take(const pbr::StopsError& error, const std::string& light) {
        ++lights;
        max = std::max(max, error.max);
        if (error.rms < rms && lights > 1) return;
        rms = error.rms;
        name = light;
    }
};

Figure measured(std::string metric, double value, std::string method) {
    return {std::move(metric), value, Evidence::measured, std::move(method), {}, {}};
}

const Json* document(const Product& product, std::string_view suffix) {
    for (const Document& found : product.documents)
        if (found.suffix == suffix) return &found.json;
    return nullptr;
}

}  // namespace

Certificate certify(const LightParams& params, const Inputs& inputs, const Product& product,
                    Context& context) {
    const ConvertedFile file = convert_file(params, inputs.at("source"), context);
    const int count = context.certify_fully() ? 4096 : 512;
    Worst all, gltf;
    std::map<std::string, Worst> kinds;
    double cone = 0;
    const Json *written = document(product, "json"), *scene = document(product, "gltf");
    std::size_t punctual = 0;
    for (std::size_t i = 0; i < file.lights.size(); ++i) {
        context.check_cancelled();
        const ConvertedLight& light = file.lights[i];
        const bool is_in_scene = light.is_punctual();
        if (light.fit) {
            const pbr::PhysicalLight found =
                written ? written_light((*written)["lights"][i]) : light.fit->light;
            const pbr::StopsError error =
                pbr::stops_between(found, light.law, light.law_lx, light.span_m, count);
            all.take(error, light.name);
            kinds[law_kind(light.law)].take(error, light.name);
            if (scene && is_in_scene) {
                const Json& told = (*scene)["extensions"]["KHR_lights_punctual"]["lights"][punctual];
                gltf.take(pbr::stops_between(written_gltf(told, light.rgb), light.law, light.law_lx,
                                             light.span_m, count),
                          light.name);
            }
        }
        if (light.spot) cone = std::max(cone, light.spot->rms_share);
        if (is_in_scene) ++punctual;
    }
    context.count("certify.distances", all.lights * static_cast<std::size_t>(count));

    const std::string over = " over " + std::to_string(count) + " distances at which the light matters";
    Certificate certificate;
    certificate.headline = measured(
        "stops_rms", all.rms,
        all.lights == 0 ? "no light fades with distance"
                        : "root mean square of stops between the source's law and the numbers written," +
                              over + "; the worst light, \"" + all.name + "\"");
    certificate.figures.push_back(*certificate.headline);
    certificate.figures.push_back(measured("stops_max", all.max, "largest difference of any light," + over));
    for (const auto& [kind, worst] : kinds)
        certificate.figures.push_back(measured(
            "stops_rms." + kind, worst.rms,
            "the worst of " + std::to_string(worst.lights) + " lights of this law, \"" + worst.name + "\""));
    if (gltf.lights > 0)
        certificate.figures.push_back(
            measured("gltf_stops_rms", gltf.rms,
                     "the same of what glTF can say, a point without a source radius; the worst light, \"" +
                         gltf.name + "\""));
    certificate.figures.push_back(measured(
        "cone_rms", cone,
        "root mean square over the cone between a spot's law and the one written, of the intensity on the "
        "axis; the worst light"));
    return certificate;
}

}  // namespace pbrbake::light

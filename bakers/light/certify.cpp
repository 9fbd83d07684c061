// What is known of a conversion's error: the numbers of the product's documents, as they are written, against
// the laws of the source, in stops over distance. The laws are read anew; no fit is made or used here.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "bakers/light/converted_file.hpp"
#include "bakers/light/light.hpp"

namespace pbrbake::light {
namespace {

/// A light as NAME.json tells it.
pbr::PhysicalLight told_by_json(const Json& light) {
    pbr::PhysicalLight told;
    const std::string shape = light["shape"];
    told.shape = shape == "disk"                                     ? pbr::EmitterShape::disk
                 : shape == "sphere"                                 ? pbr::EmitterShape::sphere
                 : shape == "rectangle" && !light.contains("size_m") ? pbr::EmitterShape::rectangle
                                                                     : pbr::EmitterShape::point;
    told.window =
        light["window"] == "quartic" ? pbr::LightWindow::quartic : pbr::LightWindow::quartic_squared;
    told.intensity = light["intensity_cd"];
    told.radius = light["source_radius_m"];
    if (!light["attenuation_radius_m"].is_null()) told.attenuation_radius = light["attenuation_radius_m"];
    return told;
}

/// A light as NAME.gltf tells it. `rgb` is its colour at luminance 1.
pbr::PhysicalLight told_by_gltf(const Json& light, const glm::dvec3& rgb) {
    pbr::PhysicalLight told;
    told.window = pbr::LightWindow::quartic;
    // Its colour's largest component is 1: the intensity is that component's.
    told.intensity = light["intensity"].get<double>() / std::max({rgb.x, rgb.y, rgb.z});
    if (light.contains("range")) told.attenuation_radius = light["range"];
    return told;
}

Figure measured(std::string metric, double value, std::string method) {
    return {std::move(metric), value, Evidence::measured, std::move(method), {}, {}, nullptr};
}

/// The worst of some lights.
struct Worst {
    double rms = 0, max = 0;
    const ConvertedLight* light = nullptr;
    pbr::PhysicalLight told;
    std::size_t lights = 0;

    void take(const ConvertedLight& other, const pbr::PhysicalLight& other_told,
              const pbr::StopsError& error) {
        ++lights;
        max = std::max(max, error.max);
        if (light && error.rms < rms) return;
        rms = error.rms;
        light = &other;
        told = other_told;
    }

    Figure figure(const std::string& metric, const std::string& method) const {
        if (!light) return measured(metric, 0, "no light fades with distance");
        Figure figure = measured(metric, rms, method + "; the worst light, \"" + light->name + "\"");
        figure.curve = curve_json(*light, told, "written_lx");
        return figure;
    }
};

/// What the documents of a product say of the lights of its source.
class Survey {
  public:
    Survey(const Product& product, const ConvertedFile& file, Context& context)
        : count_(context.certify_fully() ? 4096 : 512) {
        const Json *json = document(product, "json"), *gltf = document(product, "gltf");
        const Json* punctual = gltf && gltf->contains("extensions")
                                   ? &(*gltf)["extensions"]["KHR_lights_punctual"]["lights"]
                                   : nullptr;
        std::size_t next = 0;
        for (std::size_t i = 0; i < file.lights.size(); ++i) {
            context.check_cancelled();
            const ConvertedLight& light = file.lights[i];
            if (json) take_json(light, (*json)["lights"][i]);
            if (punctual && light.is_punctual()) take_gltf(light, (*punctual)[next++], !json);
        }
        context.count("certify.distances", distances_);
    }

    Certificate certificate() const {
        const std::string method =
            "root mean square of stops between the source's law and the numbers written, over " +
            std::to_string(count_) + " distances at which the light matters";
        // Without NAME.json, what glTF says is all there is.
        const Worst& all = all_.lights > 0 ? all_ : gltf_;
        Certificate certificate;
        certificate.headline = all.figure("stops_rms", method);
        certificate.headline->curve = nullptr;  // it is one of the laws' below
        certificate.figures.push_back(*certificate.headline);
        certificate.figures.push_back(
            measured("stops_max", all.max,
                     "largest difference of any light from the nearest of those distances to "
                     "the farthest, ends included"));
        for (const auto& [kind, worst] : kinds_)
            certificate.figures.push_back(
                worst.figure("stops_rms." + kind,
                             "the same of the " + std::to_string(worst.lights) + " lights of this law"));
        if (gltf_.lights > 0)
            certificate.figures.push_back(gltf_.figure(
                "gltf_stops_rms", "the same of what glTF can say, a point without a source radius"));
        certificate.figures.push_back(measured("cone_rms", cone_,
                                               "root mean square over the cone between a spot's law and the "
                                               "one written, of the intensity on the "
                                               "axis; the worst light"));
        return certificate;
    }

  private:
    static const Json* document(const Product& product, std::string_view suffix) {
        for (const Document& found : product.documents)
            if (found.suffix == suffix) return &found.json;
        return nullptr;
    }

    pbr::StopsError difference(const ConvertedLight& light, const pbr::PhysicalLight& written) {
        distances_ += static_cast<std::size_t>(count_);
        return pbr::stops_between(written, light.law, light.law_lx, light.span_m, count_);
    }

    void take_json(const ConvertedLight& light, const Json& told) {
        if (!light.fades()) return;
        const pbr::PhysicalLight written = told_by_json(told);
        const pbr::StopsError error = difference(light, written);
        all_.take(light, written, error);
        kinds_[law_kind(light.law)].take(light, written, error);
        constexpr double kDegree = std::numbers::pi / 180;
        if (light.spot_law)
            take_cone(*light.spot_law, told["spot"]["inner_half_angle_deg"].get<double>() * kDegree,
                      told["spot"]["outer_half_angle_deg"].get<double>() * kDegree);
    }

    void take_gltf(const ConvertedLight& light, const Json& told, bool is_alone) {
        if (!light.fades()) return;
        const pbr::PhysicalLight written = told_by_gltf(told, light.rgb);
        gltf_.take(light, written, difference(light, written));
        if (light.spot_law && is_alone)
            take_cone(*light.spot_law, told["spot"]["innerConeAngle"], told["spot"]["outerConeAngle"]);
    }

    void take_cone(const pbr::SpotFalloff& law, double inner_rad, double outer_rad) {
        cone_ = std::max(cone_, pbr::spot_difference(law, inner_rad, outer_rad, count_).rms_share);
    }

    int count_;
    Worst all_, gltf_;
    std::map<std::string, Worst> kinds_;
    double cone_ = 0;
    std::size_t distances_ = 0;
};

}  // namespace

Certificate certify(const LightParams& params, const Inputs& inputs, const Product& product,
                    Context& context) {
    const ConvertedFile file = convert_file(params, inputs.at("source"), context, Fits::left_out);
    return Survey(product, file, context).certificate();
}

}  // namespace pbrbake::light

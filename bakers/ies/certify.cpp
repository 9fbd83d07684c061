// What is known of a texture's error: flux and peak as a shader's bilinear lookup finds them in the stored
// texels.

#include <cmath>

#include "bakers/ies/decoded.hpp"
#include "bakers/ies/ies.hpp"
#include "bakers/ies/resolution.hpp"

namespace pbrbake::ies {
namespace {

Figure measured(std::string metric, double value, std::string method) {
    return {std::move(metric), value, Evidence::measured, std::move(method), {}, {}};
}

}  // namespace

Certificate certify(const IesParams& params, const Inputs& inputs, const Product& product, Context& context) {
    const Luminaire luminaire = read_luminaire(params, inputs);
    const Profile& profile = luminaire.profile;
    const Json& texture = product.properties["texture"];
    const Layout layout = make_layout(params, profile, texture["size"][0].get<int>(),
                                      texture["size"][1].get<int>(), texture["align"] == "ends");
    Rendered stored{layout, {}, decode(layout, profile, product.images.front()), truth(layout, profile)};
    const double unit_cd = texture["candela_per_unit"].get<double>() / product.scale;
    stored.decoded.flux *= unit_cd;
    stored.decoded.peak *= unit_cd;
    context.count("certify.texels", product.images.front().levels.front().texels.size());

    const std::string by = params.projection == Projection::latlong || params.projection == Projection::axial
                               ? "exact integral of the stored texels' bilinear interpolation"
                               : "2 x 2 Gauss points between stored texels, interpolated bilinearly";
    Certificate certificate;
    certificate.headline =
        measured("flux_error", stored.flux_error(), by + ", relative to the exact flux of the file's web");
    certificate.figures.push_back(*certificate.headline);
    certificate.figures.push_back(
        measured("peak_error", stored.peak_error(),
                 "largest stored texel relative to the largest intensity of the file"));
    certificate.figures.push_back(measured("decoded_flux_lm", stored.decoded.flux, by));
    certificate.figures.push_back(measured("decoded_peak_cd", stored.decoded.peak, "largest stored texel"));
    if (params.projection == Projection::cookie && profile.web().flux_lm() > 0)
        certificate.figures.push_back(
            measured("flux_outside", 1 - stored.truth.flux / profile.web().flux_lm(),
                     "share of the luminaire's flux that the cookie's square leaves out"));
    return certificate;
}

}  // namespace pbrbake::ies

// Proof of what was kept: both lobes evaluated from the files and from the stored texels.

#include <algorithm>
#include <cmath>

#include "bakers/texture/convert.hpp"
#include "bakers/texture/difference.hpp"
#include "bakers/texture/pack.hpp"
#include "bakers/texture/source_material.hpp"

namespace pbrbake::texture {
namespace {

/// Sums over texels, of the set as calibrated against the images as stored.
struct Totals {
    double energy_before = 0, energy_off = 0, delta = 0, worst_delta = 0, worst_diffuse = 0, worst_f0 = 0;
    std::uint64_t texels = 0;
};

Figure figure(std::string metric, double value, Evidence evidence, std::string method) {
    return {std::move(metric), value, evidence, std::move(method), {}, {}};
}

float largest_difference(const Colour& a, const Colour& b) { return pbr::max_channel(glm::abs(a - b)); }

}  // namespace

Certificate certify(const TextureParams& given, const Inputs& inputs, const Product& product,
                    Context& context) {
    const TextureParams params = settled(given, inputs);
    const Sources sources(params, inputs);
    const Layout layout = layout_of(params, sources.has_opacity());
    const Json& properties = product.properties["set"];
    const float unit = layout.has_residual ? properties["dielectric_f0_unit"].get<float>() : 1;
    const auto scattering = params.multiscatter ? pbr::Scattering::multiple : pbr::Scattering::single;
    // Calibration looks at whole maps, so the set is converted again; sampling spares the comparison alone.
    Converted set = convert(sources, context);
    const bool is_calibrated = set.findings.calibration != "none";

    constexpr std::uint64_t kSamples = 65536;
    const std::uint64_t texels = set.level.texels();
    const std::uint64_t stride =
        context.certify_fully() ? 1 : std::max<std::uint64_t>(1, texels / kSamples) | 1;
    Totals totals;
    for (std::uint64_t i = 0; i < texels; i += stride) {
        const auto x = static_cast<int>(i % set.level.width), y = static_cast<int>(i / set.level.width);
        const Unpacked stored = unpack(params, layout, product.images, x, y, unit, product.scale);
        const auto after = pbr::reflected_from_metallic(stored.material, layout.coupling);
        const pbr::Reflected<float> before{set.level.diffuse[i], set.level.f0[i]};
        Albedo truth = pbr_albedo(before, set.level.perceptual_roughness[i], scattering);
        // A Phong lobe's albedo comes from its closed form, not from the f0 that was solved for it.
        if (params.model != Model::specular_gloss && sources.has_specular() && !is_calibrated)
            truth.specular = sources.texel(x, y).specular_albedo;
        const Albedo found = pbr_albedo(after, stored.perceptual_roughness, scattering);
        const double energy = static_cast<double>(pbr::mean_channel(truth.total()));
        totals.energy_before += energy;
        totals.energy_off += std::abs(static_cast<double>(pbr::mean_channel(found.total())) - energy);
        const double delta = delta_e(truth.total(), found.total());
        totals.delta += delta;
        totals.worst_delta = std::max(totals.worst_delta, delta);
        totals.worst_diffuse = std::max(
            totals.worst_diffuse, static_cast<double>(largest_difference(before.diffuse, after.diffuse)));
        totals.worst_f0 =
            std::max(totals.worst_f0, static_cast<double>(largest_difference(before.f0, after.f0)));
        ++totals.texels;
    }
    context.count("certify.texels", totals.texels);

    const Evidence evidence = stride == 1 ? Evidence::measured : Evidence::estimate;
    const std::string by =
        std::string(stride == 1 ? "all texels" : "every " + std::to_string(stride) + "th texel") +
        " of the largest level, files" + (is_calibrated ? ", calibrated," : "") + " against stored codes";
    const auto count = static_cast<double>(totals.texels);
    Certificate certificate;
    certificate.headline =
        figure("energy_error", totals.energy_before > 0 ? totals.energy_off / totals.energy_before : 0,
               evidence, "mean absolute change of the albedo under an even sky, relative; " + by);
    certificate.figures.push_back(*certificate.headline);
    certificate.figures.push_back(
        figure("delta_e_mean", totals.delta / count, evidence, "CIE 1976, of that albedo's colour; " + by));
    certificate.figures.push_back(figure("delta_e_max", totals.worst_delta, evidence, "CIE 1976; " + by));
    certificate.figures.push_back(
        figure("diffuse_max_error", totals.worst_diffuse, evidence, "diffuse albedo, linear; " + by));
    certificate.figures.push_back(figure("f0_max_error", totals.worst_f0, evidence, "linear; " + by));
    certificate.figures.push_back(figure("f0_clamped", set.findings.f0_clamped, Evidence::measured,
                                         "share of texels whose lobe reflects more than a PBR lobe can"));
    return certificate;
}

}  // namespace pbrbake::texture

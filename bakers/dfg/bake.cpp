#include <vector>

#include "bakers/dfg/dfg.hpp"
#include "bakers/dfg/layout.hpp"
#include "pbr/brdf/roughness.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::dfg {
namespace {

/// E and Fc of row y, by the integrator asked for.
void ggx_row(const DfgParams& params, const pbr::DfgRule& rule, int y, const Context& context, std::vector<double>& E,
             std::vector<double>& Fc) {
    std::vector<double> NoV(params.width());
    for (int x = 0; x < params.width(); ++x) NoV[x] = nov_of_column(params, x);
    const double alpha = pbr::alpha_from_perceptual_roughness(perceptual_roughness_of_row(params, y));
    if (params.integrator == Integrator::quadrature) {
        pbr::dfg_ggx_row(NoV, alpha, rule, E, Fc);
        return;
    }
    for (int x = 0; x < params.width(); ++x) {
        context.check_cancelled();  // a texel of many samples takes a while
        const std::uint64_t seed = pbr::random_bits(params.seed, x, y);
        const pbr::DirectionalAlbedo albedo = pbr::dfg_ggx_importance_sampled(NoV[x], alpha, params.samples, seed);
        E[x] = albedo.E;
        Fc[x] = albedo.Fc;
    }
}

Json column_names(const DfgParams& params) {
    Json names = Json::array();
    for (const Term term : params.terms) {
        if (term == Term::disney_diffuse) {
            names.push_back("disney_diffuse");
        } else if (params.form == Form::mix) {
            names.insert(names.end(), {"ggx.bias", "ggx.albedo"});
        } else {
            names.insert(names.end(), {"ggx.scale", "ggx.bias"});
        }
    }
    return names;
}

}  // namespace

std::vector<Mistake> check(const DfgParams& params) {
    std::vector<Mistake> mistakes;
    if (params.integrator == Integrator::is && params.samples < 1)
        mistakes.push_back({"/samples", "importance sampling needs at least one sample"});
    return mistakes;
}

std::vector<Read> reads(const DfgParams&) { return {}; }

Product bake(const DfgParams& params, const Inputs&, Context& context) {
    const int width = params.width(), height = params.height(), channels = column_count(params);
    const bool ggx = has_term(params, Term::ggx), disney = has_term(params, Term::disney_diffuse);
    const pbr::DfgRule rule = pbr::dfg_rule(quadrature_error(context.accuracy()));

    Image image;
    for (int c = 0; c < channels; ++c) image.channels.emplace_back(1, "RGBA"[c]);
    image.levels.push_back({width, height, std::vector<float>(static_cast<std::size_t>(width) * height * channels)});
    context.expect(height);
    context.parallel_for(height, 4, [&](std::int64_t begin, std::int64_t end) {
        std::vector<double> E(width), Fc(width);
        for (int y = static_cast<int>(begin); y < end; ++y) {
            if (ggx) ggx_row(params, rule, y, context, E, Fc);
            const double perceptual_roughness = perceptual_roughness_of_row(params, y);
            for (int x = 0; x < width; ++x) {
                const double diffuse = disney ? disney_albedo(params, nov_of_column(params, x), perceptual_roughness) : 0;
                write_texel(params, {E[x], Fc[x]}, diffuse, image.texel(0, 0, y, x));
            }
            context.advance(1);
        }
    });
    const std::uint64_t texels = static_cast<std::uint64_t>(width) * height;
    const int per_texel = params.integrator == Integrator::quadrature ? rule.evaluations() : params.samples;
    if (ggx) context.count("ggx", texels * static_cast<std::uint64_t>(per_texel));
    if (disney) context.count("disney_diffuse", texels * 5);  // Gauss points of the closed form

    Product product;
    product.images.push_back(std::move(image));
    product.units = "albedo";
    product.properties["columns"] = column_names(params);
    return product;
}

}  // namespace pbrbake::dfg

#include <algorithm>
#include <span>
#include <vector>

#include "bakers/dfg/dfg.hpp"
#include "bakers/dfg/layout.hpp"
#include "pbr/brdf/roughness.hpp"

namespace pbrbake::dfg {
namespace {

constexpr std::size_t kViewsACall = 64;  // between looks at whether the run was interrupted

/// E and Fc of row y.
void ggx_row(const DfgParams& params, const pbr::DfgMethod& method, int y, const Context& context,
             std::vector<double>& E, std::vector<double>& Fc) {
    const double alpha = pbr::alpha_from_perceptual_roughness(perceptual_roughness_of_row(params, y));
    std::vector<double> NoV(E.size());
    for (std::size_t x = 0; x < NoV.size(); ++x) NoV[x] = nov_of_column(params, static_cast<int>(x));
    for (std::size_t first = 0; first < NoV.size(); first += kViewsACall) {
        context.check_cancelled();
        const std::size_t count = std::min(kViewsACall, NoV.size() - first);
        pbr::dfg_ggx_row(std::span(NoV).subspan(first, count), alpha, method,
                         std::span(E).subspan(first, count), std::span(Fc).subspan(first, count));
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

std::vector<Mistake> check(const DfgParams&, const std::string&) { return {}; }

std::vector<Read> reads(const DfgParams&) { return {}; }

Product bake(const DfgParams& params, const Inputs&, Context& context) {
    const int width = params.width(), height = params.height(), channels = column_count(params);
    const bool ggx = has_term(params, Term::ggx), disney = has_term(params, Term::disney_diffuse);
    const pbr::DfgMethod method = params.integrator == Integrator::quadrature
                                      ? pbr::DfgMethod::quadrature(quadrature_error(context.accuracy()))
                                      : pbr::DfgMethod::importance_sampling(params.samples, params.seed);

    Image image;
    for (int c = 0; c < channels; ++c) image.channels.emplace_back(1, "RGBA"[c]);
    image.levels.push_back(
        {width, height, std::vector<float>(static_cast<std::size_t>(width) * height * channels)});
    context.expect(height);
    context.parallel_for(height, 4, [&](std::int64_t begin, std::int64_t end) {
        std::vector<double> E(width), Fc(width);
        for (int y = static_cast<int>(begin); y < end; ++y) {
            if (ggx) ggx_row(params, method, y, context, E, Fc);
            const double perceptual_roughness = perceptual_roughness_of_row(params, y);
            for (int x = 0; x < width; ++x) {
                const double diffuse =
                    disney ? disney_albedo(params, nov_of_column(params, x), perceptual_roughness) : 0;
                write_texel(params, {E[x], Fc[x]}, diffuse, image.texel(0, 0, y, x));
            }
            context.advance(1);
        }
    });
    const std::uint64_t texels = static_cast<std::uint64_t>(width) * height;
    if (ggx) context.count("ggx", texels * static_cast<std::uint64_t>(method.evaluations()));
    if (disney) context.count("disney_diffuse", texels * 5);  // Gauss points of the closed form

    Product product;
    product.images.push_back(std::move(image));
    product.units = "albedo";
    product.properties["columns"] = column_names(params);
    return product;
}

}  // namespace pbrbake::dfg

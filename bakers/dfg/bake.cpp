#include <algorithm>
#include <vector>

#include "bakers/dfg/choose.hpp"
#include "bakers/dfg/dfg.hpp"
#include "bakers/dfg/layout.hpp"
#include "bakers/dfg/terms.hpp"

namespace pbrbake::dfg {
namespace {

constexpr std::size_t kMostChannels = 4;  // what a texture holds

}  // namespace

pbr::DfgMethod method_of(const DfgParams& params, const Accuracy& accuracy) {
    return params.integrator == Integrator::quadrature
               ? pbr::DfgMethod::quadrature(quadrature_error(accuracy))
               : pbr::DfgMethod::importance_sampling(params.samples, params.seed);
}

std::vector<Mistake> check(const DfgParams& asked, const std::string&) {
    const DfgParams params = settled(asked);
    std::vector<Mistake> mistakes;
    const std::size_t channels = channel_names(params).size();
    if (channels > kMostChannels)
        mistakes.push_back({"/terms", "found terms of " + std::to_string(channels) +
                                          " channels; a table has up to 4: bake several"});
    if (params.terms.size() > 1 && std::any_of(params.terms.begin(), params.terms.end(), is_over_curvature))
        mistakes.push_back({"/terms",
                            "subsurface has axes of its own (NoL and curvature); bake it as a table of its "
                            "own"});
    return mistakes;
}

std::vector<Read> reads(const DfgParams&) { return {}; }

Product bake(const DfgParams& asked, const Inputs&, Context& context) {
    Product product;
    DfgParams params = settled(asked);
    if (context.accuracy().as_sampled) {
        const Choice choice = choose(asked, context);
        params = choice.params;
        product.pixel = choice.pixel;
    }
    const int width = params.width(), height = params.height();
    const std::vector<std::string> names = channel_names(params);
    const pbr::DfgMethod method = method_of(params, context.accuracy());
    std::vector<double> across;
    for (int x = 0; x < width; ++x) across.push_back(value_of_column(params, x));

    Image image;
    for (std::size_t c = 0; c < names.size(); ++c) image.channels.emplace_back(1, "RGBA"[c]);
    image.levels.push_back(
        {width, height, std::vector<float>(static_cast<std::size_t>(width) * height * names.size())});
    context.expect(height);
    context.parallel_for(height, 4, [&](std::int64_t begin, std::int64_t end) {
        for (int y = static_cast<int>(begin); y < end; ++y) {
            const Columns columns = Row(params, method, value_of_row(params, y), across, context).evaluate();
            for (int x = 0; x < width; ++x)
                for (std::size_t c = 0; c < columns.size(); ++c)
                    image.texel(0, 0, y, x)[c] = static_cast<float>(columns[c][x]);
            context.advance(1);
        }
    });
    product.images.push_back(std::move(image));
    product.units = "albedo";
    product.properties["columns"] = names;
    product.properties["layout"] = layout_json(params);
    return product;
}

}  // namespace pbrbake::dfg

// What is known of a table's error: at its texels, and between them as a shader's bilinear lookup reads it.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

#include "bakers/dfg/dfg.hpp"
#include "bakers/dfg/layout.hpp"
#include "pbr/brdf/roughness.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::dfg {
namespace {

constexpr int kViewsARow = 16;  // checked together: the quadrature is vectorised over views
constexpr double kTruth = 1e-8;

const pbr::DfgMethod& truth() {
    static const pbr::DfgMethod method = pbr::DfgMethod::quadrature(kTruth);
    return method;
}

/// The true channels at views of one roughness.
std::vector<float> true_texels(const DfgParams& params, const std::vector<double>& NoV,
                               double perceptual_roughness, Context& context) {
    std::vector<double> E(NoV.size()), Fc(NoV.size());
    if (has_term(params, Term::ggx)) {
        pbr::dfg_ggx_row(NoV, pbr::alpha_from_perceptual_roughness(perceptual_roughness), truth(), E, Fc);
        context.count("certify.ggx", NoV.size() * static_cast<std::uint64_t>(truth().evaluations()));
    }
    const std::size_t channels = static_cast<std::size_t>(column_count(params));
    std::vector<float> texels(NoV.size() * channels);
    for (std::size_t i = 0; i < NoV.size(); ++i)
        write_texel(params, {E[i], Fc[i]}, disney_albedo(params, NoV[i], perceptual_roughness),
                    &texels[i * channels]);
    return texels;
}

/// Bilinear lookup with clamped coordinates, as a GPU does it.
double lookup(const Image& image, double column, double row, int channel) {
    const Level& level = image.levels[0];
    const double x = std::clamp(column, 0.0, level.width - 1.0), y = std::clamp(row, 0.0, level.height - 1.0);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, level.width - 1), y1 = std::min(y0 + 1, level.height - 1);
    const double fx = x - x0, fy = y - y0;
    const auto at = [&](int j, int i) { return static_cast<double>(image.texel(0, 0, j, i)[channel]); };
    return (1 - fy) * ((1 - fx) * at(y0, x0) + fx * at(y0, x1)) +
           fy * ((1 - fx) * at(y1, x0) + fx * at(y1, x1));
}

/// Largest errors over rows of checked points. Reduced in order: the same at any thread count.
template <class ErrorOfRow>
double largest(Context& context, int rows, const ErrorOfRow& error_of_row) {
    std::vector<double> errors(rows);
    context.parallel_for(rows, 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) errors[i] = error_of_row(static_cast<int>(i));
    });
    return rows > 0 ? *std::max_element(errors.begin(), errors.end()) : 0;
}

double texel_error(const DfgParams& params, const Image& image, double scale, int y,
                   const std::vector<int>& columns, Context& context) {
    std::vector<double> NoV;
    for (const int x : columns) NoV.push_back(nov_of_column(params, x));
    const std::vector<float> truth =
        true_texels(params, NoV, perceptual_roughness_of_row(params, y), context);
    const int channels = image.channel_count();
    double error = 0;
    for (std::size_t i = 0; i < columns.size(); ++i)
        for (int c = 0; c < channels; ++c)
            error = std::max(error, std::abs(image.texel(0, 0, y, columns[i])[c] / scale -
                                             static_cast<double>(truth[i * channels + c])));
    return error;
}

/// Rows of views that each of the two checks can afford, so that together they cost about what the bake did.
int checked_rows(const DfgParams& params, const Context& context) {
    const double per_texel =
        params.integrator == Integrator::quadrature
            ? pbr::DfgMethod::quadrature(quadrature_error(context.accuracy())).evaluations()
            : params.samples;
    const double bake = per_texel * params.width() * params.height();
    return static_cast<int>(std::clamp(bake / (2.0 * kViewsARow * truth().evaluations()), 2.0, 64.0));
}

/// The error at texels, storage included: all of them, or some chosen by hash, the hard corner always among
/// them.
Figure texel_figure(const DfgParams& params, const Product& product, std::uint64_t seed, Context& context) {
    const int width = params.width(), height = params.height();
    // A stated max_error is held against every texel: the largest of some would be a lower bound.
    const bool all = context.certify_fully() || context.accuracy().stated();
    const int rows = all ? height : checked_rows(params, context);
    const double error = largest(context, rows, [&](int i) {
        if (all) {
            std::vector<int> columns(width);
            std::iota(columns.begin(), columns.end(), 0);
            return texel_error(params, product.images[0], product.scale, i, columns, context);
        }
        const int smoothest = params.flip_rows ? height - 1 : 0;
        const int y = i == 0 ? smoothest
                             : static_cast<int>(pbr::random_bits(seed, 1, i) % static_cast<unsigned>(height));
        std::vector<int> columns{0};
        for (int k = 1; k < kViewsARow; ++k)
            columns.push_back(
                static_cast<int>(pbr::random_bits(seed, 2, i, k) % static_cast<unsigned>(width)));
        return texel_error(params, product.images[0], product.scale, y, columns, context);
    });
    const std::string where = all ? "at every texel"
                                  : "at " + std::to_string(rows * kViewsARow) +
                                        " texels chosen by hash, the smoothest row and the grazing side "
                                        "among them; the largest found, so a lower bound";
    return {"max_abs_error",
            error,
            all ? Evidence::measured : Evidence::estimate,
            "stored values against quadrature to 1e-8, " + where,
            {},
            {}};
}

/// The error of a shader's bilinear lookup between texels.
Figure sampled_figure(const DfgParams& params, const Product& product, std::uint64_t seed, Context& context) {
    const Image& image = product.images[0];
    const std::size_t channels = static_cast<std::size_t>(image.channel_count());
    const double lowest = params.min_perceptual_roughness;
    const int rows = checked_rows(params, context) * (context.certify_fully() ? 16 : 1);
    const double error = largest(context, rows, [&](int i) {
        const double perceptual_roughness = lowest + (1 - lowest) * pbr::random_unit(seed, 3, i);
        std::vector<double> NoV;
        for (int k = 0; k < kViewsARow; ++k) NoV.push_back(pbr::random_unit(seed, 4, i, k));
        const std::vector<float> truth = true_texels(params, NoV, perceptual_roughness, context);
        const double row = row_of_perceptual_roughness(params, perceptual_roughness);
        double worst = 0;
        for (std::size_t k = 0; k < NoV.size(); ++k)
            for (std::size_t c = 0; c < channels; ++c) {
                const double value = lookup(image, column_of_nov(params, NoV[k]), row, static_cast<int>(c));
                worst = std::max(
                    worst, std::abs(value / product.scale - static_cast<double>(truth[k * channels + c])));
            }
        return worst;
    });
    return {"max_abs_error_sampled",
            error,
            Evidence::estimate,
            "bilinear lookup against quadrature to 1e-8, at " + std::to_string(rows * kViewsARow) +
                " points chosen by hash over NoV in [0, 1] and perceptual roughness from "
                "min_perceptual_roughness to 1; the largest found, so a lower bound",
            {},
            {}};
}

}  // namespace

Certificate certify(const DfgParams& params, const Inputs&, const Product& product, Context& context) {
    const std::uint64_t seed = pbr::random_bits(params.seed, 0x646667u);
    Certificate certificate;
    if (has_term(params, Term::ggx) && params.integrator == Integrator::quadrature)
        certificate.figures.push_back({"quadrature_error",
                                       pbr::dfg_rule(quadrature_error(context.accuracy())).max_error,
                                       Evidence::bound,
                                       "promised of E and Fc over the whole domain, and held by a test",
                                       {},
                                       {}});

    certificate.headline = texel_figure(params, product, seed, context);
    certificate.figures.push_back(*certificate.headline);
    certificate.figures.push_back(sampled_figure(params, product, seed, context));
    return certificate;
}

}  // namespace pbrbake::dfg

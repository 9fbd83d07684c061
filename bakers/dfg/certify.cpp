// What is known of a table's error: at its texels, and between them as a shader's bilinear lookup reads it.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "bakers/dfg/analytic_fit.hpp"
#include "bakers/dfg/dfg.hpp"
#include "bakers/dfg/layout.hpp"
#include "bakers/dfg/sampled.hpp"
#include "bakers/dfg/terms.hpp"
#include "pbr/ibl/dfg_anisotropic.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::dfg {
namespace {

constexpr int kViewsARow = 16;  // checked together: the quadrature is vectorised over views

/// How the table was baked, and what stands for the truth: exact enough for the errors that are looked for,
/// so that looking costs no more than the bake.
struct Methods {
    pbr::DfgMethod baked, truth;
};

Methods methods_of(const DfgParams& params, const Accuracy& accuracy) {
    return {method_of(params, accuracy),
            pbr::DfgMethod::quadrature(std::max(quadrature_error(accuracy) / 100, 1e-8))};
}
constexpr const char* kAgainst = " against quadrature to a hundredth of the accuracy, or to 1e-8";

struct TexelErrors {
    double integration = 0;   ///< of the method, before storage
    double quantisation = 0;  ///< of the pixel format
    double total = 0;
    void include(const TexelErrors& other) {
        integration = std::max(integration, other.integration);
        quantisation = std::max(quantisation, other.quantisation);
        total = std::max(total, other.total);
    }
};

/// `row` counts down the rows, slice after slice.
TexelErrors texel_errors(const DfgParams& params, const Methods& methods, const Product& product, int row,
                         const std::vector<int>& columns, Context& context) {
    std::vector<double> across;
    for (const int x : columns) across.push_back(value_of_column(params, x));
    const int z = row / params.height(), y = row % params.height();
    const Place place{value_of_row(params, y), value_of_slice(params, z)};
    const Columns exact = Row(params, methods.truth, place, across, context, "certify.").evaluate();
    const Columns baked = Row(params, methods.baked, place, across, context, "certify.").evaluate();
    TexelErrors errors;
    for (std::size_t c = 0; c < exact.size(); ++c)
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const double stored = product.images[0].texel(0, z, y, columns[i])[c] / product.scale;
            errors.include({std::abs(baked[c][i] - exact[c][i]), std::abs(stored - baked[c][i]),
                            std::abs(stored - exact[c][i])});
        }
    return errors;
}

/// Evaluations that each of the two checks can afford, so that together they cost about what the bake did.
double affordable_views(const DfgParams& params, const Methods& methods) {
    double baked = 0, exact = 0;  // evaluations of a row
    for (int x = 0; x < params.width(); ++x) {
        const double across = std::max(0.0, value_of_column(params, x));  // NoL of subsurface is negative too
        baked += methods.baked.evaluations(across);
        exact += methods.truth.evaluations(across);
    }
    return baked / exact * params.width() * params.height() * params.depth() / 2;
}

/// Errors at texels: all of them, or some chosen by hash, the hard corner always among them.
TexelErrors texel_errors(const DfgParams& params, const Methods& methods, const Product& product, bool all,
                         int rows, std::uint64_t seed, Context& context) {
    const int width = params.width(), height = params.height() * params.depth();
    const int smoothest = params.flip_rows ? params.height() - 1 : 0;
    std::vector<TexelErrors> found(rows);
    context.parallel_for(rows, 1, [&](std::int64_t begin, std::int64_t end) {
        for (int i = static_cast<int>(begin); i < end; ++i) {
            std::vector<int> columns(all ? width : kViewsARow);
            if (all)
                std::iota(columns.begin(), columns.end(), 0);
            else
                for (int k = 1; k < kViewsARow; ++k)
                    columns[k] =
                        static_cast<int>(pbr::random_bits(seed, 2, i, k) % static_cast<unsigned>(width));
            const int hashed = static_cast<int>(pbr::random_bits(seed, 1, i) % static_cast<unsigned>(height));
            found[i] = texel_errors(params, methods, product,
                                    all      ? i
                                    : i == 0 ? smoothest
                                             : hashed,
                                    columns, context);
        }
    });
    TexelErrors worst;
    for (const TexelErrors& errors : found) worst.include(errors);
    return worst;
}

Figure figure(std::string metric, double value, bool all, const std::string& method,
              const std::string& where) {
    return {std::move(metric),     value, all ? Evidence::measured : Evidence::estimate,
            method + ", " + where, {},    {}};
}

/// What a shader would be off by that took an analytic fit instead, on a grid over the table's range.
void add_fits(std::vector<Figure>& figures, DfgParams params, Context& context) {
    constexpr int kGrid = 32;
    params.terms = {Term::ggx};
    params.form = Form::scale_bias;
    const Range smoothest = down(params);
    std::vector<double> NoV;
    for (int x = 0; x < kGrid; ++x) NoV.push_back(x / (kGrid - 1.0));
    const pbr::DfgMethod method = pbr::DfgMethod::quadrature(1e-3);  // fits are off by .1 and more
    double karis = 0, lazarov = 0;
    for (int y = 0; y < kGrid; ++y) {
        const double p = smoothest.lowest + (1 - smoothest.lowest) * y / (kGrid - 1.0);
        const Columns exact = Row(params, method, {p}, NoV, context, "certify.").evaluate();
        const auto error = [&](const ScaleBias& fit, int x) {
            return std::max(std::abs(fit.scale - exact[0][x]), std::abs(fit.bias - exact[1][x]));
        };
        for (int x = 0; x < kGrid; ++x) {
            karis = std::max(karis, error(karis_fit(NoV[x], p), x));
            lazarov = std::max(lazarov, error(lazarov_fit(NoV[x], p), x));
        }
    }
    const std::string where =
        ", for comparison: what a shader without the table is off by, on a grid of 32 x 32";
    figures.push_back(
        {"analytic_fit_error", karis, Evidence::estimate, "of Karis's fit (2014)" + where, {}, {}});
    figures.push_back({"analytic_fit_error_lazarov",
                       lazarov,
                       Evidence::estimate,
                       "of Lazarov's fit (2013)" + where,
                       {},
                       {}});
}

/// The largest difference that a third axis makes which isn't there: E and Fc, as stored, of lobes of
/// Burley's convention seen from all around, and of those in the view's own axes that a shader looks up
/// instead.
double reduction_error(const DfgParams& params, double anisotropy) {
    constexpr int kViews = 16, kRoughnesses = 12, kAzimuths = 12;
    const pbr::DfgRule rule = pbr::dfg_anisotropic_rule(1e-3);  // reductions are off by 1e-2 and more
    std::vector<double> NoV, E(kViews), Fc(kViews), E_read(kViews), Fc_read(kViews);
    for (int x = 0; x < kViews; ++x) NoV.push_back(std::pow(x / (kViews - 1.0), 2));
    double worst = 0;
    for (int y = 0; y < kRoughnesses; ++y)
        for (int k = 1; k < kAzimuths; ++k) {
            const double least = std::max(params.min_perceptual_roughness, 0.01);
            const double p = least + (1 - least) * y / (kRoughnesses - 1.0);
            const pbr::AnisotropicAlpha<double> alpha = pbr::anisotropic_alpha(p * p, anisotropy);
            const pbr::SinCos turned = pbr::sin_cos_pi(0.5 * k / kAzimuths);
            const pbr::TangentAzimuth azimuth{turned.cos, turned.sin};
            const pbr::ViewWidths seen = pbr::view_widths(azimuth, alpha);
            pbr::dfg_ggx_anisotropic_row(NoV, azimuth, alpha, rule, E, Fc);
            pbr::dfg_ggx_anisotropic_row(NoV, {}, {seen.along, seen.across}, rule, E_read, Fc_read);
            for (int x = 0; x < kViews; ++x) {
                const double e = E_read[x] - E[x], f = Fc_read[x] - Fc[x];
                const double first = params.form == Form::mix ? e : e - f;
                worst = std::max({worst, std::abs(first), std::abs(f)});
            }
        }
    return worst;
}

void add_reduction(std::vector<Figure>& figures, const DfgParams& params, Context& context) {
    const std::string where =
        ", what three axes for four numbers lose at azimuths between the tangent and the bitangent, on a "
        "grid of "
        "16 x 12 x 11; comes on top of the others";
    for (const auto& [metric, anisotropy, words] :
         {std::tuple{"reduction_error", 1.0, "widths that differ ten times"},
          std::tuple{"reduction_error_half", 0.5, "half of Burley's anisotropy, widths as 1.8 to 1"}}) {
        context.check_cancelled();
        figures.push_back(
            {metric, reduction_error(params, anisotropy), Evidence::estimate, words + where, {}, {}});
    }
}

}  // namespace

Certificate certify(const DfgParams& asked, const Inputs&, const Product& product, Context& context) {
    const DfgParams params = as_baked(asked, product);
    const std::uint64_t seed = pbr::random_bits(params.seed, 0x646667u);
    const Accuracy& accuracy = context.accuracy();
    Certificate certificate;
    const auto add = [&](Figure figure) { certificate.figures.push_back(std::move(figure)); };
    if (params.integrator == Integrator::quadrature && std::ranges::any_of(params.terms, is_of_ggx))
        add({"quadrature_error",
             pbr::dfg_rule(quadrature_error(accuracy)).max_error,
             Evidence::bound,
             "promised of the GGX integrals over the whole domain, and held by a test",
             {},
             {}});

    if (is_volume(params)) {
        add({"quadrature_error",
             pbr::dfg_anisotropic_rule(quadrature_error(accuracy)).max_error,
             Evidence::bound,
             "promised of the anisotropic integrals where the widths differ by up to ten times, and held by "
             "a test",
             {},
             {}});
        add_reduction(certificate.figures, params, context);
    }

    // A stated max_error is held against every texel: the largest of some would be a lower bound.
    const bool all = context.certify_fully() || accuracy.stated();
    const Methods methods = methods_of(params, accuracy);
    const double views = affordable_views(params, methods);
    const int rows =
        all ? params.height() * params.depth() : static_cast<int>(std::clamp(views / kViewsARow, 2.0, 64.0));
    const TexelErrors texels = texel_errors(params, methods, product, all, rows, seed, context);
    const std::string where = all ? "at every texel"
                                  : "at " + std::to_string(rows * kViewsARow) +
                                        " texels chosen by hash, the smoothest row and the grazing side "
                                        "among them; the largest found, so a lower bound";
    add(figure("integration_error", texels.integration, all, std::string("before storage,") + kAgainst,
               where));
    add(figure("quantisation_error", texels.quantisation, all, "stored values against those before storage",
               where));
    const Figure total =
        figure("max_abs_error", texels.total, all, std::string("stored values") + kAgainst, where);
    add(total);

    const bool thorough = context.certify_fully() || accuracy.as_sampled;
    // A row of points takes three views a column, and two rows of texels.
    const int sampled_rows = static_cast<int>(std::clamp(views / (5.0 * params.width()), 2.0, 64.0));
    const SampledErrors between =
        sampled_errors(params, &product, methods.truth, thorough ? Probing::thorough : Probing::some,
                       sampled_rows, seed, context);
    const std::string points =
        std::to_string(between.points) +
        (thorough ? " points, in every cell of the range that a shader reads"
                  : " points, rows chosen by hash, the smoothest among them; the largest found, so a lower "
                    "bound");
    add(figure("interpolation_error", between.interpolation, thorough,
               std::string("bilinear lookup in exact texels") + kAgainst, points));
    const Figure sampled = figure("max_abs_error_sampled", between.sampled, thorough,
                                  std::string("bilinear lookup in stored texels") + kAgainst, points);
    add(sampled);
    if (std::find(params.terms.begin(), params.terms.end(), Term::ggx) != params.terms.end())
        add_fits(certificate.figures, params, context);
    certificate.headline = accuracy.as_sampled ? sampled : total;
    return certificate;
}

}  // namespace pbrbake::dfg

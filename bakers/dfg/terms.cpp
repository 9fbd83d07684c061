#include "bakers/dfg/terms.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "pbr/brdf/chan.hpp"
#include "pbr/brdf/charlie.hpp"
#include "pbr/brdf/clear_coat.hpp"
#include "pbr/brdf/disney_diffuse.hpp"
#include "pbr/brdf/eon.hpp"
#include "pbr/brdf/fresnel.hpp"
#include "pbr/brdf/hammon.hpp"
#include "pbr/brdf/multiscatter.hpp"
#include "pbr/brdf/roughness.hpp"
#include "pbr/brdf/subsurface.hpp"
#include "pbr/ibl/dfg_anisotropic.hpp"

namespace pbrbake::dfg {
namespace {

constexpr std::size_t kViewsACall = 64;  // between looks at whether the run was interrupted

/// The two channels of a lobe with Schlick's Fresnel.
Columns in_form(Form form, const Row::Ggx& lobe) {
    if (form == Form::mix) return {lobe.Fc, lobe.E};
    std::vector<double> scale(lobe.E.size());
    std::transform(lobe.E.begin(), lobe.E.end(), lobe.Fc.begin(), scale.begin(), std::minus());
    return {scale, lobe.Fc};
}

std::vector<std::string> form_names(const DfgParams& params) {
    return params.form == Form::mix ? std::vector<std::string>{"bias", "albedo"}
                                    : std::vector<std::string>{"scale", "bias"};
}

std::vector<std::string> single(const DfgParams&) { return {""}; }

Columns ggx(Row& row) { return in_form(row.params().form, row.ggx()); }

Columns uncorrelated(Row& row) {
    return in_form(row.params().form, row.ggx_of(pbr::DfgVisibility::uncorrelated, "uncorrelated"));
}

Columns ggx_anisotropic(Row& row) { return in_form(row.params().form, row.ggx_anisotropic()); }

Columns disney_diffuse(Row& row) {
    constexpr std::uint64_t kGaussPoints = 5;  // of the closed form
    const Disney disney = row.params().disney;
    return {row.each("disney_diffuse", kGaussPoints, [&](double NoV) {
        if (disney == Disney::renormalised) return pbr::albedo_disney_diffuse(NoV, row.down());
        const double albedo = pbr::albedo_disney_diffuse_original(NoV, row.down());
        return disney == Disney::original ? albedo : albedo - 0.5;
    })};
}

/// What Kulla and Conty's lobe gives back, 1 - E, and its mean, 1 - E_avg, the same along a row. Not E
/// itself: a half just below 1 is off by up to 2.4e-4, which for smooth surfaces is all of 1 - E_avg and
/// more.
Columns multiscatter(Row& row) {
    constexpr std::uint64_t kViews = 48;  // that average_albedo_ggx takes
    std::vector<double> lost = row.ggx().E;
    for (double& value : lost) value = 1 - value;
    const double average = 1 - pbr::average_albedo_ggx(row.alpha());
    row.count("multiscatter", kViews);
    return {std::move(lost), std::vector<double>(row.views(), average)};
}

Columns charlie(Row& row) {
    constexpr std::uint64_t kEvaluations = 1600;
    const auto visibility = row.params().cloth == Cloth::neubelt ? pbr::CharlieVisibility::neubelt
                                                                 : pbr::CharlieVisibility::charlie;
    const double alpha = std::max(row.alpha(), 0.01);  // the least that albedo_charlie takes
    return {row.each("charlie", kEvaluations,
                     [&](double NoV) { return pbr::albedo_charlie(NoV, alpha, visibility); })};
}

Columns clear_coat(Row& row) {
    const Row::Ggx& lobe = row.ggx();
    std::vector<double> albedo(row.views());
    for (std::size_t i = 0; i < albedo.size(); ++i)
        albedo[i] = pbr::kClearCoatF0<double> * (lobe.E[i] - lobe.Fc[i]) + lobe.Fc[i];
    row.count("clear_coat", row.views());
    return {std::move(albedo)};
}

Columns eon(Row& row) {
    return {
        row.each("eon", 1, [&](double NoV) { return pbr::albedo_fon(pbr::eon_g_exact(NoV), row.down()); })};
}

constexpr std::uint64_t kDiffuseEvaluations = 24 * 16;  // of the rules in libpbr

Columns chan(Row& row) {
    return {row.each("chan", kDiffuseEvaluations,
                     [&](double NoV) { return pbr::albedo_chan(NoV, row.alpha()); })};
}

Columns hammon(Row& row) {
    return {row.each("hammon", kDiffuseEvaluations,
                     [&](double NoV) { return pbr::albedo_hammon_single(NoV, row.alpha()); })};
}

Columns subsurface(Row& row) {
    constexpr std::uint64_t kNodes = 8 * 32;  // panels by points, at most
    return {row.each("subsurface", kNodes,
                     [&](double NoL) { return pbr::preintegrated_diffusion(NoL, row.down()); })};
}

struct TermKind {
    Term term;
    /// Names of its channels, after the term's own.
    std::vector<std::string> (*names)(const DfgParams&);
    /// Its channels along a row.
    Columns (*evaluate)(Row&);
    bool is_of_ggx = false;
    bool is_over_curvature = false;
    bool is_volume = false;
};

constexpr std::array kTermKinds{
    TermKind{Term::ggx, form_names, ggx, true},
    TermKind{Term::disney_diffuse, single, disney_diffuse},
    TermKind{Term::multiscatter,
             [](const DfgParams&) {
                 return std::vector<std::string>{"lost", "average_lost"};
             },
             multiscatter, true},
    TermKind{Term::charlie, single, charlie},
    TermKind{Term::clear_coat, single, clear_coat, true},
    TermKind{Term::uncorrelated, form_names, uncorrelated, true},
    TermKind{Term::eon, single, eon},
    TermKind{Term::chan, single, chan},
    TermKind{Term::hammon, single, hammon},
    TermKind{Term::subsurface, single, subsurface, false, true},
    TermKind{Term::ggx_anisotropic, form_names, ggx_anisotropic, false, false, true},
};

const TermKind& kind_of(Term term) {
    return *std::find_if(kTermKinds.begin(), kTermKinds.end(),
                         [&](const TermKind& kind) { return kind.term == term; });
}

}  // namespace

Row::Row(const DfgParams& params, const pbr::DfgMethod& method, Place place, std::span<const double> across,
         Context& context, std::string_view counter_prefix)
    : params_(params),
      method_(method),
      place_(place),
      across_(across),
      context_(context),
      counter_prefix_(counter_prefix) {}

Columns Row::evaluate() {
    Columns all;
    for (const Term term : params_.terms)
        for (std::vector<double>& column : kind_of(term).evaluate(*this)) all.push_back(std::move(column));
    return all;
}

const Row::Ggx& Row::ggx() {
    if (ggx_.E.empty()) ggx_ = ggx_of(pbr::DfgVisibility::correlated, "ggx");
    return ggx_;
}

Row::Ggx Row::ggx_of(pbr::DfgVisibility visibility, std::string_view effect) {
    const pbr::DfgMethod method = method_.with(visibility);
    Ggx lobe{std::vector<double>(views()), std::vector<double>(views())};
    for (std::size_t first = 0; first < views(); first += kViewsACall) {
        context_.check_cancelled();
        const std::size_t number = std::min(kViewsACall, views() - first);
        pbr::dfg_ggx_row(across_.subspan(first, number), alpha(), method,
                         std::span(lobe.E).subspan(first, number), std::span(lobe.Fc).subspan(first, number));
    }
    std::uint64_t evaluations = 0;
    for (const double NoV : across_) evaluations += static_cast<std::uint64_t>(method.evaluations(NoV));
    count(effect, evaluations);
    return lobe;
}

Row::Ggx Row::ggx_anisotropic() {
    const double along = alpha();
    Ggx lobe{std::vector<double>(views(), 1.0), std::vector<double>(views())};
    if (along == 0) {
        std::transform(across_.begin(), across_.end(), lobe.Fc.begin(), pbr::schlick_weight<double>);
        return lobe;
    }
    const pbr::DfgRule rule = pbr::dfg_anisotropic_rule(method_.rule.max_error);
    std::uint64_t evaluations = 0;
    for (std::size_t first = 0; first < views(); first += kViewsACall) {
        context_.check_cancelled();
        const auto views_here = across_.subspan(first, std::min(kViewsACall, views() - first));
        pbr::dfg_ggx_anisotropic_row(views_here, {}, {along, along * place_.stretch}, rule,
                                     std::span(lobe.E).subspan(first, views_here.size()),
                                     std::span(lobe.Fc).subspan(first, views_here.size()));
        for (const double NoV : views_here)
            evaluations += 4 * static_cast<std::uint64_t>(rule.evaluations(NoV));
    }
    count("ggx_anisotropic", evaluations);
    return lobe;
}

void Row::count(std::string_view effect, std::uint64_t evaluations) {
    context_.count(std::string(counter_prefix_).append(effect), evaluations);
}

double Row::alpha() const { return pbr::alpha_from_perceptual_roughness(place_.down); }

std::vector<std::string> channel_names(const DfgParams& params) {
    std::vector<std::string> all;
    for (const Term term : params.terms)
        for (const std::string& part : kind_of(term).names(params))
            all.push_back(std::string(enum_name(term)) + (part.empty() ? "" : "." + part));
    return all;
}

bool is_of_ggx(Term term) { return kind_of(term).is_of_ggx; }

bool is_volume(Term term) { return kind_of(term).is_volume; }

bool is_volume(const DfgParams& params) { return is_volume(params.terms.front()); }

bool is_over_curvature(Term term) { return kind_of(term).is_over_curvature; }

}  // namespace pbrbake::dfg

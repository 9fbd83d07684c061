#include "bakers/ies/resolution.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace pbrbake::ies {
namespace {

struct Candidate {
    int width, height;
    bool ends;
};

/// Steps of a range of `span` degrees, the fewest whose multiples are all the angles; nothing if no such step
/// of at least a hundredth of a degree exists.
std::optional<int> common_steps(const std::vector<double>& angles, double first, double span) {
    constexpr double kHundredth = 100;
    long divisor = std::lround(span * kHundredth);
    const auto take = [&](double angle) {
        const double scaled = (angle - first) * kHundredth;
        if (std::abs(scaled - std::round(scaled)) > .01) return false;
        divisor = std::gcd(divisor, std::lround(scaled));
        return true;
    };
    if (!std::all_of(angles.begin(), angles.end(), take) || divisor == 0) return {};
    return static_cast<int>(std::lround(span * kHundredth) / divisor);
}

/// Counts of samples along an angle, ascending, that keep the grid, or else a plain series.
std::vector<int> counts(std::optional<int> steps, int most) {
    std::vector<int> list;
    if (steps && *steps > 0)
        for (long n = *steps; n + 1 <= most; n *= 2) list.push_back(static_cast<int>(n) + 1);
    if (list.empty())
        for (const int n : {65, 97, 129, 193, 257, 385, 513, 769, 1024, 1537, 2049, 3073, 4097, 8193})
            if (n <= most) list.push_back(n);
    if (list.empty()) list.push_back(most);
    return list;
}

std::vector<Candidate> polar_candidates(const IesParams& params, const Profile& profile) {
    const bool is_axial = params.projection == Projection::axial;
    const int most = params.max_size;
    const Layout range = make_layout(params, profile, 2, 2, true);
    const Axis &polar = is_axial ? range.x : range.y, &azimuth = range.x;
    const pbr::PhotometricWeb& web = profile.web();
    const bool symmetric = profile.is_polar() && web.cover() == pbr::HorizontalCover::axial;
    const std::vector<int> rows =
        counts(profile.is_polar() ? common_steps(web.vertical_deg(), polar.first, polar.last - polar.first)
                                  : std::nullopt,
               most);
    std::vector<int> columns{1};
    if (!is_axial && !symmetric) {
        std::optional<int> steps;
        if (profile.is_polar() && web.cover() != pbr::HorizontalCover::range)
            steps = common_steps(range.is_folded ? web.horizontal_deg() : web.unfolded().horizontal_deg(),
                                 azimuth.first, azimuth.last - azimuth.first);
        columns = counts(steps, most);
    }
    std::vector<Candidate> list;
    const auto add = [&](std::size_t i, bool ends) {
        const int row = rows[std::min(i, rows.size() - 1)], column = columns[std::min(i, columns.size() - 1)];
        // Texel centres off the ends: an even number of rows has the horizon between two of them.
        const auto even = [](int n) { return n > 1 ? n / 2 * 2 : n; };
        list.push_back(is_axial ? Candidate{ends ? row : even(row), 1, ends}
                                : Candidate{ends ? column : even(column), ends ? row : even(row), ends});
    };
    for (const bool ends : {true, false})
        if (params.align == Align::automatic || (params.align == Align::ends) == ends)
            for (std::size_t i = 0; i < std::max(rows.size(), columns.size()); ++i) add(i, ends);
    return list;
}

/// Odd, so that the axis, where most beams have their peak, falls on a texel.
std::vector<Candidate> square_candidates(const IesParams& params) {
    std::vector<Candidate> list;
    const bool ends = params.align != Align::center && params.projection != Projection::cube;
    for (int n = 33; n <= params.max_size; n = 2 * n - 1) list.push_back({n, n, ends});
    const int most = params.max_size - (params.max_size % 2 == 0 ? 1 : 0);
    if (list.empty() || list.back().width < most) list.push_back({most, most, ends});
    return list;
}

Rendered render_one(const IesParams& params, const Profile& profile, const Candidate& candidate,
                    Context& context) {
    Rendered rendered;
    rendered.layout = make_layout(params, profile, candidate.width, candidate.height, candidate.ends);
    rendered.image = render(rendered.layout, profile, context);
    rendered.decoded = decode(rendered.layout, profile, rendered.image);
    rendered.truth = truth(rendered.layout, profile);
    return rendered;
}

double relative(double value, double truth) { return truth > 0 ? std::abs(value / truth - 1) : 0; }

}  // namespace

double Rendered::flux_error() const { return relative(decoded.flux, truth.flux); }
double Rendered::peak_error() const { return relative(decoded.peak, truth.peak); }

Tolerance tolerance_of(const Accuracy& accuracy) {
    // Half rounds a peak by 5e-4 and leaves flux alone; what is asked for here leaves room for that.
    if (accuracy.stated()) return {.8 * accuracy.max_error, 8 * accuracy.max_error};
    if (accuracy.name == "draft") return {8e-3, .04};
    if (accuracy.name == "reference") return {8e-5, 8e-4};
    return {8e-4, 8e-3};
}

Rendered render_at_best_size(const IesParams& params, const Profile& profile, Context& context) {
    if (!params.is_sized_by_error()) {
        const int height = params.size.size() > 1 ? params.size.back() : 0;
        return render_one(params, profile, {params.size.front(), height, params.align != Align::center},
                          context);
    }
    const bool polar = params.projection == Projection::latlong || params.projection == Projection::axial;
    const Tolerance tolerance = tolerance_of(context.accuracy());
    std::optional<Rendered> best;
    // The mean over azimuth has not the lamp's peak, at any size.
    const bool has_peak =
        params.projection != Projection::axial || profile.web().cover() == pbr::HorizontalCover::axial;
    const auto excess = [&](const Rendered& r) {
        return std::max(r.flux_error() / tolerance.flux, has_peak ? r.peak_error() / tolerance.peak : 0);
    };
    for (const Candidate& candidate : polar ? polar_candidates(params, profile) : square_candidates(params)) {
        context.check_cancelled();
        Rendered rendered = render_one(params, profile, candidate, context);
        const bool fits = excess(rendered) <= 1;
        if (!best || excess(rendered) < excess(*best)) best = std::move(rendered);
        if (fits) break;
    }
    best->is_within = excess(*best) <= 1;
    return std::move(*best);
}

}  // namespace pbrbake::ies

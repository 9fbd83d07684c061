#include "bakers/dfg/sampled.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "bakers/dfg/layout.hpp"
#include "bakers/dfg/terms.hpp"
#include "pbr/numerics/sequence.hpp"

namespace pbrbake::dfg {
namespace {

/// Where a bilinear lookup reads along one axis: texels `low` and `low + 1`, the latter with weight `part`.
struct Lookup {
    int low;
    double part;
};

Lookup lookup(double texel, int n) {
    const double clamped = std::clamp(texel, 0.0, n - 1.0);
    const int low = std::min(static_cast<int>(clamped), std::max(n - 2, 0));
    return {low, clamped - low};
}

double mix(double a, double b, double part) { return (1 - part) * a + part * b; }

/// Values along an axis at which the lookup's error is looked at: both ends of the range and, in each cell
/// between them, the given parts of it. `value` and `texel` convert between values and texel coordinates.
template <class Value, class Texel>
std::vector<double> values_between(Range range, int n, const std::vector<double>& parts, const Value& value,
                                   const Texel& texel) {
    std::vector<double> values{range.lowest, range.highest};
    for (int i = 0; i + 1 < n; ++i)
        for (const double part : parts) {
            // A part of the way in texel coordinates, found by bisection: axes are monotonic.
            double low = std::min(value(i), value(i + 1)), high = std::max(value(i), value(i + 1));
            const bool rising = value(i + 1) > value(i);
            for (int step = 0; step < 40; ++step) {
                const double middle = (low + high) / 2;
                (((texel(middle) < i + part) == rising) ? low : high) = middle;
            }
            if (low > range.lowest && low < range.highest) values.push_back(low);
        }
    std::sort(values.begin(), values.end());
    return values;
}

class Prober {
  public:
    Prober(const DfgParams& params, const Product* table, const pbr::DfgMethod& truth, Context& context)
        : params_(params), table_(table), truth_(truth), context_(context) {
        for (int x = 0; x < params.width(); ++x) texel_values_.push_back(value_of_column(params, x));
        texels_.resize(params.height());
    }

    /// Evaluates the rows of texels that lookups at these values read.
    void prepare(const std::vector<double>& downs) {
        std::set<int> read;
        for (const double down : downs) {
            const int low = lookup(row_of_value(params_, down), params_.height()).low;
            read.insert({low, std::min(low + 1, params_.height() - 1)});
        }
        const std::vector<int> rows(read.begin(), read.end());
        context_.parallel_for(static_cast<std::int64_t>(rows.size()), 1,
                              [&](std::int64_t begin, std::int64_t end) {
                                  for (std::int64_t i = begin; i < end; ++i)
                                      texels_[rows[i]] = exact(value_of_row(params_, rows[i]), texel_values_);
                              });
    }

    /// The errors along one row of points.
    SampledErrors row(double down, const std::vector<double>& across) const {
        const Columns truth = exact(down, across);
        const Lookup y = lookup(row_of_value(params_, down), params_.height());
        const int high_row = std::min(y.low + 1, params_.height() - 1);
        const Columns& low = texels_[y.low];
        const Columns& high = texels_[high_row];
        SampledErrors errors;
        errors.points = static_cast<int>(across.size());
        for (std::size_t i = 0; i < across.size(); ++i) {
            const Lookup x = lookup(column_of_value(params_, across[i]), params_.width());
            const int right = std::min(x.low + 1, params_.width() - 1);
            for (std::size_t c = 0; c < truth.size(); ++c) {
                const double interpolated = mix(mix(low[c][x.low], low[c][right], x.part),
                                                mix(high[c][x.low], high[c][right], x.part), y.part);
                errors.interpolation = std::max(errors.interpolation, std::abs(interpolated - truth[c][i]));
                if (!table_) continue;
                const auto stored = [&](int row, int column) {
                    return table_->images[0].texel(0, 0, row, column)[c] / table_->scale;
                };
                const double read =
                    mix(mix(stored(y.low, x.low), stored(y.low, right), x.part),
                        mix(stored(high_row, x.low), stored(high_row, right), x.part), y.part);
                errors.sampled = std::max(errors.sampled, std::abs(read - truth[c][i]));
            }
        }
        return errors;
    }

  private:
    Columns exact(double down, const std::vector<double>& across) const {
        return Row(params_, truth_, down, across, context_, "certify.").evaluate();
    }

    const DfgParams& params_;
    const Product* table_;
    const pbr::DfgMethod& truth_;
    Context& context_;
    std::vector<double> texel_values_;
    std::vector<Columns> texels_;  ///< exact, a row each; empty where no lookup reads
};

/// The smoothest row, where errors are largest, and others by hash, more of them smooth.
std::vector<double> some_rows(Range range, int number, std::uint64_t seed) {
    std::vector<double> rows{range.lowest};
    for (int i = 1; i < number; ++i) {
        const double u = pbr::random_unit(seed, 3, i);
        rows.push_back(range.lowest + (range.highest - range.lowest) * u * u);
    }
    return rows;
}

}  // namespace

SampledErrors sampled_errors(const DfgParams& params, const Product* table, const pbr::DfgMethod& truth,
                             Probing probing, int row_count, std::uint64_t seed, Context& context) {
    const std::vector<double> columns = values_between(
        across(params), params.width(),
        probing == Probing::middles ? std::vector{0.5} : std::vector{0.25, 0.5, 0.75},
        [&](int x) { return value_of_column(params, x); },
        [&](double value) { return column_of_value(params, value); });
    const std::vector<double> rows =
        probing != Probing::some
            ? values_between(
                  down(params), params.height(), {0.0, 0.5}, [&](int y) { return value_of_row(params, y); },
                  [&](double value) { return row_of_value(params, value); })
            : some_rows(down(params), row_count, seed);
    Prober prober(params, table, truth, context);
    prober.prepare(rows);
    std::vector<SampledErrors> found(rows.size());
    context.parallel_for(
        static_cast<std::int64_t>(rows.size()), 1, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t i = begin; i < end; ++i)
                found[static_cast<std::size_t>(i)] = prober.row(rows[static_cast<std::size_t>(i)], columns);
        });
    SampledErrors worst;
    for (const SampledErrors& errors : found) {
        worst.interpolation = std::max(worst.interpolation, errors.interpolation);
        worst.sampled = std::max(worst.sampled, errors.sampled);
        worst.points += errors.points;
    }
    return worst;
}

}  // namespace pbrbake::dfg

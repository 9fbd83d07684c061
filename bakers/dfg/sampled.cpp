#include "bakers/dfg/sampled.hpp"

#include <algorithm>
#include <array>
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
        texels_.resize(static_cast<std::size_t>(params.height()) * params.depth());
    }

    /// Evaluates the rows of texels that lookups at these values read.
    void prepare(const std::vector<Place>& places) {
        std::set<int> read;
        for (const Place& place : places)
            for (const WeightedRow& row : rows_read(place)) read.insert(row.index);
        const std::vector<int> rows(read.begin(), read.end());
        context_.parallel_for(static_cast<std::int64_t>(rows.size()), 1,
                              [&](std::int64_t begin, std::int64_t end) {
                                  for (std::int64_t i = begin; i < end; ++i)
                                      texels_[rows[i]] = exact(place_of(rows[i]), texel_values_);
                              });
    }

    /// The errors along one row of points.
    SampledErrors row(const Place& place, const std::vector<double>& across) const {
        const Columns truth = exact(place, across);
        const std::array<WeightedRow, 4> rows = rows_read(place);
        SampledErrors errors;
        errors.points = static_cast<int>(across.size());
        for (std::size_t i = 0; i < across.size(); ++i) {
            const Lookup x = lookup(column_of_value(params_, across[i]), params_.width());
            const int right = std::min(x.low + 1, params_.width() - 1);
            for (std::size_t c = 0; c < truth.size(); ++c) {
                double interpolated = 0, read = 0;
                for (const auto& [index, weight] : rows) {
                    const std::vector<double>& exact_row = texels_[index][c];
                    interpolated += weight * mix(exact_row[x.low], exact_row[right], x.part);
                    if (table_)
                        read += weight * mix(stored(index, x.low, c), stored(index, right, c), x.part);
                }
                errors.interpolation = std::max(errors.interpolation, std::abs(interpolated - truth[c][i]));
                if (!table_) continue;
                errors.sampled = std::max(errors.sampled, std::abs(read - truth[c][i]));
            }
        }
        return errors;
    }

  private:
    /// A row of texels by its index, slices slowest, and what a lookup takes of it.
    struct WeightedRow {
        int index;
        double weight;
    };
    std::array<WeightedRow, 4> rows_read(const Place& place) const {
        const Lookup y = lookup(row_of_value(params_, place.down), params_.height());
        const Lookup z = lookup(slice_of_value(params_, place.stretch), params_.depth());
        const int right = std::min(y.low + 1, params_.height() - 1);
        const int near = z.low * params_.height(),
                  far = std::min(z.low + 1, params_.depth() - 1) * params_.height();
        return {{{near + y.low, (1 - z.part) * (1 - y.part)},
                 {near + right, (1 - z.part) * y.part},
                 {far + y.low, z.part * (1 - y.part)},
                 {far + right, z.part * y.part}}};
    }
    Place place_of(int row) const {
        return {value_of_row(params_, row % params_.height()),
                value_of_slice(params_, row / params_.height())};
    }
    Columns exact(const Place& place, const std::vector<double>& across) const {
        return Row(params_, truth_, place, across, context_, "certify.").evaluate();
    }
    double stored(int row, int x, std::size_t c) const {
        return table_->images[0].texel(0, row / params_.height(), row % params_.height(), x)[c] /
               table_->scale;
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
    const std::vector<double> downs =
        probing != Probing::some
            ? values_between(
                  down(params), params.height(), {0.0, 0.5}, [&](int y) { return value_of_row(params, y); },
                  [&](double value) { return row_of_value(params, value); })
            : some_rows(down(params), row_count, seed);
    const std::vector<double> stretches = values_between(
        deep(params), params.depth(), {0.5}, [&](int z) { return value_of_slice(params, z); },
        [&](double value) { return slice_of_value(params, value); });
    std::vector<Place> rows;
    for (std::size_t i = 0; i < downs.size(); ++i) {
        if (!is_volume(params))
            rows.push_back({downs[i]});
        else if (probing == Probing::some)
            rows.push_back({downs[i], stretches[i * 7 % stretches.size()]});
        else
            for (const double stretch : stretches) rows.push_back({downs[i], stretch});
    }
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

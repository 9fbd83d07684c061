#pragma once
// What a table's channels can hold. A term is an entry of one list in terms.cpp; nothing else knows them.

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/context.hpp"
#include "bakers/dfg/params.hpp"
#include "pbr/ibl/dfg.hpp"

namespace pbrbake::dfg {

/// Values along a row, a vector for each channel.
using Columns = std::vector<std::vector<double>>;

/// Where a row lies, beside the views along it.
struct Place {
    double down;         ///< perceptual roughness, of a volume that along the view; curvature
    double stretch = 1;  ///< of a volume: width across the view over that along it
};

/// A row of a table that is being evaluated: many views at one roughness. What several terms need is had
/// once, and counted where it is had.
class Row {
  public:
    /// `params` are settled; `across` are values of NoV (NoL of a subsurface table), `place` the
    /// row's. Evaluations are counted as `counter_prefix` + effect. What is passed
    /// by reference outlives the row.
    Row(const DfgParams& params, const pbr::DfgMethod& method, Place place, std::span<const double> across,
        Context& context, std::string_view counter_prefix = "");

    /// All channels of all terms, in their order.
    Columns evaluate();

    struct Ggx {
        std::vector<double> E, Fc;
    };
    /// E and Fc of height-correlated GGX along the row.
    const Ggx& ggx();
    /// The same of another visibility, counted as `effect`.
    Ggx ggx_of(pbr::DfgVisibility visibility, std::string_view effect);
    /// The same of a lobe that is stretched along or across the view.
    Ggx ggx_anisotropic();

    template <class Value>
    std::vector<double> each(std::string_view effect, std::uint64_t evaluations_a_view, const Value& value) {
        context_.check_cancelled();
        std::vector<double> values;
        for (const double x : across_) values.push_back(value(x));
        count(effect, evaluations_a_view * across_.size());
        return values;
    }
    void count(std::string_view effect, std::uint64_t evaluations);

    const DfgParams& params() const { return params_; }
    double down() const { return place_.down; }
    double alpha() const;
    std::size_t views() const { return across_.size(); }

  private:
    const DfgParams& params_;
    const pbr::DfgMethod& method_;
    Place place_;
    std::span<const double> across_;
    Context& context_;
    std::string_view counter_prefix_;
    Ggx ggx_;  ///< empty until asked for
};

/// Names of all channels, in order.
std::vector<std::string> channel_names(const DfgParams& params);

/// Whether a term is had over (NoL, curvature) instead of (NoV, roughness).
bool is_over_curvature(Term term);

/// Whether a term is had over (NoV, roughness along the view, stretch): its table is a volume.
bool is_volume(Term term);
bool is_volume(const DfgParams& params);

/// Whether a term is made of E and Fc, whose error the certificate bounds.
bool is_of_ggx(Term term);

}  // namespace pbrbake::dfg

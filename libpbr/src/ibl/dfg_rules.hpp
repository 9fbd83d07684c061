#pragma once
// Tables of quadrature rules by the error they leave.

#include <array>
#include <span>

#include "pbr/ibl/dfg.hpp"

namespace pbr {

/// Node counts of each band and the largest error they leave.
struct DfgRuleSize {
    double max_error;
    struct Nodes {
        int azimuth, radial;
    };
    std::array<Nodes, 4> bands;
};

/// The first rule of a table, coarse to fine, whose error is at most max_error, else the finest.
inline DfgRule dfg_rule_of(std::span<const DfgRuleSize> sizes, double max_error) {
    constexpr std::array kLowestNoV{0.0, 0.01, 0.1, 0.4};
    std::size_t i = 0;
    while (i + 1 < sizes.size() && sizes[i].max_error > max_error) ++i;
    DfgRule rule{{}, sizes[i].max_error};
    for (std::size_t band = 0; band < rule.bands.size(); ++band)
        rule.bands[band] = {kLowestNoV[band], gauss_legendre(sizes[i].bands[band].azimuth),
                            gauss_legendre(sizes[i].bands[band].radial)};
    return rule;
}

}  // namespace pbr

#pragma once
// The constants of energy.hpp, for one lobe and for many.

#include <array>

namespace pbr {

/// Fits at Chebyshev nodes; lowest power first.
inline constexpr std::array kMeanE{.99999978,   4.2863883e-05, .000575394657, -.132804113,
                                   -4.99341348, 13.324337,     -23.7703342,   31.5947027,
                                   -25.8141901, 11.152991,     -1.9527692};
inline constexpr std::array kMeanFc{.0476217617, -.00066311233, .0281961339, -.59658902,
                                    -3.88473752, 28.175411,     -72.3342107, 99.9956362,
                                    -79.6328315, 34.5652046,    -6.36028471};

inline constexpr double kF90Slope = 50 * .33 * 3;  ///< of f90_from_f0 over grey f0
inline constexpr double kFullF90 = 1 / kF90Slope;  ///< the f0 from which f90 is 1
inline constexpr double kMeanWeight = 1. / 21;     ///< mean of Schlick's weight

}  // namespace pbr

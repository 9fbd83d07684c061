#include "pbr/brdf/multiscatter.hpp"

#include <cmath>
#include <vector>

#include "pbr/ibl/dfg.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {

double average_albedo_ggx(double alpha) {
    if (alpha <= 0) return 1;
    // E bends where mu is about alpha: one panel up to there, and one in the logarithm of mu from there on,
    // which at alpha = 1 is empty.
    static const QuadratureRule rule = gauss_legendre(24);
    static const DfgMethod method = DfgMethod::quadrature(1e-8);
    std::vector<double> mu, weight;
    for (int i = 0; i < rule.size(); ++i) {
        mu.push_back(alpha * rule.nodes[i]);
        weight.push_back(alpha * rule.weights[i]);
        mu.push_back(std::pow(alpha, rule.nodes[i]));
        weight.push_back(-std::log(alpha) * mu.back() * rule.weights[i]);
    }
    std::vector<double> E(mu.size()), Fc(mu.size());
    dfg_ggx_row(mu, alpha, method, E, Fc);
    double lost = 0;
    for (std::size_t i = 0; i < mu.size(); ++i) lost += 2 * weight[i] * mu[i] * (1 - E[i]);
    return 1 - lost;
}

}  // namespace pbr

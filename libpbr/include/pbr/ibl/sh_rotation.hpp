#pragma once
// Rotation of functions given by spherical harmonics. T is float or double.

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <glm/mat3x3.hpp>
#include <span>
#include <vector>

#include "pbr/ibl/spherical_harmonics.hpp"

namespace pbr {

/// The matrices that rotate coefficients, one a band: Y(R d) = M Y(d), and a function f with coefficients c
/// becomes f(R^-1 d) with coefficients M c.
///
/// Ivanic & Ruedenberg's recursion over bands (1996, "Rotation matrices for real spherical harmonics. Direct
/// determination by recursion", J. Phys. Chem. 100, eqs. 6-8 and tables 1-2) with the corrections of 1998 (J.
/// Phys. Chem. A 102, p. 9099), and one that their correction still lacks: for m < 0, V takes P(1, m+1) (1 -
/// delta(m, -1)) + P(-1, -m-1) sqrt(1 + delta(m, -1)). Orthogonal within 2e-14 for 16 bands in double, 2e-5
/// in float. Memory and time grow with bands^3.
template <class T>
class ShRotation {
  public:
    /// `rotation` takes directions to rotated directions; it must be orthogonal with determinant 1. bands >=
    /// 1.
    ShRotation(int bands, const glm::mat<3, 3, T>& rotation) : bands_(bands) {
        assert(bands >= 1);
        matrices_.resize(bands);
        matrices_[0] = {T(1)};
        if (bands < 2) return;
        constexpr int kAxis[3] = {1, 2, 0};  // band 1 is (y, z, x)
        matrices_[1].resize(9);
        for (int m = 0; m < 3; ++m)
            for (int n = 0; n < 3; ++n)
                matrices_[1][m * 3 + n] = rotation[kAxis[n]][kAxis[m]];  // GLM: column, row
        for (int l = 2; l < bands; ++l) {
            matrices_[l].resize((2 * l + 1) * (2 * l + 1));
            for (int m = -l; m <= l; ++m)
                for (int n = -l; n <= l; ++n) matrices_[l][(m + l) * (2 * l + 1) + n + l] = element(l, m, n);
        }
    }

    /// The element of band l's matrix that takes coefficient n to m; -l <= m, n <= l < bands.
    T at(int l, int m, int n) const { return matrices_[l][(m + l) * (2 * l + 1) + n + l]; }

    /// Rotates bands^2 coefficients (T or GLM vectors); the spans may not overlap.
    template <class Value>
    void apply(std::span<const Value> coefficients, std::span<Value> out) const {
        for (int l = 0; l < bands_; ++l)
            for (int m = -l; m <= l; ++m) {
                Value sum(T(0));
                for (int n = -l; n <= l; ++n) sum += coefficients[sh_index(l, n)] * at(l, m, n);
                out[sh_index(l, m)] = sum;
            }
    }

  private:
    /// P of the paper's table 2, from the matrices of band 1 and l - 1.
    T p(int l, int i, int a, int b) const {
        if (b == l) return at(1, i, 1) * at(l - 1, a, l - 1) - at(1, i, -1) * at(l - 1, a, 1 - l);
        if (b == -l) return at(1, i, 1) * at(l - 1, a, 1 - l) + at(1, i, -1) * at(l - 1, a, l - 1);
        return at(1, i, 0) * at(l - 1, a, b);
    }

    /// V of table 1, without its factor v.
    T v_term(int l, int m, int n) const {
        if (m == 0) return p(l, 1, 1, n) + p(l, -1, -1, n);
        const T root2 = std::numbers::sqrt2_v<T>;
        if (m == 1) return root2 * p(l, 1, 0, n);
        if (m == -1) return root2 * p(l, -1, 0, n);
        return m > 0 ? p(l, 1, m - 1, n) - p(l, -1, 1 - m, n) : p(l, 1, m + 1, n) + p(l, -1, -m - 1, n);
    }

    /// W of table 1, without its factor w.
    T w_term(int l, int m, int n) const {
        return m > 0 ? p(l, 1, m + 1, n) + p(l, -1, -m - 1, n) : p(l, 1, m - 1, n) - p(l, -1, 1 - m, n);
    }

    /// Element (m, n) of band l's matrix, u U + v V + w W.
    T element(int l, int m, int n) const {
        const int a = std::abs(m);
        const T d = static_cast<T>(std::abs(n) < l ? (l + n) * (l - n) : 2 * l * (2 * l - 1));
        const T u = std::sqrt(static_cast<T>((l + m) * (l - m)) / d);
        const T v =
            std::sqrt(static_cast<T>((m == 0 ? 2 : 1) * (l + a - 1) * (l + a)) / d) / T(m == 0 ? -2 : 2);
        const T w = m == 0 ? T(0) : -std::sqrt(static_cast<T>((l - a - 1) * (l - a)) / d) / T(2);
        // Where a factor is 0 its term would read outside band l - 1.
        T sum = v * v_term(l, m, n);
        if (u != T(0)) sum += u * p(l, 0, m, n);
        if (w != T(0)) sum += w * w_term(l, m, n);
        return sum;
    }

    int bands_;
    std::vector<std::vector<T>> matrices_;
};

}  // namespace pbr

#pragma once
// 3x3 matrices between primaries and CIE XYZ, in double.

#include <array>

#include "bakers/io/encoding.hpp"

namespace pbrbake::io {

using Vector3 = std::array<double, 3>;
using Matrix3 = std::array<Vector3, 3>;  ///< rows

inline Vector3 operator*(const Matrix3& m, const Vector3& v) {
    Vector3 r{};
    for (std::size_t i = 0; i < 3; ++i) r[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return r;
}

inline Matrix3 operator*(const Matrix3& a, const Matrix3& b) {
    Matrix3 r{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
            r[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
    return r;
}

inline double determinant(const Matrix3& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// `m` must not be singular.
inline Matrix3 inverse(const Matrix3& m) {
    const double d = 1 / determinant(m);
    const auto cofactor = [&](std::size_t i, std::size_t j) {
        const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
        return m[i1][j1] * m[i2][j2] - m[i1][j2] * m[i2][j1];
    };
    Matrix3 r{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) r[i][j] = cofactor(j, i) * d;
    return r;
}

/// XYZ of luminance 1 at chromaticity xy; y must not be 0.
inline Vector3 xyz_of(const std::array<double, 2>& xy) {
    return {xy[0] / xy[1], 1, (1 - xy[0] - xy[1]) / xy[1]};
}

inline Matrix3 diagonal(const Vector3& v) { return {{{v[0], 0, 0}, {0, v[1], 0}, {0, 0, v[2]}}}; }

/// RGB to XYZ with white at luminance 1 (SMPTE RP 177-1993, section 3.3).
inline Matrix3 rgb_to_xyz(const Chromaticities& c) {
    const auto column = [](const std::array<double, 2>& xy) {
        return Vector3{xy[0], xy[1], 1 - xy[0] - xy[1]};
    };
    const Vector3 r = column(c.red), g = column(c.green), b = column(c.blue);
    const Matrix3 p{{{r[0], g[0], b[0]}, {r[1], g[1], b[1]}, {r[2], g[2], b[2]}}};
    return p * diagonal(inverse(p) * xyz_of(c.white));
}

/// Bradford chromatic adaptation of XYZ from one white to another (Lam 1985; ICC.1:2022, annex E).
inline Matrix3 bradford(const std::array<double, 2>& from, const std::array<double, 2>& to) {
    constexpr Matrix3 cone{{{.8951, .2664, -.1614}, {-.7502, 1.7135, .0367}, {.0389, -.0685, 1.0296}}};
    const Vector3 a = cone * xyz_of(from), b = cone * xyz_of(to);
    return inverse(cone) * diagonal({b[0] / a[0], b[1] / a[1], b[2] / a[2]}) * cone;
}

}  // namespace pbrbake::io

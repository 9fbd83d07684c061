#include "bakers/probe/low_bands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/zonal_harmonics.hpp"
#include "pbr/ibl/zonal_kernel.hpp"

namespace pbrbake::probe {
namespace {

constexpr std::size_t kDegrees = 4;  // of monomials: 0 to 3

/// On a face d = (s, t, 1) / rho in some order and with some signs: a monomial of d is one of s and t over
/// rho^degree.
struct FaceMonomial {
    std::size_t degree, of_s, of_t;
    double sign;
};

std::array<FaceMonomial, pbr::kMomentCount> monomials_on(int face) {
    const glm::dvec3 middle = pbr::cube_vector(face, 0, 0);
    const glm::dvec3 along_s = pbr::cube_vector(face, 1, 0) - middle,
                     along_t = pbr::cube_vector(face, 0, 1) - middle;
    std::array<FaceMonomial, pbr::kMomentCount> on_face{};
    for (std::size_t k = 0; k < on_face.size(); ++k) {
        const pbr::Monomial& m = pbr::kMonomials[k];
        const std::array<int, 3> powers{m.a, m.b, m.c};
        FaceMonomial& own = on_face[k] = {0, 0, 0, 1};
        for (int i = 0; i < 3; ++i)
            for (int p = 0; p < powers[static_cast<std::size_t>(i)]; ++p) {
                ++own.degree;
                own.of_s += along_s[i] != 0;
                own.of_t += along_t[i] != 0;
                own.sign *= middle[i] + along_s[i] + along_t[i];
            }
    }
    return on_face;
}

/// The bands of a filtered picture as a polynomial of the direction: factors of kMonomials. With k_l of the
/// kernel it is the sum over l of k_l (2 l + 1) / (4 pi) times the integral of radiance times P_l(n.d), and
/// the powers of n.d are polynomials of n with moments of d.
pbr::SphereMoments filtered(const pbr::SphereMoments& source, double alpha) {
    std::vector<double> k = pbr::zonal_ggx(pbr::GgxZonalKernel(alpha), kDegrees);
    for (double& band : k) band /= 4 * std::numbers::pi;
    const std::array<double, kDegrees> of_power{k[0] - 2.5 * k[2], 3 * k[1] - 10.5 * k[3], 7.5 * k[2],
                                                17.5 * k[3]};
    constexpr std::array<double, kDegrees> kFactorial{1, 1, 2, 6};
    pbr::SphereMoments factors = source;
    for (std::size_t i = 0; i < factors.size(); ++i) {
        const pbr::Monomial& m = pbr::kMonomials[i];
        const auto degree = static_cast<std::size_t>(m.a + m.b + m.c);
        factors[i] *= of_power[degree] * kFactorial[degree] /
                      (kFactorial[static_cast<std::size_t>(m.a)] * kFactorial[static_cast<std::size_t>(m.b)] *
                       kFactorial[static_cast<std::size_t>(m.c)]);
    }
    return factors;
}

/// What all rows of a level share.
struct Columns {
    explicit Columns(int n) : s(static_cast<std::size_t>(n)), inverse(s), solid_angle(s), value(s) {
        for (int x = 0; x < n; ++x) s[static_cast<std::size_t>(x)] = (2 * x + 1.0) / n - 1;
    }
    void set_row(double t, const double* solid_angles) {
        for (std::size_t x = 0; x < s.size(); ++x) {
            inverse[x] = 1 / std::sqrt(1 + s[x] * s[x] + t * t);
            solid_angle[x] = solid_angles[x];
        }
    }
    std::vector<double> s;
    std::vector<double> inverse;  ///< 1 / rho
    std::vector<double> solid_angle;
    std::vector<double> value;
};

/// Sums of one face and channel over its rows, a column each: of value times solid angle times t^q /
/// rho^degree.
class FaceSums {
  public:
    explicit FaceSums(int n) {
        for (auto& of_degree : sums_)
            for (auto& sum : of_degree) sum.resize(static_cast<std::size_t>(n));
    }

    /// Takes the polynomial off the values of a row, and adds them; `channel` is that of the factors.
    void add_row(double t, const std::array<FaceMonomial, pbr::kMomentCount>& on_face,
                 const pbr::SphereMoments& factors, int channel, Columns& columns) {
        const double powers[kDegrees] = {1, t, t * t, t * t * t};
        double of_s[kDegrees][kDegrees] = {};  // a degree: factors of the powers of s
        for (std::size_t k = 0; k < on_face.size(); ++k)
            of_s[on_face[k].degree][on_face[k].of_s] +=
                on_face[k].sign * factors[k][channel] * powers[on_face[k].of_t];
        const std::size_t n = columns.s.size();
        const double *s = columns.s.data(), *inverse = columns.inverse.data();
        double* value = columns.value.data();
        for (std::size_t x = 0; x < n; ++x) {
            double known = 0;
            for (std::size_t degree = kDegrees; degree-- > 0;) {
                const double* of = of_s[degree];
                known = known * inverse[x] + (of[0] + s[x] * (of[1] + s[x] * (of[2] + s[x] * of[3])));
            }
            value[x] = (value[x] - known) * columns.solid_angle[x];
        }
        for (std::size_t degree = 0; degree < kDegrees; ++degree) {
            for (std::size_t q = 0; q <= degree; ++q) {
                double* sum = sums_[degree][q].data();
                for (std::size_t x = 0; x < n; ++x) sum[x] += powers[q] * value[x];
            }
            for (std::size_t x = 0; x < n; ++x) value[x] *= inverse[x];
        }
    }

    /// The sum over the face of value times solid angle times a monomial.
    double moment(const FaceMonomial& monomial, const Columns& columns) const {
        double result = 0;
        for (std::size_t x = 0; x < columns.s.size(); ++x) {
            double power = 1;
            for (std::size_t p = 0; p < monomial.of_s; ++p) power *= columns.s[x];
            result += power * sums_[monomial.degree][monomial.of_t][x];
        }
        return monomial.sign * result;
    }

  private:
    std::array<std::array<std::vector<double>, kDegrees>, kDegrees> sums_;
};

}  // namespace

double low_band_difference(const Image& image, int level, double scale, const pbr::SphereMoments& source,
                           double alpha, const pbr::ForEach& each) {
    const int n = image.levels[static_cast<std::size_t>(level)].width;
    const pbr::SphereMoments factors = filtered(source, alpha);
    const std::vector<double> solid_angles = pbr::cubemap_solid_angles(n);
    std::array<pbr::SphereMoments, 6> of_faces{};
    each(6, [&](int face) {
        const std::array<FaceMonomial, pbr::kMomentCount> on_face = monomials_on(face);
        Columns columns(n);
        std::array<FaceSums, 3> sums{FaceSums(n), FaceSums(n), FaceSums(n)};
        for (int y = 0; y < n; ++y) {
            const double t = (2 * y + 1.0) / n - 1;
            columns.set_row(t, &solid_angles[static_cast<std::size_t>(y) * n]);
            const float* texels = image.texel(level, face, y, 0);
            for (int c = 0; c < 3; ++c) {
                for (int x = 0; x < n; ++x)
                    columns.value[static_cast<std::size_t>(x)] =
                        static_cast<double>(texels[3 * x + c]) / scale;
                sums[static_cast<std::size_t>(c)].add_row(t, on_face, factors, c, columns);
            }
        }
        pbr::SphereMoments& own = of_faces[static_cast<std::size_t>(face)];
        for (std::size_t k = 0; k < own.size(); ++k)
            for (int c = 0; c < 3; ++c)
                own[k][c] = sums[static_cast<std::size_t>(c)].moment(on_face[k], columns);
    });
    pbr::SphereMoments rest{};
    for (const pbr::SphereMoments& of_face : of_faces)
        for (std::size_t k = 0; k < rest.size(); ++k) rest[k] += of_face[k];
    double largest = 0;
    for (const glm::dvec3& coefficient : pbr::sh_project(rest, pbr::kMomentBands))
        for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(coefficient[c]));
    return largest;
}

}  // namespace pbrbake::probe

// Near sums over an equirect. Lanes hold neighbouring columns: |n - d|^2 = A + B sin^2(half their azimuth
// from n), A and B of the row alone. Any vector width gives the same bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/near_field_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "src/simd/near_field_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, kNearLanes>;
using V = hn::Vec<D>;

HWY_INLINE V near_value(const NearKernel& kernel, V chord2) {
    const D d;
    const V half = hn::Mul(chord2, hn::Set(d, 0.5f)), t = hn::Sub(half, hn::Set(d, kernel.limit));
    const V f = hn::Add(hn::Set(d, kernel.alpha2), hn::Mul(hn::Set(d, kernel.slope), chord2));
    const V mu = hn::Sub(hn::Set(d, kernel.normalisation), hn::Mul(hn::Set(d, kernel.normalisation), half));
    V far = hn::Set(d, kernel.polynomial[3]);
    for (int n = 2; n >= 0; --n)
        far = hn::Add(hn::Mul(far, t), hn::Set(d, kernel.polynomial[static_cast<std::size_t>(n)]));
    return hn::IfThenElseZero(hn::Lt(t, hn::Zero(d)), hn::Sub(hn::Div(mu, hn::Mul(f, f)), far));
}

/// sin^2 of half the azimuths between the direction and the points of a rule, [i * columns + column].
void half_azimuths(const NearWindow& window, const NearField::Points& points, std::vector<float>& squares) {
    const hn::CappedTag<double, kNearLanes> d;
    const hn::Rebind<float, decltype(d)> narrow;
    const std::size_t columns = static_cast<std::size_t>(window.blocks) * kNearLanes, width = window.width;
    squares.resize(columns * points.order);
    const auto x = hn::Set(d, window.x), z = hn::Set(d, window.z);
    for (std::size_t i = 0; i < static_cast<std::size_t>(points.order); ++i)
        for (std::size_t k = 0; k < columns; k += hn::Lanes(d)) {
            const std::size_t from = i * 2 * width + window.left + k;
            const auto dx = hn::Sub(hn::LoadU(d, &points.column_sine[from]), x);
            const auto dz = hn::Sub(hn::LoadU(d, &points.column_cosine[from]), z);
            const auto chord2 = hn::Add(hn::Mul(dx, dx), hn::Mul(dz, dz));
            hn::StoreU(hn::DemoteTo(narrow, hn::Mul(chord2, hn::Set(d, 0.25))), narrow,
                       &squares[i * columns + k]);
        }
}

/// Sums for one direction; returns the evaluations.
std::uint64_t near_sum(const NearKernel& kernel, const NearWindow& window,
                       std::span<const NearField::Points> rules, std::vector<std::vector<float>>& squares,
                       double* rgb) {
    const D d;
    const std::size_t lanes = hn::Lanes(d), columns = static_cast<std::size_t>(window.blocks) * kNearLanes;
    for (std::vector<float>& of_rule : squares) of_rule.clear();
    half_azimuths(window, rules[0], squares[0]);
    std::vector<float>& least = squares.back();  // of each block
    for (int block = 0; block < window.blocks; ++block) {
        const float* own = &squares[0][static_cast<std::size_t>(block) * kNearLanes];
        least.push_back(*std::min_element(own, own + kNearLanes));
    }
    HWY_ALIGN_MAX float sums[3][kNearLanes] = {};
    std::uint64_t evaluations = 0;
    for (int row = window.top; row < window.bottom; ++row) {
        const auto place = [&](const NearField::Points& points, std::size_t i, double& a, double& b) {
            const std::size_t at = static_cast<std::size_t>(row) * points.order + i;
            const double ds = window.sine - points.row_sine[at], dc = window.cosine - points.row_cosine[at];
            a = ds * ds + dc * dc;
            b = 4 * window.sine * points.row_sine[at];
        };
        double middle_a, middle_b;
        place(rules[0], 0, middle_a, middle_b);
        for (int block = 0; block < window.blocks; ++block) {
            const std::size_t first = static_cast<std::size_t>(block) * kNearLanes;
            const double nearest2 =
                middle_a + middle_b * static_cast<double>(least[static_cast<std::size_t>(block)]);
            if (nearest2 >= window.beyond2) continue;
            std::size_t index = 0;
            while (index + 1 < rules.size() && nearest2 < rules[index].from2) ++index;
            const NearField::Points& points = rules[index];
            if (squares[index].empty()) half_azimuths(window, points, squares[index]);

            HWY_ALIGN_MAX float weights[kNearLanes] = {};
            for (std::size_t i = 0; i < static_cast<std::size_t>(points.order); ++i) {
                double a, b;
                place(points, i, a, b);
                const V va = hn::Set(d, static_cast<float>(a)), vb = hn::Set(d, static_cast<float>(b));
                const float of_row = points.row_weight[static_cast<std::size_t>(row) * points.order + i];
                for (std::size_t lane = 0; lane < kNearLanes; lane += lanes) {
                    V sum = hn::Zero(d);
                    for (std::size_t j = 0; j < static_cast<std::size_t>(points.order); ++j) {
                        const V square = hn::LoadU(d, &squares[index][j * columns + first + lane]);
                        sum = hn::Add(sum, hn::Mul(hn::Set(d, points.column_weight[j]),
                                                   near_value(kernel, hn::Add(va, hn::Mul(vb, square)))));
                    }
                    const V total = hn::Add(hn::Load(d, weights + lane), hn::Mul(sum, hn::Set(d, of_row)));
                    hn::Store(total, d, weights + lane);
                }
            }
            evaluations += static_cast<std::uint64_t>(points.order) * points.order * kNearLanes;

            int column = window.left + static_cast<int>(first);
            if (column >= window.width) column -= window.width;
            const float* from = window.rows[static_cast<std::size_t>(row)] + 3L * column;
            float joined[3 * kNearLanes];
            const int ahead = window.width - column;
            if (ahead < kNearLanes) {  // around the seam; what a picture is too narrow for has no weight
                for (int k = 0; k < kNearLanes; ++k) {
                    const int x = (column + k) % window.width;
                    std::copy_n(window.rows[static_cast<std::size_t>(row)] + 3L * x, 3, joined + 3 * k);
                    if (static_cast<int>(first) + k >= window.width) weights[k] = 0;
                }
                from = joined;
            }
            for (std::size_t lane = 0; lane < kNearLanes; lane += lanes) {
                V r, g, b;
                hn::LoadInterleaved3(d, from + 3 * lane, r, g, b);
                const V weight = hn::Load(d, weights + lane);
                const auto add = [&](V value, std::size_t channel) HWY_ATTR {
                    const V more = hn::Mul(weight, hn::Sub(value, hn::Set(d, window.constant[channel])));
                    hn::Store(hn::Add(hn::Load(d, sums[channel] + lane), more), d, sums[channel] + lane);
                };
                add(r, 0);
                add(g, 1);
                add(b, 2);
            }
        }
    }
    for (int c = 0; c < 3; ++c)
        for (const float sum : sums[c]) rgb[c] += static_cast<double>(sum);
    return evaluations;
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(near_sum);

constexpr double kPi = std::numbers::pi;

NearField::Points points_of(const EquirectView& source, int order) {
    const QuadratureRule rule = gauss_legendre(order);
    NearField::Points points{order, 0, {}, {}, {}, {}, {}, {}};
    for (int row = 0; row < source.height; ++row) {
        double sines = 0;
        for (int i = 0; i < order; ++i) {
            const SinCos angle = sin_cos_pi((row + rule.nodes[i]) / source.height);
            points.row_sine.push_back(angle.sin);
            points.row_cosine.push_back(angle.cos);
            sines += rule.weights[i] * angle.sin;
        }
        const double area = equirect_texel_solid_angle(source.width, source.height, row);
        for (int i = 0; i < order; ++i)
            points.row_weight.push_back(static_cast<float>(
                area * rule.weights[i] * points.row_sine[static_cast<std::size_t>(row) * order + i] / sines));
    }
    for (int i = 0; i < order; ++i) {
        points.column_weight.push_back(static_cast<float>(rule.weights[i]));
        for (int column = 0; column < 2 * source.width; ++column) {
            const SinCos longitude =
                sin_cos_pi(1 - 2 * (column % source.width + rule.nodes[i]) / source.width);
            points.column_sine.push_back(longitude.sin);
            points.column_cosine.push_back(longitude.cos);
        }
    }
    // Blocks of a picture around which the window goes end past its columns.
    points.column_sine.resize(points.column_sine.size() + kNearLanes);
    points.column_cosine.resize(points.column_cosine.size() + kNearLanes);
    return points;
}

}  // namespace

NearField::NearField(const EquirectView& source, const PicturePart& part, const SplitKernel& split)
    : source_(source),
      constant_(part.constant),
      split_(split),
      radius_(split.radius()),
      texel_angle_(std::max(2 * kPi / source.width, kPi / source.height)),
      rows_(source, part) {
    // Gauss-Legendre over a texel of angle h converges once h is well below the distance of the kernel's
    // poles, about hypot(2 alpha, angle); of lobes narrower than texels it is that of the texel's edge.
    const double poles = 2 * split.kernel().alpha(), margin = poles < texel_angle_ ? texel_angle_ / 2 : 0;
    for (const int order : {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64, 96, 128}) {
        rules_.push_back(points_of(source, order));
        const double distance = texel_angle_ / (order == 1 ? 0.04 : (order - 1) / 4.0);
        if (distance <= poles) break;
        rules_.back().from2 = std::pow(margin + std::sqrt((distance - poles) * (distance + poles)), 2);
    }
}

std::uint64_t NearField::add(std::span<const glm::dvec3> directions, std::span<double> rgb) const {
    const NearKernel kernel(split_);
    const double sine_radius = sin_cos_pi(radius_ / kPi).sin;
    std::vector<std::vector<float>> squares(rules_.size() + 1);
    std::vector<glm::dvec3> turned;
    for (const glm::dvec3& direction : directions) turned.push_back(source_.world_to_source * direction);
    std::vector<glm::dvec2> points(turned.size());
    equirect_points(turned, points);
    std::uint64_t evaluations = 0;
    for (std::size_t i = 0; i < turned.size(); ++i) {
        const glm::dvec3& n = turned[i];
        const double sine = std::sqrt(n.x * n.x + n.z * n.z), colatitude = points[i].y * kPi;
        NearWindow window{rows_.all(), source_.width, constant_, 0, 0, 0,
                          0,           sine,          n.y,       0, 1, std::pow(radius_ + texel_angle_, 2)};
        if (sine > 0) window.x = n.x / sine, window.z = n.z / sine;
        const double rows_a_radian = source_.height / kPi;
        window.top = std::max(0, static_cast<int>((colatitude - radius_) * rows_a_radian));
        window.bottom =
            std::min(source_.height, static_cast<int>((colatitude + radius_) * rows_a_radian) + 1);
        // The cap's azimuths reach to asin(sin radius / sin colatitude), or all around if it holds a pole.
        double half = kPi;
        if (sine > sine_radius)
            half = atan2_exact(sine_radius, std::sqrt((sine - sine_radius) * (sine + sine_radius)));
        const double middle = points[i].x * source_.width, reach = half / (2 * kPi) * source_.width;
        const int left = static_cast<int>(std::floor(middle - reach)),
                  count = static_cast<int>(std::floor(middle + reach)) + 1 - left;
        window.blocks = (count + kNearLanes - 1) / kNearLanes;
        window.left = (left % source_.width + source_.width) % source_.width;
        if (window.blocks * kNearLanes >= source_.width) {
            window.left = 0;
            window.blocks = (source_.width + kNearLanes - 1) / kNearLanes;
        }
        evaluations += HWY_DYNAMIC_DISPATCH(near_sum)(kernel, window, rules_, squares, &rgb[i * 3]);
    }
    return evaluations;
}

}  // namespace pbr
#endif

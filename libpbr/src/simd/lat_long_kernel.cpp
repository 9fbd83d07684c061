// Points of equirects, and interpolation between grid points. Lanes hold points, or the channels of one: any
// vector width gives the same bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/lat_long_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <glm/vec3.hpp>

#include "pbr/ibl/environment.hpp"
#include "src/simd/lat_long_kernel.hpp"
#include "src/simd/vector_math.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kPointLanes = 8;

void points_of(std::span<const glm::dvec3> directions, std::span<glm::dvec2> uv_out) {
    const hn::CappedTag<double, kPointLanes> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    HWY_ALIGN_MAX double x[kPointLanes], y[kPointLanes], z[kPointLanes];
    for (std::size_t first = 0; first < directions.size(); first += lanes) {
        const std::size_t count = std::min(lanes, directions.size() - first);
        for (std::size_t i = 0; i < lanes; ++i) {
            const glm::dvec3& direction = directions[first + std::min(i, count - 1)];
            x[i] = direction.x, y[i] = direction.y, z[i] = direction.z;
        }
        const V vx = hn::Load(d, x), vz = hn::Load(d, z), one = hn::Set(d, 1.0);
        const V turn = hn::Mul(atan2(d, vx, vz), hn::Set(d, 1 / (2 * std::numbers::pi)));
        const V u = hn::Sub(hn::Set(d, 0.5), turn);
        hn::Store(hn::IfThenElse(hn::Ge(u, one), hn::Sub(u, one), u), d, x);
        const V sine = hn::Sqrt(hn::Add(hn::Mul(vx, vx), hn::Mul(vz, vz)));
        hn::Store(hn::Mul(atan2(d, sine, hn::Load(d, y)), hn::Set(d, 1 / std::numbers::pi)), d, y);
        for (std::size_t i = 0; i < count; ++i) uv_out[first + i] = {x[i], y[i]};
    }
}

/// Weights of Lagrange's polynomial through the points -2 ... 3 at t in [0, 1], as floats; see
/// ibl/lat_long_grid.hpp.
template <class D, class V = hn::Vec<D>>
HWY_INLINE void store_weights(D d, V t, float (*weights)[kPointLanes]) {
    const auto plus = [&](double value) HWY_ATTR { return hn::Add(t, hn::Set(d, value)); };
    const V a = plus(2), b = plus(1), c = t, e = plus(-1), f = plus(-2), g = plus(-3);
    const V ab = hn::Mul(a, b), ce = hn::Mul(c, e), fg = hn::Mul(f, g);
    const hn::Rebind<float, D> df;
    const auto store = [&](int place, V product, double factor) HWY_ATTR {
        hn::StoreU(hn::DemoteTo(df, hn::Mul(product, hn::Set(d, factor))), df, weights[place]);
    };
    store(0, hn::Mul(b, hn::Mul(ce, fg)), -1. / 120);
    store(1, hn::Mul(a, hn::Mul(ce, fg)), 1. / 24);
    store(2, hn::Mul(ab, hn::Mul(e, fg)), -1. / 12);
    store(3, hn::Mul(ab, hn::Mul(c, fg)), 1. / 12);
    store(4, hn::Mul(ab, hn::Mul(ce, g)), -1. / 24);
    store(5, hn::Mul(ab, hn::Mul(ce, f)), 1. / 120);
}

void interpolate_points(const LatLongTexels& grid, std::span<const glm::dvec2> points,
                        std::span<float> rgb_out) {
    const hn::CappedTag<double, kPointLanes> d;
    // Lanes hold the channels of two neighbouring texels; pairs of columns are added up, and their halves
    // last.
    constexpr std::size_t kPair = 8;
    const hn::CappedTag<float, kPair> dp;
    const std::size_t lanes = hn::Lanes(d);
    HWY_ALIGN_MAX double tx[kPointLanes], ty[kPointLanes];
    const float* corners[kPointLanes];
    float wx[6][kPointLanes], wy[6][kPointLanes];
    for (std::size_t first = 0; first < points.size(); first += lanes) {
        const std::size_t count = std::min(lanes, points.size() - first);
        for (std::size_t i = 0; i < lanes; ++i) {
            const glm::dvec2& point = points[first + std::min(i, count - 1)];
            const double px = point.x * grid.columns, py = point.y * grid.rows + 0.5;
            const int x = std::min(static_cast<int>(px), grid.columns - 1), y = static_cast<int>(py) - 1;
            tx[i] = px - x, ty[i] = py - 1 - y;
            corners[i] = grid.rgba + ((y - 2) * grid.stride + x - 2) * 4;
        }
        store_weights(d, hn::Load(d, tx), wx);
        store_weights(d, hn::Load(d, ty), wy);
        for (std::size_t i = 0; i < count; ++i) {
            HWY_ALIGN_MAX float sums[kPair];
            for (std::size_t place = 0; place < kPair; place += hn::Lanes(dp)) {
                const auto is_left = hn::FirstN(dp, place < 4 ? 4 - place : 0);
                const auto weights = [&](int left) HWY_ATTR {
                    return hn::IfThenElse(is_left, hn::Set(dp, wx[left][i]), hn::Set(dp, wx[left + 1][i]));
                };
                const auto w0 = weights(0), w1 = weights(2), w2 = weights(4);
                auto sum = hn::Zero(dp);
                for (int row = 0; row < 6; ++row) {
                    const float* texel = corners[i] + row * grid.stride * 4 + place;
                    auto of_row = hn::Mul(w0, hn::LoadU(dp, texel));
                    of_row = hn::Add(of_row, hn::Mul(w1, hn::LoadU(dp, texel + kPair)));
                    of_row = hn::Add(of_row, hn::Mul(w2, hn::LoadU(dp, texel + 2 * kPair)));
                    sum = hn::Add(sum, hn::Mul(hn::Set(dp, wy[row][i]), of_row));
                }
                hn::Store(sum, dp, sums + place);
            }
            for (std::size_t c = 0; c < 3; ++c) rgb_out[(first + i) * 3 + c] = sums[c] + sums[c + 4];
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(points_of);
HWY_EXPORT(interpolate_points);

}  // namespace

void equirect_points(std::span<const glm::dvec3> directions, std::span<glm::dvec2> uv_out) {
    HWY_DYNAMIC_DISPATCH(points_of)(directions, uv_out);
}

void interpolate(const LatLongTexels& grid, std::span<const glm::dvec2> points, std::span<float> rgb_out) {
    HWY_DYNAMIC_DISPATCH(interpolate_points)(grid, points, rgb_out);
}

}  // namespace pbr
#endif

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
    const hn::CappedTag<float, 4> d4;
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
            HWY_ALIGN float rgba[4];
            for (std::size_t channel = 0; channel < 4; channel += hn::Lanes(d4)) {
                auto sum = hn::Zero(d4);
                for (int row = 0; row < 6; ++row) {
                    const float* texel = corners[i] + row * grid.stride * 4 + channel;
                    auto of_row = hn::Zero(d4);
                    for (int column = 0; column < 6; ++column) {
                        const auto value = hn::LoadU(d4, texel + column * 4);
                        of_row = hn::Add(of_row, hn::Mul(hn::Set(d4, wx[column][i]), value));
                    }
                    sum = hn::Add(sum, hn::Mul(hn::Set(d4, wy[row][i]), of_row));
                }
                hn::Store(sum, d4, rgba + channel);
            }
            std::copy_n(rgba, 3, &rgb_out[(first + i) * 3]);
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

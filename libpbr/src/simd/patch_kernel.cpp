// Points of patches and their moments. Lanes hold points, 16 sums side by side whatever the vector width: the
// bits are the same on all machines.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/patch_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "src/simd/patch_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One row of points: directions and weights, kLanes at once.
template <std::size_t kLanes>
HWY_INLINE void lat_long_row(const LatLongPatch& patch, std::size_t row, std::size_t at,
                             PatchPoints& points) {
    const hn::CappedTag<double, kLanes> d;
    const hn::Rebind<float, decltype(d)> to_float;
    const std::size_t lanes = hn::Lanes(d), count = static_cast<std::size_t>(patch.width) * patch.order;
    const double sine = patch.rows.sines[row];
    const glm::dvec3 up = patch.up * patch.rows.cosines[row], right = patch.right * sine,
                     ahead = patch.ahead * sine;
    const double weight = patch.rows.weights[row];
    float* const coordinates[3] = {points.x.data() + at, points.y.data() + at, points.z.data() + at};
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        const auto sines = hn::LoadU(d, patch.columns.sines + i),
                   cosines = hn::LoadU(d, patch.columns.cosines + i);
        for (int c = 0; c < 3; ++c) {
            const auto turned = hn::Add(hn::Add(hn::Set(d, up[c]), hn::Mul(hn::Set(d, right[c]), sines)),
                                        hn::Mul(hn::Set(d, ahead[c]), cosines));
            hn::StoreU(hn::DemoteTo(to_float, turned), to_float, coordinates[c] + i);
        }
        hn::StoreU(
            hn::DemoteTo(to_float, hn::Mul(hn::Set(d, weight), hn::LoadU(d, patch.columns.weights + i))),
            to_float, points.weight.data() + at + i);
    }
    for (; i < count; ++i) {
        for (int c = 0; c < 3; ++c)
            coordinates[c][i] = static_cast<float>(up[c] + right[c] * patch.columns.sines[i] +
                                                   ahead[c] * patch.columns.cosines[i]);
        points.weight[at + i] = static_cast<float>(weight * patch.columns.weights[i]);
    }
}

/// The radiance of a row of texels, a point each.
HWY_INLINE void radiance_row(const float* rgb, std::size_t count, std::size_t at, PatchPoints& points) {
    const hn::CappedTag<float, 8> d;
    const std::size_t lanes = hn::Lanes(d);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes) {
        hn::Vec<decltype(d)> r, g, b;
        hn::LoadInterleaved3(d, rgb + 3 * i, r, g, b);
        hn::StoreU(r, d, points.r.data() + at + i);
        hn::StoreU(g, d, points.g.data() + at + i);
        hn::StoreU(b, d, points.b.data() + at + i);
    }
    for (; i < count; ++i) {
        points.r[at + i] = rgb[3 * i];
        points.g[at + i] = rgb[3 * i + 1];
        points.b[at + i] = rgb[3 * i + 2];
    }
}

void lat_long_points(const LatLongPatch& patch, std::size_t at, PatchPoints& points) {
    const std::size_t order = static_cast<std::size_t>(patch.order),
                      columns = static_cast<std::size_t>(patch.width) * order;
    if (order == 1) {
        for (int y = 0; y < patch.height; ++y, at += static_cast<std::size_t>(patch.width)) {
            lat_long_row<8>(patch, static_cast<std::size_t>(y), at, points);
            radiance_row(patch.rgb + y * patch.stride, static_cast<std::size_t>(patch.width), at, points);
        }
        return;
    }
    for (int y = 0; y < patch.height; ++y) {
        for (std::size_t b = 0; b < order; ++b) {
            lat_long_row<4>(patch, y * order + b, at, points);
            if (b > 0) {  // the texels of the row before
                for (std::vector<float>* channel : {&points.r, &points.g, &points.b})
                    std::copy_n(channel->data() + at - columns, columns, channel->data() + at);
                at += columns;
                continue;
            }
            const float* rgb = patch.rgb + y * patch.stride;
            for (int x = 0; x < patch.width; ++x, rgb += 3)
                for (std::size_t a = 0; a < order; ++a, ++at) {
                    points.r[at] = rgb[0];
                    points.g[at] = rgb[1];
                    points.b[at] = rgb[2];
                }
        }
    }
}

constexpr std::size_t kSums = 16;

void point_moments(const PatchPoints& points, const glm::dvec3& centre, PatchMoments& moments) {
    const hn::CappedTag<float, kSums> d;
    using V = hn::Vec<decltype(d)>;
    const std::size_t lanes = hn::Lanes(d);
    const V cx = hn::Set(d, static_cast<float>(centre.x)), cy = hn::Set(d, static_cast<float>(centre.y)),
            cz = hn::Set(d, static_cast<float>(centre.z));
    constexpr std::size_t kCount = kMonomials.size();
    HWY_ALIGN_MAX float all[kCount][4][kSums];
    for (std::size_t begin = 0; begin < kSums; begin += lanes) {
        V sums[kCount][4];
        for (auto& of_monomial : sums)
            for (V& sum : of_monomial) sum = hn::Zero(d);
        for (std::size_t i = begin; i < points.size(); i += kSums) {
            const std::size_t left = std::min(lanes, points.size() - i);
            const auto load = [&](const std::vector<float>& array) HWY_ATTR {
                return left == lanes ? hn::LoadU(d, &array[i])
                                     : hn::MaskedLoad(hn::FirstN(d, left), d, &array[i]);
            };
            const V x = hn::Sub(load(points.x), cx), y = hn::Sub(load(points.y), cy),
                    z = hn::Sub(load(points.z), cz);
            const V w = load(points.weight), r = hn::Mul(w, load(points.r)), g = hn::Mul(w, load(points.g)),
                    b = hn::Mul(w, load(points.b));
            const V xx = hn::Mul(x, x), yy = hn::Mul(y, y), zz = hn::Mul(z, z), xy = hn::Mul(x, y);
            const auto add = [&](std::size_t k, V power) HWY_ATTR {
                sums[k][0] = hn::Add(sums[k][0], hn::Mul(r, power));
                sums[k][1] = hn::Add(sums[k][1], hn::Mul(g, power));
                sums[k][2] = hn::Add(sums[k][2], hn::Mul(b, power));
                sums[k][3] = hn::Add(sums[k][3], hn::Mul(w, power));
            };
            add(0, hn::Set(d, 1.0f));
            add(1, x), add(2, y), add(3, z);
            add(4, xx), add(5, yy), add(6, zz);
            add(7, xy), add(8, hn::Mul(x, z)), add(9, hn::Mul(y, z));
            add(10, hn::Mul(xx, x)), add(11, hn::Mul(yy, y)), add(12, hn::Mul(zz, z));
            add(13, hn::Mul(xx, y)), add(14, hn::Mul(xx, z)), add(15, hn::Mul(yy, x));
            add(16, hn::Mul(yy, z)), add(17, hn::Mul(zz, x)), add(18, hn::Mul(zz, y));
            add(19, hn::Mul(xy, z));
        }
        for (std::size_t k = 0; k < kCount; ++k)
            for (std::size_t c = 0; c < 4; ++c) hn::Store(sums[k][c], d, all[k][c] + begin);
    }
    for (std::size_t k = 0; k < kCount; ++k)
        for (std::size_t c = 0; c < 4; ++c) {
            const float* const s = all[k][c];
            const auto quarter = [&](int i) HWY_ATTR { return (s[i] + s[i + 8]) + (s[i + 4] + s[i + 12]); };
            moments[k][c] = static_cast<double>((quarter(0) + quarter(2)) + (quarter(1) + quarter(3)));
        }
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {

HWY_EXPORT(lat_long_points);
HWY_EXPORT(point_moments);

void fill_lat_long_points(const LatLongPatch& patch, std::size_t at, PatchPoints& points) {
    HWY_DYNAMIC_DISPATCH(lat_long_points)(patch, at, points);
}

PatchMoments moments_of_points(const PatchPoints& points, const glm::dvec3& centre) {
    PatchMoments moments{};
    HWY_DYNAMIC_DISPATCH(point_moments)(points, centre, moments);
    return moments;
}

}  // namespace pbr
#endif

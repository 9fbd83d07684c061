// Lanes hold points: any vector width gives the same bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/great_circle_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "src/simd/great_circle_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// a b - c d.
template <class V>
HWY_INLINE V cross(V a, V b, V c, V d) {
    return hn::Sub(hn::Mul(a, b), hn::Mul(c, d));
}

/// As its twin for single numbers.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V small_arc_sine(D d, V x) {
    const V x2 = hn::Mul(x, x);
    V sum = hn::Set(d, 105. / 3456);
    for (const double coefficient : {15. / 336, 3. / 40, 1. / 6, 1.})
        sum = hn::Add(hn::Mul(sum, x2), hn::Set(d, coefficient));
    return hn::Mul(sum, x);
}

template <class D>
void find_points(D d, const GreatCircle& circle, CirclePoints& p, std::size_t at) {
    const auto u = hn::Set(d, circle.u), v = hn::Set(d, circle.v);
    const auto x = hn::LoadU(d, &p.cos[at]), y = hn::LoadU(d, &p.sin[at]);
    const auto t = hn::Add(hn::Mul(u, x), hn::Mul(v, y));
    const auto m = hn::Sqrt(hn::Add(hn::Set(d, circle.n * circle.n), hn::Mul(t, t)));
    hn::StoreU(cross(u, y, v, x), d, &p.s[at]);
    hn::StoreU(m, d, &p.m[at]);
    hn::StoreU(hn::Div(t, m), d, &p.cosine[at]);
}

template <class D>
void find_arcs_between(D d, CirclePoints& p, std::size_t at) {
    const auto load = [&](const std::vector<double>& of, std::size_t i)
                          HWY_ATTR { return hn::LoadU(d, &of[i]); };
    const auto turn = cross(load(p.cos, at), load(p.sin, at + 1), load(p.sin, at), load(p.cos, at + 1));
    const auto rise = cross(load(p.m, at), load(p.s, at + 1), load(p.s, at), load(p.m, at + 1));
    hn::StoreU(small_arc_sine(d, turn), d, &p.width[at]);
    hn::StoreU(small_arc_sine(d, rise), d, &p.below[at]);
}

void arcs(const GreatCircle& circle, CirclePoints& p) {
    const hn::ScalableTag<double> d;
    const hn::CappedTag<double, 1> one;
    const std::size_t n = p.size(), lanes = hn::Lanes(d);
    std::size_t i = 0, k = 0;
    for (; i + lanes <= n; i += lanes) find_points(d, circle, p, i);
    for (; i < n; ++i) find_points(one, circle, p, i);
    for (; k + lanes < n; k += lanes) find_arcs_between(d, p, k);
    for (; k + 1 < n; ++k) find_arcs_between(one, p, k);
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(arcs);

}  // namespace

void find_arcs(const GreatCircle& circle, CirclePoints& points) {
    for (std::vector<double>* of : {&points.s, &points.m, &points.cosine, &points.width, &points.below})
        of->resize(points.size());
    HWY_DYNAMIC_DISPATCH(arcs)(circle, points);
}

}  // namespace pbr
#endif

// Where directions pierce the cube, for the kernels. Included once a target; hence the toggled guard.

#if defined(PBR_SIMD_CUBE_FACE_HPP_) == defined(HWY_TARGET_TOGGLE)
#ifdef PBR_SIMD_CUBE_FACE_HPP_
#undef PBR_SIMD_CUBE_FACE_HPP_
#else
#define PBR_SIMD_CUBE_FACE_HPP_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// cube_point of ibl/cubemap.hpp, and the reciprocal of the largest component.
template <class V>
struct FacePoint {
    V face, s, t, inverse_major;
};
template <class D, class V = hn::Vec<D>>
HWY_INLINE FacePoint<V> face_point(D d, V x, V y, V z) {
    const V zero = hn::Zero(d), one = hn::Set(d, 1.0f);
    const V ax = hn::Abs(x), ay = hn::Abs(y), az = hn::Abs(z);
    const auto x_major = hn::And(hn::Ge(ax, ay), hn::Ge(ax, az));
    const auto y_major = hn::AndNot(x_major, hn::Ge(ay, az));
    const V major = hn::IfThenElse(x_major, x, hn::IfThenElse(y_major, y, z));
    const V sign = hn::And(major, hn::SignBit(d));
    const V inverse = hn::Div(one, hn::Abs(major));
    // s, t are (-+z, -y) on X, (x, +-z) on Y, (+-x, -y) on Z.
    const V s_of_x_or_z = hn::Xor(sign, hn::IfThenElse(x_major, hn::Neg(z), x));
    const V s = hn::IfThenElse(y_major, x, s_of_x_or_z);
    const V t = hn::IfThenElse(y_major, hn::Xor(sign, z), hn::Neg(y));
    const V pair = hn::IfThenElse(x_major, zero, hn::IfThenElse(y_major, hn::Set(d, 2.0f), hn::Set(d, 4.0f)));
    const V face = hn::Add(pair, hn::IfThenElse(hn::Lt(major, zero), one, zero));
    return {face, hn::Mul(s, inverse), hn::Mul(t, inverse), inverse};
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#endif

// Lanes hold channels: any vector width gives the same bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/cube_images_kernel.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include <algorithm>

#include "src/simd/cube_images_kernel.hpp"

HWY_BEFORE_NAMESPACE();
namespace pbr {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A picture's texels as vectors of four floats, of which the last means nothing. Nothing is read beyond the
/// picture's end.
class FourFloats {
  public:
    explicit FourFloats(const EquirectView& source)
        : source_(source), last_(source.texel(source.width - 1, source.height - 1)) {
        std::copy_n(last_, 3, copy_of_last_);
    }

    HWY_INLINE const float* at(const float* texel) const { return texel == last_ ? copy_of_last_ : texel; }

    /// A texel of an image; `column` may be off by up to a turn.
    HWY_INLINE const float* texel(const CubeImage& image, int column, int row) const {
        int x = image.column + column;
        x = x < 0 ? x + source_.width : x;
        x = x >= source_.width ? x - source_.width : x;
        return source_.texel(x, image.south ? source_.height - 1 - row : row);
    }

  private:
    const EquirectView& source_;
    const float* last_;
    float copy_of_last_[4] = {};
};

void interpolate_images_of(const EquirectView& source, const CubeImages& images,
                           std::span<const BilinearPoint> points, int j, std::span<float> rgb_out) {
    const hn::CappedTag<double, 4> d;
    const hn::Rebind<float, decltype(d)> narrow;
    const FourFloats picture(source);
    for (const CubeImage& image : images) {
        float* out = rgb_out.data() + (image.origin + j * image.step_j) * 3;
        for (const BilinearPoint& point : points) {
            const bool over_pole = point.row < 0;
            const int above = over_pole ? point.column + source.width / 2 : point.column;
            const float* from[4] = {picture.texel(image, above, std::max(0, point.row)),
                                    picture.texel(image, above + 1, std::max(0, point.row)),
                                    picture.texel(image, point.column, point.row + 1),
                                    picture.texel(image, point.column + 1, point.row + 1)};
            HWY_ALIGN float rgb[4];
            for (std::size_t channel = 0; channel < 4; channel += hn::Lanes(d)) {
                const auto value = [&](int corner) HWY_ATTR {
                    return hn::PromoteTo(d, hn::LoadU(narrow, picture.at(from[corner]) + channel));
                };
                const auto mix = [&](auto a, auto b, double t)
                                     HWY_ATTR { return hn::Add(a, hn::Mul(hn::Set(d, t), hn::Sub(b, a))); };
                const auto top = mix(value(0), value(1), point.across);
                const auto bottom = mix(value(2), value(3), point.across);
                hn::StoreU(hn::DemoteTo(narrow, mix(top, bottom, point.down)), narrow, rgb + channel);
            }
            std::copy_n(rgb, 3, out);
            out += image.step_i * 3;
        }
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(interpolate_images_of);

}  // namespace

void interpolate_images(const EquirectView& source, const CubeImages& images,
                        std::span<const BilinearPoint> points, int j, std::span<float> rgb_out) {
    HWY_DYNAMIC_DISPATCH(interpolate_images_of)(source, images, points, j, rgb_out);
}

}  // namespace pbr
#endif

// Lanes hold channels: any vector width gives the same bits.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/simd/cube_images_kernel.cpp"
#include <hwy/cache_control.h>
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

/// Where images have runs of texels, on their way to the cache: of the first run in all images, of the
/// second, and so on. Copies of those that the end of a row cuts, and of the picture's last texel, which has
/// nothing behind it.
class FoundRuns {
  public:
    FoundRuns(const EquirectView& source, std::span<const TexelRun> runs, std::span<const CubeImage> images)
        : source_(source) {
        found_.reserve(runs.size() * images.size());
        for (const TexelRun& run : runs)
            for (const CubeImage& image : images) {
                int x = image.column + run.column;
                x = x >= source.width ? x - source.width : x;
                const int row = image.south ? source.height - 1 - run.row : run.row;
                const float* texel = source.texel(x, row);
                hwy::Prefetch(texel);
                const int beyond = x + run.count - source.width;
                found_.push_back(beyond < 0 ? texel : copy(texel, run.count, std::max(0, beyond)));
            }
    }

    const float* const* all() const { return found_.data(); }

  private:
    const float* copy(const float* texel, int count, int beyond) {
        const float* end = texel + 3L * (count - beyond);
        std::vector<float>& run = copies_.emplace_back(texel, end);
        run.insert(run.end(), end - 3L * source_.width, end - 3L * (source_.width - beyond));
        run.push_back(0);
        return run.data();
    }

    const EquirectView& source_;
    std::vector<const float*> found_;
    std::vector<std::vector<float>> copies_;
};

/// Of `kCount` images at once, which share what is known of their texels.
template <std::size_t kCount>
void mean_some_images(const EquirectView& source, std::span<const CubeImage, kCount> images,
                      const RowShares& row, int j, std::span<float> rgb_out) {
    const hn::CappedTag<double, 4> d;
    const hn::Rebind<float, decltype(d)> narrow;
    const FoundRuns found(source, row.runs, images);
    float* out[kCount];
    for (std::size_t n = 0; n < kCount; ++n)
        out[n] = rgb_out.data() + (images[n].origin + j * images[n].step_j) * 3;
    const float* const* run_texels = found.all();
    const double* first_share = row.shares.data();
    const TexelRun* run = row.runs.data();
    for (const RowShares::Texel& texel : row.texels) {
        HWY_ALIGN float rgb[kCount][4];
        const TexelRun* const runs_end = row.runs.data() + texel.runs_end;
        const auto scale = hn::Set(d, 1 / texel.solid_angle);
        for (std::size_t channel = 0; channel < 4; channel += hn::Lanes(d)) {
            hn::Vec<decltype(d)> sums[kCount];
            for (std::size_t n = 0; n < kCount; ++n) sums[n] = hn::Zero(d);
            const float* const* texels = run_texels;
            const double* share = first_share;
            for (const TexelRun* of = run; of != runs_end; ++of, texels += kCount)
                for (long at = static_cast<long>(channel); at < 3L * of->count; at += 3, ++share) {
                    const auto weight = hn::Set(d, *share);
                    for (std::size_t n = 0; n < kCount; ++n)
                        sums[n] = hn::Add(
                            sums[n], hn::Mul(weight, hn::PromoteTo(d, hn::LoadU(narrow, texels[n] + at))));
                }
            for (std::size_t n = 0; n < kCount; ++n)
                hn::StoreU(hn::DemoteTo(narrow, hn::Mul(sums[n], scale)), narrow, rgb[n] + channel);
        }
        for (; run != runs_end; ++run, run_texels += kCount) first_share += run->count;
        for (std::size_t n = 0; n < kCount; ++n) {
            std::copy_n(rgb[n], 3, out[n]);
            out[n] += images[n].step_i * 3;
        }
    }
}

void mean_images_of(const EquirectView& source, const CubeImages& images, const RowShares& row, int j,
                    std::span<float> rgb_out) {
    if (images.size() == kCubeImages) {
        mean_some_images(source, std::span<const CubeImage, kCubeImages>(images), row, j, rgb_out);
    } else {
        for (const CubeImage& image : images)
            mean_some_images(source, std::span<const CubeImage, 1>(&image, 1), row, j, rgb_out);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace pbr
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace pbr {
namespace {

HWY_EXPORT(interpolate_images_of);
HWY_EXPORT(mean_images_of);

}  // namespace

void interpolate_images(const EquirectView& source, const CubeImages& images,
                        std::span<const BilinearPoint> points, int j, std::span<float> rgb_out) {
    HWY_DYNAMIC_DISPATCH(interpolate_images_of)(source, images, points, j, rgb_out);
}

void mean_images(const EquirectView& source, const CubeImages& images, const RowShares& row, int j,
                 std::span<float> rgb_out) {
    HWY_DYNAMIC_DISPATCH(mean_images_of)(source, images, row, j, rgb_out);
}

}  // namespace pbr
#endif

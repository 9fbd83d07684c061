#pragma once
// The metal mask: an estimate a texel, then along the picture's regions where a texel alone can't tell.

#include "bakers/texture/calibrate.hpp"
#include "bakers/texture/maps.hpp"

namespace pbrbake::texture {

/// Rows above and below that a row's mask depends on.
inline constexpr int kMetalReach = 2;

/// Estimates metallic and confidence of texels as calibrated.
class MetalEstimator {
  public:
    MetalEstimator(const Sources& sources, const Calibration& calibration);
    /// Of a row, whose metallic is taken where it is stated.
    void operator()(const LegacyRow& row, float* metallic, float* confidence) const;
    /// Whether texels are estimates, and neighbours may tell more.
    bool regularises() const { return regularises_; }

  private:
    void limit(const LegacyRow& row, float* metallic, float* confidence) const;

    float told_ = -1;  ///< metallic of the whole set, where it is known; else < 0
    float trust_;
    pbr::MetallicPrior<float> prior_;
    pbr::DiffuseCoupling coupling_;
    float largest_error_;
    bool has_residual_;  ///< what metal leaves of f0 is kept, so that metallic has a limit
    bool is_stated_;     ///< by the set itself
    bool regularises_;
};

/// Lowers the metallic of `count` texels from `begin` on to what a material of theirs may have, if diffuse
/// may be off by `largest_error`: what neighbours or several texels have in the mean may be above it.
void limit_metallic(float largest_error, std::size_t begin, std::size_t count, MapLevel& level);

/// Rows of a set laid out for the mask: a plane each of diffuse, f0, metallic and confidence, with
/// kMetalReach columns more on either side.
class MetalRows {
  public:
    MetalRows(int width, int rows, Wrap wrap);
    /// A row, and what was estimated of it.
    void set(int row, const LegacyRow& texels, const float* metallic, const float* confidence);
    /// The mask of a row, whose neighbours up to kMetalReach away are complete: where a texel's confidence is
    /// below .95, from the sure ones of the 5 x 5 around it that look alike.
    void regularise(int row, float* metallic) const;

  private:
    enum Plane { diffuse = 0, f0 = 3, metallic = 6, confidence = 7, planes = 8 };
    const float* plane(int plane, int row) const {
        return values_.data() + (static_cast<std::size_t>(plane) * rows_ + row) * pitch_ + kMetalReach;
    }
    float* plane(int plane, int row) {
        return const_cast<float*>(static_cast<const MetalRows*>(this)->plane(plane, row));
    }
    void regularise_run(int row, int begin, int end, float* metallic) const;

    int width_, rows_, pitch_;
    Wrap wrap_;
    std::vector<float> values_;
};

}  // namespace pbrbake::texture

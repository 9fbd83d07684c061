#pragma once
// A small reference renderer: spheres and planes under an environment, by the exact integral and by the split
// sum with baked products.

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/verify/demo_pictures.hpp"
#include "bakers/verify/flip.hpp"
#include "pbr/brdf/standard_material.hpp"
#include "pbr/ibl/patches.hpp"

namespace pbrbake::verify {

/// What shades: the integral over all texels of the environment, or one look-up of the probe and the table,
/// along the mirror direction or along Frostbite's dominant direction (pbr::dominant_factor_frostbite).
enum class Shading { exact, split_sum, split_sum_dominant };
inline constexpr std::array<std::string_view, 3> kShadingNames{"exact", "split_sum", "split_sum_dominant"};

/// A visible point: unit vectors, `view` away from the surface, NoV > 0.
struct VisiblePoint {
    glm::dvec3 normal, view;
    double NoV() const;
};

/// What a picture sees, a point a pixel; nothing where the background is.
struct ShadedScene {
    int width, height;
    std::vector<std::optional<VisiblePoint>> points;  ///< row 0 at the top
    View camera;
};

/// A sphere that fills the picture, seen from afar.
ShadedScene sphere_scene(int size, const glm::dvec3& towards);
/// A horizontal plane, seen from 30° above it at the picture's bottom to 2° at its top.
ShadedScene plane_scene(int width, int height, const glm::dvec3& towards);

/// Shades points of a standard material: diffuse by Disney's lobe as Frostbite renormalised it, specular by
/// height-correlated GGX, once scattered.
class ShadedTruth {
  public:
    /// `environment` is an equirect's first level (R G B); `probe` was baked from it, `table` holds ggx and
    /// disney_diffuse in the default layout. All must outlive this.
    ShadedTruth(const Level& environment, const BakedImage& probe, const BakedImage& table);

    /// Radiance towards the viewer. The exact integral is within 1e-3 of its own scale, by its own estimate;
    /// alpha > 0.
    glm::dvec3 radiance(Shading shading, const pbr::Surface<double>& surface,
                        const VisiblePoint& point) const;

    /// A picture; black where there is no point.
    LinearPicture render(Shading shading, const pbr::Surface<double>& surface, const ShadedScene& scene,
                         int threads) const;

  private:
    glm::dvec3 exact(const pbr::Surface<double>& surface, const VisiblePoint& point) const;
    glm::dvec3 split_sum(bool dominant, const pbr::Surface<double>& surface, const VisiblePoint& point) const;

    pbr::PatchBlocks blocks_;
    ProbeLookup probe_;
    const BakedImage& table_;
};

/// Error of luminances over the points of a scene with NoV in [low, high).
struct ShadingError {
    double low, high;
    double relative_rms;  ///< root mean square over the mean
    double bias;          ///< mean of the error over the mean
    int points;
};

/// Grazing first: NoV below .1, .3, .6 and the rest, then all.
std::vector<ShadingError> shading_errors(const LinearPicture& picture, const LinearPicture& exact,
                                         const ShadedScene& scene);

}  // namespace pbrbake::verify

#pragma once
// A decoded source, oriented as the job asks, as libpbr's views.

#include <optional>
#include <span>
#include <vector>

#include "bakers/image.hpp"
#include "bakers/probe/params.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/ibl/environment_sampler.hpp"
#include "pbr/ibl/ld_harmonic.hpp"
#include "pbr/ibl/patches.hpp"

namespace pbrbake::probe {

/// An equirect or a cube map in the frame of the output. An equirect is turned by its matrix and stays where
/// it is in memory (the SourceImage must outlive this); a cube map is permuted once, which is exact.
class Environment {
  public:
    Environment(const ProbeParams& params, const SourceImage& source);

    bool is_cube() const { return cube_.rgb != nullptr; }

    /// Size of a cube map with texels as large as the source's at its middle.
    int equivalent_size() const;

    /// How many texels.
    double texels() const;

    pbr::PatchBlocks blocks() const;

    /// What draws directions where it is bright.
    pbr::EnvironmentSampler sampler() const;

    /// Its transform for lobes of alpha >= smallest_alpha.
    pbr::LdHarmonic harmonic(double smallest_alpha, double max_error, const pbr::ForEach& each) const;

    /// Texels of a row of a face from `left` on, by the slower and more exact way: what resample() is held
    /// against.
    void resample_strip(int size, const pbr::CubeTexel& left, std::span<float> rgb_out) const;

    /// A whole cube of `size` (faces, rows, RGB): the mean over each texel, or bilinear where they shrink.
    void resample(int size, const pbr::ForEach& each, std::span<float> rgb_out) const;

    /// The mean over each texel, whatever the size.
    void resample_area(int size, const pbr::ForEach& each, std::span<float> rgb_out) const;

  private:
    void resample_row(int size, int face, int y, std::span<float> rgb_out) const;

    pbr::EquirectView equirect_;
    pbr::CubeView cube_;
    std::vector<float> permuted_;
};

/// True if a job's turn can be applied to a cube map by permuting texels: a multiple of 90 degrees.
bool permutes_cube(double rotate_deg);

}  // namespace pbrbake::probe

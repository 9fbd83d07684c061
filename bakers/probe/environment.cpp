#include "bakers/probe/environment.hpp"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::probe {
namespace {

/// Takes world directions to the source's own frame. The environment is first mirrored left to right (x ->
/// -x), then turned counter-clockwise about its vertical axis as seen from above, then stood on the world's
/// up axis.
glm::dmat3 world_to_source(const ProbeParams& params) {
    const pbr::SinCos turn = pbr::sin_cos_pi(params.rotate_deg / 180);
    // Columns are the images of the source's axes.
    const glm::dmat3 mirror(params.mirror ? -1 : 1, 0, 0, 0, 1, 0, 0, 0, 1);
    const glm::dmat3 rotate(turn.cos, 0, -turn.sin, 0, 1, 0, turn.sin, 0, turn.cos);
    // z up: the source's y becomes the world's z, its z the world's -y; x stays.
    const glm::dmat3 stand = params.up == Up::z ? glm::dmat3(1, 0, 0, 0, 0, 1, 0, -1, 0) : glm::dmat3(1);
    return glm::transpose(stand * rotate * mirror);
}

}  // namespace

bool permutes_cube(double rotate_deg) { return std::fmod(rotate_deg, 90.0) == 0; }

Environment::Environment(const ProbeParams& params, const SourceImage& source) {
    const Level& level = source.image.levels[0];
    const glm::dmat3 turn = world_to_source(params);
    if (source.image.faces == 1) {
        equirect_ = {level.texels.data(), level.width, level.height, turn};
        return;
    }
    const int n = level.width;
    if (turn == glm::dmat3(1)) {
        cube_ = {level.texels.data(), n};
        return;
    }
    permuted_.resize(level.texels.size());
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                // Multiples of 90 degrees take texel centres to texel centres.
                const pbr::CubeTexel from =
                    pbr::cubemap_texel(turn * pbr::cubemap_texel_direction({face, x, y}, n), n);
                std::copy_n(source.image.texel(0, from.face, from.y, from.x), 3,
                            &permuted_[((static_cast<std::size_t>(face) * n + y) * n + x) * 3]);
            }
    cube_ = {permuted_.data(), n};
}

int Environment::equivalent_size() const {
    return is_cube() ? cube_.size : std::max({1, equirect_.width / 4, equirect_.height / 2});
}

pbr::PatchBlocks Environment::blocks() const {
    return is_cube() ? pbr::PatchBlocks(cube_) : pbr::PatchBlocks(equirect_);
}

pbr::EnvironmentSampler Environment::sampler() const {
    return is_cube() ? pbr::EnvironmentSampler(cube_) : pbr::EnvironmentSampler(equirect_);
}

pbr::LdHarmonic Environment::harmonic(double smallest_alpha, double max_error,
                                      const pbr::ForEach& each) const {
    return is_cube() ? pbr::LdHarmonic(cube_, smallest_alpha, max_error, each)
                     : pbr::LdHarmonic(equirect_, smallest_alpha, max_error, each);
}

double Environment::texels() const {
    return is_cube() ? 6.0 * cube_.size * cube_.size : 1.0 * equirect_.width * equirect_.height;
}

namespace {

std::span<float> row_of(std::span<float> rgb, int size, int row) {
    const std::size_t stride = static_cast<std::size_t>(size) * 3;
    return rgb.subspan(static_cast<std::size_t>(row) * stride, stride);
}

}  // namespace

void Environment::resample_strip(int size, const pbr::CubeTexel& left, std::span<float> rgb_out) const {
    if (is_cube() || size > equivalent_size()) {  // a row's texels share most of their work
        std::vector<float> row(static_cast<std::size_t>(size) * 3);
        resample_row(size, left.face, left.y, row);
        std::copy_n(&row[static_cast<std::size_t>(left.x) * 3], rgb_out.size(), rgb_out.begin());
        return;
    }
    std::vector<pbr::CubeTexel> texels;
    for (std::size_t i = 0; i < rgb_out.size() / 3; ++i)
        texels.push_back({left.face, left.x + static_cast<int>(i), left.y});
    pbr::resample_area(equirect_, size, texels, rgb_out);
}

void Environment::resample_row(int size, int face, int y, std::span<float> rgb_out) const {
    const bool grows = size <= equivalent_size();
    if (is_cube())
        return grows ? pbr::resample_area(cube_, size, face, y, rgb_out)
                     : pbr::resample_bilinear(cube_, size, face, y, rgb_out);
    return grows ? pbr::resample_area(equirect_, size, face, y, rgb_out)
                 : pbr::resample_bilinear(equirect_, size, face, y, rgb_out);
}

void Environment::resample(int size, const pbr::ForEach& each, std::span<float> rgb_out) const {
    if (size <= equivalent_size()) return resample_area(size, each, rgb_out);
    if (!is_cube()) return pbr::resample_bilinear(equirect_, size, each, rgb_out);
    each(6 * size, [&](int row) { resample_row(size, row / size, row % size, row_of(rgb_out, size, row)); });
}

void Environment::resample_area(int size, const pbr::ForEach& each, std::span<float> rgb_out) const {
    if (!is_cube()) return pbr::resample_area(equirect_, size, each, rgb_out);
    each(6 * size, [&](int row) {
        pbr::resample_area(cube_, size, row / size, row % size, row_of(rgb_out, size, row));
    });
}

}  // namespace pbrbake::probe

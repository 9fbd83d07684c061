#include "bakers/texture/chain.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "pbr/brdf/roughness.hpp"
#include "pbr/legacy/normal_variance.hpp"

namespace pbrbake::texture {
namespace {

/// The texels along one axis that a smaller one covers, and their shares: two, or three of an odd side.
struct Cover {
    int first = 0, count = 0;
    std::array<float, 4> share{};
};

Cover cover(int index, int small, int large) {
    const double begin = static_cast<double>(index) * large / small,
                 end = static_cast<double>(index + 1) * large / small;
    Cover result;
    result.first = static_cast<int>(begin);
    result.count = std::min(4, static_cast<int>(std::ceil(end - 1e-9)) - result.first);
    for (int i = 0; i < result.count; ++i) {
        const double low = std::max(begin, static_cast<double>(result.first + i));
        const double high = std::min(end, static_cast<double>(result.first + i + 1));
        result.share[static_cast<std::size_t>(i)] = static_cast<float>((high - low) / (end - begin));
    }
    return result;
}

struct Sums {
    Colour diffuse{0}, f0{0}, emissive{0};
    float f90 = 0, metallic = 0, occlusion = 0, opacity = 0;
    pbr::SlopeMoments<float> slopes;

    void add(const MapLevel& level, std::size_t i, float share) {
        diffuse += share * level.diffuse[i];
        f0 += share * level.f0[i];
        metallic += share * level.metallic[i];
        if (!level.f90.empty()) f90 += share * level.f90[i];
        if (!level.occlusion.empty()) occlusion += share * level.occlusion[i];
        if (!level.opacity.empty()) opacity += share * level.opacity[i];
        if (!level.emissive.empty()) emissive += share * level.emissive[i];
        slopes.add(level.normal.empty() ? Colour(0, 0, 1) : level.normal[i],
                   pbr::alpha_from_perceptual_roughness(level.perceptual_roughness[i]), share);
    }

    void store(MapLevel& level, std::size_t i) const {
        level.diffuse.set(i, diffuse);
        level.f0.set(i, f0);
        level.metallic[i] = metallic;
        if (!level.f90.empty()) level.f90[i] = f90;
        level.perceptual_roughness[i] = pbr::perceptual_roughness_from_alpha(slopes.alpha());
        if (!level.normal.empty()) level.normal.set(i, slopes.normal());
        if (!level.occlusion.empty()) level.occlusion[i] = occlusion;
        if (!level.opacity.empty()) level.opacity[i] = opacity;
        if (!level.emissive.empty()) level.emissive.set(i, emissive);
    }
};

}  // namespace

MapLevel level_below(const MapLevel& level, int levels, int rows) {
    MapLevel next;
    next.width = side_below(level.width, levels);
    next.height = side_below(level.height, levels);
    next.rows = rows;
    next.diffuse.resize(next.texels());
    next.f0.resize(next.texels());
    next.metallic.resize(next.texels());
    next.perceptual_roughness.resize(next.texels());
    if (!level.f90.empty()) next.f90.resize(next.texels());
    if (!level.normal.empty()) next.normal.resize(next.texels());
    if (!level.occlusion.empty()) next.occlusion.resize(next.texels());
    if (!level.opacity.empty()) next.opacity.resize(next.texels());
    if (!level.emissive.empty()) next.emissive.resize(next.texels());
    return next;
}

RowRange rows_under(RowRange next, int height) {
    const int next_height = side_below(height);
    const auto first = [&](int row) {
        return row >= next_height ? height : cover(row, next_height, height).first;
    };
    return {first(next.begin), first(next.end)};
}

int reach_under(int row, int height) {
    const Cover rows = cover(row, side_below(height), height);
    return rows.first + rows.count;
}

void fill_row(const MapLevel& level, int y, MapLevel& next) {
    const Cover rows = cover(y, next.height, level.height);
    for (int x = 0; x < next.width; ++x) {
        const Cover columns = cover(x, next.width, level.width);
        Sums sums;
        for (int j = 0; j < rows.count; ++j)
            for (int i = 0; i < columns.count; ++i)
                sums.add(
                    level, level.at(rows.first + j) + static_cast<std::size_t>(columns.first + i),
                    rows.share[static_cast<std::size_t>(j)] * columns.share[static_cast<std::size_t>(i)]);
        sums.store(next, next.at(y) + static_cast<std::size_t>(x));
    }
}

}  // namespace pbrbake::texture

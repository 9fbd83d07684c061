#include "src/ibl/resample_bright.hpp"

#include <algorithm>
#include <vector>

#include "pbr/ibl/cubemap.hpp"

namespace pbr {
namespace {

constexpr float kBright = 20;            // times the mean
constexpr std::size_t kMostShare = 256;  // one texel in so many

struct BrightTexel {
    std::size_t index;
    float value;
};

float largest_channel(const float* rgb) { return std::max({rgb[0], rgb[1], rgb[2]}); }

/// The bright texels of a cube map, or the brightest of them.
std::vector<BrightTexel> bright_texels(std::span<const float> rgb) {
    const std::size_t count = rgb.size() / 3;
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += static_cast<double>(largest_channel(&rgb[i * 3]));
    const auto least = static_cast<float>(kBright * sum / static_cast<double>(count));
    std::vector<BrightTexel> bright;
    for (std::size_t i = 0; i < count; ++i)
        if (const float value = largest_channel(&rgb[i * 3]); value > least) bright.push_back({i, value});
    const auto brighter = [](const BrightTexel& a, const BrightTexel& b) {
        return a.value != b.value ? a.value > b.value : a.index < b.index;
    };
    if (const std::size_t most = count / kMostShare + 1; bright.size() > most) {
        std::ranges::nth_element(bright, bright.begin() + static_cast<std::ptrdiff_t>(most), brighter);
        bright.resize(most);
    }
    return bright;
}

/// Indices of texels and of all that touch them, also across edges; ascending, each once.
std::vector<std::size_t> with_neighbours(const std::vector<BrightTexel>& texels, int size) {
    const std::size_t n = static_cast<std::size_t>(size);
    std::vector<std::size_t> indices;
    for (const BrightTexel& texel : texels) {
        const int face = static_cast<int>(texel.index / (n * n)), y = static_cast<int>(texel.index / n % n),
                  x = static_cast<int>(texel.index % n);
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const CubeTexel beside = cubemap_texel(
                    cube_vector(face, cube_coordinate(x + dx, size), cube_coordinate(y + dy, size)), size);
                indices.push_back((static_cast<std::size_t>(beside.face) * n + beside.y) * n + beside.x);
            }
    }
    std::ranges::sort(indices);
    const auto repeated = std::ranges::unique(indices);
    indices.erase(repeated.begin(), repeated.end());
    return indices;
}

}  // namespace

void resample_bright_texels(const EquirectView& source, int size, const ForEach& each,
                            std::span<float> rgb_out) {
    const std::vector<std::size_t> indices = with_neighbours(bright_texels(rgb_out), size);
    constexpr std::size_t kTask = 16;
    const std::size_t n = static_cast<std::size_t>(size);
    each(static_cast<int>((indices.size() + kTask - 1) / kTask), [&](int task) {
        const std::size_t first = static_cast<std::size_t>(task) * kTask,
                          last = std::min(indices.size(), first + kTask);
        std::vector<CubeTexel> texels;
        for (std::size_t i = first; i < last; ++i)
            texels.push_back({static_cast<int>(indices[i] / (n * n)), static_cast<int>(indices[i] % n),
                              static_cast<int>(indices[i] / n % n)});
        std::vector<float> rgb(texels.size() * 3);
        resample_area(source, size, texels, rgb);
        for (std::size_t i = first; i < last; ++i)
            std::copy_n(&rgb[(i - first) * 3], 3, &rgb_out[indices[i] * 3]);
    });
}

}  // namespace pbr

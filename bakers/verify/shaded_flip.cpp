#include "bakers/verify/shaded_flip.hpp"

#include <algorithm>

#include "bakers/verify/picture.hpp"

namespace pbrbake::verify {
namespace {

constexpr int kLargestSphere = 96, kSmallestSphere = 24;  // pixels across
/// FLIP's exposures each cost as much as the first. Beyond these stops there is a sun in the reference, and
/// what is darker by 2^-kMostStops is black beside it.
constexpr double kMostStops = 16;

/// Spheres side by side; beyond a sphere's rim its colour goes on, as a black background would count as
/// right.
LinearPicture spheres(const Image& probe, double scale, int size) {
    const int count = static_cast<int>(probe.levels.size());
    const View view({-0.5, -0.2, -1});
    LinearPicture picture(size * count, size);
    for (int sphere = 0; sphere < count; ++sphere) {
        const Radiance radiance = radiance_of_level(probe, sphere, scale);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x)
                picture.at(sphere * size + x, y) =
                    radiance(reflected_at(view, (2 * x + 1.0) / size - 1, 1 - (2 * y + 1.0) / size));
    }
    return picture;
}

}  // namespace

ShadedFlip shaded_flip(const Image& a, const Image& b, double scale,
                       std::optional<std::pair<double, double>> exposures) {
    const int size = std::clamp(b.levels.front().width, kSmallestSphere, kLargestSphere);
    LinearPicture of_a = spheres(a, scale, size), of_b = spheres(b, scale, size);
    std::pair<double, double> used = exposures ? *exposures : flip_exposures(of_b);
    if (!exposures) used.first = std::max(used.first, used.second - kMostStops);
    FlipMap map = hdr_flip(of_b, of_a, used);
    const double mean = map.mean(), max = map.max();
    return {mean, max, used.first, used.second, std::move(of_a), std::move(of_b), std::move(map)};
}

}  // namespace pbrbake::verify

#include "bakers/verify/face.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pbrbake::verify {

float Face::between(double x, double y, int c) const {
    x = std::clamp(x, 0.0, width - 1.0);
    y = std::clamp(y, 0.0, height - 1.0);
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const int x1 = std::min(x0 + 1, width - 1), y1 = std::min(y0 + 1, height - 1);
    const double tx = x - x0, ty = y - y0;
    return static_cast<float>((1 - ty) * ((1 - tx) * at(x0, y0, c) + tx * at(x1, y0, c)) +
                              ty * ((1 - tx) * at(x0, y1, c) + tx * at(x1, y1, c)));
}

Face face_of(const Image& image, int level, int face) {
    const Level& l = image.levels[static_cast<std::size_t>(level)];
    const std::size_t size = static_cast<std::size_t>(l.width) * l.height * image.channels.size();
    const float* begin = image.texel(level, face, 0, 0);
    return {l.width, l.height, image.channel_count(), {begin, begin + size}};
}

Face shrunk(Face face, int side) {
    while (std::max(face.width, face.height) > side && face.width % 2 == 0 && face.height % 2 == 0) {
        Face half{face.width / 2, face.height / 2, face.channels, {}};
        half.texels.resize(face.texels.size() / 4);
        for (int y = 0; y < half.height; ++y)
            for (int x = 0; x < half.width; ++x)
                for (int c = 0; c < face.channels; ++c)
                    half.at(x, y, c) =
                        0.25f * (face.at(2 * x, 2 * y, c) + face.at(2 * x + 1, 2 * y, c) +
                                 face.at(2 * x, 2 * y + 1, c) + face.at(2 * x + 1, 2 * y + 1, c));
        face = std::move(half);
    }
    return face;
}

Face window_of(const Face& face, int side) {
    Face window{std::min(face.width, side), std::min(face.height, side), face.channels, {}};
    window.texels.resize(static_cast<std::size_t>(window.width) * window.height * window.channels);
    const int left = (face.width - window.width) / 2, top = (face.height - window.height) / 2;
    for (int y = 0; y < window.height; ++y)
        for (int x = 0; x < window.width; ++x)
            for (int c = 0; c < face.channels; ++c) window.at(x, y, c) = face.at(left + x, top + y, c);
    return window;
}

double distance(const Face& a, const Face& b, const std::vector<double>& typical, int margin, double enough) {
    const int width = a.width - 2 * margin, height = a.height - 2 * margin;
    if (width <= 0 || height <= 0) return 0;
    const double count = static_cast<double>(width) * height * a.channels;
    double sum = 0;
    for (int y = margin; y < margin + height && sum <= enough * count; ++y)
        for (int x = margin; x < margin + width; ++x)
            for (int c = 0; c < a.channels; ++c) {
                const double va = a.at(x, y, c), vb = b.at(x, y, c);
                const double size =
                    std::max({std::abs(va), std::abs(vb), typical[static_cast<std::size_t>(c)]});
                if (std::isfinite(va) && std::isfinite(vb) && size > 0) sum += std::abs(va - vb) / size;
            }
    return sum / count;
}

Face turned(const Face& face, int way) {
    Face result = face;
    for (int y = 0; y < face.height; ++y)
        for (int x = 0; x < face.width; ++x) {
            int u = (way & 1) ? face.width - 1 - x : x, v = (way & 2) ? face.height - 1 - y : y;
            if (way & 4) std::swap(u, v);
            for (int c = 0; c < face.channels; ++c) result.at(x, y, c) = face.at(u, v, c);
        }
    return result;
}

}  // namespace pbrbake::verify

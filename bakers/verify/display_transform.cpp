#include "bakers/verify/display_transform.hpp"

#include <array>
#include <cmath>

#include "bakers/error.hpp"
#include "bakers/io/display.hpp"

namespace pbrbake::verify {
namespace {

constexpr const char* kWorkingSpace = "lin_rec709";

}  // namespace

DisplayTransform::DisplayTransform() : has_aces_(true) {
    try {
        std::array<float, 3> black{};
        io::to_display(kWorkingSpace, black);
    } catch (const Error&) {
        has_aces_ = false;
    }
}

const char* DisplayTransform::name() const {
    return has_aces_ ? "ACES 1's output transform for SDR video on an sRGB display, by OpenColorIO"
                     : "sRGB, clipped (OpenColorIO is not installed)";
}

Picture DisplayTransform::operator()(const LinearPicture& exposed) const {
    Picture picture(exposed.width, exposed.height);
    std::vector<float> rgb;
    for (const glm::dvec3& colour : exposed.rgb)
        for (int c = 0; c < 3; ++c) rgb.push_back(static_cast<float>(colour[c]));
    if (has_aces_) io::to_display(kWorkingSpace, rgb);
    for (std::size_t i = 0; i < rgb.size(); ++i)
        picture.rgb[i] = has_aces_ ? static_cast<std::uint8_t>(std::lround(255 * rgb[i])) : srgb_byte(rgb[i]);
    return picture;
}

}  // namespace pbrbake::verify

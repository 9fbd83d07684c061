#pragma once
// Products as pictures for people: exposure, tone, false colour, and layouts of cube maps. For reports alone;
// nothing here goes into a product.

#include <array>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "bakers/image.hpp"

namespace pbrbake::verify {

/// An 8-bit RGB picture, display-encoded, row 0 at the top.
struct Picture {
    Picture(int columns, int rows)
        : width(columns), height(rows), rgb(static_cast<std::size_t>(columns) * rows * 3) {}

    int width, height;
    std::vector<std::uint8_t> rgb;

    std::uint8_t* pixel(int x, int y) { return &rgb[(static_cast<std::size_t>(y) * width + x) * 3]; }
    const std::uint8_t* pixel(int x, int y) const {
        return &rgb[(static_cast<std::size_t>(y) * width + x) * 3];
    }
};

/// "data:image/png;base64,…"
std::string data_uri(const Picture& picture);

/// pbr::exposure_by_saturation: multiplies luminance in cd/m^2 so that 1 is what saturates a sensor.
double exposure_of_ev100(double ev100);

/// The display transform: sRGB's curve (IEC 61966-2-1) of a linear value, as a byte; clipped to [0, 1]
/// before. NaN is 0.
std::uint8_t srgb_byte(double linear);

/// The inverse, a channel at a time, of values in [0, 1]: for what is display-encoded and goes through put().
glm::dvec3 linear_of_display(const glm::dvec3& encoded);

/// Writes a pixel from linear light.
void put(Picture& picture, int x, int y, const glm::dvec3& linear);

/// A colour scale for [0, 1], dark to light and even in lightness (viridis), display-encoded; clipped
/// outside.
glm::dvec3 false_colour(double value);

/// Radiance seen in a direction (unit vector).
using Radiance = std::function<glm::dvec3(const glm::dvec3& direction)>;

/// One level of an RGB cube map of any size as a shader reads it: bilinear and seamless across edges; values
/// divided by `scale`.
Radiance radiance_of_level(const Image& cube, int level, double scale);

/// Between levels as a shader's trilinear lookup reads it: level = (levels - 1) * perceptual_roughness.
class ProbeLookup {
  public:
    ProbeLookup(const Image& cube, double scale);
    glm::dvec3 operator()(const glm::dvec3& direction, double perceptual_roughness) const;

  private:
    std::vector<Radiance> levels_;
};

/// One level unfolded: 4n x 3n, +Y and -Y above and below +Z, as drawn in libpbr's ibl/cubemap.hpp; what no
/// face covers is `background` (display-encoded).
Picture cross_picture(const Image& cube, int level, double factor,
                      const std::array<std::uint8_t, 3>& background);

/// A camera's frame: right-handed, y up as far as `towards` allows.
struct View {
    explicit View(const glm::dvec3& towards);
    glm::dvec3 right, up, forward;
};

/// The direction that a mirror ball reflects the view into at (u, v) of its disk, v upwards, seen from afar;
/// of its rim beyond.
glm::dvec3 reflected_at(const View& view, double u, double v);

/// A mirror ball seen from afar: the colour of each point of the disk from its normal and the direction it
/// reflects into. `shade` is called with both. Pixels outside the disk get the colour of its nearest point.
using BallShade = std::function<glm::dvec3(const glm::dvec3& normal, const glm::dvec3& reflected)>;
Picture ball_picture(int size, const View& view, const BallShade& shade);

/// A row of `balls` before a background, which the camera sees in perspective, `width_deg` of it across the
/// picture.
struct StripScene {
    int width, height, balls;
    double width_deg;
    View view;
    std::function<glm::dvec3(int ball, const glm::dvec3& normal, const glm::dvec3& reflected)> shade;
    Radiance background;
};
Picture strip_picture(const StripScene& scene);

}  // namespace pbrbake::verify

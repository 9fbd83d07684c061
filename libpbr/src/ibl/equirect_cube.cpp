// A whole cube map from an equirect, faster than texel by texel where the picture's axis is one of the
// cube's: eight images of one pattern (src/ibl/cube_images.hpp).

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"
#include "src/ibl/cube_images.hpp"
#include "src/ibl/resample_bright.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;
/// Sums over one texel of the pattern, in all its images.
struct Sums {
    double flux[kCubeImages][3] = {}, area = 0;

    /// Adds texels of a column of the picture, from `row` towards the equator.
    void add(const EquirectView& source, const CubeImages& images, int column, int row,
             const std::vector<double>& weights) {
        for (const double weight : weights) area += weight;
        const long count = static_cast<long>(weights.size());
        for (std::size_t image = 0; image < kCubeImages; ++image) {
            int x = images[image].column + column;
            x = x < 0 ? x + source.width : x >= source.width ? x - source.width : x;
            const bool south = images[image].south;
            const float* rgb = source.texel(x, south ? source.height - 1 - row : row);
            const long step = (south ? -3L : 3L) * source.width;
            double *sum = flux[image], r = sum[0], g = sum[1], b = sum[2];
            for (long k = 0; k < count; ++k, rgb += step) {
                const double weight = weights[static_cast<std::size_t>(k)];
                r += weight * static_cast<double>(rgb[0]);
                g += weight * static_cast<double>(rgb[1]);
                b += weight * static_cast<double>(rgb[2]);
            }
            sum[0] = r, sum[1] = g, sum[2] = b;
        }
    }

    void write_means(const CubeImages& images, int i, int j, std::span<float> rgb_out) const {
        for (std::size_t image = 0; image < kCubeImages; ++image) {
            const CubeImage& at = images[image];
            const auto texel = static_cast<std::size_t>(at.origin + i * at.step_i + j * at.step_j);
            for (std::size_t c = 0; c < 3; ++c)
                rgb_out[texel * 3 + c] = static_cast<float>(flux[image][c] / area);
        }
    }
};

/// The picture, its rows, and the phase of its columns against the pattern's.
struct Pattern {
    const EquirectView& source;
    const CubeImages& images;
    double phase;
    int size;
    const std::vector<double>& row_cosines;  ///< between rows, falling

    /// The row whose span of cosines holds z.
    int row_of(double z) const {
        const auto below = std::lower_bound(row_cosines.begin(), row_cosines.end(), z, std::greater<>());
        return std::clamp(static_cast<int>(below - row_cosines.begin()) - 1, 0, source.height - 1);
    }
};

/// Half a face beside the axis: direction = normal + a across + b up, a eastward, b >= 0. Meridians are the
/// lines a = const, and dOmega = da / (1 + a^2) dc with c the cosine of colatitude: for each of a few a
/// within a column one walk along the meridian cuts it at rows and at texels.
class BesideStrip {
  public:
    /// Texels [first, last) of the pattern's j.
    BesideStrip(const Pattern& pattern, int first, int last)
        : p_(pattern), first_(first), last_(last), sums_(static_cast<std::size_t>(last - first)) {}

    void fill(std::span<float> rgb_out) {
        for (int i = 0; i < p_.size; ++i) {
            std::fill(sums_.begin(), sums_.end(), Sums());
            add_line(2.0 * i / p_.size - 1, 2.0 * (i + 1) / p_.size - 1);
            for (int j = first_; j < last_; ++j)
                sums_[static_cast<std::size_t>(j - first_)].write_means(p_.images, i, j, rgb_out);
        }
    }

  private:
    /// A walk along one meridian, from texel to texel.
    struct Walk {
        double a2, weight;  ///< 1 + a^2, and what an interval of cosines counts
        double low;         ///< cosine of colatitude
        int row;            ///< that holds it
    };

    double boundary(int column) const {
        const SinCos angle = sin_cos_pi(2 * (column - p_.phase) / p_.source.width);
        return angle.sin / angle.cos;
    }

    /// b at the lower edge of texel j: texel 0 straddles the equator where the size is odd.
    double edge(int j) const { return (2.0 * j - p_.size % 2) / p_.size; }

    void add_line(double from, double to) {
        int column =
            static_cast<int>(std::floor(atan2_exact(from, 1) / (2 * kPi) * p_.source.width + p_.phase));
        for (double at = from; at < to; ++column) {
            const double end = std::clamp(boundary(column + 1), at, to);
            if (end - at > 1e-15) add_piece(column, at, end);
            at = end;
        }
    }

    void add_piece(int column, double from, double to) {
        static const QuadratureRule rule = gauss_legendre(2);
        std::array<Walk, 2> walks;
        for (std::size_t k = 0; k < 2; ++k) {
            const double a = from + (to - from) * rule.nodes[k], a2 = 1 + a * a, b = edge(first_);
            const double low = b / std::sqrt(a2 + b * b);
            walks[k] = {a2, rule.weights[k] * (to - from) / a2, low, p_.row_of(low)};
        }
        for (int j = first_; j < last_; ++j) {
            const double b = edge(j + 1);
            const int bottom = std::max(walks[0].row, walks[1].row);
            weights_.clear();
            for (Walk& walk : walks) step(walk, b / std::sqrt(walk.a2 + b * b), bottom);
            std::reverse(weights_.begin(), weights_.end());
            sums_[static_cast<std::size_t>(j - first_)].add(
                p_.source, p_.images, column, bottom + 1 - static_cast<int>(weights_.size()), weights_);
        }
    }

    /// Adds the weights of rows up to `high`, counted upwards from `bottom`.
    void step(Walk& walk, double high, int bottom) {
        for (;; --walk.row) {
            const double top = std::min(high, p_.row_cosines[static_cast<std::size_t>(walk.row)]);
            const auto place = static_cast<std::size_t>(bottom - walk.row);
            if (weights_.size() <= place) weights_.resize(place + 1);
            weights_[place] += walk.weight * (top - walk.low);
            walk.low = top;
            if (top >= high || walk.row == 0) break;
        }
    }

    const Pattern& p_;
    int first_, last_;
    std::vector<Sums> sums_;
    std::vector<double> weights_;
};

double cross(const glm::dvec2& p, const glm::dvec2& q) { return p.x * q.y - p.y * q.x; }

/// A quadrant of a face that the axis pierces in the middle: direction = axis + a e + b f, a and b >= 0, f to
/// the east of e. Columns are wedges about the middle.
class PiercedQuadrant {
  public:
    explicit PiercedQuadrant(const Pattern& pattern) : p_(pattern) {
        for (int k = 0; k <= p_.source.width / 4 + 1; ++k) {
            const SinCos angle = sin_cos_pi(2 * (k - p_.phase) / p_.source.width);
            boundaries_.emplace_back(angle.cos, angle.sin);
        }
    }

    /// All texels of one j.
    void fill_row(int j, std::span<float> rgb_out) const {
        std::vector<double> weights;
        for (int i = 0; i < p_.size / 2; ++i) {
            Sums sums;
            add_texel({edge(i), edge(i + 1), edge(j), edge(j + 1)}, sums, weights);
            sums.write_means(p_.images, i, j, rgb_out);
        }
    }

  private:
    struct Box {
        double a0, a1, b0, b1;
    };

    double edge(int k) const { return 2.0 * k / p_.size; }

    void add_texel(const Box& box, Sums& sums, std::vector<double>& weights) const {
        // Corners by their angle about the middle; the one in the middle, if any, has none.
        std::array<glm::dvec2, 4> corners{
            glm::dvec2(box.a1, box.b0), {box.a0, box.b0}, {box.a1, box.b1}, {box.a0, box.b1}};
        std::size_t count = 4;
        if (box.a0 == 0 && box.b0 == 0) {
            corners = {corners[0], corners[2], corners[3], {}};
            count = 3;
        } else if (cross(corners[1], corners[2]) < 0) {
            std::swap(corners[1], corners[2]);
        }
        glm::dvec2 at = glm::normalize(corners[0]);
        int wedge = wedge_of(at), row = p_.row_of(1 / std::sqrt(1 + box.a0 * box.a0 + box.b0 * box.b0));
        for (std::size_t k = 1; k < count; ++k) {
            const glm::dvec2 corner = glm::normalize(corners[k]);
            for (; cross(boundary(wedge + 1), corner) > 0; ++wedge) {
                add_wedge(wedge, at, boundary(wedge + 1), box, row, sums, weights);
                at = boundary(wedge + 1);
            }
            add_wedge(wedge, at, corner, box, row, sums, weights);
            at = corner;
        }
    }

    const glm::dvec2& boundary(int wedge) const { return boundaries_[static_cast<std::size_t>(wedge)]; }

    /// The wedge that begins at or holds a direction.
    int wedge_of(const glm::dvec2& direction) const {
        const double turns = atan2_exact(direction.y, direction.x) / (2 * kPi);
        const int last = static_cast<int>(boundaries_.size()) - 2;
        int wedge = std::clamp(static_cast<int>(turns * p_.source.width + p_.phase), 0, last);
        // Rounding may have put a direction on a boundary to either side; the right one makes wedges
        // positive.
        if (wedge < last && cross(boundary(wedge + 1), direction) >= 0) ++wedge;
        return wedge;
    }

    /// Adds what lies between unit vectors p and q, q to the east of it by a small angle.
    void add_wedge(int wedge, const glm::dvec2& p, const glm::dvec2& q, const Box& box, int& row, Sums& sums,
                   std::vector<double>& weights) const {
        const double sine = cross(p, q);
        if (sine < 1e-15) return;
        const double sine2 = sine * sine, angle = sine * (1 + sine2 * (1.0 / 6 + sine2 * 3 / 40));
        const glm::dvec2 middle = glm::normalize(p + q), across(-middle.y, middle.x);
        constexpr double kNode = 0.28867513459481287;  // two-point Gauss: 1 / (2 sqrt(3)) either side
        const double x = angle * kNode, x2 = x * x;
        const double sin_x = x * (1 - x2 / 6), cos_x = 1 - x2 / 2 * (1 - x2 / 12);
        const Ray rays[2] = {ray(middle * cos_x - across * sin_x, box),
                             ray(middle * cos_x + across * sin_x, box)};
        const std::vector<double>& cosines = p_.row_cosines;
        const double highest = std::max(rays[0].high, rays[1].high);
        while (row > 0 && cosines[static_cast<std::size_t>(row)] < highest) --row;
        while (row + 1 < p_.source.height && cosines[static_cast<std::size_t>(row) + 1] >= highest) ++row;
        weights.clear();
        const double lowest = std::min(rays[0].low, rays[1].low);
        for (auto r = static_cast<std::size_t>(row); cosines[r] > lowest; ++r) {
            double weight = 0;
            for (const Ray& of : rays)
                weight += std::max(0.0, std::min(of.high, cosines[r]) - std::max(of.low, cosines[r + 1]));
            weights.push_back(weight * angle / 2);
        }
        sums.add(p_.source, p_.images, wedge, row, weights);
    }

    /// The part of a meridian within a box, by cosines of colatitude.
    struct Ray {
        double low, high;
    };
    static Ray ray(const glm::dvec2& direction, const Box& box) {
        const double ia = 1 / direction.x, ib = 1 / direction.y;
        const double in = std::max(box.a0 * ia, box.b0 * ib), out = std::min(box.a1 * ia, box.b1 * ib);
        const double high = 1 / std::sqrt(1 + in * in);
        return {out > in ? 1 / std::sqrt(1 + out * out) : high, high};
    }

    const Pattern& p_;
    std::vector<glm::dvec2> boundaries_;  ///< between wedges, unit vectors (a, b)
};

/// Rows that the patterns leave out: those of pierced faces whose middle lies in a texel.
void fill_pierced_rows(const EquirectView& source, int size, const CubeImages& pierced, const ForEach& each,
                       std::span<float> rgb_out) {
    const std::size_t stride = static_cast<std::size_t>(size) * 3;
    each(2 * size, [&](int k) {
        const long texels = static_cast<long>(size) * size;
        const int face = static_cast<int>(pierced[k < size ? 0 : 4].origin / texels), y = k % size;
        resample_area(source, size, face, y,
                      rgb_out.subspan((static_cast<std::size_t>(face) * size + y) * stride, stride));
    });
}

}  // namespace

void resample_area(const EquirectView& source, int size, const ForEach& each, std::span<float> rgb_out) {
    const std::size_t stride = static_cast<std::size_t>(size) * 3;
    const std::optional<CubeFaces> faces = CubeFaces::of(source, size);
    if (!faces)
        return each(6 * size, [&](int row) {
            resample_area(source, size, row / size, row % size,
                          rgb_out.subspan(static_cast<std::size_t>(row) * stride, stride));
        });
    std::vector<double> row_cosines;
    for (int r = 0; r <= source.height; ++r)
        row_cosines.push_back(sin_cos_pi(static_cast<double>(r) / source.height).cos);
    // Strips are narrow so that the rows of the picture they read stay in the cache from column to column.
    constexpr int kStrip = 8;
    const int half = (size + 1) / 2, strips = (half + kStrip - 1) / kStrip;
    const bool even = size % 2 == 0;
    const Pattern beside{source, faces->beside, faces->phase, size, row_cosines};
    const Pattern pierced{source, faces->pierced, faces->phase, size, row_cosines};
    const PiercedQuadrant quadrant(pierced);
    each(strips + (even ? half : 0), [&](int task) {
        if (task >= strips) return quadrant.fill_row(task - strips, rgb_out);
        BesideStrip(beside, task * kStrip, std::min(half, (task + 1) * kStrip)).fill(rgb_out);
    });
    if (!even) fill_pierced_rows(source, size, faces->pierced, each, rgb_out);
    resample_bright_texels(source, size, each, rgb_out);
}

}  // namespace pbr

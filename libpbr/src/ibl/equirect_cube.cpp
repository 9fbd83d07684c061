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
#include "src/simd/cube_images_kernel.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;
/// Sums over texels of the pattern in all its images: what is to be read is listed, then read at once.
class PatternSums {
  public:
    explicit PatternSums(int texels) : areas_(texels), sums_(texels * kImageSums) {}

    /// Begins a piece: texels of a column of the picture, from `row` towards the equator, whose weights
    /// follow.
    void begin(int texel, int column, int row) { pieces_.push_back({column, row, 0, texel}); }
    void add(double weight) {
        ++pieces_.back().count;
        areas_[static_cast<std::size_t>(pieces_.back().texel)] += weight;
        weights_.push_back(weight);
    }

    /// Reads all that was listed.
    void read(const EquirectView& source, const CubeImages& images) {
        add_pieces(source, images, pieces_, weights_.data(), sums_.data());
    }

    /// Texel (i, j) of the pattern.
    void write_mean(int texel, const CubeImages& images, int i, int j, std::span<float> rgb_out) const {
        const double share = 1 / areas_[static_cast<std::size_t>(texel)];
        const double* sum = &sums_[static_cast<std::size_t>(texel * kImageSums)];
        for (const CubeImage& at : images) {
            float* rgb = &rgb_out[static_cast<std::size_t>(at.origin + i * at.step_i + j * at.step_j) * 3];
            for (std::size_t c = 0; c < 3; ++c) rgb[c] = static_cast<float>(sum[c] * share);
            sum += 4;
        }
    }

  private:
    std::vector<double> areas_, sums_, weights_;
    std::vector<ColumnPiece> pieces_;
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
        : p_(pattern), first_(first), last_(last), sums_(pattern.size * (last - first)) {}

    void fill(std::span<float> rgb_out) {
        for (int i = 0; i < p_.size; ++i) add_line(i);
        sums_.read(p_.source, p_.images);
        for (int i = 0; i < p_.size; ++i)
            for (int j = first_; j < last_; ++j) sums_.write_mean(texel(i, j), p_.images, i, j, rgb_out);
    }

  private:
    /// A walk along one meridian, from texel to texel.
    struct Walk {
        double a2, weight;  ///< 1 + a^2, and what an interval of cosines counts
        double low, high;   ///< cosines of colatitude of the texel's edges
        int row;            ///< that holds the upper one

        /// What lies in a row.
        double share(const Pattern& pattern, int row_of_picture) const {
            const double* cosine = &pattern.row_cosines[static_cast<std::size_t>(row_of_picture)];
            return weight * std::max(0.0, std::min(high, cosine[0]) - std::max(low, cosine[1]));
        }
    };

    double boundary(int column) const {
        const SinCos angle = sin_cos_pi(2 * (column - p_.phase) / p_.source.width);
        return angle.sin / angle.cos;
    }

    /// b at the lower edge of texel j: texel 0 straddles the equator where the size is odd.
    double edge(int j) const { return (2.0 * j - p_.size % 2) / p_.size; }

    int texel(int i, int j) const { return i * (last_ - first_) + j - first_; }

    void add_line(int i) {
        const double from = 2.0 * i / p_.size - 1, to = 2.0 * (i + 1) / p_.size - 1;
        int column =
            static_cast<int>(std::floor(atan2_exact(from, 1) / (2 * kPi) * p_.source.width + p_.phase));
        for (double at = from; at < to; ++column) {
            const double end = std::clamp(boundary(column + 1), at, to);
            if (end - at > 1e-15) add_piece(i, column, at, end);
            at = end;
        }
    }

    void add_piece(int i, int column, double from, double to) {
        static const QuadratureRule rule = gauss_legendre(2);
        std::array<Walk, 2> walks;
        for (std::size_t k = 0; k < 2; ++k) {
            const double a = from + (to - from) * rule.nodes[k], a2 = 1 + a * a, b = edge(first_);
            const double low = b / std::sqrt(a2 + b * b);
            walks[k] = {a2, rule.weights[k] * (to - from) / a2, low, low, p_.row_of(low)};
        }
        for (int j = first_; j < last_; ++j) {
            const double b = edge(j + 1);
            const int bottom = std::max(walks[0].row, walks[1].row);
            for (Walk& walk : walks) {
                walk.high = b / std::sqrt(walk.a2 + b * b);
                while (walk.row > 0 && p_.row_cosines[static_cast<std::size_t>(walk.row)] < walk.high)
                    --walk.row;
            }
            const int top = std::min(walks[0].row, walks[1].row);
            sums_.begin(texel(i, j), column, top);
            for (int row = top; row <= bottom; ++row)
                sums_.add(walks[0].share(p_, row) + walks[1].share(p_, row));
            for (Walk& walk : walks) walk.low = walk.high;
        }
    }

    const Pattern& p_;
    int first_, last_;
    PatternSums sums_;
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
        PatternSums sums(p_.size / 2);
        for (int i = 0; i < p_.size / 2; ++i)
            add_texel(i, {edge(i), edge(i + 1), edge(j), edge(j + 1)}, sums);
        sums.read(p_.source, p_.images);
        for (int i = 0; i < p_.size / 2; ++i) sums.write_mean(i, p_.images, i, j, rgb_out);
    }

  private:
    struct Box {
        double a0, a1, b0, b1;
    };

    double edge(int k) const { return 2.0 * k / p_.size; }

    void add_texel(int i, const Box& box, PatternSums& sums) const {
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
                add_wedge(i, wedge, at, boundary(wedge + 1), box, row, sums);
                at = boundary(wedge + 1);
            }
            add_wedge(i, wedge, at, corner, box, row, sums);
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
    void add_wedge(int i, int wedge, const glm::dvec2& p, const glm::dvec2& q, const Box& box, int& row,
                   PatternSums& sums) const {
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
        sums.begin(i, wedge, row);
        const double lowest = std::min(rays[0].low, rays[1].low);
        for (auto r = static_cast<std::size_t>(row); cosines[r] > lowest; ++r) {
            double weight = 0;
            for (const Ray& of : rays)
                weight += std::max(0.0, std::min(of.high, cosines[r]) - std::max(of.low, cosines[r + 1]));
            sums.add(weight * angle / 2);
        }
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
    // Strips are narrow so that the rows of the picture they read stay in the cache from column to column,
    // although rows are a power of two apart, or near.
    constexpr int kStrip = 2;
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
}

}  // namespace pbr

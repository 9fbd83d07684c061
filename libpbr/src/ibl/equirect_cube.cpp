// A whole cube map from an equirect, faster than texel by texel where the picture's axis is one of the
// cube's.
//
// On a face beside the axis meridians are the lines a = const, a the coordinate across the axis, and dOmega =
// da / (1 + a^2) dc with c the cosine of colatitude. So for a few a within each column of the picture one
// walk along the line serves all texels of it: rows of the picture are passed once, not once a texel.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;

/// A face whose texels line up with meridians: direction = normal + a across + b up, in the picture's frame,
/// up along its axis.
struct SideFace {
    glm::dvec3 normal, across;
    bool across_is_s;
    double b_sign;  ///< of the other coordinate against b

    /// Nothing if the picture's axis isn't parallel to an edge of the face.
    static std::optional<SideFace> of(const glm::dmat3& world_to_source, int face) {
        const glm::dvec3 normal = world_to_source * cube_vector(face, 0, 0);
        const glm::dvec3 s = world_to_source * cube_vector(face, 1, 0) - normal;
        const glm::dvec3 t = world_to_source * cube_vector(face, 0, 1) - normal;
        for (const bool across_is_s : {true, false}) {
            const glm::dvec3 &across = across_is_s ? s : t, &along = across_is_s ? t : s;
            if (std::abs(normal.y) < 1e-12 && std::abs(across.y) < 1e-12)
                return SideFace{normal, across, across_is_s, along.y > 0 ? 1.0 : -1.0};
        }
        return std::nullopt;
    }
};

/// One line of texels of a side face, those at the same place across.
class MeridianLine {
  public:
    MeridianLine(const EquirectView& source, const SideFace& face, int size,
                 const std::vector<double>& row_cosines)
        : source_(source),
          face_(face),
          size_(size),
          row_cosines_(row_cosines),
          sums_(static_cast<std::size_t>(size) * 4) {}

    /// Means of the texels from b = -1 to b = 1, RGB each.
    std::vector<double> means(int index) {
        const double from = 2.0 * index / size_ - 1, to = 2.0 * (index + 1) / size_ - 1;
        // u falls with longitude, and longitude is monotone in a. Columns meet the piece from one end to the
        // other.
        const double u_from = u_of(from), turn = std::remainder(u_of(to) - u_from, 1.0);
        const double first = u_from * source_.width, last = first + turn * source_.width;
        const int step = turn > 0 ? 1 : -1;
        double at = from;
        for (int column = step > 0 ? static_cast<int>(std::floor(first))
                                   : static_cast<int>(std::ceil(first)) - 1;
             ; column += step) {
            const double boundary = step > 0 ? column + 1 : column;
            const bool ends = step > 0 ? boundary >= last : boundary <= last;
            const double end = ends ? to : std::clamp(a_of(boundary / source_.width), at, to);
            add_piece((column % source_.width + source_.width) % source_.width, at, end);
            if (ends) break;
            at = end;
        }
        std::vector<double> result;
        for (int j = 0; j < size_; ++j)
            for (std::size_t c = 0; c < 3; ++c) result.push_back(sums_[j * 4 + c] / sums_[j * 4 + 3]);
        return result;
    }

  private:
    double u_of(double a) const { return equirect_point(face_.normal + a * face_.across).x; }
    double a_of(double u) const {
        const glm::dvec3 d = equirect_direction(u, 0.5);
        return (d.x * face_.across.x + d.z * face_.across.z) / (d.x * face_.normal.x + d.z * face_.normal.z);
    }

    void add_piece(int column, double from, double to) {
        if (to - from < 1e-15) return;
        static const QuadratureRule rule = gauss_legendre(2);
        for (int i = 0; i < rule.size(); ++i) {
            const double a = from + (to - from) * rule.nodes[i];
            walk(column, a, rule.weights[i] * (to - from) / (1 + a * a));
        }
    }

    /// Adds to all texels along the meridian at a.
    void walk(int column, double a, double weight) {
        const double a2 = 1 + a * a;
        double low = -1 / std::sqrt(a2 + 1);  // cosine of colatitude at b = -1
        int row = static_cast<int>(
            std::lower_bound(row_cosines_.rbegin(), row_cosines_.rend(), low, std::less<>()) -
            row_cosines_.rbegin());
        row = std::clamp(source_.height - row, 0, source_.height - 1);
        for (int j = 0; j < size_; ++j) {
            const double b = 2.0 * (j + 1) / size_ - 1;
            const double high = b / std::sqrt(a2 + b * b);
            double* sum = &sums_[static_cast<std::size_t>(j) * 4];
            for (;;) {
                const double top = std::min(high, row_cosines_[static_cast<std::size_t>(row)]);
                const double area = weight * (top - low);
                const float* texel = source_.texel(column, row);
                for (int c = 0; c < 3; ++c) sum[c] += area * static_cast<double>(texel[c]);
                sum[3] += area;
                low = top;
                if (top >= high || row == 0) break;
                --row;
            }
        }
    }

    const EquirectView& source_;
    const SideFace& face_;
    int size_;
    const std::vector<double>& row_cosines_;
    std::vector<double> sums_;  ///< flux and area of each texel
};

double cross(const glm::dvec2& p, const glm::dvec2& q) { return p.x * q.y - p.y * q.x; }

/// A face that the picture's axis pierces in the middle: direction = axis + a s + b t.
class PolarFace {
  public:
    /// Nothing if it is another face, or the picture's columns are wider than the wedges' series is good for.
    static std::optional<PolarFace> of(const EquirectView& source, int face,
                                       const std::vector<double>& row_cosines) {
        constexpr int kFewestColumns = 64;
        const glm::dvec3 normal = source.world_to_source * cube_vector(face, 0, 0);
        if (std::abs(normal.x) > 1e-12 || std::abs(normal.z) > 1e-12 || source.width < kFewestColumns)
            return std::nullopt;
        return PolarFace(source, face, normal, row_cosines);
    }

    /// Mean of the texel [a0, a1] x [b0, b1], which the middle is outside of or a corner of.
    void mean(double a0, double a1, double b0, double b1, float* rgb_out) const {
        // Corners counter-clockwise about the middle, by the tangent of their angle to the texel's centre.
        const glm::dvec2 centre((a0 + a1) / 2, (b0 + b1) / 2);
        std::array<std::pair<double, glm::dvec2>, 4> corners;
        int count = 0;
        for (const glm::dvec2& corner : {glm::dvec2(a0, b0), {a1, b0}, {a0, b1}, {a1, b1}}) {
            const double length = glm::length(corner);
            if (length < 1e-12) continue;
            const double tangent = cross(centre, corner) / glm::dot(centre, corner);
            int place = count++;
            for (; place > 0 && corners[place - 1].first > tangent; --place)
                corners[place] = corners[place - 1];
            corners[place] = {tangent, corner / length};
        }
        Sum sum;
        glm::dvec2 at = corners[0].second;
        int wedge = wedge_of(at);
        for (int k = 1; k < count; ++k) {
            const glm::dvec2& corner = corners[k].second;
            for (; cross(boundaries_[wedge + 1], corner) > 0; wedge = (wedge + 1) % source_->width) {
                add_wedge(wedge, at, boundaries_[wedge + 1], {a0, a1, b0, b1}, sum);
                at = boundaries_[wedge + 1];
            }
            add_wedge(wedge, at, corner, {a0, a1, b0, b1}, sum);
            at = corner;
        }
        for (int c = 0; c < 3; ++c) rgb_out[c] = static_cast<float>(sum.flux[c] / sum.area);
    }

  private:
    struct Sum {
        double flux[3] = {0, 0, 0}, area = 0;
        int row = 0;  ///< where the last ray began
    };
    struct Box {
        double a0, a1, b0, b1;
    };

    PolarFace(const EquirectView& source, int face, const glm::dvec3& normal,
              const std::vector<double>& row_cosines)
        : source_(&source), row_cosines_(&row_cosines), south_(normal.y < 0) {
        const glm::dvec3 s = source.world_to_source * cube_vector(face, 1, 0) - normal;
        const glm::dvec3 t = source.world_to_source * cube_vector(face, 0, 1) - normal;
        // Wedges go counter-clockwise in (s, t); the picture's columns do or don't.
        for (int k = 0; k <= source.width; ++k) {
            const glm::dvec3 d = equirect_direction(static_cast<double>(k) / source.width, 0.5);
            boundaries_.push_back({glm::dot(d, s), glm::dot(d, t)});
        }
        clockwise_ = cross(boundaries_[0], boundaries_[1]) < 0;
        if (clockwise_) std::reverse(boundaries_.begin(), boundaries_.end());
    }

    int column(int wedge) const { return clockwise_ ? source_->width - 1 - wedge : wedge; }

    int wedge_of(const glm::dvec2& direction) const {
        const glm::dvec2& zero = boundaries_[0];
        const double turns = atan2_exact(cross(zero, direction), glm::dot(zero, direction)) / (2 * kPi);
        int wedge = static_cast<int>((turns < 0 ? turns + 1 : turns) * source_->width);
        wedge = std::clamp(wedge, 0, source_->width - 1);
        // Rounding may have put a direction on a boundary to either side; the right one makes wedges
        // positive.
        if (cross(boundaries_[wedge + 1], direction) >= 0) wedge = (wedge + 1) % source_->width;
        return wedge;
    }

    /// Adds what lies between unit vectors p and q, q counter-clockwise by a small angle.
    void add_wedge(int wedge, const glm::dvec2& p, const glm::dvec2& q, const Box& box, Sum& sum) const {
        const double sine = cross(p, q);
        if (sine < 1e-15) return;
        const double sine2 = sine * sine, angle = sine * (1 + sine2 * (1.0 / 6 + sine2 * 3 / 40));
        const glm::dvec2 middle = glm::normalize(p + q), across(-middle.y, middle.x);
        constexpr double kNode = 0.28867513459481287;  // two-point Gauss: 1 / (2 sqrt(3)) either side
        const double x = angle * kNode, x2 = x * x;
        const double sin_x = x * (1 - x2 / 6), cos_x = 1 - x2 / 2 * (1 - x2 / 12);
        for (const double side : {-1.0, 1.0})
            add_ray(column(wedge), middle * cos_x + across * (side * sin_x), box, angle / 2, sum);
    }

    void add_ray(int column, const glm::dvec2& direction, const Box& box, double weight, Sum& sum) const {
        const double ia = 1 / direction.x, ib = 1 / direction.y;
        const double a_in = std::min(box.a0 * ia, box.a1 * ia), a_out = std::max(box.a0 * ia, box.a1 * ia);
        const double b_in = std::min(box.b0 * ib, box.b1 * ib), b_out = std::max(box.b0 * ib, box.b1 * ib);
        const double in = std::max({0.0, a_in, b_in}), out = std::min(a_out, b_out);
        if (!(out > in)) return;
        double high = 1 / std::sqrt(1 + in * in);  // cosine of the angle to the axis, falling along the ray
        const double low = 1 / std::sqrt(1 + out * out);
        const std::vector<double>& cosines = *row_cosines_;
        int& row = sum.row;
        while (row > 0 && cosines[static_cast<std::size_t>(row)] < high) --row;
        while (cosines[static_cast<std::size_t>(row) + 1] >= high) ++row;
        for (int r = row;; ++r) {
            const double bottom = std::max(low, cosines[static_cast<std::size_t>(r) + 1]);
            const double area = weight * (high - bottom);
            const float* texel = source_->texel(column, south_ ? source_->height - 1 - r : r);
            for (int c = 0; c < 3; ++c) sum.flux[c] += area * static_cast<double>(texel[c]);
            sum.area += area;
            high = bottom;
            if (bottom <= low) break;
        }
    }

    const EquirectView* source_;
    const std::vector<double>* row_cosines_;
    bool south_, clockwise_ = false;
    std::vector<glm::dvec2> boundaries_;  ///< between wedges, unit vectors in (s, t)
};

}  // namespace

void resample_area(const EquirectView& source, int size, const ForEach& each, std::span<float> rgb_out) {
    std::vector<double> row_cosines;
    for (int r = 0; r <= source.height; ++r)
        row_cosines.push_back(sin_cos_pi(static_cast<double>(r) / source.height).cos);
    std::array<std::optional<SideFace>, 6> sides;
    std::array<std::optional<PolarFace>, 6> polar;
    for (int face = 0; face < 6; ++face) {
        sides[face] = SideFace::of(source.world_to_source, face);
        polar[face] = PolarFace::of(source, face, row_cosines);
    }
    const std::size_t stride = static_cast<std::size_t>(size) * 3;
    each(6 * size, [&](int i) {
        const int face = i / size, line = i % size;
        float* out = &rgb_out[static_cast<std::size_t>(face) * size * stride];
        const std::optional<SideFace>& side = sides[face];
        const bool holds_middle = 2 * line + 1 == size;  // in one of its texels
        if (polar[face] && !holds_middle) {
            const auto edge = [&](int k) { return 2.0 * k / size - 1; };
            for (int x = 0; x < size; ++x)
                polar[face]->mean(edge(x), edge(x + 1), edge(line), edge(line + 1),
                                  out + line * stride + x * 3);
            return;
        }
        if (!side) return resample_area(source, size, face, line, {out + line * stride, stride});
        const std::vector<double> means = MeridianLine(source, *side, size, row_cosines).means(line);
        for (int j = 0; j < size; ++j) {
            const int along = side->b_sign > 0 ? j : size - 1 - j;
            const int x = side->across_is_s ? line : along, y = side->across_is_s ? along : line;
            for (std::size_t c = 0; c < 3; ++c)
                out[y * stride + x * 3 + c] = static_cast<float>(means[j * 3 + c]);
        }
    });
}

}  // namespace pbr

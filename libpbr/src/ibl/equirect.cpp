#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "pbr/ibl/cubemap.hpp"
#include "pbr/ibl/environment.hpp"
#include "pbr/numerics/elementary.hpp"
#include "pbr/numerics/quadrature.hpp"

namespace pbr {
namespace {

constexpr double kPi = std::numbers::pi;

/// Cosines of the colatitudes between rows, and the row of a cosine without inverse trigonometry at run time.
class RowTable {
  public:
    explicit RowTable(int height) : cosines_(height + 1) {
        for (int r = 0; r <= height; ++r) cosines_[r] = sin_cos_pi(static_cast<double>(r) / height).cos;
    }
    double cosine(int row) const { return cosines_[row]; }

    /// The row whose span of cosines holds z.
    int row(double z) const {
        const int rows = static_cast<int>(cosines_.size()) - 1;
        int guess = std::clamp(static_cast<int>(approximate_acos(z) * (rows / kPi)), 0, rows - 1);
        while (guess > 0 && z > cosines_[guess]) --guess;
        while (guess < rows - 1 && z < cosines_[guess + 1]) ++guess;
        return guess;
    }

  private:
    /// Abramowitz & Stegun 4.4.45, error below 7e-5: a first guess, corrected by the table.
    static double approximate_acos(double z) {
        const double a = std::min(1.0, std::abs(z));
        const double angle =
            std::sqrt(1 - a) * (1.5707288 + a * (-0.2121144 + a * (0.0742610 - a * 0.0187293)));
        return z < 0 ? kPi - angle : angle;
    }
    std::vector<double> cosines_;
};

/// The part of a meridian inside a texel, as an interval of cosines of colatitude; empty if low >= high.
struct MeridianSpan {
    double low, high;
};

/// A cube texel as a spherical quadrilateral in the frame of the picture.
class TexelQuad {
  public:
    TexelQuad(const EquirectView& source, int size, int face, int x, int y) {
        const double s0 = 2.0 * x / size - 1, s1 = 2.0 * (x + 1) / size - 1;
        const double t0 = 2.0 * y / size - 1, t1 = 2.0 * (y + 1) / size - 1;
        const glm::dvec3 centre = source.world_to_source * cube_vector(face, (s0 + s1) / 2, (t0 + t1) / 2);
        const std::array corners{source.world_to_source * cube_vector(face, s0, t0),
                                 source.world_to_source * cube_vector(face, s1, t0),
                                 source.world_to_source * cube_vector(face, s1, t1),
                                 source.world_to_source * cube_vector(face, s0, t1)};
        bool holds_north = true, holds_south = true;
        for (int k = 0; k < 4; ++k) {
            glm::dvec3 normal = glm::cross(corners[k], corners[(k + 1) % 4]);
            if (glm::dot(normal, centre) < 0) normal = -normal;
            normals_[k] = normal;
            holds_north &= normal.y > 1e-12;
            holds_south &= normal.y < -1e-12;
        }
        find_longitudes(centre, corners, holds_north || holds_south);
    }

    /// Longitudes at which the quad's outline has a corner, ascending; the first and last bound it.
    std::span<const double> longitudes() const {
        return {longitudes_.data(), static_cast<std::size_t>(count_)};
    }

    /// On a meridian, colatitude theta is inside where n . (sin theta m + cos theta y) >= 0 for the four
    /// edges, so each edge bounds cot(theta) from one side.
    MeridianSpan span(double sine, double cosine) const {
        double low = -1e300, high = 1e300;
        for (const glm::dvec3& n : normals_) {
            const double along = n.x * sine + n.z * cosine;
            if (n.y > 1e-14)
                low = std::max(low, -along / n.y);
            else if (n.y < -1e-14)
                high = std::min(high, -along / n.y);
            else if (along < 0)
                return {0, 0};
        }
        if (low >= high) return {0, 0};
        const auto cosine_of_cot = [](double c) {
            return c < -1e150 ? -1.0 : c > 1e150 ? 1.0 : c / std::sqrt(1 + c * c);
        };
        return {cosine_of_cot(low), cosine_of_cot(high)};
    }

  private:
    void find_longitudes(const glm::dvec3& centre, const std::array<glm::dvec3, 4>& corners,
                         bool holds_pole) {
        const double middle = atan2_exact(centre.x, centre.z);
        for (const glm::dvec3& corner : corners) {
            if (corner.x * corner.x + corner.z * corner.z < 1e-20)
                continue;  // at a pole: no longitude of its own
            double longitude = atan2_exact(corner.x, corner.z);
            if (longitude < middle - kPi) longitude += 2 * kPi;
            if (longitude > middle + kPi) longitude -= 2 * kPi;
            int place = count_++;
            for (; place > 0 && longitudes_[place - 1] > longitude; --place)
                longitudes_[place] = longitudes_[place - 1];
            longitudes_[place] = longitude;
        }
        if (holds_pole) {
            longitudes_[count_] = longitudes_[0] + 2 * kPi;
            ++count_;
        }
    }

    std::array<glm::dvec3, 4> normals_;
    std::array<double, 5> longitudes_{};
    int count_ = 0;
};

/// Adds the integral over one piece of longitude, within one column of the picture.
class AreaIntegral {
  public:
    AreaIntegral(const EquirectView& source, const RowTable& rows) : source_(source), rows_(rows) {}

    void add(const TexelQuad& quad, double from, double to) {
        if (to - from < 1e-15) return;
        // The piece's middle tells the column; u = 1/2 - longitude / 2 pi.
        const double u = 0.5 - (from + to) / (4 * kPi);
        column_ = std::clamp(static_cast<int>((u - std::floor(u)) * source_.width), 0, source_.width - 1);
        constexpr int kHalvings = 7;
        add_halved(quad, from, to, kHalvings);
    }

    void mean(float* rgb) const {
        for (int c = 0; c < 3; ++c) rgb[c] = static_cast<float>(sum_[c] / solid_angle_);
    }

  private:
    /// Rows in which a span begins and ends.
    struct Ends {
        int first, last;
        bool operator==(const Ends&) const = default;
    };
    Ends ends(const MeridianSpan& span) const { return {rows_.row(span.high), rows_.row(span.low)}; }

    /// Where an edge of the texel crosses from row to row the integrand has a kink: pieces are halved until
    /// they have none, or what it can still do is small.
    void add_halved(const TexelQuad& quad, double from, double to, int halvings) {
        static const QuadratureRule rule = gauss_legendre(3);
        std::array<MeridianSpan, 3> spans;
        const auto span_at = [&](double share) {
            const SinCos longitude = sin_cos_pi((from + (to - from) * share) / kPi);
            return quad.span(longitude.sin, longitude.cos);
        };
        for (std::size_t i = 0; i < 3; ++i) spans[i] = span_at(rule.nodes[i]);
        if (halvings > 0) {
            constexpr double kInside = 1e-3;  // at a corner itself the span is empty
            const Ends first = ends(span_at(kInside)), last = ends(span_at(1 - kInside));
            if (first != last || ends(spans[1]) != first) {
                const double middle = (from + to) / 2;
                add_halved(quad, from, middle, halvings - 1);
                add_halved(quad, middle, to, halvings - 1);
                return;
            }
        }
        for (std::size_t i = 0; i < 3; ++i)
            if (spans[i].low < spans[i].high) add_span(spans[i], rule.weights[i] * (to - from));
    }

    void add_span(const MeridianSpan& span, double weight) {
        const int last = rows_.row(span.low);
        for (int row = rows_.row(span.high); row <= last; ++row) {
            const double top = std::min(span.high, rows_.cosine(row));
            const double bottom = std::max(span.low, rows_.cosine(row + 1));
            const double area = weight * std::max(0.0, top - bottom);
            const float* texel = source_.texel(column_, row);
            for (int c = 0; c < 3; ++c) sum_[c] += area * static_cast<double>(texel[c]);
            solid_angle_ += area;
        }
    }

    const EquirectView& source_;
    const RowTable& rows_;
    int column_ = 0;
    double sum_[3] = {0, 0, 0};
    double solid_angle_ = 0;
};

}  // namespace

glm::dvec3 equirect_direction(double u, double v) {
    const SinCos longitude = sin_cos_pi(1 - 2 * u), colatitude = sin_cos_pi(v);
    return {longitude.sin * colatitude.sin, colatitude.cos, longitude.cos * colatitude.sin};
}

glm::dvec2 equirect_point(const glm::dvec3& d) {
    const double u = 0.5 - atan2_exact(d.x, d.z) / (2 * kPi);
    return {u >= 1 ? u - 1 : u, atan2_exact(std::sqrt(d.x * d.x + d.z * d.z), d.y) / kPi};
}

double equirect_texel_solid_angle(int width, int height, int y) {
    return 4 * kPi / width * sin_cos_pi((y + 0.5) / height).sin * sin_cos_pi(0.5 / height).sin;
}

void resample_area(const EquirectView& source, int size, std::span<const CubeTexel> texels,
                   std::span<float> rgb_out) {
    const RowTable rows(source.height);
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const TexelQuad quad(source, size, texels[i].face, texels[i].x, texels[i].y);
        const std::span<const double> breaks = quad.longitudes();
        AreaIntegral integral(source, rows);
        for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
            // Cut at the picture's columns, which meet at longitudes pi - 2 pi j / width.
            const double column_width = 2 * kPi / source.width;
            const int first = static_cast<int>(std::floor((kPi - breaks[k + 1]) / column_width)) + 1;
            const int last = static_cast<int>(std::ceil((kPi - breaks[k]) / column_width)) - 1;
            double from = breaks[k];
            for (int j = last; j >= first; --j) {
                const double cut = std::clamp(kPi - j * column_width, from, breaks[k + 1]);
                integral.add(quad, from, cut);
                from = cut;
            }
            integral.add(quad, from, breaks[k + 1]);
        }
        integral.mean(&rgb_out[i * 3]);
    }
}

void resample_area(const EquirectView& source, int size, int face, int y, std::span<float> rgb_out) {
    std::vector<CubeTexel> texels;
    for (int x = 0; x < size; ++x) texels.push_back({face, x, y});
    resample_area(source, size, texels, rgb_out);
}

void resample_bilinear(const EquirectView& source, int size, int face, int y, std::span<float> rgb_out) {
    const auto fetch = [&](int i, int j) {
        if (j < 0 || j >= source.height) {  // over the pole, half a turn away
            j = j < 0 ? 0 : source.height - 1;
            i += source.width / 2;
        }
        i %= source.width;
        return source.texel(i < 0 ? i + source.width : i, j);
    };
    std::vector<glm::dvec3> directions;
    for (int x = 0; x < size; ++x)
        directions.push_back(source.world_to_source * cubemap_texel_direction({face, x, y}, size));
    std::vector<glm::dvec2> points(directions.size());
    equirect_points(directions, points);
    for (int x = 0; x < size; ++x) {
        const glm::dvec2& uv = points[static_cast<std::size_t>(x)];
        const double px = uv.x * source.width - 0.5, py = uv.y * source.height - 0.5;
        const int i = static_cast<int>(std::floor(px)), j = static_cast<int>(std::floor(py));
        const double fx = px - i, fy = py - j;
        const float *a = fetch(i, j), *b = fetch(i + 1, j), *c = fetch(i, j + 1), *d = fetch(i + 1, j + 1);
        for (int k = 0; k < 3; ++k) {
            const double top = a[k] + fx * (static_cast<double>(b[k]) - a[k]);
            const double bottom = c[k] + fx * (static_cast<double>(d[k]) - c[k]);
            rgb_out[static_cast<std::size_t>(x) * 3 + k] = static_cast<float>(top + fy * (bottom - top));
        }
    }
}

}  // namespace pbr

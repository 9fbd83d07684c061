#pragma once
// Edges of a cube map's texels, cut where they cross the columns and rows of an equirect.
//
// In azimuth A and cosine of colatitude c, solid angle is dA dc, and along an edge, which is part of a great
// circle, the integral of c dA is known in closed form: each piece of an edge bounds an exactly known area of
// one texel of the picture.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "src/simd/great_circle_kernel.hpp"

namespace pbr {

/// Columns and rows of an equirect of 64 columns or more: column x begins at azimuth 2 pi (x - phase) /
/// width, counted from the direction -z by way of +x, as in an EquirectView.
class Graticule {
  public:
    static constexpr int kFewestColumns = 64;  // arcs within a column are then as short as find_arcs asks for

    Graticule(int width, int height, double phase);

    int width() const { return width_; }
    int height() const { return static_cast<int>(cosines_.size()) - 1; }
    double phase() const { return phase_; }

    /// Cosine of the colatitude above a row, or below the last.
    double cosine(int row) const { return cosines_[static_cast<std::size_t>(row)]; }

    /// Cosine and sine of the azimuth where a column begins, column < 2 width.
    const glm::dvec2& meridian(int column) const {
        return meridians_[static_cast<std::size_t>(column < width_ ? column : column - width_)];
    }

  private:
    int width_;
    double phase_;
    std::vector<double> cosines_;
    std::vector<glm::dvec2> meridians_;
};

/// A direction, and the column and row of the picture that it lies in, give or take a rounding.
struct Corner {
    glm::dvec2 azimuth;  ///< its cosine and sine
    int column, row;
};

/// The great circle through two directions. A meridian bounds no area and is nothing.
std::optional<GreatCircle> circle_through(const glm::dvec3& p, const glm::dvec3& q);

/// A piece of an edge, within a texel of the picture.
struct EdgePiece {
    int column, row;  ///< column < 2 width: they are counted on beyond the last
    double width;     ///< in azimuth; negative if the edge goes west
    double area;      ///< between the piece and the texel's upper side, sr, with the same sign
};

/// The pieces [first, last) of an edge.
struct Edge {
    std::size_t first = 0, last = 0;
    int west = 0, east = 0, top = 0,
        bottom = 0;    ///< columns and rows they lie in; columns as theirs, west < width
    double width = 0;  ///< their sum
};

/// Edges, line by line.
class EdgePieces {
  public:
    explicit EdgePieces(const Graticule& graticule) : graticule_(&graticule) {}

    void clear() { pieces_.clear(), edges_.clear(); }

    /// Adds the edges from corner to corner along a circle, less than half a turn of it; without pieces if it
    /// is a meridian.
    void add_line(const std::optional<GreatCircle>& circle, std::span<const Corner> corners);

    const Edge& edge(std::size_t index) const { return edges_[index]; }
    std::span<const EdgePiece> pieces(const Edge& edge) const {
        return std::span(pieces_).subspan(edge.first, edge.last - edge.first);
    }

  private:
    struct Point {
        double cos, sin, s, m, cosine;  ///< as in CirclePoints
    };
    /// On the way along an edge, eastward.
    struct Walk {
        const GreatCircle& circle;
        double sign;  ///< of what is added
        int turn;     ///< what columns count too many
        int row;      ///< that it is in
        Edge edge;
    };
    void place_points(std::span<const Corner> corners, bool eastward);
    Point point(std::size_t index) const;
    Point crossing(const GreatCircle& circle, int row, double side) const;
    void add_arc(std::size_t index, Walk& walk);
    void add_steep_arc(std::size_t index, bool over_top, Walk& walk);
    void add_piece(int column, double width, double below, Walk& walk);

    const Graticule* graticule_;
    std::vector<EdgePiece> pieces_;
    std::vector<Edge> edges_;
    CirclePoints points_;       ///< of the line that is being added: its corners, and where it changes column
    std::vector<int> columns_;  ///< of the arcs from them
    std::vector<std::size_t> corners_;  ///< indices of points that are corners
};

}  // namespace pbr

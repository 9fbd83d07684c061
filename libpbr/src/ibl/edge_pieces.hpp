#pragma once
// Edges of a cube map's texels, cut where they cross the columns and rows of an equirect.
//
// In azimuth A and cosine of colatitude c, solid angle is dA dc. An edge is part of a great circle of normal
// n, n.y > 0, along which c = t / m with t = rho cos(A - A0), m^2 = n.y^2 + t^2, rho^2 + n.y^2 = 1: the
// integral of c dA is asin(rho sin(A - A0)). So each piece of an edge bounds an exactly known area of one
// texel of the picture.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace pbr {

/// Columns and rows of an equirect: column x begins at azimuth 2 pi (x - phase) / width, counted from the
/// direction -z by way of +x, as in an EquirectView.
class Graticule {
  public:
    Graticule(int width, int height, double phase);

    int width() const { return width_; }
    int height() const { return static_cast<int>(cosines_.size()) - 1; }
    double phase() const { return phase_; }

    /// Of the colatitude above a row, or below the last.
    double cosine(int row) const { return cosines_[static_cast<std::size_t>(row)]; }
    double cotangent(int row) const { return cotangents_[static_cast<std::size_t>(row)]; }

    /// Cosine and sine of the azimuth where a column begins, column < 2 width.
    const glm::dvec2& meridian(int column) const {
        return meridians_[static_cast<std::size_t>(column < width_ ? column : column - width_)];
    }

  private:
    int width_;
    double phase_;
    std::vector<double> cosines_, cotangents_;
    std::vector<glm::dvec2> meridians_;
};

/// A direction, and the column and row of the picture that it lies in.
struct Corner {
    glm::dvec2 azimuth;  ///< its cosine and sine
    int column, row;
};

/// A great circle: rho cos A0, rho sin A0 and n.y. A meridian's n.y is 0; it bounds no area.
struct GreatCircle {
    double u = 0, v = 0, n = 0;

    /// Through two directions.
    static GreatCircle through(const glm::dvec3& p, const glm::dvec3& q);
};

/// A piece of an edge, within a texel of the picture.
struct EdgePiece {
    int column, row;  ///< column < 2 width: they are counted on beyond the last
    double width;     ///< in azimuth; negative if the edge goes west
    double area;      ///< between the piece and the texel's upper side, sr, with the same sign
};

/// The pieces [first, last) of an edge.
struct Edge {
    std::size_t first, last;
    int west, east, top, bottom;  ///< columns and rows that they lie in; columns as theirs, west < width
    double width;                 ///< their sum
};

/// Edges one after the other.
class EdgePieces {
  public:
    explicit EdgePieces(const Graticule& graticule) : graticule_(&graticule) {}

    void clear() { pieces_.clear(), edges_.clear(); }

    /// Adds the edge from p to q along a circle; it has no pieces if that is a meridian. The picture is at
    /// least 8 texels wide.
    void add(const GreatCircle& circle, const Corner& p, const Corner& q);

    const Edge& edge(int index) const { return edges_[static_cast<std::size_t>(index)]; }
    const EdgePiece* piece(std::size_t index) const { return &pieces_[index]; }

  private:
    struct Point;
    struct Walk;
    static Point point(const GreatCircle& circle, const glm::dvec2& azimuth);
    Point crossing(const GreatCircle& circle, int row, double side) const;
    void walk_to(const Point& to, Walk& walk);
    void add_piece(const Point& to, Walk& walk);

    const Graticule* graticule_;
    std::vector<EdgePiece> pieces_;
    std::vector<Edge> edges_;
};

}  // namespace pbr

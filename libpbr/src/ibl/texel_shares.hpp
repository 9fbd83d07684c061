#pragma once
// Which texels of an equirect lie in a texel of a cube map, and with how much of their solid angle.

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "src/ibl/edge_pieces.hpp"

namespace pbr {

/// Texels of a plane square grid seen from the origin: texel (i, j) begins in the direction
/// centre + (2 i + offset_s) / size s + (2 j + offset_t) / size t, in the picture's frame.
struct TexelGrid {
    glm::dvec3 centre, s, t;
    int size;
    int offset_s, offset_t;
    int columns, rows;  ///< how many texels

    glm::dvec3 corner(int i, int j) const {
        return centre + (2.0 * i + offset_s) / size * s + (2.0 * j + offset_t) / size * t;
    }
};

/// Texels of the picture side by side, 0 <= column < its width; beyond the last column follows the first.
struct TexelRun {
    int column, row, count;
};

/// What the texels of a row of the grid are made of.
struct RowShares {
    struct Texel {
        std::size_t runs_end;  ///< its runs begin where those of the texel before it end
        double solid_angle;    ///< the sum of its shares, sr
    };
    std::vector<Texel> texels;
    std::vector<TexelRun> runs;
    std::vector<double> shares;  ///< solid angles of the runs' texels, sr
};

/// The same of the mirror image, in which column x of the picture is `reflected` - x, up to a turn of `width`
/// columns.
RowShares mirrored(const RowShares& row, int reflected, int width);

/// Shares of rows of a grid: exact but for rounding. Those below 1e-10 of a texel are left out.
class GridShares {
  public:
    /// Of rows [first, last). The graticule is referred to.
    GridShares(const Graticule& graticule, const TexelGrid& grid, int first, int last);

    /// Overwritten by the next call.
    const RowShares& of_row(int j);

  private:
    /// An edge of a texel, with the sign that its pieces have in the outline.
    struct Side {
        const EdgePieces* edges;
        const Edge* edge;
        double sign;
    };
    using Outline = std::array<Side, 4>;
    /// The part of the picture that an outline lies in.
    struct Box {
        int west, top, columns, rows;
    };

    /// What an outline's pieces within a texel of the picture sum to.
    struct Cell {
        double area = 0, width = 0;
    };

    std::vector<Corner> corners(const TexelGrid& grid, int j) const;
    Outline outline(int i, int j) const;
    Box box_about(const Outline& outline, double turn) const;
    void add_texel(const Outline& outline);
    void add_side(const Side& side, const Box& box);
    void add_shares(const Box& box, double turn);
    void add_run(std::span<const Cell> cells, double least, int west, int row);

    const Graticule& graticule_;
    double column_width_;
    int columns_, first_, rows_;
    double orientation_;
    EdgePieces along_, upright_;  ///< edges of constant j, line by line, and of constant i
    std::vector<Cell> cells_;     ///< of the box, by rows
    std::vector<double> covered_;
    RowShares shares_;
};

}  // namespace pbr

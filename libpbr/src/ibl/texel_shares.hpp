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

/// Texels of the picture side by side: 0 <= column < its width, and on from the first one beyond the last.
struct TexelRun {
    int column, row, count;
};

/// What a texel of the grid is made of.
struct TexelShares {
    std::vector<TexelRun> runs;
    /// Solid angles, sr, by runs: each three times over for the channels of its texel, and zeros up to a
    /// multiple of four texels.
    std::vector<double> solid_angles;
    double sum = 0;  ///< of the solid angles
};

/// Goes over the rows of a grid, which are traced but once. Shares are exact but for rounding; those below
/// 1e-10 of a texel are left out.
class GridShares {
  public:
    /// Begins with row `first`. Both are referred to. The picture is at least 8 texels wide.
    GridShares(const Graticule& graticule, const TexelGrid& grid, int first);

    /// Of the row's texel i; overwritten by the next call.
    const TexelShares& of_texel(int i);

    void next_row();

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

    std::vector<Corner> corners(int j) const;
    void trace_line(int j, EdgePieces& line, std::vector<Corner>& at);
    void trace_row();
    Box box_about(const Outline& outline, double turn) const;
    void add_side(const Side& side, const Box& box);
    void find_shares(const Box& box, double turn);
    void add_run(const Box& box, int row, std::span<const double> shares);

    const Graticule& graticule_;
    const TexelGrid& grid_;
    int j_;
    double orientation_;
    std::vector<GreatCircle> upright_;            ///< circles of constant i
    std::vector<Corner> corners_, corners_next_;  ///< at j and j + 1
    EdgePieces line_, line_next_, across_;        ///< edges at j, at j + 1 and between them
    std::vector<double> areas_, widths_, covered_;
    TexelShares shares_;
};

}  // namespace pbr

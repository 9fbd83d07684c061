#pragma once
// Which size a texture needs.

#include "bakers/ies/decoded.hpp"

namespace pbrbake::ies {

/// Relative errors that a texture may have.
struct Tolerance {
    double flux, peak;
};

/// What an accuracy stands for; quantising takes its own share besides.
Tolerance tolerance_of(const Accuracy& accuracy);

/// A picture in candela, how it lies, and what it should decode to.
struct Rendered {
    Layout layout;
    Image image;
    Decoded decoded, truth;
    bool is_within = true;  ///< the tolerance, where the size was chosen by it

    double flux_error() const;  ///< relative; 0 for darkness
    double peak_error() const;
};

/// The first candidate, from small to large, within the tolerance, else the one nearest to it.
/// Candidates of a latlong or axial texture keep the file's own grid points where their common step allows
/// it: then bilinear lookup is the web itself.
Rendered render_at_best_size(const IesParams& params, const Profile& profile, Context& context);

}  // namespace pbrbake::ies

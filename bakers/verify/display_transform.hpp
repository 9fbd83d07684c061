#pragma once
// How a camera's picture comes onto a page.

#include "bakers/verify/flip.hpp"
#include "bakers/verify/picture.hpp"

namespace pbrbake::verify {

/// ACES 1's output transform by OpenColorIO; where its module is not installed sRGB's curve, clipped.
class DisplayTransform {
  public:
    DisplayTransform();
    /// What it is, for a page's text.
    const char* name() const;
    /// `exposed` is linear Rec. 709, 1 what saturates the sensor.
    Picture operator()(const LinearPicture& exposed) const;

  private:
    bool has_aces_;
};

}  // namespace pbrbake::verify

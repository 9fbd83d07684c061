#pragma once
// From a set's files to the maps of its largest level, some rows at a time.

#include "bakers/texture/calibrate.hpp"
#include "bakers/texture/detect.hpp"
#include "bakers/texture/maps.hpp"
#include "bakers/texture/metal.hpp"

namespace pbrbake::texture {

/// What must be known of whole maps before a texel is converted.
struct Survey {
    Calibration calibration;
    bool green_down = false;
    double green_correlation = 0;  ///< > 0: y up; in [-1, 1]
    Doubts doubts;
};

Survey survey(const Sources& sources, Context& context);

/// Rows of the largest level, calibrated, with their metal mask.
struct Rows {
    MapLevel level;
    std::vector<float> confidence;
    /// What each texel of the set returns of an even sky (source_albedo); empty where no map asks for it.
    Planes albedo;
};

/// Converts rows; holds the room for it, so keep one for many calls. A thread needs its own.
class Converter {
  public:
    Converter(const Sources& sources, const Survey& survey, int most_rows);
    /// Rows [begin, end), most_rows of them at most; the findings of each before `own_end`, as sums, go to
    /// findings[y]. What lies beyond is another strip's, which may be at it on another thread.
    const Rows& convert(int begin, int own_end, int end, std::vector<Findings>& findings);

  private:
    int place(int y) const;
    void read(int y, int slot, bool is_own, Findings* findings);
    void calibrate();
    void read_own(int y);
    Findings find() const;

    const Sources& sources_;
    const Survey& survey_;
    MetalEstimator estimate_;
    MetalRows metal_;
    Rows rows_;
    LegacyRow line_;
    std::vector<float> metallic_, confidence_;  ///< of line_
};

}  // namespace pbrbake::texture

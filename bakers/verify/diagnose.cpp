#include "bakers/verify/diagnose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <numeric>

#include "bakers/verify/baked_image.hpp"
#include "bakers/verify/face.hpp"
#include "bakers/verify/metrics.hpp"
#include "bakers/verify/page.hpp"
#include "bakers/verify/picture.hpp"
#include "bakers/verify/turn.hpp"
#include "pbr/ibl/cubemap.hpp"

namespace pbrbake::verify {
namespace {

/// Side that faces are shrunk to before they are turned: smaller is faster, and mirrors show at any size.
constexpr int kTurnSide = 16;
constexpr int kShiftSide = 128;  // of the window in a face's middle that shifts are looked for in
/// What may be left of a difference for its cause to be named.
constexpr double kRemainder = 0.3, kRemainderResampled = 0.5;

/// A cause, and how much of the difference it leaves.
struct Suspect {
    std::string text;
    double remainder = 1;
};

constexpr std::array<const char*, 8> kWays{"as it was",
                                           "mirrored in u (columns flipped)",
                                           "flipped in v (rows upside down)",
                                           "turned by 180°",
                                           "u and v swapped",
                                           "turned by 90°",
                                           "turned by 270°",
                                           "u and v swapped and turned by 180°"};

/// The faces of a level of both pictures, those that differ most first.
class FacePairs {
  public:
    FacePairs(const Image& a, const Image& b, int level, const std::vector<double>& typical,
              int side = kWhole, int margin = 0)
        : typical_(typical), margin_(margin) {
        for (int face = 0; face < b.faces; ++face) {
            Pair pair{window_of(face_of(a, level, face), side), window_of(face_of(b, level, face), side), 0};
            pair.there = distance(pair.a, pair.b, typical_, margin_);
            pairs_.push_back(std::move(pair));
        }
        std::ranges::stable_sort(pairs_, std::greater<>(), &Pair::there);
    }

    /// Sum over faces of the distance that `made` (of a face of b) leaves, over the one there is. 1 as soon
    /// as more than `most` is left: what doesn't explain the faces that differ most is no cause.
    template <class Made>
    double remainder(double most, const Made& made) const {
        if (std::min(pairs_.front().a.width, pairs_.front().a.height) <= 2 * margin_) return 1;
        double left = 0, there = 0;
        for (const Pair& pair : pairs_) {
            there += pair.there;
            left += distance(pair.a, made(pair.b), typical_, margin_, most * there - left);
            if (left > most * there) return 1;
        }
        return there > 0 ? left / there : 1;
    }

  private:
    struct Pair {
        Face a, b;
        double there;
    };
    static constexpr int kWhole = 1 << 20;

    std::vector<Pair> pairs_;
    const std::vector<double>& typical_;
    int margin_;
};

class Diagnosis {
  public:
    Diagnosis(const Image& a, const ProductFile& product) : a_(a), b_(product.image), product_(product) {
        for (std::size_t c = 0; c < b_.channels.size(); ++c) typical_.push_back(typical_of(c));
        double most = 0;
        for (int level = 0; level < static_cast<int>(b_.levels.size()); ++level) {
            differs_.push_back(distance_at(level));
            if (differs_.back() > most) {
                most = differs_.back();
                level_ = level;
            }
        }
    }

    std::string text() {
        if (differs_[static_cast<std::size_t>(level_)] == 0) return "";
        consider(factor());
        consider(gamma());
        consider(b_.is_cube() ? moved_faces() : turned_picture());
        consider(shift());
        consider(turn());
        consider(b_.is_cube() ? probe_roughness() : table_roughness());
        return best_.text;
    }

  private:
    void consider(const Suspect& suspect) {
        if (!suspect.text.empty() && suspect.remainder < best_.remainder) best_ = suspect;
    }

    double typical_of(std::size_t channel) const {
        std::vector<float> magnitudes;
        for (std::size_t i = channel; i < b_.levels.front().texels.size(); i += b_.channels.size())
            if (std::isfinite(b_.levels.front().texels[i]))
                magnitudes.push_back(std::abs(b_.levels.front().texels[i]));
        return quantile(magnitudes, 0.5);
    }

    double distance_at(int level) const {
        double sum = 0;
        for (int face = 0; face < b_.faces; ++face)
            sum += distance(face_of(a_, level, face), face_of(b_, level, face), typical_);
        return sum / b_.faces;
    }

    FacePairs faces() const { return FacePairs(a_, b_, level_, typical_); }

    /// a / b over what isn't dark in b, as the median and those near it have it; 1 where there is nothing.
    double ratio(int level, std::size_t channel) const {
        const auto &a = a_.levels[static_cast<std::size_t>(level)].texels,
                   &b = b_.levels[static_cast<std::size_t>(level)].texels;
        std::vector<float> ratios;
        for (std::size_t i = channel; i < b.size(); i += b_.channels.size())
            if (std::isfinite(a[i]) && std::abs(b[i]) > 0.01 * typical_[channel])
                ratios.push_back(a[i] / b[i]);
        if (ratios.empty()) return 1;
        const double median = quantile(ratios, 0.5);
        double sum = 0;
        int count = 0;
        for (const float value : ratios)  // their mean is free of the steps that rounding makes
            if (std::abs(value - median) <= 0.01 * std::abs(median)) {
                sum += value;
                ++count;
            }
        return count > 0 ? sum / count : median;
    }

    Suspect factor() const;
    Suspect gamma() const;
    Suspect moved_faces() const;
    Suspect turned_picture() const;
    Suspect shift() const;
    Suspect turn() const;
    Suspect table_roughness() const;
    Suspect probe_roughness() const;

    const Image &a_, &b_;
    const ProductFile& product_;
    std::vector<double> typical_;  ///< of each channel
    std::vector<double> differs_;  ///< of each level
    int level_ = 0;                ///< that differs most
    Suspect best_;
};

/// "0.318 times the reference: 1/pi too many", "0.990 times the reference (1.00 % less)".
std::string factor_text(double factor) {
    constexpr double kPi = std::numbers::pi, kNear = 2e-3;
    const std::array<std::pair<double, const char*>, 8> named{{{kPi, "pi; a 1/pi is missing"},
                                                               {1 / kPi, "1/pi; a 1/pi too many"},
                                                               {2 * kPi, "2 pi"},
                                                               {4 * kPi, "4 pi"},
                                                               {1 / (2 * kPi), "1/(2 pi)"},
                                                               {1 / (4 * kPi), "1/(4 pi)"},
                                                               {683, "683 lm/W"},
                                                               {1 / 683.0, "1/(683 lm/W)"}}};
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), std::abs(factor - 1) < 0.1 ? "%.4f" : "%.3g", factor);
    std::string text = std::string("values are ") + digits.data() + " times the reference's";
    for (const auto& [value, name] : named)
        if (std::abs(factor / value - 1) < kNear) return text + " (" + name + ")";
    if (std::abs(factor - 1) < 0.5)
        text += " (" + percent(std::abs(factor - 1)) + (factor < 1 ? " less)" : " more)");
    return text;
}

Suspect Diagnosis::factor() const {
    const std::size_t channels = b_.channels.size();
    std::vector<double> factors;
    for (std::size_t c = 0; c < channels; ++c) factors.push_back(ratio(level_, c));
    const double left = faces().remainder(kRemainder, [&](Face face) {
        for (std::size_t i = 0; i < face.texels.size(); ++i)
            face.texels[i] = static_cast<float>(face.texels[i] * factors[i % channels]);
        return face;
    });
    if (left == 1) return {};
    const auto is_one = [](double f) { return std::abs(f - 1) < 1e-4; };
    std::string which;
    std::size_t shown = 0;
    const bool all_equal =
        std::ranges::all_of(factors, [&](double f) { return std::abs(f / factors.front() - 1) < 1e-3; });
    if (!all_equal) {
        while (shown + 1 < channels && is_one(factors[shown])) ++shown;
        which = "channel " + b_.channels[shown] + ": ";
    }
    std::string levels;
    std::size_t differing = 0;
    for (std::size_t level = 0; level < differs_.size(); ++level)
        if (std::abs(ratio(static_cast<int>(level), shown) / factors[shown] - 1) < 2e-3) {
            levels += (differing++ ? ", " : "") + std::to_string(level);
        }
    if (differing < differs_.size())
        which = (differing == 1 ? "level " : "levels ") + levels + (which.empty() ? ": " : ", " + which);
    return {which + factor_text(factors[shown]), left};
}

Suspect Diagnosis::gamma() const {
    Suspect best;
    const FacePairs pairs = faces();
    for (const auto& [power, text] :
         {std::pair{1 / 2.2, "values are display-encoded (a gamma of 2.2)"},
          std::pair{2.2, "values were decoded twice (a gamma of 2.2)"}, std::pair{2.0, "values are squared"},
          std::pair{0.5, "values are square roots"}}) {
        const double left = pairs.remainder(kRemainder, [&, power = power](Face face) {
            for (float& value : face.texels)
                value = static_cast<float>(
                    std::copysign(std::pow(std::abs(value) / product_.scale, power) * product_.scale, value));
            return face;
        });
        if (left < best.remainder) best = {text, left};
    }
    return best;
}

Suspect Diagnosis::turned_picture() const {
    Suspect best;
    const FacePairs pairs = faces();
    const bool is_square = b_.levels[static_cast<std::size_t>(level_)].width ==
                           b_.levels[static_cast<std::size_t>(level_)].height;
    for (int way = 1; way < (is_square ? 8 : 4); ++way) {
        const double left =
            pairs.remainder(kRemainder, [way](const Face& face) { return turned(face, way); });
        if (left < best.remainder)
            best = {std::string("the picture is ") + kWays[static_cast<std::size_t>(way)], left};
    }
    return best;
}

/// Which face of the reference a face holds, turned in which way.
struct FacePlace {
    int source = 0, way = 0;
    bool is_own(int face) const { return source == face && way == 0; }
};

std::string face_name(int face) { return kFaceNames[static_cast<std::size_t>(face)]; }
std::string way_text(int way) { return kWays[static_cast<std::size_t>(way)]; }

/// "every face is …", "faces +X, -Z are …", "face -Y is …"
std::string faces_are(const std::vector<int>& faces, const std::string& what) {
    if (faces.size() == 6) return "every face is " + what;
    std::string text = faces.size() == 1 ? "face" : "faces";
    for (std::size_t i = 0; i < faces.size(); ++i) text.append(i ? ", " : " ").append(face_name(faces[i]));
    return text.append(faces.size() == 1 ? " is " : " are ").append(what);
}

/// Where the faces went, in words; "" if all are in place.
std::string moved_text(const std::array<FacePlace, 6>& places) {
    std::vector<int> moved, elsewhere;
    for (int face = 0; face < 6; ++face) {
        const FacePlace& place = places[static_cast<std::size_t>(face)];
        if (!place.is_own(face)) moved.push_back(face);
        if (place.source != face) elsewhere.push_back(face);
    }
    if (moved.empty()) return "";
    const auto place = [&](int face) { return places[static_cast<std::size_t>(face)]; };
    const int way = place(moved.front()).way;
    const bool one_way = std::ranges::all_of(moved, [&](int face) { return place(face).way == way; });
    const bool swapped = elsewhere.size() == 2 && place(elsewhere[0]).source == elsewhere[1] &&
                         place(elsewhere[1]).source == elsewhere[0];
    const std::string swap =
        swapped ? "faces " + face_name(elsewhere[0]) + " and " + face_name(elsewhere[1]) + " are swapped"
                : "";
    if (one_way && (swapped || elsewhere.empty())) {
        if (way == 0) return swap;
        return faces_are(moved, way_text(way)).append(swapped ? ", and " : "").append(swap);
    }
    std::string text = "faces are moved: ";
    for (const int face : moved) {
        if (face != moved.front()) text += ", ";
        text.append(face_name(face)).append(" holds ").append(face_name(place(face).source));
        if (place(face).way != 0) text.append(" ").append(way_text(place(face).way));
    }
    return text;
}

Suspect Diagnosis::moved_faces() const {
    std::array<std::array<Face, 8>, 6> of_b;  // in each way
    for (int face = 0; face < 6; ++face)
        for (int way = 0; way < 8; ++way)
            of_b[static_cast<std::size_t>(face)][static_cast<std::size_t>(way)] =
                turned(shrunk(face_of(b_, level_, face), kTurnSide), way);
    std::array<FacePlace, 6> places;
    double left = 0, there = 0;
    for (int face = 0; face < 6; ++face) {
        const Face a = shrunk(face_of(a_, level_, face), kTurnSide);
        const double own = distance(a, of_b[static_cast<std::size_t>(face)][0], typical_);
        FacePlace& best = places[static_cast<std::size_t>(face)];
        best = {face, 0};
        double least = kRemainder * own;  // another place must explain it, not just suit it better by chance
        for (int source = 0; source < 6; ++source)
            for (int way = 0; way < 8; ++way) {
                const double d =
                    distance(a, of_b[static_cast<std::size_t>(source)][static_cast<std::size_t>(way)],
                             typical_, 0, least);
                if (d >= least) continue;
                least = d;
                best = {source, way};
            }
        there += own;
        left += best.is_own(face) ? own : least;
    }
    if (there == 0 || left > kRemainder * there) return {};
    return {moved_text(places), left / there};
}

Suspect Diagnosis::shift() const {
    Suspect best;
    const FacePairs windows(a_, b_, level_, typical_, kShiftSide, 1);
    for (int dy = -2; dy <= 2; ++dy)
        for (int dx = -2; dx <= 2; ++dx) {
            if (dx == 0 && dy == 0) continue;
            const double left = windows.remainder(kRemainderResampled, [&](const Face& face) {
                Face moved = face;
                for (int y = 0; y < face.height; ++y)
                    for (int x = 0; x < face.width; ++x)
                        for (int c = 0; c < face.channels; ++c)
                            moved.at(x, y, c) = face.between(x + 0.5 * dx, y + 0.5 * dy, c);
                return moved;
            });
            if (left >= best.remainder) continue;
            const auto along = [](int halves, const char* axis) {
                if (halves == 0) return std::string();
                return std::string(halves < 0 ? "+" : "-") + (std::abs(halves) == 1 ? "1/2" : "1") + " in " +
                       axis;
            };
            const std::string u = along(dx, "u"), v = along(dy, "v");
            best = {"texels are shifted by " + u + (u.empty() || v.empty() ? "" : " and ") + v +
                        (std::max(std::abs(dx), std::abs(dy)) == 1 ? " (half a texel)" : ""),
                    left};
        }
    const FacePairs pairs = faces();
    for (const bool to_centres : {true, false}) {
        const double left = pairs.remainder(kRemainderResampled, [&](const Face& face) {
            Face aligned = face;
            const auto from = [&](int i, int n) {
                return to_centres ? (i + 0.5) / n * (n - 1)
                                  : static_cast<double>(i) / std::max(1, n - 1) * n - 0.5;
            };
            for (int y = 0; y < face.height; ++y)
                for (int x = 0; x < face.width; ++x)
                    for (int c = 0; c < face.channels; ++c)
                        aligned.at(x, y, c) = face.between(from(x, face.width), from(y, face.height), c);
            return aligned;
        });
        if (left < best.remainder)
            best = {to_centres ? "texels are aligned to centres where the reference's are to ends (off by "
                                 "half a texel at the ends)"
                               : "texels are aligned to ends where the reference's are to centres (off by "
                                 "half a texel at the ends)",
                    left};
    }
    return best;
}

/// What turns a face, or all by a quarter, has a name already.
Suspect Diagnosis::turn() const {
    constexpr double kLeast_deg = 0.1, kWellExplained = 0.1;
    if (!b_.is_cube() || b_.channels.size() != 3 || best_.remainder < kWellExplained) return {};
    const Turn turn = vertical_turn(a_, b_, level_, typical_);
    if (turn.remainder > kRemainderResampled || std::abs(turn.degrees) < kLeast_deg) return {};
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(),
                  "the environment is turned by %.1f° about its vertical axis (as rotate_deg does)",
                  turn.degrees);
    return {text.data(), turn.remainder};
}

constexpr std::array<std::pair<bool, const char*>, 2> kRoughnessMistakes{
    {{true, "roughness is squared once too often"},
     {false, "roughness is not squared where the reference's is"}}};

Suspect Diagnosis::table_roughness() const {
    Suspect best;
    const Json layout = product_.record.is_object() ? product_.record.value("layout", Json()) : Json();
    const bool flipped = layout.is_object() && layout.value("flip_rows", false);
    const bool centred = layout.is_object() && layout.value("align", "ends") == "center";
    const FacePairs pairs = faces();
    for (const auto& [squared, text] : kRoughnessMistakes) {
        const double left = pairs.remainder(kRemainderResampled, [&, is_squared = squared](const Face& face) {
            Face remapped = face;
            const double n = face.height;
            for (int row = 0; row < face.height; ++row) {
                const int y = flipped ? face.height - 1 - row : row;
                const double p = centred ? (row + 0.5) / n : row / std::max(1.0, n - 1);
                const double at = is_squared ? p * p : std::sqrt(p);
                const double source = centred ? at * n - 0.5 : at * (n - 1);
                for (int x = 0; x < face.width; ++x)
                    for (int c = 0; c < face.channels; ++c)
                        remapped.at(x, y, c) = face.between(x, flipped ? n - 1 - source : source, c);
            }
            return remapped;
        });
        if (left < best.remainder) best = {text, left};
    }
    return best;
}

Suspect Diagnosis::probe_roughness() const {
    constexpr int kLargestSide = 64;  // of levels looked at
    const int levels = static_cast<int>(b_.levels.size());
    if (levels < 3 || b_.channels.size() != 3) return {};
    const std::vector<double> of_levels = perceptual_roughness_of_levels(product_.record, b_.levels.size());
    const ProbeLookup lookup(b_, 1, of_levels);
    double there = 0;
    std::array<double, 2> left{};
    for (int level = 1; level + 1 < levels; ++level) {  // the mirror and alpha = 1 are their own squares
        const int n = b_.levels[static_cast<std::size_t>(level)].width;
        if (n > kLargestSide) continue;
        const double p = of_levels[static_cast<std::size_t>(level)];
        for (int face = 0; face < 6; ++face) {
            const Face a = face_of(a_, level, face);
            there += distance(a, face_of(b_, level, face), typical_);
            for (std::size_t i = 0; i < kRoughnessMistakes.size(); ++i) {
                Face made{n, n, 3, std::vector<float>(a.texels.size())};
                for (int y = 0; y < n; ++y)
                    for (int x = 0; x < n; ++x) {
                        const glm::dvec3 value = lookup(pbr::cubemap_texel_direction({face, x, y}, n),
                                                        kRoughnessMistakes[i].first ? p * p : std::sqrt(p));
                        for (int c = 0; c < 3; ++c) made.at(x, y, c) = static_cast<float>(value[c]);
                    }
                left[i] += distance(a, made, typical_);
            }
        }
    }
    const std::size_t best = left[0] <= left[1] ? 0 : 1;
    if (there == 0 || left[best] > kRemainderResampled * there) return {};
    return {kRoughnessMistakes[best].second, left[best] / there};
}

}  // namespace

std::string diagnose(const Image& a, const ProductFile& b) { return Diagnosis(a, b).text(); }

}  // namespace pbrbake::verify

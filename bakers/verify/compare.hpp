#pragma once
// Regression checks: products against reference products.

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/baker.hpp"
#include "bakers/verify/metrics.hpp"
#include "bakers/verify/pairing.hpp"
#include "bakers/verify/shaded_flip.hpp"
#include "bakers/verify/thresholds.hpp"

namespace pbrbake::verify {

/// Better ones first. The last three are failures.
enum class Verdict {
    identical,   ///< the same bytes
    within_ulp,  ///< no value off by more than max_ulp
    within,      ///< off by more, and within every other threshold
    differs,
    missing,     ///< on one side
    unreadable,  ///< on either side
};
inline constexpr std::array<std::string_view, 6> kVerdictNames{"identical", "within_ulp", "within",
                                                               "differs",   "missing",    "unreadable"};

/// Errors of one channel at one place: a face of a level, or (face -1) the whole level.
struct PlaceErrors {
    int level = 0, face = 0, channel = 0;
    ErrorFigures figures;
};

struct ProductComparison {
    Pair pair;
    Verdict verdict = Verdict::identical;
    std::vector<std::string> reasons;  ///< why it fails, the gravest first: geometry, NaN, values
    std::vector<std::string> notes;    ///< what differs and is let pass
    std::string looks_like;            ///< the mistake that a difference looks like, or ""
    std::vector<std::string> channels;
    std::vector<PlaceErrors> faces;   ///< of every face and channel; empty for a document or if identical
    std::vector<PlaceErrors> levels;  ///< the same, joined over faces
    ErrorFigures worst;               ///< the largest of each figure
    std::optional<ShadedFlip> flip;   ///< of cube maps with values beyond max_ulp

    bool passed() const { return verdict <= Verdict::within; }
};

struct Comparison {
    std::vector<ProductComparison> products;  ///< sorted by name
    Thresholds thresholds;
    /// done, unreadable_input if any product is, else comparison_failed: also if there was nothing to
    /// compare.
    ExitCode code = ExitCode::done;
};

/// Compares A, products that are to be judged, with B, the reference, one product a thread. Throws what
/// pairs_of throws; a product that can't be read is a verdict.
Comparison compare(const std::filesystem::path& a, const std::filesystem::path& b,
                   const Thresholds& thresholds, int threads = 1);

/// One line on a product: verdict, name, and what it stands on.
std::string verdict_line(const ProductComparison& product);
/// One line on all of them.
std::string summary_line(const Comparison& comparison);

/// schemas/comparison.schema.json describes it.
Json comparison_json(const Comparison& comparison);

}  // namespace pbrbake::verify

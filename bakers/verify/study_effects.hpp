#pragma once
// What each effect costs, on and off: in a renderer's inner loop, and in a bake. An effect that is off costs
// nothing; here that is measured and counted.

#include <map>
#include <string>
#include <vector>

#include "bakers/verify/study.hpp"

namespace pbrbake::verify {

/// One effect, on.
struct EffectCost {
    std::string name;  ///< "clear coat"
    Timing timing;     ///< CPU seconds of one evaluation or bake; ratio to the group's without the effect
    std::map<std::string, std::uint64_t>
        evaluations;             ///< counted, of one evaluation or bake, by what is evaluated
    std::uint64_t bytes = 0;     ///< of a product, else of the object in memory
    bool rest_unchanged = true;  ///< the rest of the product keeps its values to the bit
};

/// Effects on one thing. rows[0] is that thing without any: what the others' ratios are to.
struct EffectGroup {
    std::string title;  ///< "A material: f(wo, wi) in float"
    std::string unit;   ///< what one is: "evaluation", "bake"
    std::vector<EffectCost> rows;
};

/// Measures every effect there is: of materials, lights, probe look-ups, and tables. Throws Error, Cancelled.
std::vector<EffectGroup> study_effects(const StudyOptions& options);

Json effects_json(const std::vector<EffectGroup>& groups);
std::string effects_table(const std::vector<EffectGroup>& groups);
/// A section of the study's page.
std::string effects_html(const std::vector<EffectGroup>& groups);

}  // namespace pbrbake::verify

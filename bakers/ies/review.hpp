#pragma once
// Doubts about a file that parses: numbers that can't be right, or look like a known mistake.

#include <cstddef>
#include <vector>

#include "bakers/parse/photometry.hpp"

namespace pbrbake::ies {

/// Adds what the numbers give away: more light out than in, a factor that was applied twice, radiometric
/// units, a spectrum beyond the visible, darkness, planes that disagree at the pole, a stated ratio that the
/// light contradicts.
void review(const parse::PhotometricFile& file, std::size_t lamp_set, const pbr::PhotometricWeb& web,
            std::vector<parse::Diagnostic>& diagnostics);

}  // namespace pbrbake::ies

#pragma once
// Any bytes as a photometric file: a web with a finite flux that converts with it, or an error.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "bakers/parse/grid.hpp"

namespace pbrbake::test {

inline void expect(bool holds) {
    if (!holds) std::abort();
}

inline void check_conversions(const parse::PhotometricFile& file) {
    const std::string ies = parse::write_lm63(file);
    parse::parse_lm63({reinterpret_cast<const std::byte*>(ies.data()), ies.size()}, "fuzz.ies");
    try {
        std::vector<std::string> lost;
        parse::write_eulumdat(file, lost);
    } catch (const Error& error) {
        expect(error.code() == ExitCode::unwritable_output);
    }
}

/// `read(bytes)` is the format's parser.
template <class Read>
int fuzz_photometry(const std::uint8_t* data, std::size_t size, const Read& read) {
    try {
        const parse::PhotometricFile file = read({reinterpret_cast<const std::byte*>(data), size});
        std::vector<parse::Diagnostic> diagnostics;
        const pbr::PhotometricWeb web = parse::make_web(file, 0, diagnostics);
        expect(web.flux_lm() >= 0 && web.evaluate_cd({.3, -.2, -.5}) >= 0);
        pbr::beam_angle_deg(web, pbr::AxialPlane::c0, .5);
        parse::luminous_opening(file);
        check_conversions(file);
    } catch (const Error& error) {
        expect(error.code() == ExitCode::unreadable_input && !error.message().empty());
    }
    return 0;
}

}  // namespace pbrbake::test

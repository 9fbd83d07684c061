#pragma once
// What the split sum loses, in pictures and figures: `pbrbake study --shading`.

#include <filesystem>
#include <string>

#include "bakers/baker.hpp"
#include "bakers/run/run.hpp"

namespace pbrbake::verify {

struct ShadingStudy {
    std::string environment;  ///< a built-in's name: "indoor", "outdoor"
    int size = 48;            ///< pixels across a sphere
    int threads = 1;
};

/// A built-in environment by means over 8 x 8 texels: small enough for exact integrals a pixel. Throws
/// Error(unreadable_input) naming those there are.
Image study_environment(const std::string& name);
/// Its file's name beside the job: "indoor.exr".
std::string study_environment_file(const ShadingStudy& study);

/// The job: a table and a probe of that file, as a user would write it.
Json shading_job(const ShadingStudy& study);

/// The page (HTML) of a run of that job, which must be done: each material and roughness by the exact
/// integral, by the split sum, and with Frostbite's dominant direction; their errors as pictures, and by NoV
/// as figures. `figures` gets the same as a document.
std::string shading_page(const ShadingStudy& study, const Image& environment, const run::RunReport& report,
                         Json& figures);

}  // namespace pbrbake::verify

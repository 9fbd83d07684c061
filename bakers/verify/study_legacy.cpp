#include "bakers/verify/study_legacy.hpp"

#include <array>

#include "bakers/run/atomic_file.hpp"
#include "bakers/verify/legacy_sets.hpp"

namespace pbrbake::verify {
namespace fs = std::filesystem;
namespace {

// --- texture sets
// ----------------------------------------------------------------------------------------------

Series pixel_series() {
    return {"storage",
            "bits",
            {{"8", {{"pixel", "unorm8"}, {"format", "ktx2"}}, ""},
             {"8, dithered", {{"pixel", "unorm8"}, {"format", "ktx2"}, {"dither", true}}, ""},
             {"16, half", {{"pixel", "half"}, {"format", "exr"}}, ""},
             {"16", {{"pixel", "unorm16"}, {"format", "ktx2"}}, ""},
             {"32, float", {{"pixel", "float"}, {"format", "exr"}}, ""}}};
}

/// What the solver can leave out, and do besides.
Series solver_series() {
    return {"solver",
            "options",
            {{"unregularised", {{"regularise", false}}, ""},
             {"default", Json::object(), ""},
             {"glTF, residual", {{"packing", "gltf"}}, "a dielectric f0 of any colour"},
             {"all levels", {{"levels", 0}}, "moments of slope, LEAN"}}};
}

Series fit_series() {
    Series series{"fit of the lobe", "fit", {}};
    for (const char* fit : {"slope", "l2", "cumulative", "half_width"})
        series.steps.push_back({fit, {{"fit", fit}}, ""});
    return series;
}

/// Shaders of the pictures scatter once, and have f0 and metallic apart.
StudyCase set_case(const LegacySet& set, Depth depth, const fs::path& folder) {
    StudyCase asked;
    asked.name = std::string("texture_") + set.name;
    asked.title = std::string("Legacy textures: ") + set.title;
    asked.about = set.about;
    asked.bake = write_legacy_maps(set, depth == Depth::quick ? 128 : 256, folder);
    asked.bake["multiscatter"] = false;
    asked.bake["calibrate"] = "none";
    asked.bake["packing"] = "separate";
    asked.bake["pixel"] = "half";
    asked.series = texture_series(asked.bake);
    asked.base_step = 2;
    return asked;
}

/// Smaller maps, as a shader magnifies them.
StudyCase resolution_case(Depth depth, const fs::path& folder) {
    const LegacySet& set = legacy_sets().front();
    const int full = depth == Depth::quick ? 256 : 512;
    StudyCase asked;
    asked.name = "texture_resolution";
    asked.title = "Legacy textures: resolution of the maps";
    asked.about = "Base colour read bilinearly, against that of maps of " + std::to_string(full) + " x " +
                  std::to_string(full) + " texels.";
    std::vector<std::pair<int, Json>> maps;
    for (int size = full / 16; size <= full; size *= 2)
        maps.emplace_back(size, write_legacy_maps(set, size, folder));
    asked.bake = maps.back().second;
    asked.bake["calibrate"] = "none";
    asked.reference = Json{{"pixel", "float"}};
    for (const auto& [name, pixel] : {std::pair{"8 bits", "unorm8"}, {"half", "half"}}) {
        Series series{name, "size", {}};
        for (const auto& [size, names] : maps) {
            Json overrides = names;
            overrides["pixel"] = pixel;
            overrides["format"] = "ktx2";
            series.steps.push_back({std::to_string(size), std::move(overrides), ""});
        }
        asked.series.push_back(std::move(series));
    }
    asked.base_step = 2;
    return asked;
}

// --- lights
// ----------------------------------------------------------------------------------------------------

struct Falloff {
    const char *name, *title, *about, *json;
};
constexpr std::array<Falloff, 4> kFalloffs{
    {{"ramp", "1 − d / 300", "Light that ends at 300, as Quake and early three.js had it.",
      R"({"kind": "linear", "range": 300})"},
     {"inverse", "1 / (1 + d / 10)", "Light that fades too slowly for any lamp.",
      R"({"kind": "polynomial", "constant": 1, "linear": 0.1, "quadratic": 0})"},
     {"polynomial", "1 / (1 + .7 d + 1.8 d²)", "OpenGL's three attenuations.",
      R"({"kind": "polynomial", "constant": 1, "linear": 0.7, "quadratic": 1.8})"},
     {"constant", "1, cut at 10", "A fill light that doesn't fade, and ends.",
      R"({"kind": "constant", "range": 10, "window": "cut"})"}}};

StudyCase light_case(const Falloff& falloff, const fs::path& folder) {
    const fs::path file = folder / (std::string(falloff.name) + ".json");
    run::write_atomically(
        file,
        std::string(R"({"unit": "relative", "length_m": 1, "lights": [{"name": "lamp", "type": "point", )") +
            R"("intensity": 2, "colour": [1, 0.8, 0.5], "falloff": )" + falloff.json + "}]}");
    StudyCase asked;
    asked.name = std::string("light_") + falloff.name;
    asked.title = std::string("Legacy light: ") + falloff.title;
    asked.about = std::string(falloff.about) + " Error in stops, RMS over the distances that matter.";
    asked.bake = {{"kind", "light"},
                  {"source", fs::absolute(file).string()},
                  {"format", "json"},
                  {"documents", {"json"}}};
    asked.metric = "stops_rms";
    Series shapes{"shape", "shape", {}}, accuracy{"chosen shape", "accuracy", {}};
    for (const char* shape : {"point", "rectangle", "disk"})
        shapes.steps.push_back({shape, {{"shape", shape}}, ""});
    for (const char* name : {"draft", "production", "reference"})
        accuracy.steps.push_back({name, {{"accuracy", name}}, ""});
    asked.series = {std::move(shapes), std::move(accuracy)};
    asked.base_step = 2;
    return asked;
}

}  // namespace

std::vector<Series> texture_series(const Json& bake) {
    std::vector<Series> series{pixel_series(), solver_series()};
    const std::string model = bake.value("model", std::string());
    if (model == "blinn_phong" || model == "phong") series.push_back(fit_series());
    return series;
}

std::vector<StudyCase> legacy_cases(Depth depth, const fs::path& folder) {
    std::vector<StudyCase> cases;
    for (const LegacySet& set : legacy_sets()) cases.push_back(set_case(set, depth, folder));
    cases.push_back(resolution_case(depth, folder));
    for (const Falloff& falloff : kFalloffs) cases.push_back(light_case(falloff, folder));
    return cases;
}

}  // namespace pbrbake::verify

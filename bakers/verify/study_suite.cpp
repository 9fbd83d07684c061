// What is studied: the dials of each kind, and the built-in suite.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "bakers/job/job.hpp"
#include "bakers/job/schema.hpp"
#include "bakers/run/atomic_file.hpp"
#include "bakers/verify/study.hpp"
#include "bakers/verify/study_legacy.hpp"

namespace pbrbake::verify {
namespace fs = std::filesystem;
namespace {

/// Integrators whose dial is the accuracy; any other that a schema lists takes samples, and `reference` is
/// the truth.
constexpr std::array<std::string_view, 3> kByAccuracy{"auto", "harmonic", "quadrature"};
constexpr std::string_view kReference = "reference";
constexpr const char* kFrostbite = "as in Frostbite's notes";

/// Settings of a study's depth.
struct Dials {
    std::vector<int> samples;
    std::vector<double> errors;
    std::vector<int> sizes;
};

Dials dials(Depth depth, std::vector<double> errors) {
    if (depth == Depth::quick) return {{8, 32, 128, 512, 2048}, std::move(errors), {16, 32, 64, 128}};
    return {{4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096}, std::move(errors), {16, 32, 64, 128, 256}};
}

std::string short_number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.0e", value);
    std::string number = text.data();  // "1e-03"
    const std::size_t zero = number.find("-0");
    if (zero != std::string::npos) number.erase(zero + 1, 1);
    return number;
}

/// Its integrators as the schema lists them; none if the kind has no such property.
std::vector<std::string> integrators(const std::string& kind) {
    const Json& properties = job::job_schema().root()["definitions"][kind]["properties"];
    std::vector<std::string> names;
    if (properties.contains("integrator"))
        for (const Json& name : properties["integrator"]["enum"]) names.push_back(name.get<std::string>());
    return names;
}

bool has_property(const std::string& kind, const char* name) {
    return job::job_schema().root()["definitions"][kind]["properties"].contains(name);
}

/// One series an integrator.
std::vector<Series> integrator_series(const std::string& kind, const Dials& dials) {
    std::vector<Series> list;
    for (const std::string& integrator : integrators(kind)) {
        if (integrator == kReference) continue;
        const bool by_accuracy = std::ranges::find(kByAccuracy, integrator) != kByAccuracy.end();
        Series series{integrator, by_accuracy ? "accuracy" : "samples", {}};
        if (by_accuracy)
            for (const double error : dials.errors)
                series.steps.push_back(
                    {short_number(error),
                     {{"integrator", integrator}, {"samples", nullptr}, {"accuracy", {{"max_error", error}}}},
                     ""});
        else
            for (const int samples : dials.samples)
                series.steps.push_back({std::to_string(samples),
                                        {{"integrator", integrator}, {"samples", samples}},
                                        integrator == "fis" && samples == 32 ? kFrostbite : ""});
        list.push_back(std::move(series));
    }
    return list;
}

/// Sizes of something whose other settings are `overrides`.
Series size_series(std::string name, const std::vector<int>& sizes, const Json& overrides) {
    Series series{std::move(name), "size", {}};
    for (const int size : sizes) {
        Json all = overrides;
        all["size"] = size;
        series.steps.push_back({std::to_string(size), std::move(all), ""});
    }
    return series;
}

/// Makes the setting of this series and label what ratios are to.
void set_base(StudyCase& asked, const std::string& series, const std::string& label) {
    for (std::size_t s = 0; s < asked.series.size(); ++s)
        for (std::size_t k = 0; k < asked.series[s].steps.size(); ++k)
            if (asked.series[s].name == series && asked.series[s].steps[k].label == label) {
                asked.base_series = s;
                asked.base_step = k;
            }
}

// --- the suite: probes
// ----------------------------------------------------------------------------------------

struct Scene {
    const char *name, *title, *about;
};
constexpr std::array<Scene, 5> kScenes{{
    {"indoor", "Probe of a room", "A window and two lamps: soft light, contrast 1,000."},
    {"outdoor", "Probe under the sun", "A sun of 1.5e9 cd/m² in a few texels before a clear sky."},
    {"contrast", "Probe of a night", "Forty lamps of 1e6 cd/m² of one texel each, before 0.01 cd/m²."},
    {"noise", "Probe of noise", "Every texel independent of its neighbours: all bands at once."},
    {"constant", "Probe of a constant", "The same radiance everywhere: any error is the method's own fault."},
}};

StudyCase probe_case(const Scene& scene, Depth depth) {
    StudyCase asked;
    asked.name = std::string("probe_") + scene.name;
    asked.title = scene.title;
    asked.about = scene.about;
    asked.bake = {{"kind", "probe"},
                  {"source", std::string("builtin:") + scene.name},
                  {"size", depth == Depth::quick ? 64 : 128},
                  {"pixel", "float"}};
    asked.reference = Json{{"integrator", kReference}};
    const std::vector<double> quick{1e-1, 1e-2, 1e-3, 1e-4};
    const std::vector<double> full{3e-1, 1e-1, 3e-2, 1e-2, 3e-3, 1e-3, 3e-4, 1e-4};
    asked.series = integrator_series("probe", dials(depth, depth == Depth::quick ? quick : full));
    if (depth == Depth::full) {
        Series wide{"fis, K = 4", "samples", {}};
        for (const int samples : dials(depth, {}).samples)
            wide.steps.push_back({std::to_string(samples),
                                  {{"integrator", "fis"}, {"samples", samples}, {"level_bias", 4}},
                                  ""});
        asked.series.push_back(std::move(wide));
    }
    Series half{"auto, half", "accuracy", {}};
    for (const double error :
         depth == Depth::quick ? std::vector<double>{1e-3} : std::vector<double>{1e-2, 1e-3, 1e-4})
        half.steps.push_back(
            {short_number(error), {{"pixel", "half"}, {"accuracy", {{"max_error", error}}}}, ""});
    asked.series.push_back(std::move(half));
    set_base(asked, "fis", "32");
    return asked;
}

// --- the suite: tables
// ----------------------------------------------------------------------------------------

StudyCase integral_case(Depth depth) {
    StudyCase asked;
    asked.name = "dfg_integral";
    asked.title = "Table of GGX albedo: the integral";
    asked.about = "Errors at the texels themselves, grazing views of smooth surfaces among them.";
    asked.bake = {{"kind", "dfg"}, {"size", depth == Depth::quick ? 32 : 64}, {"pixel", "float"}};
    asked.series = integrator_series("dfg", dials(depth, {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}));
    set_base(asked, "quadrature", "1e-6");
    return asked;
}

StudyCase table_case(Depth depth) {
    StudyCase asked;
    asked.name = "dfg_table";
    asked.title = "Table of GGX albedo: as a shader reads it";
    asked.about = "Bilinear lookups anywhere from perceptual roughness 0.05 up: layout, size and storage.";
    asked.bake = {{"kind", "dfg"}};
    asked.metric = "max_abs_error_sampled";
    asked.free_figure = "analytic_fit_error";
    asked.free_title = "no table: Karis's analytic fit";
    const std::vector<int> sizes = dials(depth, {}).sizes;
    const auto layout = [](const char* axis, const char* align, const char* pixel) {
        return Json{{"axis", axis}, {"align", align}, {"pixel", pixel}};
    };
    asked.series.push_back(size_series("√NoV, ends, float", sizes, layout("sqrt_nov", "ends", "float")));
    asked.series.push_back(size_series("√NoV, ends, half", sizes, layout("sqrt_nov", "ends", "half")));
    Json integers = layout("sqrt_nov", "ends", "unorm16");
    integers["format"] = "ktx2";
    asked.series.push_back(size_series("√NoV, ends, unorm16", sizes, integers));
    asked.series.push_back(size_series("√NoV, centers", sizes, layout("sqrt_nov", "center", "float")));
    asked.series.push_back(size_series("NoV, ends", sizes, layout("nov", "ends", "float")));
    asked.series.push_back(size_series("NoV, centers", sizes, layout("nov", "center", "float")));
    if (depth == Depth::full) {
        Json by_alpha = layout("sqrt_nov", "ends", "float");
        by_alpha["roughness_axis"] = "alpha";
        asked.series.push_back(size_series("√NoV, rows by alpha", sizes, by_alpha));
        Series engines{"engines' layouts", "target", {}};
        for (const Json& target :
             job::job_schema().root()["definitions"]["dfg"]["properties"]["target"]["enum"])
            if (target != "none")
                engines.steps.push_back({target.get<std::string>(), {{"target", target}}, ""});
        asked.series.push_back(std::move(engines));
    }
    set_base(asked, "√NoV, ends, half", "128");
    return asked;
}

// --- the suite: photometric profiles
// --------------------------------------------------------------------------

/// A luminaire whose intensity is cos^exponent of the polar angle, `wing` of it drawn to the sides.
struct Beam {
    const char *name, *title;
    double exponent, step_deg, wing;
};
constexpr std::array<Beam, 4> kBeams{{
    {"soft", "Profile of a soft lamp (cosine)", 1, 2.5, 0},
    {"batwing", "Profile of a batwing, which has no axis of symmetry", 2, 5, .9},
    {"spot", "Profile of a spot (22° across)", 36, 1, 0},
    {"narrow", "Profile of a narrow beam (5° across)", 728, .25, 0},
}};

/// LM-63-2002, type C, candela in whole numbers.
std::string lm63_of(const Beam& beam) {
    constexpr double kPeak_cd = 100'000, kDegree = std::numbers::pi / 180;
    const int verticals = static_cast<int>(std::lround(90 / beam.step_deg)) + 1;
    const std::vector<int> horizontals =
        beam.wing > 0 ? std::vector<int>{0, 15, 30, 45, 60, 75, 90} : std::vector<int>{0};
    std::string text = "IESNA:LM-63-2002\n[TEST] study\n[TESTLAB] none\n[MANUFAC] none\n[LUMCAT] " +
                       std::string(beam.name) + "\nTILT=NONE\n1 -1 1 " + std::to_string(verticals) + " " +
                       std::to_string(horizontals.size()) + " 1 2 0 0 0\n1 1 100\n";
    const auto line = [&](const auto& value_at, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i)
            text += value_at(i) + (i % 10 == 9 || i + 1 == count ? "\n" : " ");
    };
    line(
        [&](std::size_t i) {
            std::array<char, 32> angle{};
            std::snprintf(angle.data(), angle.size(), "%.2f", static_cast<double>(i) * beam.step_deg);
            return std::string(angle.data());
        },
        static_cast<std::size_t>(verticals));
    line([&](std::size_t i) { return std::to_string(horizontals[i]); }, horizontals.size());
    for (const int horizontal : horizontals)
        line(
            [&](std::size_t i) {
                const double polar = static_cast<double>(i) * beam.step_deg * kDegree;
                const double across = std::sin(horizontal * kDegree), sine = std::sin(polar);
                const double shape = (1 - beam.wing) + beam.wing * 4 * across * across * sine * sine;
                const double beam_cd =
                    kPeak_cd * std::pow(std::max(0.0, std::cos(polar)), beam.exponent) * shape;
                return std::to_string(
                    std::lround(i + 1 == static_cast<std::size_t>(verticals) ? 0 : beam_cd));
            },
            static_cast<std::size_t>(verticals));
    return text;
}

StudyCase profile_case(const Beam& beam, Depth depth, const fs::path& folder) {
    const fs::path file = folder / (std::string(beam.name) + ".ies");
    run::write_atomically(file, lm63_of(beam));
    StudyCase asked;
    asked.name = std::string("ies_") + beam.name;
    asked.title = beam.title;
    asked.about = "Flux of the decoded texture against the exact flux of the file.";
    asked.bake = {{"kind", "ies"},
                  {"source", fs::absolute(file).string()},
                  {"pixel", "float"},
                  {"documents", Json::array()}};
    asked.metric = "flux_error";
    std::vector<int> sizes{32, 64, 128, 256}, sides{16, 32, 64, 128};
    if (depth == Depth::full) {
        sizes = {16, 32, 64, 128, 256, 512, 1024};
        sides = {8, 16, 32, 64, 128, 256, 512};
    }
    for (const char* projection : {"latlong", "axial", "octahedral", "cube"}) {
        if (beam.wing > 0 && std::string_view(projection) == "axial") continue;
        const bool round =
            std::string_view(projection) == "latlong" || std::string_view(projection) == "axial";
        asked.series.push_back(size_series(projection, round ? sizes : sides, {{"projection", projection}}));
    }
    asked.series.push_back(
        size_series("latlong, half", sizes, {{"projection", "latlong"}, {"pixel", "half"}}));
    Series chosen{"chosen size", "accuracy", {}};
    for (const double error : {1e-2, 1e-3, 1e-4, 1e-5})
        chosen.steps.push_back({short_number(error), {{"accuracy", {{"max_error", error}}}}, ""});
    asked.series.push_back(std::move(chosen));
    set_base(asked, "latlong", "128");
    return asked;
}

// --- a job
// ----------------------------------------------------------------------------------------------------

/// Sizes at a quarter, half, and the whole of the bake's own, if that is one number.
std::vector<int> smaller_sizes(const Json& bake) {
    if (!bake.contains("size") || !bake["size"].is_number_integer()) return {};
    std::vector<int> sizes;
    for (int size = bake["size"].get<int>(), k = 0; k < 3 && size >= 2; ++k, size /= 2)
        sizes.insert(sizes.begin(), size);
    return sizes;
}

StudyCase case_of(const job::Job& job, const job::Bake& bake, Depth depth) {
    StudyCase asked;
    asked.name = bake.name;
    asked.title = bake.name + " (" + bake.kind + ")";
    asked.about = "A bake of " + job.file.filename().string() + ", and what its dials would change.";
    asked.around = {{"working_space", job.working_space},
                    {"limits", {{"max_side", job.max_side}, {"max_decoded_bytes", job.max_decoded_bytes}}}};
    asked.bake = bake.json;
    asked.bake.erase("name");
    if (!bake.pixel_stated) asked.bake["pixel"] = "auto";
    for (const job::Source& source : bake.sources)
        if (!source.file.empty()) asked.bake[source.read.field] = fs::absolute(source.file).string();
    asked.series.push_back({"as the job has it", "", {{"as stated", Json::object(), ""}}});
    const auto names = integrators(bake.kind);
    if (std::ranges::find(names, kReference) != names.end())
        asked.reference = Json{{"integrator", kReference}, {"samples", nullptr}, {"pixel", "float"}};
    for (Series& series : integrator_series(bake.kind, dials(depth, {1e-1, 1e-2, 1e-3, 1e-4})))
        asked.series.push_back(std::move(series));
    if (asked.reference) return asked;
    if (const auto sizes = smaller_sizes(bake.json); !sizes.empty())
        asked.series.push_back(size_series("size", sizes, Json::object()));
    if (bake.kind == "texture") {  // whose accuracy by name changes nothing
        if (depth == Depth::full)
            for (Series& series : texture_series(bake.json)) asked.series.push_back(std::move(series));
    } else if (names.empty() && has_property(bake.kind, "accuracy")) {
        Series accuracy{"accuracy", "accuracy", {}};
        for (const char* name : {"draft", "production", "reference"})
            accuracy.steps.push_back({name, {{"accuracy", name}}, ""});
        asked.series.push_back(std::move(accuracy));
    }
    return asked;
}

}  // namespace

std::vector<StudyCase> suite_cases(Depth depth, const fs::path& folder) {
    std::vector<StudyCase> cases;
    for (const Scene& scene : kScenes) cases.push_back(probe_case(scene, depth));
    cases.push_back(integral_case(depth));
    cases.push_back(table_case(depth));
    for (const Beam& beam : kBeams) cases.push_back(profile_case(beam, depth, folder));
    for (StudyCase& asked : legacy_cases(depth, folder)) cases.push_back(std::move(asked));
    return cases;
}

std::vector<StudyCase> job_cases(const fs::path& job_file, Depth depth) {
    const job::Job job = job::load(job_file);
    std::vector<StudyCase> cases;
    for (const job::Bake& bake : job.bakes)
        if (bake.parts.empty()) cases.push_back(case_of(job, bake, depth));  // not what joins others
    return cases;
}

}  // namespace pbrbake::verify

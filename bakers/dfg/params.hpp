#pragma once
// Parameters of a DFG table; schemas/job.schema.json, definitions/dfg, says what each means.

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/params.hpp"

namespace pbrbake {
namespace dfg {

enum class Target { none, filament, unity_hdrp, unreal, bevy, babylon, o3de };
enum class Term {
    ggx,
    disney_diffuse,
    multiscatter,
    charlie,
    clear_coat,
    uncorrelated,
    eon,
    chan,
    hammon,
    subsurface,
    ggx_anisotropic
};
enum class Disney { automatic, renormalised, original, original_minus_half };
enum class Cloth { automatic, charlie, neubelt };
enum class Axis { automatic, nov, sqrt_nov, cbrt_nov };
enum class RoughnessAxis { automatic, perceptual, sqrt_perceptual, alpha };
enum class Align { automatic, center, ends };
enum class Form { automatic, scale_bias, mix };
enum class Integrator { quadrature, is };

/// As the job has them; settled() in layout.hpp gives every `automatic`, size 0 and empty `terms` its value.
struct DfgParams {
    Target target;
    std::vector<int> size;  ///< n, or width (NoV), height (roughness) and a volume's depth; 0: for settled()
    std::vector<Term> terms;
    Disney disney;
    Cloth cloth;
    Axis axis;
    RoughnessAxis roughness_axis;
    Align align;
    Form form;
    bool flip_rows;
    double min_perceptual_roughness;
    Integrator integrator;
    int samples;
    std::uint64_t seed;

    template <class Visit>
    static void fields(Visit&& visit) {
        visit("target", &DfgParams::target);
        visit("size", &DfgParams::size);
        visit("terms", &DfgParams::terms);
        visit("disney", &DfgParams::disney);
        visit("cloth", &DfgParams::cloth);
        visit("axis", &DfgParams::axis);
        visit("roughness_axis", &DfgParams::roughness_axis);
        visit("align", &DfgParams::align);
        visit("form", &DfgParams::form);
        visit("flip_rows", &DfgParams::flip_rows);
        visit("min_perceptual_roughness", &DfgParams::min_perceptual_roughness);
        visit("integrator", &DfgParams::integrator);
        visit("samples", &DfgParams::samples);
        visit("seed", &DfgParams::seed);
    }

    int width() const { return size.front(); }
    int height() const { return size.size() > 1 ? size[1] : size.front(); }
    int depth() const { return size.size() > 2 ? size[2] : 1; }
};

}  // namespace dfg

template <>
struct EnumNames<dfg::Target> {
    static constexpr std::array<std::string_view, 7> names{"none", "filament", "unity-hdrp", "unreal",
                                                           "bevy", "babylon",  "o3de"};
};
template <>
struct EnumNames<dfg::Term> {
    static constexpr std::array<std::string_view, 11> names{
        "ggx", "disney_diffuse", "multiscatter", "charlie",    "clear_coat",     "uncorrelated",
        "eon", "chan",           "hammon",       "subsurface", "ggx_anisotropic"};
};
template <>
struct EnumNames<dfg::Disney> {
    static constexpr std::array<std::string_view, 4> names{"auto", "renormalised", "original",
                                                           "original_minus_half"};
};
template <>
struct EnumNames<dfg::Cloth> {
    static constexpr std::array<std::string_view, 3> names{"auto", "charlie", "neubelt"};
};
template <>
struct EnumNames<dfg::Axis> {
    static constexpr std::array<std::string_view, 4> names{"auto", "nov", "sqrt_nov", "cbrt_nov"};
};
template <>
struct EnumNames<dfg::RoughnessAxis> {
    static constexpr std::array<std::string_view, 4> names{"auto", "perceptual", "sqrt_perceptual", "alpha"};
};
template <>
struct EnumNames<dfg::Align> {
    static constexpr std::array<std::string_view, 3> names{"auto", "center", "ends"};
};
template <>
struct EnumNames<dfg::Form> {
    static constexpr std::array<std::string_view, 3> names{"auto", "scale_bias", "mix"};
};
template <>
struct EnumNames<dfg::Integrator> {
    static constexpr std::array<std::string_view, 2> names{"quadrature", "is"};
};

}  // namespace pbrbake

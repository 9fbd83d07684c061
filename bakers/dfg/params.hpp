#pragma once
// Parameters of a DFG table; schemas/job.schema.json, definitions/dfg, says what each means.

#include <array>
#include <cstdint>
#include <vector>

#include "bakers/params.hpp"

namespace pbrbake {
namespace dfg {

enum class Term { ggx, disney_diffuse };
enum class Disney { renormalised, original };
enum class Axis { nov, sqrt_nov };
enum class RoughnessAxis { perceptual, alpha };
enum class Align { center, ends };
enum class Form { scale_bias, mix };
enum class Integrator { quadrature, is };

struct DfgParams {
    std::vector<int> size;  ///< n, or width (NoV) and height (roughness)
    std::vector<Term> terms;
    Disney disney;
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
        visit("size", &DfgParams::size);
        visit("terms", &DfgParams::terms);
        visit("disney", &DfgParams::disney);
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
    int height() const { return size.back(); }
};

}  // namespace dfg

template <>
struct EnumNames<dfg::Term> {
    static constexpr std::array<std::string_view, 2> names{"ggx", "disney_diffuse"};
};
template <>
struct EnumNames<dfg::Disney> {
    static constexpr std::array<std::string_view, 2> names{"renormalised", "original"};
};
template <>
struct EnumNames<dfg::Axis> {
    static constexpr std::array<std::string_view, 2> names{"nov", "sqrt_nov"};
};
template <>
struct EnumNames<dfg::RoughnessAxis> {
    static constexpr std::array<std::string_view, 2> names{"perceptual", "alpha"};
};
template <>
struct EnumNames<dfg::Align> {
    static constexpr std::array<std::string_view, 2> names{"center", "ends"};
};
template <>
struct EnumNames<dfg::Form> {
    static constexpr std::array<std::string_view, 2> names{"scale_bias", "mix"};
};
template <>
struct EnumNames<dfg::Integrator> {
    static constexpr std::array<std::string_view, 2> names{"quadrature", "is"};
};

}  // namespace pbrbake

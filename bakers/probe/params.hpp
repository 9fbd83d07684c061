#pragma once
// Parameters of a prefiltered probe; schemas/job.schema.json, definitions/probe, says what each means.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bakers/params.hpp"

namespace pbrbake {
namespace probe {

enum class Integrator { automatic, is, mis, fis, harmonic, reference };
enum class SourceLayout { automatic, equirect, cube, strip, cross };
enum class Up { y, z };
enum class Units { automatic, relative, cd_per_m2 };

struct ProbeParams {
    std::string source;
    SourceLayout source_layout;
    std::string colour_space;
    Units units;
    double rotate_deg;
    Up up;
    bool mirror;
    int size;
    int levels;  ///< 0: as many as leave 8 texels a side, or as are listed here:
    std::vector<double> perceptual_roughness;  ///< of each level; empty: evenly from 0 to 1
    Integrator integrator;
    std::vector<int> samples;  ///< one for all levels, or one a level; a single 0: as the accuracy asks
    double level_bias;
    std::uint64_t seed;

    template <class Visit>
    static void fields(Visit&& visit) {
        visit("source", &ProbeParams::source);
        visit("source_layout", &ProbeParams::source_layout);
        visit("colour_space", &ProbeParams::colour_space);
        visit("units", &ProbeParams::units);
        visit("rotate_deg", &ProbeParams::rotate_deg);
        visit("up", &ProbeParams::up);
        visit("mirror", &ProbeParams::mirror);
        visit("size", &ProbeParams::size);
        visit("levels", &ProbeParams::levels);
        visit("perceptual_roughness", &ProbeParams::perceptual_roughness);
        visit("integrator", &ProbeParams::integrator);
        visit("samples", &ProbeParams::samples);
        visit("level_bias", &ProbeParams::level_bias);
        visit("seed", &ProbeParams::seed);
    }
};

}  // namespace probe

template <>
struct EnumNames<probe::Integrator> {
    static constexpr std::array<std::string_view, 6> names{"auto", "is",       "mis",
                                                           "fis",  "harmonic", "reference"};
};
template <>
struct EnumNames<probe::SourceLayout> {
    static constexpr std::array<std::string_view, 5> names{"auto", "equirect", "cube", "strip", "cross"};
};
template <>
struct EnumNames<probe::Up> {
    static constexpr std::array<std::string_view, 2> names{"y", "z"};
};
template <>
struct EnumNames<probe::Units> {
    static constexpr std::array<std::string_view, 3> names{"auto", "relative", "cd/m^2"};
};

}  // namespace pbrbake

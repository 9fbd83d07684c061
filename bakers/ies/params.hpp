#pragma once
// Parameters of a photometric profile; schemas/job.schema.json, definitions/ies, says what each means.

#include <array>
#include <string>
#include <vector>

#include "bakers/params.hpp"

namespace pbrbake {
namespace ies {

enum class Projection { latlong, axial, octahedral, cube, cookie };
enum class Align { automatic, ends, center };
enum class Normalise { max, mean, flux, candela };
enum class Aim { minus_z, minus_y };
enum class C0 { x, y };
enum class DocumentKind { light, gltf, polar, sphere, page };

struct IesParams {
    std::string source;
    Projection projection;
    std::vector<int> size;  ///< 0: chosen by error bound; n, or width and height
    int max_size;
    Align align;
    bool fold;
    Normalise normalise;
    bool flux_exact;
    double lumens;  ///< 0: as the file has it
    int lamp_set;   ///< from 1
    double tilt_deg;
    double rotate_deg;
    C0 c0;
    Aim aim;
    double squash;
    double cone_deg;  ///< 0: what holds all light, at most 160
    std::vector<DocumentKind> documents;

    template <class Visit>
    static void fields(Visit&& visit) {
        visit("source", &IesParams::source);
        visit("projection", &IesParams::projection);
        visit("size", &IesParams::size);
        visit("max_size", &IesParams::max_size);
        visit("align", &IesParams::align);
        visit("fold", &IesParams::fold);
        visit("normalise", &IesParams::normalise);
        visit("flux_exact", &IesParams::flux_exact);
        visit("lumens", &IesParams::lumens);
        visit("lamp_set", &IesParams::lamp_set);
        visit("tilt_deg", &IesParams::tilt_deg);
        visit("rotate_deg", &IesParams::rotate_deg);
        visit("c0", &IesParams::c0);
        visit("aim", &IesParams::aim);
        visit("squash", &IesParams::squash);
        visit("cone_deg", &IesParams::cone_deg);
        visit("documents", &IesParams::documents);
    }

    /// Whether the resolution is chosen by error bound.
    bool is_sized_by_error() const { return size.front() == 0; }
};

}  // namespace ies

template <>
struct EnumNames<ies::Projection> {
    static constexpr std::array<std::string_view, 5> names{"latlong", "axial", "octahedral", "cube",
                                                           "cookie"};
};
template <>
struct EnumNames<ies::Align> {
    static constexpr std::array<std::string_view, 3> names{"auto", "ends", "center"};
};
template <>
struct EnumNames<ies::Normalise> {
    static constexpr std::array<std::string_view, 4> names{"max", "mean", "flux", "candela"};
};
template <>
struct EnumNames<ies::Aim> {
    static constexpr std::array<std::string_view, 2> names{"-z", "-y"};
};
template <>
struct EnumNames<ies::C0> {
    static constexpr std::array<std::string_view, 2> names{"x", "y"};
};
template <>
struct EnumNames<ies::DocumentKind> {
    static constexpr std::array<std::string_view, 5> names{"light", "gltf", "polar", "sphere", "page"};
};

}  // namespace pbrbake

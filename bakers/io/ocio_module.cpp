// OpenColorIO's share of io, as a module that is loaded when two colour spaces differ.
//
// OpenColorIO 2.1 has no built-in configs and no linear Rec.2020 or P3, and its own sRGB display curve
// is 2.5e-4 off in the toe: gamuts it knows are chained from its built-in transforms, the others from
// matrices, and sRGB is the exponent-with-linear form of IEC 61966-2-1 (gamma 2.4, offset .055), which is
// within 1e-6 of it everywhere.

#include <OpenColorIO/OpenColorIO.h>

#include <algorithm>
#include <exception>

#include "bakers/io/matrix3.hpp"
#include "bakers/io/module_api.hpp"

namespace OCIO = OCIO_NAMESPACE;

namespace pbrbake::io {
namespace {

OCIO::TransformRcPtr builtin(const char* style, OCIO::TransformDirection direction) {
    const auto transform = OCIO::BuiltinTransform::Create();
    transform->setStyle(style);
    transform->setDirection(direction);
    return transform;
}

/// The gamut's RGB to CIE XYZ, adapted to D65.
OCIO::TransformRcPtr matrix_to_xyz_d65(const Chromaticities& c) {
    const Matrix3 m = bradford(c.white, kD65) * rgb_to_xyz(c);
    const double m44[16] = {m[0][0], m[0][1], m[0][2], 0, m[1][0], m[1][1], m[1][2], 0,
                            m[2][0], m[2][1], m[2][2], 0, 0,       0,       0,       1};
    const auto transform = OCIO::MatrixTransform::Create();
    transform->setMatrix(m44);
    return transform;
}

/// Appends the steps from linear RGB of `gamut` to ACES2065-1.
void append_to_ap0(OCIO::GroupTransform& steps, Gamut gamut, const Chromaticities& custom) {
    const auto via_xyz = [&](const Chromaticities& c) {
        steps.appendTransform(matrix_to_xyz_d65(c));
        steps.appendTransform(builtin("UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD", OCIO::TRANSFORM_DIR_INVERSE));
    };
    switch (gamut) {
        case Gamut::ap0:
            break;
        case Gamut::ap1:
            steps.appendTransform(builtin("ACEScg_to_ACES2065-1", OCIO::TRANSFORM_DIR_FORWARD));
            break;
        case Gamut::rec709:
            steps.appendTransform(
                builtin("UTILITY - ACES-AP1_to_LINEAR-REC709_BFD", OCIO::TRANSFORM_DIR_INVERSE));
            steps.appendTransform(builtin("ACEScg_to_ACES2065-1", OCIO::TRANSFORM_DIR_FORWARD));
            break;
        case Gamut::rec2020:
            via_xyz(kRec2020);
            break;
        case Gamut::p3_d65:
            via_xyz(kP3D65);
            break;
        case Gamut::adobe_rgb:
            via_xyz(kAdobeRgb);
            break;
        case Gamut::custom:
            via_xyz(custom);
            break;
    }
}

void append_curve(OCIO::GroupTransform& steps, const Encoding& from) {
    if (from.curve == Curve::srgb) {
        const auto curve = OCIO::ExponentWithLinearTransform::Create();
        curve->setGamma({2.4, 2.4, 2.4, 1});
        curve->setOffset({.055, .055, .055, 0});
        curve->setNegativeStyle(OCIO::NEGATIVE_MIRROR);
        steps.appendTransform(curve);
    } else if (from.curve == Curve::power) {
        const auto curve = OCIO::ExponentTransform::Create();
        curve->setValue({from.gamma, from.gamma, from.gamma, 1});
        curve->setNegativeStyle(OCIO::NEGATIVE_MIRROR);
        steps.appendTransform(curve);
    }
}

OCIO::GroupTransformRcPtr steps_between(const Encoding& from, Gamut working) {
    auto steps = OCIO::GroupTransform::Create();
    append_curve(*steps, from);
    if (from.gamut != working) {
        append_to_ap0(*steps, from.gamut, from.primaries);
        const auto back = OCIO::GroupTransform::Create();
        append_to_ap0(*back, working, {});
        back->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
        steps->appendTransform(back);
    }
    return steps;
}

/// Applies what `steps` returns to RGB triples.
template <class Steps>
bool apply(const Steps& steps, float* rgb, std::size_t texels, std::string& error) {
    try {
        const auto config = OCIO::Config::Create();
        config->setVersion(2, 1);
        const OCIO::ConstProcessorRcPtr processor = config->getProcessor(steps());
        // Lossless leaves out the fast, approximate pow.
        const OCIO::ConstCPUProcessorRcPtr cpu =
            processor->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS);
        constexpr std::size_t kRun = 4096;
        for (std::size_t begin = 0; begin < texels; begin += kRun) {
            const std::size_t count = std::min(kRun, texels - begin);
            OCIO::PackedImageDesc run(rgb + 3 * begin, static_cast<long>(count), 1, 3);
            cpu->apply(run);
        }
        return true;
    } catch (const std::exception& failure) {
        error = failure.what();
    }
    return false;
}

bool convert(const Encoding& from, Gamut working, float* rgb, std::size_t texels, std::string& error) {
    return apply([&] { return steps_between(from, working); }, rgb, texels, error);
}

bool display(Gamut working, float* rgb, std::size_t texels, std::string& error) {
    const auto steps = [&] {
        auto group = OCIO::GroupTransform::Create();
        append_to_ap0(*group, working, {});
        group->appendTransform(
            builtin("ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0", OCIO::TRANSFORM_DIR_FORWARD));
        group->appendTransform(builtin("DISPLAY - CIE-XYZ-D65_to_sRGB", OCIO::TRANSFORM_DIR_FORWARD));
        return group;
    };
    return apply(steps, rgb, texels, error);
}

}  // namespace
}  // namespace pbrbake::io

extern "C" __attribute__((visibility("default"))) const pbrbake::io::OcioModule* pbrbake_ocio_module() {
    static const pbrbake::io::OcioModule table{pbrbake::io::kModuleAbi, &pbrbake::io::convert,
                                               &pbrbake::io::display};
    return &table;
}

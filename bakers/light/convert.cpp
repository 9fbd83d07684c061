#include "bakers/light/convert.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "bakers/light/clean.hpp"
#include "bakers/parse/text.hpp"
#include "pbr/camera/exposure.hpp"
#include "pbr/light/colour.hpp"
#include "pbr/light/unit_conversions.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::light {
namespace {

using parse::LegacyLight;
using parse::LightType;
using parse::LightUnit;
using parse::Severity;

constexpr double kPi = std::numbers::pi;
/// A light counts as gone where it gives 1/256 of what its reference white gets: the last step of 8 bits.
constexpr double kLastStep = 1. / 256;
/// A colour or intensity below it is none.
constexpr double kDarkest = 1e-30;
constexpr double kFarthest_m = 1e12, kNearest_m = 1e-9;

double decoded(double value, parse::ColourEncoding encoding) {
    const double size = std::abs(value);
    double linear = size;
    if (encoding == parse::ColourEncoding::gamma_2_2) linear = pbr::power_exact(size, 2.2);
    if (encoding == parse::ColourEncoding::srgb)  // IEC 61966-2-1
        linear = size <= .04045 ? size / 12.92 : pbr::power_exact((size + .055) / 1.055, 2.4);
    return std::copysign(linear, value);
}

/// y up: z-up files turn by a quarter about x.
glm::dvec3 turned(const glm::dvec3& v, parse::UpAxis up) {
    return up == parse::UpAxis::z ? glm::dvec3(v.x, v.z, -v.y) : v;
}

/// Lengths of a law in metres; a power's floor and value scale with it.
pbr::Falloff in_metres(const pbr::Falloff& law, double unit_m, double& factor) {
    pbr::Falloff scaled = law;
    scaled.linear /= unit_m;
    scaled.quadratic /= unit_m * unit_m;
    scaled.begin *= unit_m;
    scaled.range *= unit_m;
    factor = law.power > 0 ? pbr::power_exact(unit_m, law.power) : 1;
    scaled.floor *= factor;
    return scaled;
}

/// Solid angle that a spot's law fills: 2 pi times its integral over the cosine, by midpoints.
double solid_angle_of(const pbr::SpotFalloff& law) {
    constexpr int kCount = 4096;
    const double lowest = pbr::sin_cos_pi(law.outer_rad / kPi).cos;
    double sum = 0;
    for (int i = 0; i < kCount; ++i)
        sum += pbr::spot_falloff_at(law, lowest + (1 - lowest) * ((i + .5) / kCount));
    return 2 * kPi * (1 - lowest) * sum / kCount;
}

class Conversion {
  public:
    Conversion(const LegacyLight& light, parse::UpAxis up, const Anchor& anchor, const LightParams& params,
               Fits fits)
        : light_(light), up_(up), anchor_(anchor), params_(params), fits_(fits) {}

    ConvertedLight run() {
        result_.name = light_.name;
        result_.line = light_.line;
        result_.type = light_.type;
        result_.flags = light_.diagnostics;
        result_.position_m = turned(light_.position, up_) * anchor_.unit_m;
        result_.width_m = std::abs(light_.width) * anchor_.unit_m;
        result_.height_m = std::abs(light_.height) * anchor_.unit_m;
        set_direction();
        const double luminance = set_colour();
        set_law(luminance);
        if (light_.type == LightType::directional || light_.type == LightType::ambient)
            set_far_light();
        else
            set_near_light();
        if (result_.is_negative) {
            result_.is_fill = true;
            add(Severity::warning, "negative",
                "takes light away, which no photometric light can; kept as a fill");
        }
        if (result_.is_dark && !result_.has("cone_zero") && !result_.has("range_zero"))
            add(Severity::note, "dark", "gives no light");
        flag_overflow();
        return std::move(result_);
    }

  private:
    void add(Severity severity, const char* code, std::string message) {
        flag(result_.flags, severity, code, light_.line, std::move(message));
    }

    void set_direction() {
        const glm::dvec3 along = turned(light_.direction, up_);
        const double length = glm::length(along);
        const bool aims = light_.type != LightType::point && light_.type != LightType::ambient &&
                          light_.type != LightType::sphere;
        if (length > 0 && std::isfinite(length)) {
            result_.direction = along / length;
        } else if (aims) {
            result_.direction = {0, -1, 0};
            add(Severity::warning, "no_direction", "has no direction; it is aimed downwards");
        }
    }

    /// Colour of luminance 1; returns the luminance that it had.
    double set_colour() {
        parse::ColourEncoding encoding = light_.encoding;
        if (params_.colours == Colours::linear) encoding = parse::ColourEncoding::linear;
        if (params_.colours == Colours::srgb) encoding = parse::ColourEncoding::srgb;
        glm::dvec3 rgb;
        for (int i = 0; i < 3; ++i) rgb[i] = decoded(light_.colour[i], encoding);
        const double largest = std::max({rgb.x, rgb.y, rgb.z}), least = std::min({rgb.x, rgb.y, rgb.z});
        if (largest <= 0 && least < 0) {  // a negative light by its colour
            rgb = -rgb;
            result_.is_negative = true;
        } else if (least < 0) {
            rgb = glm::max(rgb, glm::dvec3(0));
            add(Severity::warning, "colour_negative", "has a negative colour component; it became 0");
        }
        const double luminance = pbr::luminance_of_rgb(rgb);
        if (!(luminance > kDarkest)) {
            result_.rgb = glm::dvec3(1);
            return 0;
        }
        result_.rgb = rgb / luminance;
        const glm::dvec3 xyz = pbr::xyz_from_rgb(pbr::kRec709) * result_.rgb;
        result_.temperature = pbr::correlated_temperature(pbr::chromaticity_of(xyz));
        return luminance;
    }

    /// Illuminance where the law is 1, on a surface that faces the light.
    void set_law(double luminance) {
        pbr::Falloff law = light_.falloff;
        clean_falloff(law, light_.line, result_.flags);
        double factor = 1;
        result_.law = in_metres(law, anchor_.unit_m, factor);
        if (pbr::has_range(result_.law) && result_.law.range < kNearest_m && !result_.has("range_zero"))
            add(Severity::warning, "range_zero", "has a range of next to nothing: it lights nothing");
        if (light_.spot) {
            pbr::SpotFalloff spot = *light_.spot;
            if (clean_spot(spot, light_.line, result_.flags))
                result_.spot_law = spot;
            else
                result_.type = LightType::point;
        }
        const double intensity = light_.intensity * luminance;
        if (intensity < 0) result_.is_negative = !result_.is_negative;
        result_.law_lx = std::abs(intensity) * worth() * factor;
        result_.is_dark =
            !(result_.law_lx > kDarkest) || result_.has("cone_zero") || result_.has("range_zero");
        if (result_.is_dark) result_.is_negative = false;
    }

    /// Lux of an intensity of 1 where the law, which divides by the file's lengths, is 1.
    double worth() const {
        const double area = result_.width_m * result_.height_m;
        const double radius_m = std::abs(light_.radius) * anchor_.unit_m;
        const double per_candela = 1 / (anchor_.unit_m * anchor_.unit_m);
        const bool is_rectangle = light_.type == LightType::rectangle;
        const double shape_sr = is_rectangle ? kPi : 4 * kPi;
        switch (light_.unit) {
            case LightUnit::relative:
                return anchor_.reference_lx;
            case LightUnit::candela:
                return per_candela;
            case LightUnit::lumen: {
                const double sr = result_.spot_law ? solid_angle_of(*result_.spot_law) : shape_sr;
                return sr > 0 ? per_candela / sr : 0;
            }
            case LightUnit::lumen_over_pi:
                return per_candela / kPi;
            case LightUnit::lumen_over_4_pi:
                return per_candela / (4 * kPi);
            case LightUnit::lux:
                return 1;
            case LightUnit::nit:
                return per_candela * (is_rectangle ? area : kPi * radius_m * radius_m);
            case LightUnit::watt:
                return per_candela * anchor_.efficacy_lm_per_w / shape_sr;
            case LightUnit::watt_per_sr:
                return per_candela * anchor_.efficacy_lm_per_w;
            case LightUnit::watt_per_m2:
                return anchor_.efficacy_lm_per_w;
        }
        return 1;
    }

    void set_far_light() {
        result_.illuminance_lx = result_.law_lx;
        if (light_.type == LightType::directional || result_.is_dark) return;
        result_.is_fill = true;
        add(Severity::warning, "ambient_fill", "lights everything alike; a probe or sky takes its place");
    }

    void set_near_light() {
        if (result_.is_dark) return;
        if (pbr::is_constant_fill(result_.law)) {
            result_.is_fill = true;
            result_.illuminance_lx = result_.law_lx;
            add(Severity::warning, "constant_fill",
                "doesn't fade with distance, which no photometric light of finite power does; kept as a "
                "fill");
            return;
        }
        set_span();
        if (fits_ == Fits::left_out) return;
        fit();
        if (result_.spot_law) {
            result_.spot = pbr::fit_spot(*result_.spot_law);
            constexpr double kNoticeable = .05;
            if (result_.spot->error.rms_share > kNoticeable)
                add(Severity::warning, "cone_far",
                    "fades from its axis as no photometric spot does: " +
                        share_text(result_.spot->error.rms_share) +
                        " of the intensity on the axis is left between them (root mean square)");
        }
        set_power();
    }

    static std::string share_text(double share) {
        return parse::number_text(std::round(share * 1000) / 10) + " %";
    }

    void set_span() {
        // A physical range is meant in its own units, whatever the exposure.
        const bool is_whole = light_.unit != LightUnit::relative && pbr::has_range(result_.law);
        const double threshold = is_whole ? 1e-30 * result_.law_lx : kLastStep * anchor_.reference_lx;
        result_.span_m = pbr::distances_that_matter(result_.law, result_.law_lx, threshold);
        // A light too dim to reach the last step still has a law: over its range, or over a metre.
        if (!(result_.span_m.far > 0)) {
            const double reach = pbr::has_range(result_.law) ? result_.law.range : 1;
            result_.span_m = {.05 * reach, .9 * reach};
        }
        // No scene is larger; squares stay finite.
        result_.span_m.far = std::min(result_.span_m.far, kFarthest_m);
        result_.span_m.near = std::min(result_.span_m.near, .05 * kFarthest_m);
        // Nobody stands inside a sphere; one that reaches no further is looked at from near by.
        if (light_.type == LightType::sphere && light_.radius != 0) {
            const double surface = std::abs(light_.radius) * anchor_.unit_m;
            result_.span_m.near = std::max(result_.span_m.near, surface);
            result_.span_m.far = std::max(result_.span_m.far, 2 * surface);
        }
        if (params_.far_m > 0) result_.span_m.far = params_.far_m;
        if (params_.near_m > 0) result_.span_m.near = params_.near_m;
        if (result_.span_m.near < result_.span_m.far) return;
        result_.span_m.near = .05 * result_.span_m.far;
        if (params_.near_m > 0)
            add(Severity::warning, "near_m_beyond_reach",
                "matters up to " + parse::number_text(result_.span_m.far) + " m; near_m is " +
                    parse::number_text(params_.near_m) + ", and " + parse::number_text(result_.span_m.near) +
                    " is taken");
    }

    void fit() {
        using pbr::EmitterShape, pbr::LightWindow;
        const auto fitted = [&](EmitterShape shape, LightWindow window) {
            return pbr::fit_light(result_.law, result_.law_lx, shape, window, result_.span_m);
        };
        result_.point = fitted(EmitterShape::point, LightWindow::quartic_squared);
        result_.gltf = fitted(EmitterShape::point, LightWindow::quartic);
        const bool has_shape = light_.type == LightType::sphere || light_.type == LightType::rectangle;
        result_.fit = result_.point;
        if (params_.shape == Shape::disk || params_.shape == Shape::rectangle) {
            result_.fit = fitted(params_.shape == Shape::disk ? EmitterShape::disk : EmitterShape::rectangle,
                                 LightWindow::quartic_squared);
        } else if (params_.shape == Shape::automatic && !has_shape && !result_.point->is_exact) {
            const pbr::LightFit disk = fitted(EmitterShape::disk, LightWindow::quartic_squared);
            if (disk.is_exact || result_.point->error.rms > anchor_.tolerance_stops) result_.fit = disk;
        }
        // glTF's own window where that is what the file has.
        if (!result_.fit->is_exact && result_.gltf->is_exact && params_.shape == Shape::automatic)
            result_.fit = result_.gltf;
        if (has_shape) give_shape(*result_.fit);
        if (result_.fit->error.rms > std::max(anchor_.tolerance_stops, .15))
            add(Severity::warning, "far_fit",
                "stays " + parse::number_text(std::round(result_.fit->error.rms * 100) / 100) +
                    " stops (root mean square) from any light of its shape");
    }

    /// A sphere is a point from outside; a rectangle is one from afar.
    void give_shape(pbr::LightFit& fit) const {
        fit.light.shape =
            light_.type == LightType::sphere ? pbr::EmitterShape::sphere : pbr::EmitterShape::point;
        fit.light.radius = light_.type == LightType::sphere ? std::abs(light_.radius) * anchor_.unit_m : 0;
    }

    void set_power() {
        const double cd = result_.fit->light.intensity, r = result_.fit->light.radius;
        double area = 0;
        switch (result_.fit->light.shape) {
            case pbr::EmitterShape::point:
                area = result_.width_m * result_.height_m;
                break;
            case pbr::EmitterShape::sphere:
            case pbr::EmitterShape::disk:
                area = kPi * r * r;
                break;
            case pbr::EmitterShape::rectangle:
                area = 4 * r * r;
                break;
        }
        result_.luminance_nit = area > 0 ? cd / area : 0;
        double solid_angle = light_.type == LightType::rectangle ? kPi : 4 * kPi;
        if (result_.spot)
            solid_angle = solid_angle_of(
                {pbr::SpotLaw::cosine_ramp, result_.spot->inner_rad, result_.spot->outer_rad, 2});
        result_.flux_lm = cd * solid_angle;
    }

    void flag_overflow() {
        const double nearest = result_.fit ? pbr::illuminance_at(result_.fit->light, result_.span_m.near) : 0;
        const std::pair<const char*, double> figures[] = {
            {"lx", std::max(result_.illuminance_lx, nearest)},
            {"cd", result_.fit ? result_.fit->light.intensity : 0},
            {"cd/m2", result_.luminance_nit}};
        for (const auto& [unit, value] : figures)
            if (value > kHalfMax)
                add(Severity::warning, "half_overflow",
                    "has " + parse::number_text(std::round(value)) + " " + unit +
                        ", more than a half float's 65504; a renderer must expose it before it stores it");
    }

    const LegacyLight& light_;
    parse::UpAxis up_;
    const Anchor& anchor_;
    const LightParams& params_;
    Fits fits_;
    ConvertedLight result_;
};

}  // namespace

// Documents promise bytes, so that 2^EV is our own; the exposure of EV 0 has no power in it.
double reference_illuminance_lx(double ev100) {
    return kPi / pbr::exposure_by_saturation(pbr::Ev100<double>()) *
           pbr::exp_exact(ev100 * std::numbers::ln2);
}

double ev100_of_reference(double illuminance_lx) {
    return pbr::log2_exact(illuminance_lx * pbr::exposure_by_saturation(pbr::Ev100<double>()) / kPi);
}

bool ConvertedLight::has(std::string_view code) const {
    return std::any_of(flags.begin(), flags.end(),
                       [&](const parse::Diagnostic& d) { return d.code == code; });
}

ConvertedLight convert(const LegacyLight& light, parse::UpAxis up, const Anchor& anchor,
                       const LightParams& params, Fits fits) {
    return Conversion(light, up, anchor, params, fits).run();
}

}  // namespace pbrbake::light

#include "bakers/texture/appearance.hpp"

#include "bakers/texture/difference.hpp"
#include "bakers/texture/material.hpp"

namespace pbrbake::texture {

BeforeAndAfter::BeforeAndAfter(const TextureParams& params, const Inputs& inputs, std::vector<Image> images,
                               double scale, const Json& set, Context& context)
    : sources_(params, inputs),
      calibration_(find_calibration(sources_, context)),
      layout_(layout_of(sources_)),
      images_(std::move(images)),
      scale_(scale),
      set_(set) {}

Appearance BeforeAndAfter::as_read(int x, int y) const {
    const LegacyTexel texel = sources_.texel(x, y);
    Appearance seen = of_source(texel.reflected, texel.perceptual_roughness);
    if (!sources_.has_legacy_lobe()) return seen;
    const auto lobe = params().model == Model::phong ? pbr::PhongLobe::mirror : pbr::PhongLobe::blinn;
    seen.phong = PhongTerm{lobe, static_cast<double>(sources_.lobe_exponent(x, y)), texel.specular_albedo};
    return seen;
}

Appearance BeforeAndAfter::calibrated(int x, int y) const {
    if (!is_calibrated()) return as_read(x, y);
    const LegacyTexel texel = sources_.texel(x, y);
    return of_source(calibration_(texel.reflected), texel.perceptual_roughness);
}

Appearance BeforeAndAfter::of_source(const pbr::Reflected<float>& reflected,
                                     float perceptual_roughness) const {
    return {reflected.diffuse, reflected.f0, source_f90(sources_, reflected.f0), perceptual_roughness, {}};
}

Appearance BeforeAndAfter::stored(int x, int y) const {
    const Unpacked texel = unpacked(x, y);
    return {texel.reflected.diffuse, texel.reflected.f0, texel.f90, texel.perceptual_roughness, {}};
}

Change BeforeAndAfter::change(int x, int y) const {
    LegacyTexel legacy = sources_.texel(x, y);
    legacy.reflected = calibration_(legacy.reflected);
    const Colour before = source_albedo(sources_, calibration_, legacy).total();
    const Unpacked texel = unpacked(x, y);
    const Colour after =
        pbr_albedo(texel.reflected, texel.f90, texel.perceptual_roughness, scattering_of(params())).total();
    const auto energy = static_cast<double>(pbr::mean_channel(before));
    const double gained = static_cast<double>(pbr::mean_channel(after)) - energy;
    return {delta_e(before, after), energy > 0 ? gained / energy : 0};
}

Unpacked BeforeAndAfter::unpacked(int x, int y) const {
    if (images_.empty()) return factors_from(set_.at("factors"), layout_);
    return unpack(layout_, images_, x, y, set_.value("dielectric_f0_unit", 1.f), scale_);
}

}  // namespace pbrbake::texture

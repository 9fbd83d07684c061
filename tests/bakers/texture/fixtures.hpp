#pragma once
// Texture sets for tests: sources from numbers, and bakes with the schema's defaults.

#include <cmath>
#include <functional>
#include <string>

#include "bakers/io/io.hpp"
#include "bakers/texture/texture.hpp"
#include "pbr/numerics/vector.hpp"

namespace pbrbake::texture::test {

using Rgba = std::array<float, 4>;

/// The defaults of schemas/job.schema.json, with a diffuse and a specular map stated.
inline TextureParams defaults() {
    TextureParams params{};
    params.diffuse = "set_d.png";
    params.specular = "set_s.png";
    params.colour_space = "auto";
    params.power_scale = 255;
    params.diffuse_factor = params.specular_factor = {1, 1, 1};
    params.gloss_factor = params.opacity_factor = params.normal_scale = params.occlusion_strength = 1;
    params.emissive_factor = {0, 0, 0};
    params.alpha_cutoff = .5;
    params.uv_offset = {0, 0};
    params.uv_scale = {1, 1};
    params.dielectric_f0 = .04;
    params.f0_tolerance = .02;
    params.regularise = params.multiscatter = params.residual = true;
    params.levels = 1;
    return params;
}

/// A source of linear texels; `bits` 8 rounds colours to sRGB codes, 16 to linear ones.
inline SourceImage source(int width, int height, int channels, int bits,
                          const std::function<Rgba(int x, int y)>& texel) {
    SourceImage result;
    result.bits = bits;
    result.colour_space = bits == 8 ? "srgb" : "lin_rec709";
    Image& image = result.image;
    for (const char* name : {"R", "G", "B", "A"})
        if (image.channel_count() < channels) image.channels.emplace_back(name);
    Level level{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Rgba value = texel(x, y);
            level.texels.insert(level.texels.end(), value.begin(), value.begin() + channels);
        }
    image.levels.push_back(std::move(level));
    if (bits > 0) {
        image.transfer = bits == 8 ? Transfer::srgb : Transfer::linear;
        std::vector<Image> images{std::move(image)};
        io::quantise(images, bits == 8 ? PixelType::unorm8 : PixelType::unorm16);
        image = std::move(images.front());
    }
    return result;
}

struct Baked {
    Product product;
    Certificate certificate;
    const Json& set() const { return product.properties["set"]; }
    const Image& image(const std::string& name) const {
        for (const Image& image : product.images)
            if (image.name == name) return image;
        throw std::out_of_range(name);
    }
    double figure(const std::string& metric) const {
        for (const Figure& figure : certificate.figures)
            if (figure.metric == metric) return figure.value;
        return -1;
    }
};

inline Baked bake_set(const TextureParams& params, const Inputs& inputs, PixelType pixel, int threads = 1) {
    Context context(threads, {});
    context.set_certify_fully(true);
    Baked baked{bake(params, inputs, context), {}};
    baked.product.scale = io::quantise(baked.product.images, pixel);
    baked.certificate = certify(params, inputs, baked.product, context);
    return baked;
}

}  // namespace pbrbake::texture::test

#pragma once
// Texture sets for tests: sources from numbers, and bakes with the schema's defaults.

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "bakers/io/io.hpp"
#include "bakers/texture/texture.hpp"
#include "bakers/unorm8.hpp"
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

/// The same picture as read_source hands it over where codes are asked for; of 8 bits.
inline SourceImage coded(const SourceImage& floats) {
    SourceImage result = floats;
    Image& image = result.image;
    const std::size_t channels = image.channels.size();
    for (std::size_t code = 0; code < 256; ++code) {
        std::vector<Image> one{{"", {"R"}, 1, {{1, 1, {0}}}, image.transfer}};
        const auto value = static_cast<double>(code) / 255;
        const double linear = image.transfer == Transfer::linear ? value
                              : value <= .04045                  ? value / 12.92
                                                                 : std::pow((value + .055) / 1.055, 2.4);
        one[0].levels[0].texels[0] = static_cast<float>(linear);
        io::quantise(one, PixelType::unorm8);
        result.linear[code] = one[0].levels[0].texels[0];
    }
    std::vector<float>& texels = image.levels[0].texels;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const auto found = std::ranges::min_element(result.linear, {},
                                                    [&](float value) { return std::abs(value - texels[i]); });
        result.codes.push_back(static_cast<std::uint8_t>(i % channels == 3 ? std::lround(texels[i] * 255)
                                                                           : found - result.linear.begin()));
    }
    texels.clear();
    return result;
}

/// A text as its bytes.
inline SourceImage text_source(const std::string& name, const std::string& text) {
    SourceImage result;
    result.name = name;
    const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
    result.bytes.assign(bytes, bytes + text.size());
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

/// Codes as the floats they stand for, so that tests read products of any pixel type alike.
inline void decode(std::vector<Image>& images) {
    for (Image& image : images)
        for (Level& level : image.levels)
            for (std::size_t i = 0; i < level.codes.size(); ++i)
                level.texels.push_back(
                    from_unorm8(level.codes[i], channel_transfer(image, i % image.channels.size())));
}

inline Baked bake_set(const TextureParams& params, const Inputs& inputs, PixelType pixel, int threads = 1) {
    Context context(threads, {});
    context.set_certify_fully(true);
    context.set_pixels({pixel});
    Baked baked{bake(params, inputs, context), {}};
    baked.product.scale = io::quantise(baked.product.images, pixel);
    baked.certificate = certify(params, inputs, baked.product, context);
    decode(baked.product.images);
    return baked;
}

}  // namespace pbrbake::texture::test

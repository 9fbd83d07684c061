#pragma once
// The containers of products, and what each holds: one table for the job that is checked, and for io that
// writes.

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/image.hpp"

namespace pbrbake {

/// A container. The first of `pixels` is what "auto" stands for; a document has none.
struct Format {
    std::string_view name;  ///< also the file's extension
    std::vector<PixelType> pixels;
    int max_channels;
    bool is_chain;   ///< holds cube maps and mip levels
    bool is_volume;  ///< holds 3D textures

    bool is_document() const { return pixels.empty(); }
};

/// exr, ktx2, dds, png, hdr, h; and the documents that are products of their own, json and gltf.
std::span<const Format> formats();

/// The format of a name, or null.
const Format* find_format(std::string_view name);

/// The format of a product's pictures: its own, or png beside a document. `name` is a format's.
const Format& picture_format(std::string_view name);

/// "half", "float", "unorm16", "unorm8", "rgbe".
std::string_view pixel_name(PixelType pixel);

/// The pixel type that a bake's format and `pixel` ("auto" or a name) stand for; throws Error(invalid_job),
/// its message for the pointer /pixel, if the format doesn't hold it. A document has "auto" alone; what is
/// returned for it means nothing.
PixelType settle_pixel(std::string_view format, std::string_view pixel);

}  // namespace pbrbake

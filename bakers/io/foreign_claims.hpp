#pragma once
// What the bytes of a foreign file can possibly hold: its format, the least bytes its picture takes, and
// marks that OpenImageIO doesn't tell.

#include <optional>
#include <string>

#include "bakers/io/decoded.hpp"
#include "bakers/io/module_api.hpp"

namespace pbrbake::io {

/// The format by the file's first bytes; TGA, which has no magic, by its extension (".tga").
std::optional<ForeignFormat> foreign_format(Bytes file, const std::string& extension);

/// A lower bound of the bytes in which the format can hold the picture that `spec` claims.
double least_bytes(ForeignFormat format, Bytes file, const PictureSpec& spec);

/// What a PNG's sRGB, gAMA and cHRM chunks say of its encoding (PNG, third edition, 11.3.2); nothing when it
/// has neither of the first two. OpenImageIO calls every PNG sRGB. Throws Error(unreadable_input) for
/// impossible primaries.
std::optional<Encoding> png_encoding(Bytes file, const std::string& where);

/// Whether a PNG's chunks run to its IEND. libpng finds out by itself, but OpenImageIO 2.4 leaks memory when
/// it does.
bool png_is_complete(Bytes file);

/// Whether a JPEG runs to its end-of-image marker. Decoders paint what is missing grey and call it success.
bool jpeg_is_complete(Bytes file);

}  // namespace pbrbake::io

#pragma once
// What the bytes of a foreign file can possibly hold: its format, the least bytes its picture takes, and marks that
// OpenImageIO doesn't tell.

#include <optional>
#include <string>

#include "bakers/io/decoded.hpp"
#include "bakers/io/module_api.hpp"

namespace pbrbake::io {

/// The format by the file's first bytes; TGA, which has no magic, by its extension (".tga").
std::optional<ForeignFormat> foreign_format(Bytes file, const std::string& extension);

/// A lower bound of the bytes in which the format can hold the picture that `spec` claims.
double least_bytes(ForeignFormat format, Bytes file, const PictureSpec& spec);

/// Whether a PNG says how it is encoded (an sRGB or gAMA chunk before its pixels).
bool png_states_encoding(Bytes file);

/// Whether a JPEG runs to its end-of-image marker. Decoders paint what is missing grey and call it success.
bool jpeg_is_complete(Bytes file);

}  // namespace pbrbake::io

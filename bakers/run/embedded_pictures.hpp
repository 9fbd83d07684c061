#pragma once
// Pictures that glTF files embed.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "bakers/image.hpp"
#include "bakers/parse/gltf_file.hpp"

namespace pbrbake::run {

/// The pictures of one glTF file after the other; a file is parsed once as long as no other is asked for.
class EmbeddedPictures {
  public:
    /// The bytes of image `index`. Throws Error(unreadable_input).
    std::vector<std::byte> read(const std::filesystem::path& file, std::size_t index);

    /// Files besides the glTF that held the pictures that were read.
    const std::vector<std::filesystem::path>& buffers() const { return buffers_; }

  private:
    void open(const std::filesystem::path& file);

    SourceImage source_;
    parse::GltfFile gltf_;  ///< views source_
    std::vector<std::filesystem::path> buffers_;
};

}  // namespace pbrbake::run

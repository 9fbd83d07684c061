#include "bakers/run/embedded_pictures.hpp"

#include <algorithm>

#include "bakers/io/io.hpp"

namespace pbrbake::run {
namespace fs = std::filesystem;

std::vector<std::byte> EmbeddedPictures::read(const fs::path& file, std::size_t index) {
    open(file);
    const parse::GltfBytes bytes = parse::gltf_picture(gltf_, index, source_.name);
    if (bytes.path.empty()) return {bytes.own().begin(), bytes.own().end()};
    const fs::path buffer = file.parent_path() / bytes.path;
    if (std::ranges::find(buffers_, buffer) == buffers_.end()) buffers_.push_back(buffer);
    return io::read_part(buffer, bytes.offset, bytes.size);
}

void EmbeddedPictures::open(const fs::path& file) {
    if (source_.name == file.string()) return;
    source_ = io::read_text_source(file);
    gltf_ = parse::parse_gltf(source_.bytes, source_.name);
}

}  // namespace pbrbake::run

#pragma once
// Products baked once for all tests of a program, and copies of them with one thing changed.

#include <fstream>
#include <functional>
#include <string>

#include "bakers/io/io.hpp"
#include "bakers/job/job.hpp"
#include "bakers/run/run.hpp"
#include "tests/bakers/job/temporary_folder.hpp"

namespace pbrbake::test {

/// A table of 64 x 64 (table.exr), a probe of 64 texels and four levels (room.ktx2) and their manifest.
inline const std::filesystem::path& baked_folder() {
    static const TemporaryFolder folder;
    static const bool done = [] {
        const auto file = folder.write("job.json", R"({"version": 1, "output": "baked", "bakes": [
            {"kind": "dfg", "name": "table", "size": 64, "terms": ["ggx", "disney_diffuse"], "certify": "none"},
            {"kind": "probe", "name": "room", "source": "builtin:indoor", "size": 64, "levels": 5, "format": "ktx2",
             "certify": "none"}]})");
        const job::Job job = job::load(file);
        if (run::run(std::span(&job, 1), {}).code != ExitCode::done)
            throw std::runtime_error("the test's products could not be baked");
        return true;
    }();
    (void)done;
    static const std::filesystem::path path = folder / "baked";
    return path;
}

using Change = std::function<void(Image&)>;

/// A product read, changed, rounded and written as another file, without its record.
inline void write_changed(const std::filesystem::path& from, const std::filesystem::path& to,
                          const Change& change) {
    io::ReadBack product = io::read_product(from);
    change(product.image);
    std::vector<Image> images{std::move(product.image)};
    const double scale = io::quantise(images, product.info.pixel);
    product.image = std::move(images.front());
    if (scale != 1) product.info.metadata["pbrbake:scale"] = std::to_string(scale);
    const auto bytes = io::encode(product.format, product.image, product.info);
    std::filesystem::create_directories(to.parent_path());
    std::ofstream(to, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

/// Every value v of an image becomes f(v).
inline Change each_value(const std::function<double(double)>& f) {
    return [f](Image& image) {
        for (Level& level : image.levels)
            for (float& value : level.texels) value = static_cast<float>(f(value));
    };
}

/// Every texel (face, x, y) becomes what `f` makes of the old image.
inline Change each_texel(
    const std::function<void(const Image& old, int level, int face, int y, int x, float* texel)>& f) {
    return [f](Image& image) {
        const Image old = image;
        for (int l = 0; l < static_cast<int>(image.levels.size()); ++l)
            for (int face = 0; face < image.faces; ++face)
                for (int y = 0; y < image.levels[static_cast<std::size_t>(l)].height; ++y)
                    for (int x = 0; x < image.levels[static_cast<std::size_t>(l)].width; ++x)
                        f(old, l, face, y, x, image.texel(l, face, y, x));
    };
}

}  // namespace pbrbake::test

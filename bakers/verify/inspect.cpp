#include "bakers/verify/inspect.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include "bakers/formats.hpp"
#include "bakers/verify/metrics.hpp"
#include "bakers/verify/product_file.hpp"

namespace pbrbake::verify {
namespace fs = std::filesystem;
namespace {

LevelSummary summarise(const Image& image, int index, double scale) {
    const Level& level = image.levels[static_cast<std::size_t>(index)];
    const bool is_cube = image.is_cube();
    const std::vector<double> weight = texel_weights(level, is_cube);
    const std::size_t channels = image.channels.size();
    LevelSummary summary{level.width, level.height, std::vector<ChannelSummary>(channels)};
    for (std::size_t c = 0; c < channels; ++c) {
        ChannelSummary& channel = summary.channels[c];
        channel.lowest = std::numeric_limits<double>::infinity();
        channel.highest = -channel.lowest;
        double sum = 0, weight_sum = 0;
        for (std::size_t i = c, texel = 0; i < level.texels.size(); i += channels, ++texel) {
            const double value = level.texels[i] / scale;
            if (!std::isfinite(value)) {
                ++channel.non_finite;
                continue;
            }
            channel.lowest = std::min(channel.lowest, value);
            channel.highest = std::max(channel.highest, value);
            sum += value * weight[texel % weight.size()];
            weight_sum += weight[texel % weight.size()];
        }
        if (weight_sum == 0) channel.lowest = channel.highest = 0;
        channel.mean = weight_sum > 0 ? sum / weight_sum : 0;
        channel.energy = is_cube ? sum : 0;
    }
    return summary;
}

/// A product, or a picture that isn't one, by its extension.
ProductFile read_picture(const fs::path& file) {
    static const std::map<std::string, const char*> kSources{
        {".jpg", "jpeg"}, {".jpeg", "jpeg"}, {".tga", "tga"}, {".tif", "tiff"}, {".tiff", "tiff"}};
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension == ".gltf" || extension == ".glb")
        throw Error(ExitCode::unreadable_input, file.string(),
                    "is a document; inspect a picture of its base colour, of a material that isn't recorded "
                    "with --metallic-roughness");
    const auto found = kSources.find(extension);
    if (found == kSources.end()) return read_product_file(file);
    SourceImage source = io::read_source({.path = file, .with_alpha = true});
    ProductFile picture;
    picture.format = found->second;
    picture.info.pixel = source.bits == 8    ? PixelType::unorm8
                         : source.bits == 16 ? PixelType::unorm16
                                             : PixelType::float32;
    picture.image = std::move(source.image);
    return picture;
}

}  // namespace

Inspection inspect(const fs::path& file, const SetFiles& set) {
    const ProductFile product = read_picture(file);
    Inspection inspection{product.format,
                          std::string(pixel_name(product.info.pixel)),
                          product.image.faces,
                          product.image.is_volume,
                          product.image.channels,
                          product.scale,
                          product.units,
                          {},
                          set.is_set() ? check_ranges(set) : check_ranges(file, product.record),
                          product.record};
    for (int level = 0; level < static_cast<int>(product.image.levels.size()); ++level)
        inspection.levels.push_back(summarise(product.image, level, inspection.scale));
    return inspection;
}

Json inspection_json(const Inspection& inspection) {
    Json levels = Json::array();
    for (const LevelSummary& level : inspection.levels) {
        Json channels = Json::array();
        for (std::size_t c = 0; c < level.channels.size(); ++c) {
            const ChannelSummary& summary = level.channels[c];
            Json channel{{"channel", inspection.channels[c]},
                         {"min", summary.lowest},
                         {"max", summary.highest},
                         {"mean", summary.mean},
                         {"non_finite", summary.non_finite}};
            if (inspection.faces == 6 && !inspection.is_volume) channel["energy"] = summary.energy;
            channels.push_back(std::move(channel));
        }
        levels.push_back(
            {{"width", level.width}, {"height", level.height}, {"channels", std::move(channels)}});
    }
    Json json{{"version", 1},
              {"format", inspection.format},
              {"pixel", inspection.pixel},
              {inspection.is_volume ? "depth" : "faces", inspection.faces},
              {"scale", inspection.scale},
              {"units", inspection.units},
              {"levels", std::move(levels)}};
    for (const RangeCheck& check : inspection.ranges)
        json["ranges"].push_back({{"what", check.what},
                                  {"lowest", check.lowest},
                                  {"highest", check.highest},
                                  {"texels", check.texels},
                                  {"below", check.below},
                                  {"above", check.above},
                                  {"source", check.source}});
    json["record"] = inspection.record;
    return json;
}

}  // namespace pbrbake::verify

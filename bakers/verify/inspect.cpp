#include "bakers/verify/inspect.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "bakers/formats.hpp"
#include "bakers/io/io.hpp"
#include "bakers/job/json_text.hpp"
#include "pbr/ibl/cubemap.hpp"

namespace pbrbake::verify {
namespace fs = std::filesystem;
namespace {

double scale_of(const io::FileInfo& info) {
    double scale = 1;
    if (const auto found = info.metadata.find("pbrbake:scale"); found != info.metadata.end())
        std::from_chars(found->second.data(), found->second.data() + found->second.size(), scale);
    return scale > 0 && std::isfinite(scale) ? scale : 1;
}

/// The weight of each texel of a face or picture: its solid angle, or 1.
std::vector<double> weights(const Level& level, bool is_cube) {
    std::vector<double> list(static_cast<std::size_t>(level.width) * level.height, 1.0);
    if (is_cube)
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x)
                list[static_cast<std::size_t>(y) * level.width + x] =
                    pbr::cubemap_texel_solid_angle(level.width, x, y);
    return list;
}

LevelSummary summarise(const Image& image, int index, double scale) {
    const Level& level = image.levels[static_cast<std::size_t>(index)];
    const bool is_cube = image.faces == 6;
    const std::vector<double> weight = weights(level, is_cube);
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

/// A JSON file beside a product, or null: a product without a record is still worth a look.
Json document_beside(const fs::path& file) {
    try {
        return job::parse_json(job::read_text(file), file.string());
    } catch (const Error&) {
        return nullptr;
    }
}

bool lists(const Json& entry, const std::string& name) {
    if (!entry.is_object() || !entry.contains("outputs") || !entry["outputs"].is_array()) return false;
    return std::any_of(entry["outputs"].begin(), entry["outputs"].end(), [&](const Json& output) {
        return output.is_object() && output.value("path", Json()) == name;
    });
}

Json record_of(const fs::path& file) {
    const std::string name = file.filename().string();
    if (Json sidecar = document_beside(file.string() + ".json"); lists(sidecar, name)) return sidecar;
    const Json manifest = document_beside(file.parent_path() / "manifest.json");
    if (manifest.is_object() && manifest.contains("products") && manifest["products"].is_array())
        for (const Json& entry : manifest["products"])
            if (lists(entry, name)) return entry;
    return nullptr;
}

}  // namespace

Inspection inspect(const fs::path& file) {
    const io::ReadBack product = io::read_product(file);
    Inspection inspection{product.format,
                          std::string(pixel_name(product.info.pixel)),
                          product.image.faces,
                          product.image.channels,
                          scale_of(product.info),
                          "relative",
                          {},
                          record_of(file)};
    if (const auto units = product.info.metadata.find("pbrbake:units"); units != product.info.metadata.end())
        inspection.units = units->second;
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
            if (inspection.faces == 6) channel["energy"] = summary.energy;
            channels.push_back(std::move(channel));
        }
        levels.push_back(
            {{"width", level.width}, {"height", level.height}, {"channels", std::move(channels)}});
    }
    return {{"format", inspection.format}, {"pixel", inspection.pixel}, {"faces", inspection.faces},
            {"scale", inspection.scale},   {"units", inspection.units}, {"levels", std::move(levels)},
            {"record", inspection.record}};
}

}  // namespace pbrbake::verify

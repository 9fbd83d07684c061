#include "bakers/run/entry.hpp"

#include <algorithm>

#include "bakers/formats.hpp"
#include "bakers/job/json_text.hpp"
#include "bakers/run/run.hpp"

namespace pbrbake::run {
namespace {

constexpr std::array<std::string_view, 4> kEvidenceNames{"exact", "bound", "measured", "estimate"};

Json inputs_json(std::span<const job::Source> sources, const Inputs& inputs) {
    Json list = Json::array();
    for (const job::Source& source : sources) {
        const SourceImage& image = inputs.at(source.read.field);
        Json input{{"path", source.read.path}};
        if (!image.hash.empty()) input[source.file.empty() ? "revision" : "xxh3"] = image.hash;
        if (!image.colour_space.empty()) input["colour_space"] = image.colour_space;
        list.push_back(std::move(input));
    }
    return list;
}

Json outputs_json(const std::vector<Output>& outputs) {
    Json list = Json::array();
    for (const Output& output : outputs)
        list.push_back(
            {{"path", output.file.generic_string()}, {"xxh3", output.hash}, {"bytes", output.bytes}});
    return list;
}

Json repairs_json(const Inputs& inputs) {
    Repairs sum;
    for (const auto& [field, image] : inputs) {
        sum.non_finite += image.repairs.non_finite;
        sum.negative += image.repairs.negative;
        sum.lowest = std::min(sum.lowest, image.repairs.lowest);
    }
    return {{"non_finite", sum.non_finite}, {"negative", sum.negative}, {"lowest", sum.lowest}};
}

Json certificate_json(const Certificate& certificate, const std::map<std::string, std::uint64_t>& work) {
    Json json = Json::object();
    if (certificate.headline) json["headline"] = figure_json(*certificate.headline);
    json["figures"] = Json::array();
    for (const Figure& figure : certificate.figures) json["figures"].push_back(figure_json(figure));
    json["work"] = Json(work);
    return json;
}

}  // namespace

Json figure_json(const Figure& figure) {
    Json json{{"metric", figure.metric},
              {"value", figure.value},
              {"evidence", kEvidenceNames[static_cast<std::size_t>(figure.evidence)]},
              {"method", figure.method}};
    if (figure.interval) json["interval"] = {figure.interval->first, figure.interval->second};
    if (figure.level) json["level"] = *figure.level;
    if (!figure.curve.is_null()) json["curve"] = figure.curve;
    return json;
}

Json entry(const job::Job& job, const job::Bake& bake, std::span<const job::Source> sources,
           const Inputs& inputs, const Product& product, const Certificate& certificate,
           const std::map<std::string, std::uint64_t>& work, const std::vector<Output>& outputs) {
    Json json{{"kind", bake.kind},
              {"name", bake.name},
              {"tool", tool_version()},
              {"algorithm_version", bake.baker->algorithm_version},
              {"params", bake.params},
              {"working_space", job.working_space},
              {"inputs", inputs_json(sources, inputs)},
              {"outputs", outputs_json(outputs)}};
    if (!product.images.empty())
        json["pixel"] = product.pixel ? Json(pixel_name(*product.pixel)) : bake.params["pixel"];
    json["units"] = product.units;
    json["scale"] = product.scale;
    for (const auto& [key, value] : product.properties.items()) json[key] = value;
    json["repairs"] = repairs_json(inputs);
    json["certificate"] = certificate_json(certificate, work);
    return json;
}

std::map<std::string, std::string> metadata(const job::Job& job, const job::Bake& bake,
                                            const Product& product) {
    std::map<std::string, std::string> entries{{"pbrbake:tool", std::string(tool_version())},
                                               {"pbrbake:kind", bake.kind},
                                               {"pbrbake:params", job::to_line(bake.params)},
                                               {"pbrbake:working_space", job.working_space},
                                               {"pbrbake:units", product.units},
                                               {"pbrbake:scale", job::to_line(product.scale)}};
    for (const char* key : {"columns", "layout"})  // of a table
        if (product.properties.contains(key))
            entries[std::string("pbrbake:") + key] = job::to_line(product.properties[key]);
    return entries;
}

std::filesystem::path sidecar_file(const job::Job& job, const job::Bake& bake) {
    return job.output / (bake.file + ".json");
}

}  // namespace pbrbake::run

#include "bakers/verify/product_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "bakers/job/json_text.hpp"

namespace pbrbake::verify {
namespace fs = std::filesystem;
namespace {

double scale_of(const std::string& text) {
    double scale = 1;
    std::from_chars(text.data(), text.data() + text.size(), scale);
    return scale > 0 && std::isfinite(scale) ? scale : 1;
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

/// A text of the container's metadata, else of the record, else "".
std::string stated(const ProductFile& file, const char* name) {
    if (const auto found = file.info.metadata.find(std::string("pbrbake:") + name);
        found != file.info.metadata.end())
        return found->second;
    if (!file.record.is_object() || !file.record.contains(name)) return "";
    const Json& value = file.record[name];
    return value.is_string() ? value.get<std::string>() : value.is_number() ? job::to_line(value) : "";
}

/// The record of a bake's other files, "crate_normal.png" or "crate.material.json", beside its main file:
/// "crate.png.json".
Json record_of_main_file(const fs::path& file) {
    const std::string name = file.filename().string();
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(fs::absolute(file).parent_path(), error)) {
        const fs::path main = entry.path().stem();  // of "crate.png.json"
        if (entry.path().extension() != ".json" || !main.has_extension() ||
            !name.starts_with(main.stem().string()))
            continue;
        if (Json record = document_beside(entry.path()); lists(record, name)) return record;
    }
    return nullptr;
}

/// Containers of four channels hold a probe's three and an alpha of 1.
void drop_padding(Image& image) {
    image.channels.resize(3);
    for (Level& level : image.levels) {
        std::size_t to = 0;
        for (std::size_t from = 0; from < level.texels.size(); ++from)
            if (from % 4 != 3) level.texels[to++] = level.texels[from];
        level.texels.resize(to);
    }
}

}  // namespace

Json record_of(const fs::path& file) {
    const std::string name = file.filename().string();
    if (Json sidecar = document_beside(file.string() + ".json"); lists(sidecar, name)) return sidecar;
    const Json manifest = document_beside(file.parent_path() / "manifest.json");
    if (manifest.is_object() && manifest.contains("products") && manifest["products"].is_array())
        for (const Json& entry : manifest["products"])
            if (lists(entry, name)) return entry;
    return record_of_main_file(file);
}

ProductFile read_product_file(const fs::path& file) { return read_product_file(file, record_of(file)); }

ProductFile read_product_file(const fs::path& file, Json record) {
    io::ReadBack read = io::read_product(file);
    ProductFile product;
    product.format = std::move(read.format);
    product.info = std::move(read.info);
    product.image = std::move(read.image);
    product.record = std::move(record);
    product.kind = stated(product, "kind");
    if (product.kind == "probe" && product.image.channels.size() == 4) drop_padding(product.image);
    if (const std::string scale = stated(product, "scale"); !scale.empty()) product.scale = scale_of(scale);
    if (const std::string units = stated(product, "units"); !units.empty()) product.units = units;
    return product;
}

}  // namespace pbrbake::verify

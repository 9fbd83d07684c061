#include "bakers/verify/pairing.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>

#include "bakers/formats.hpp"
#include "bakers/job/json_text.hpp"
#include "bakers/verify/product_file.hpp"

namespace pbrbake::verify {
namespace fs = std::filesystem;
namespace {

/// Whether a file is a product: most are by their ending, a JSON document if it has a record of its own.
bool is_product(const fs::path& file) {
    const std::string extension = file.extension().string();
    if (extension == ".json") return !record_of(file).is_null();
    return !extension.empty() && find_format(extension.substr(1)) != nullptr;
}

/// The files that a record lists; `folder` is the record's, `prefix` what names begin with.
void list_entry(const Json& entry, const fs::path& folder, const fs::path& prefix, const std::string& where,
                std::vector<ListedFile>& files) {
    try {
        for (const Json& file : entry.at("outputs")) {
            const std::string path = file.at("path").get<std::string>();
            files.push_back({(prefix / path).generic_string(), folder / path, entry});
        }
    } catch (const Json::exception&) {
        throw Error(ExitCode::unreadable_input, where, "has an entry without outputs; not a record of ours");
    }
}

void list_document(const fs::path& file, const fs::path& prefix, std::vector<ListedFile>& files) {
    const Json json = [&] {
        try {
            return job::parse_json(job::read_text(file), file.string());
        } catch (const Error& error) {
            throw Error(ExitCode::unreadable_input, error.where(), error.message());
        }
    }();
    if (json.is_object() && json.contains("products") && json["products"].is_array())
        for (const Json& entry : json["products"])
            list_entry(entry, file.parent_path(), prefix, file.string(), files);
    else if (json.is_object() && json.contains("outputs"))
        list_entry(json, file.parent_path(), prefix, file.string(), files);
    else
        throw Error(
            ExitCode::unreadable_input, file.string(),
            "is neither a manifest nor a product's record; compare takes those, folders and products");
}

void list_folder(const fs::path& folder, const fs::path& prefix, std::vector<ListedFile>& files) {
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
    std::ranges::sort(entries);
    const bool has_manifest = fs::is_regular_file(folder / "manifest.json");
    if (has_manifest) list_document(folder / "manifest.json", prefix, files);
    std::set<std::string> listed;
    for (const fs::path& path : entries) {
        if (fs::is_directory(path) && !fs::is_symlink(path)) {
            list_folder(path, prefix / path.filename(), files);
        } else if (!has_manifest && is_product(path) && listed.insert(path.filename().string()).second) {
            const Json record = record_of(path);
            if (record.is_null()) {
                files.push_back({(prefix / path.filename()).generic_string(), path, nullptr});
                continue;
            }
            std::vector<ListedFile> of_record;
            list_entry(record, folder, prefix, path.string(), of_record);
            for (ListedFile& file : of_record) {
                const std::string name = file.path.filename().string();
                if (name == path.filename() || listed.insert(name).second) files.push_back(std::move(file));
            }
        }
    }
}

std::vector<ListedFile> listing(const fs::path& path) {
    std::vector<ListedFile> files;
    try {
        if (fs::is_directory(path))
            list_folder(path, "", files);
        else
            list_document(path, "", files);
    } catch (const fs::filesystem_error& error) {
        throw Error(ExitCode::unreadable_input, path.string(), error.code().message());
    }
    return files;
}

using Key = std::function<std::string(const ListedFile&)>;

/// Moves what `key` pairs from both lists to `pairs`; an empty key, or one that several share, pairs nothing.
void take_pairs(std::vector<ListedFile>& a, std::vector<ListedFile>& b, const Key& key, const char* note,
                std::vector<Pair>& pairs) {
    std::map<std::string, std::vector<std::size_t>> of_b;
    std::map<std::string, int> count_a;
    for (std::size_t i = 0; i < b.size(); ++i) of_b[key(b[i])].push_back(i);
    for (const ListedFile& file : a) ++count_a[key(file)];
    std::set<std::size_t> taken;
    std::vector<ListedFile> left_a, left_b;
    for (ListedFile& file : a) {
        const std::string k = key(file);
        const auto found = of_b.find(k);
        if (k.empty() || found == of_b.end() || found->second.size() != 1 || count_a[k] != 1) {
            left_a.push_back(std::move(file));
            continue;
        }
        const std::size_t at = found->second.front();
        taken.insert(at);
        const std::string text = *note ? "held against " + b[at].name + ": " + note : "";
        pairs.push_back({file.name, file.path, b[at].path, file.entry, b[at].entry, text});
    }
    for (std::size_t i = 0; i < b.size(); ++i)
        if (!taken.contains(i)) left_b.push_back(std::move(b[i]));
    a = std::move(left_a);
    b = std::move(left_b);
}

/// Which of its bake's files one is: what follows the bake's name, "_normal" or ".material.json"; endings of
/// pictures don't count. Never empty.
std::string output_key(const ListedFile& file) {
    const fs::path path = fs::path(file.name).filename();
    const std::string extension = path.extension().string();
    const Format* format = extension.empty() ? nullptr : find_format(extension.substr(1));
    const std::string text = (format && !format->is_document() ? path.stem() : path).string();
    const std::string name = file.entry.value("name", std::string());
    return "#" + (text.starts_with(name) ? text.substr(name.size()) : text);
}

std::string bake_key(const ListedFile& file) {
    if (!file.entry.is_object() || !file.entry.contains("name")) return "";
    return fs::path(file.name).parent_path().generic_string() + "/" + job::to_line(file.entry["name"]) +
           output_key(file);
}

std::string recipe_key(const ListedFile& file) {
    if (!file.entry.is_object() || !file.entry.contains("params")) return "";
    return job::to_line(file.entry.value("kind", Json())) + job::to_line(file.entry["params"]) +
           output_key(file);
}

bool is_record(const std::vector<ListedFile>& files) {
    return !files.empty() && files.front().entry.is_object() &&
           std::ranges::all_of(files,
                               [&](const ListedFile& file) { return file.entry == files.front().entry; });
}

}  // namespace

std::vector<Pair> pairs_of(const fs::path& a, const fs::path& b) {
    const auto is_set = [](const fs::path& path) {
        std::error_code error;
        if (!fs::exists(path, error))
            throw Error(ExitCode::unreadable_input, path.string(), "does not exist");
        return fs::is_directory(path) || (path.extension() == ".json" && !is_product(path));
    };
    const bool set_a = is_set(a), set_b = is_set(b);
    if (set_a != set_b)
        throw Error(ExitCode::usage, (set_a ? b : a).string(),
                    "is one product, and the other side a set of them; compare two products, or two folders, "
                    "manifests or records");
    if (!set_a) return {{a.filename().string(), a, b, record_of(a), record_of(b), ""}};
    std::vector<ListedFile> of_a = listing(a), of_b = listing(b);
    std::vector<Pair> pairs;
    const bool two_records = a.extension() == ".json" && is_record(of_a) && is_record(of_b);
    if (two_records) take_pairs(of_a, of_b, output_key, "", pairs);
    take_pairs(
        of_a, of_b, [](const ListedFile& file) { return file.name; }, "", pairs);
    take_pairs(of_a, of_b, bake_key, "the bake has the same name", pairs);
    take_pairs(of_a, of_b, recipe_key, "the same was baked", pairs);
    for (ListedFile& file : of_a) pairs.push_back({file.name, file.path, {}, file.entry, nullptr, ""});
    for (ListedFile& file : of_b) pairs.push_back({file.name, {}, file.path, nullptr, file.entry, ""});
    std::ranges::sort(pairs, {}, &Pair::name);
    return pairs;
}

}  // namespace pbrbake::verify

#include "bakers/job/job.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "bakers/formats.hpp"
#include "bakers/job/json_text.hpp"
#include "bakers/job/paths.hpp"
#include "bakers/job/schema.hpp"
#include "bakers/job/words.hpp"

namespace pbrbake::job {
namespace fs = std::filesystem;
namespace {

std::string all_lines(const std::vector<Mistake>& mistakes) {
    std::vector<std::string> lines;
    for (const Mistake& mistake : mistakes) lines.push_back(mistake.pointer + ": " + mistake.message);
    return joined(lines, "\n");
}

constexpr std::size_t kLongestName = 100;  ///< as the schema has it

/// Reads a document that the schema may have found fault with: what is sound is still looked at.
class Reading {
  public:
    Reading(Json document, Fence fence) : document_(std::move(document)), fence_(std::move(fence)) {
        mistakes_ = job_schema().mistakes(document_);
        if (mistakes_.empty()) expand_bakes();
        job_schema().complete(document_);
    }

    /// A bake's product is called by its name, unless `product` is given.
    Job read(const fs::path& product) {
        Job job;
        if (is_sound("/working_space")) job.working_space = document_["working_space"].get<std::string>();
        if (is_sound("/limits")) {
            job.max_side = document_["limits"]["max_side"].get<int>();
            job.max_decoded_bytes = document_["limits"]["max_decoded_bytes"].get<std::uint64_t>();
        }
        if (is_sound("/output")) job.output = read_output();
        if (document_.contains("bakes") && document_["bakes"].is_array())
            for (std::size_t i = 0; i < document_["bakes"].size(); ++i) {
                const Origin origin =
                    origins_.empty() ? Origin{"/bakes/" + std::to_string(i), "", {}, {}, 0} : origins_[i];
                if (!is_sound(origin.at)) continue;
                Bake bake = read_bake(document_["bakes"][i], origin);
                const std::string stem =
                    product.empty() ? bake.name : product.stem().string() + origin.suffix;
                bake.file = stem + "." + bake.format;
                const std::size_t parts = std::min(origin.parts, job.bakes.size());
                join(std::span(job.bakes).last(parts), product.empty() ? job.output : product.parent_path(),
                     bake);
                job.bakes.push_back(std::move(bake));
            }
        return job;
    }

    const std::vector<Mistake>& mistakes() const { return mistakes_; }

  private:
    void add(std::string pointer, std::string message) {
        mistakes_.push_back({std::move(pointer), std::move(message)});
    }

    /// Whether the document is an object and nothing is wrong at a pointer or inside it.
    bool is_sound(const std::string& pointer) const {
        return document_.is_object() &&
               std::none_of(mistakes_.begin(), mistakes_.end(), [&](const Mistake& mistake) {
                   return (mistake.pointer + "/").starts_with(pointer + "/");
               });
    }

    /// Which bake of the document as it was written one comes from.
    struct Origin {
        std::string at;      ///< its pointer
        std::string suffix;  ///< of its name: "_brick", or "" where it stands for itself alone
        std::vector<std::string> warnings;
        std::optional<Error> error;
        std::size_t parts;  ///< bakes before it that it joins
    };

    /// Puts in the place of each bake those that it stands for, as if the job had stated them.
    void expand_bakes() {
        const Json given = std::move(document_["bakes"]);
        document_["bakes"] = Json::array();
        for (std::size_t i = 0; i < given.size(); ++i) {
            const std::string at = "/bakes/" + std::to_string(i), name = given[i]["name"];
            std::size_t parts = 0;  // those that can be joined: a source that can't be read has none
            for (Expansion& expansion : expansions(given[i])) {
                parts += expansion.suffix.empty() ? 0 : 1;
                expansion.bake["name"] =
                    name.substr(0, kLongestName - std::min(kLongestName, expansion.suffix.size())) +
                    expansion.suffix;
                origins_.push_back({at, std::move(expansion.suffix), std::move(expansion.warnings),
                                    std::move(expansion.error), 0});
                document_["bakes"].push_back(std::move(expansion.bake));
            }
            const Baker& baker = *find_baker(given[i]["kind"].get_ref<const std::string&>());
            if (parts == 0 || !baker.joiner || !baker.is_joined(given[i])) continue;
            origins_.push_back({at, "", {}, {}, parts});
            document_["bakes"].push_back(given[i]);
        }
        refuse_fields_of_sources(given);
    }

    std::vector<Expansion> expansions(const Json& bake) const {
        const Baker& baker = *find_baker(bake["kind"].get_ref<const std::string&>());
        if (!baker.expand) return {{bake, "", {}, {}}};
        try {
            return baker.expand(bake, file_queries());
        } catch (const Error& error) {
            return {{bake, "", {}, error}};
        }
    }

    /// What a source says is held against the schema as what a job says is, but it is the source's mistake.
    void refuse_fields_of_sources(const Json& given) {
        for (const Mistake& mistake : job_schema().mistakes(document_)) {
            const std::string at = mistake.pointer.substr(std::string_view("/bakes/").size());
            const std::size_t i = std::stoul(at);
            Json& bake = document_["bakes"][i];
            if (origins_[i].error) continue;
            origins_[i].error = Error(ExitCode::unreadable_input, bake.value("source", ""),
                                      "material " + shown(bake["material"]) + ": " +
                                          at.substr(at.find('/') + 1) + ": " + mistake.message);
        }
        for (std::size_t i = 0; i < origins_.size(); ++i) {
            if (!origins_[i].error) continue;
            Json& bake = document_["bakes"][i];
            const Json name = bake["name"];
            bake = given[std::stoul(origins_[i].at.substr(std::string_view("/bakes/").size()))];
            bake["name"] = name;
        }
    }

    /// Has a bake read what is baked before it, in the folder of outputs.
    static void join(std::span<const Bake> parts, const fs::path& output, Bake& bake) {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            const std::string document =
                fs::path(parts[i].file).stem().string() + "." + std::string(parts[i].baker->part_document);
            bake.parts.push_back(parts[i].name);
            bake.sources.push_back(
                {{"part." + std::to_string(i), document, "", Read::As::text}, output / document});
        }
    }

    FileQueries file_queries() const {
        return {[this](const std::string& path) {
                    if (const auto refusal = fence_.refusal(path))
                        throw Error(ExitCode::unreadable_input, path, *refusal);
                    return read_text(fence_.resolve(path), kLargestSource);
                },
                [this](const std::string& path) { return fence_.find(path); }};
    }

    fs::path read_output() {
        const std::string output = document_["output"].get<std::string>();
        if (const auto refusal = fence_.refusal(output)) add("/output", shown(output) + " " + *refusal);
        return fence_.resolve(output);
    }

    Bake read_bake(Json& json, const Origin& origin) {
        const std::string& at = origin.at;
        Bake bake;
        bake.warnings = origin.warnings;
        bake.error = origin.error;
        bake.kind = json["kind"].get<std::string>();
        bake.name = json["name"].get<std::string>();
        bake.format = json["format"].get<std::string>();
        read_pixel(json, at, bake);
        bake.certify = read_certify(json["certify"].get<std::string>());
        bake.baker = find_baker(bake.kind);
        read_accuracy(json, at, bake);
        if (origin.parts > 0) {  // whose certificates are all that there is to certify
            bake.baker = bake.baker->joiner;
            bake.accuracy = {"production"};
            bake.certify = Certify::none;
        }
        check_name(bake.name, at);
        if (!bake.error)
            for (const Mistake& mistake : bake.baker->check(json)) add(at + mistake.pointer, mistake.message);
        bake.json = json;
        bake.params = json;
        bake.params.erase("kind");
        bake.params.erase("name");
        if (!bake.error)
            for (const Read& read : bake.baker->reads(json)) read_source(read, at, bake);
        if (bake.baker->expand) {  // a base name is no file that is read
            const fs::path source(bake.params["source"].get<std::string>());
            if (source.is_absolute()) bake.params["source"] = source.filename().string();
        }
        return bake;
    }

    /// "auto" gives way to what it stands for: records say what was stored.
    void read_pixel(Json& json, const std::string& at, Bake& bake) {
        try {
            bake.pixel_stated = json["pixel"] != "auto";
            bake.pixel = settle_pixel(bake.format, json["pixel"].get<std::string>());
            if (!find_format(bake.format)->is_document()) json["pixel"] = pixel_name(bake.pixel);
        } catch (const Error& error) {
            add(at + "/pixel", error.message());
        }
    }

    static Certify read_certify(const std::string& name) {
        return name == "none" ? Certify::none : name == "full" ? Certify::full : Certify::sampled;
    }

    void read_accuracy(Json& json, const std::string& at, Bake& bake) {
        const bool own = json.contains("accuracy");
        if (!own && is_sound("/accuracy")) json["accuracy"] = document_["accuracy"];
        if (!json.contains("accuracy")) return;
        const Json& accuracy = json["accuracy"];
        if (accuracy.is_string()) {
            bake.accuracy = {accuracy.get<std::string>()};
            return;
        }
        bake.accuracy = {"", accuracy["max_error"].get<double>(), accuracy.value("as", "") == "sampled"};
        if (bake.certify == Certify::none)
            add(at + "/certify",
                std::string("found \"none\", but ") + (own ? "this bake" : "the job") +
                    " states a max_error, which takes a certificate to check; allowed: \"sampled\", "
                    "\"full\", or an accuracy by name");
    }

    void check_name(const std::string& name, const std::string& at) {
        const auto [earlier, is_new] = names_.emplace(name, at);
        if (!is_new)
            add(at + "/name", "found " + shown(name) + ", the name of " + earlier->second +
                                  " too; names differ, "
                                  "because each names its own product");
    }

    void read_source(const Read& read, const std::string& at, Bake& bake) {
        if (read.path.starts_with(kBuiltinScheme)) {
            bake.sources.push_back({read, {}});
            return;
        }
        const std::string key = read.field.substr(0, read.field.find('.'));  // "source" of "source.px" too
        const Place place = place_of(read.path);
        if (const auto refusal = fence_.refusal(place.file)) {
            add(at + "/" + key, shown(read.path) + " " + *refusal);
            return;
        }
        Source source{read, fence_.resolve(place.file), place.image};
        if (fs::path(place.file).is_absolute()) {  // only trusted paths are; a record holds no absolute path
            source.read.path = place.name();
            bake.params[key] = place_of(bake.json[key].get<std::string>()).name();
        }
        bake.sources.push_back(std::move(source));
    }

    Json document_;
    Fence fence_;
    std::vector<Mistake> mistakes_;
    std::map<std::string, std::string> names_;  ///< name -> pointer of its bake
    std::vector<Origin> origins_;               ///< of each bake; none where the document isn't sound
};

std::vector<fs::path> declared_roots(const Json& document) {
    std::vector<fs::path> roots;
    if (!document.is_object() || !document.contains("roots") || !document["roots"].is_array()) return roots;
    for (const Json& root : document["roots"])
        if (root.is_string()) roots.emplace_back(root.get<std::string>());
    return roots;
}

/// How the user knows a place: the longest pointer of the list that leads there.
std::string place_name(const OneShot& command, const std::string& pointer) {
    std::string best = pointer;
    std::size_t longest = 0;
    for (const auto& [known, name] : command.places)
        if (known.size() > longest && (pointer + "/").starts_with(known + "/")) {
            longest = known.size();
            best = name;
        }
    return best;
}

/// A product, record or manifest must not replace a file that the job reads, nor the job itself.
std::vector<Mistake> overwrites(const Job& job) {
    std::map<fs::path, std::string> kept;  // what stands at a path that must stay
    const auto keep = [&](const fs::path& path, std::string what) {
        if (!path.empty()) kept.emplace(fs::weakly_canonical(path), std::move(what));
    };
    keep(job.file, "the job file");
    for (const Bake& bake : job.bakes)
        for (const Source& source : bake.sources)
            if (bake.parts.empty() ||
                &source == &bake.sources.front())  // the others are other bakes' products
                keep(source.file, "the source of bake \"" + bake.name + "\"");

    std::vector<Mistake> mistakes;
    const auto write = [&](const std::string& file, const std::string& pointer) {
        const auto found = kept.find(fs::weakly_canonical(job.output / file));
        if (found != kept.end())
            mistakes.push_back({pointer, "would write " + file + " over " + found->second +
                                             "; choose another name, format or output folder"});
    };
    for (std::size_t i = 0; i < job.bakes.size(); ++i) {
        const Bake& bake = job.bakes[i];
        const std::string pointer = "/bakes/" + std::to_string(i) + "/name";
        write(bake.file, pointer);
        if (job.record == Record::sidecar) write(bake.file + ".json", pointer);
        if (bake.baker && bake.baker->images)
            for (const std::string& image : bake.baker->images(bake.json))
                write(image_file(bake, image), pointer);
        if (bake.baker && bake.baker->documents)
            for (const std::string& suffix : bake.baker->documents(bake.json, {}))
                if (document_file(bake, suffix) != bake.file) write(document_file(bake, suffix), pointer);
    }
    if (job.record == Record::manifest) write("manifest.json", "/output");
    return mistakes;
}

}  // namespace

std::string image_file(const Bake& bake, const std::string& image) {
    std::string file = fs::path(bake.file).stem().string();
    return file.append("_").append(image).append(".").append(picture_format(bake.format).name);
}

std::string document_file(const Bake& bake, const std::string& suffix) {
    return fs::path(bake.file).stem().string() + "." + suffix;
}

JobError::JobError(ExitCode code, std::vector<Mistake> mistakes)
    : Error(code, "", all_lines(mistakes)), mistakes_(std::move(mistakes)) {}

Job load(const fs::path& file, const std::vector<fs::path>& roots) {
    Json document = parse_json(read_text(file), file.string());
    std::vector<fs::path> all_roots = declared_roots(document);
    for (const fs::path& root : roots) all_roots.push_back(fs::absolute(root));

    Reading reading(std::move(document), Fence(file.parent_path(), all_roots));
    Job job = reading.read({});
    job.file = file;
    std::vector<Mistake> mistakes = reading.mistakes();
    if (mistakes.empty()) mistakes = overwrites(job);
    if (mistakes.empty()) return job;
    for (Mistake& mistake : mistakes) mistake.pointer = file.string() + "#" + mistake.pointer;
    throw JobError(ExitCode::invalid_job, std::move(mistakes));
}

Job from_document(Json document, const OneShot& command) {
    Reading reading(std::move(document), Fence::open());
    Job job = reading.read(command.output);
    job.output = command.output.parent_path();
    job.record = Record::sidecar;
    std::vector<Mistake> mistakes = reading.mistakes();
    if (mistakes.empty()) mistakes = overwrites(job);
    if (mistakes.empty()) return job;
    for (Mistake& mistake : mistakes) mistake.pointer = place_name(command, mistake.pointer);
    throw JobError(ExitCode::usage, std::move(mistakes));
}

}  // namespace pbrbake::job

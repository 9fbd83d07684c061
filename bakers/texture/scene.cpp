// glTF 2.0: materials, textures and images are referred to by their indices.

#include "bakers/texture/scene.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <set>

#include "bakers/parse/gltf_file.hpp"
#include "bakers/parse/materials.hpp"
#include "bakers/texture/gltf_buffers.hpp"
#include "bakers/texture/gltf_document.hpp"

namespace pbrbake::texture {
namespace {

constexpr const char* kSpecularGloss = "KHR_materials_pbrSpecularGlossiness";
constexpr const char* kTransform = "KHR_texture_transform";

using parse::JsonFields;

/// Calls visit(key, info) for each texture that a material refers to: glTF and its extensions call all of
/// them "…Texture".
void for_each_texture(Json& json, const std::function<void(const std::string& key, Json& info)>& visit) {
    if (!json.is_object()) return;
    for (auto& [key, value] : json.items()) {
        if (key.ends_with("Texture") && value.is_object() && value.contains("index")) visit(key, value);
        for_each_texture(value, visit);
    }
}

Json member(const Json& json, const char* key) {
    return json.is_object() && json.contains(key) ? json[key] : Json();
}

bool is_specular_gloss(const Json& material) {
    return member(member(material, "extensions"), kSpecularGloss).is_object();
}

/// A buffer or an image that stays in use, and is written beside the document.
struct Kept {
    std::string list;  ///< "buffers" or "images"
    std::size_t index;
    std::string path;                ///< beside the source; "": the source holds it itself
    std::string suffix;              ///< of the file that it becomes
    std::vector<Stretch> stretches;  ///< of a buffer; none: it stays whole

    /// In the inputs.
    std::string field() const { return list + "." + std::to_string(index); }
};

class Scene {
  public:
    explicit Scene(const Inputs& inputs)
        : source_(inputs.at("source")), gltf_(parse::parse_gltf(source_.bytes, source_.name)) {
        JsonFields(document(), source_.name).objects("textures");  // refuses what is no list
        std::size_t part = 0;
        for (Json& material : document()["materials"])
            if (is_specular_gloss(material)) {
                const auto input = inputs.find("part." + std::to_string(part++));
                replace(material, input == inputs.end() ? nullptr : &input->second);
            }
        if (has_known_extensions()) drop_unused();
        if (names_views_plainly(document())) drop_unused_bytes();
        list_extensions();
        find_kept("buffers");
        find_kept("images");
    }

    const std::vector<Kept>& kept() const { return kept_; }

    Product product(const Inputs& inputs, const std::string& file) {
        const std::string stem = file.substr(0, file.find_last_of('.'));
        Product product;
        for (const Kept& kept : kept_)
            product.documents.push_back({kept.suffix, nullptr, bytes_of(kept, inputs)});
        for (const Kept& kept : kept_) {
            if (!kept.stretches.empty()) describe_stretches(kept.stretches, kept.index, document());
            document()[kept.list][kept.index]["uri"] = uri_of(stem + "." + kept.suffix);
        }
        product.documents.insert(product.documents.begin(), {"gltf", std::move(document()), ""});
        return product;
    }

  private:
    Json& document() { return gltf_.json; }

    std::string bytes_of(const Kept& kept, const Inputs& inputs) const {
        parse::GltfBytes own;
        std::span<const std::byte> bytes;
        if (kept.path.empty()) {
            own = parse::gltf_buffer(gltf_, kept.index, source_.name);
            bytes = own.own();
        } else {
            const auto input = inputs.find(kept.field());
            if (input == inputs.end())
                throw parse::malformed(source_.name, 0,
                                       "names the file \"" + kept.path + "\", which is not there");
            bytes = input->second.bytes;
        }
        if (kept.stretches.empty()) return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
        const Stretch& last = kept.stretches.back();
        if (last.from + last.size > bytes.size())
            throw parse::malformed(source_.name, 0,
                                   "reads " + std::to_string(last.from + last.size) +
                                       " bytes of the file \"" + kept.path + "\", which has " +
                                       std::to_string(bytes.size()));
        return stretch_bytes(kept.stretches, bytes);
    }

    /// The baked material over the old one's name, extras and other extensions. Its textures are read where
    /// those were that they come from, with the same sampler. Null: what it will be isn't known yet.
    void replace(Json& material, const SourceImage* part) {
        const Json old = material;
        for (const char* key :
             {"pbrMetallicRoughness", "normalTexture", "occlusionTexture", "emissiveTexture",
              "emissiveFactor", "alphaMode", "alphaCutoff", "doubleSided"})
            material.erase(key);
        for (const char* key : {kSpecularGloss, "KHR_materials_ior", "KHR_materials_specular",
                                "KHR_materials_emissive_strength"})
            material["extensions"].erase(key);
        if (!part) return;
        const std::string text(reinterpret_cast<const char*>(part->bytes.data()), part->bytes.size());
        const Json gltf = parse::parse_json_source(text, part->name)["gltf"];
        const std::string name = part->name.substr(part->name.find_last_of("/\\") + 1);
        const std::string stem = name.substr(0, name.size() - std::string_view(kPartDocument).size() - 1);
        Json baked = gltf["material"];
        std::map<std::size_t, std::size_t> textures;  // by image of the part
        for_each_texture(baked, [&](const std::string& key, Json& info) {
            const Json like = origin_of(key, old);
            const std::size_t image = info["index"].get<std::size_t>();
            if (!textures.contains(image))
                textures[image] =
                    add_texture(stem + "_" + gltf["images"][image].get<std::string>() + ".png", like);
            info["index"] = textures[image];
            place(like, info);
        });
        material.update(baked, true);
        if (material["extensions"].empty()) material.erase("extensions");
    }

    /// The old texture that one of the baked material's comes from; null for none.
    static Json origin_of(const std::string& key, const Json& old) {
        if (key == "normalTexture" || key == "occlusionTexture" || key == "emissiveTexture")
            return member(old, key.c_str());
        const Json gloss = member(member(old, "extensions"), kSpecularGloss);
        const Json diffuse = member(gloss, "diffuseTexture");
        return diffuse.is_null() ? member(gloss, "specularGlossinessTexture") : diffuse;
    }

    /// Texture coordinates and their transform as another has them.
    static void place(const Json& like, Json& info) {
        if (!like.is_object()) return;
        if (like.contains("texCoord")) info["texCoord"] = like["texCoord"];
        const Json transform = member(member(like, "extensions"), kTransform);
        info.erase("extensions");
        if (!transform.is_null()) info["extensions"][kTransform] = transform;
    }

    std::size_t add_texture(const std::string& file, const Json& like) {
        Json& textures = document()["textures"];
        Json texture{{"source", document()["images"].size()}};
        if (like.is_object()) {
            const auto index = JsonFields(like, source_.name).index("index", textures.size());
            if (index && textures[*index].contains("sampler"))
                texture["sampler"] = textures[*index]["sampler"];
        }
        document()["images"].push_back({{"uri", uri_of(file)}, {"mimeType", "image/png"}});
        textures.push_back(std::move(texture));
        baked_uris_.insert(uri_of(file));
        return textures.size() - 1;
    }

    /// Other extensions of the document may refer to textures and images by index.
    bool has_known_extensions() {
        const Json extensions = member(document(), "extensions");
        static const std::set<std::string> kKnown{"KHR_lights_punctual", "KHR_materials_variants"};
        return !extensions.is_object() || std::ranges::all_of(extensions.items(), [](const auto& item) {
            return kKnown.contains(item.key());
        });
    }

    /// Keeps the elements that `users` refer to, which are indices in the list, and moves them up.
    void keep(const char* list_name, const std::vector<Json*>& users) {
        if (!document().contains(list_name)) return;
        Json& list = document()[list_name];
        std::map<std::size_t, std::size_t> moved;
        for (const Json* user : users) {
            if (!user->is_number_unsigned() || user->get<std::size_t>() >= list.size())
                throw parse::malformed(
                    source_.name, 0,
                    std::string("refers to an element of \"") + list_name + "\" that isn't there");
            moved[user->get<std::size_t>()] = 0;
        }
        Json kept = Json::array();
        for (auto& [from, to] : moved) {
            to = kept.size();
            kept.push_back(list[from]);
        }
        for (Json* user : users) *user = moved[user->get<std::size_t>()];
        list = std::move(kept);
        if (list.empty()) document().erase(list_name);
    }

    void drop_unused() {
        std::vector<Json*> textures, images;
        for (Json& material : document()["materials"])
            for_each_texture(material,
                             [&](const std::string&, Json& info) { textures.push_back(&info["index"]); });
        keep("textures", textures);
        if (document().contains("textures"))
            for (Json& texture : document()["textures"]) {
                if (texture.contains("source")) images.push_back(&texture["source"]);
                if (texture.contains("extensions"))
                    for (auto& [name, extension] : texture["extensions"].items())
                        if (extension.is_object() && extension.contains("source"))
                            images.push_back(&extension["source"]);
            }
        keep("images", images);
    }

    /// Buffers that held pictures alone go, and of others what held them.
    void drop_unused_bytes() {
        const JsonFields root(document(), source_.name);
        const std::vector<JsonFields> views = root.objects("bufferViews"), all = root.objects("buffers");
        for (const JsonFields& view : views) parse::gltf_view(view, all);  // named as the source has them
        keep("bufferViews", view_users(document()));
        std::vector<Json*> buffers;
        if (document().contains("bufferViews"))
            for (Json& view : document()["bufferViews"]) buffers.push_back(&view["buffer"]);
        is_cut_ = buffers.size() < views.size();
        if (!is_cut_) return;
        if (std::ranges::none_of(buffers, [](const Json* index) { return *index == 0; })) gltf_.chunk = {};
        keep("buffers", buffers);
    }

    void list_extensions() {
        std::set<std::string> found;
        for (const Json& material : document()["materials"]) find_extensions(material, found);
        for (const char* key : {"extensionsUsed", "extensionsRequired"}) {
            Json names = Json::array();
            for (const Json& name : member(document(), key))
                if (name != kSpecularGloss) names.push_back(name);
            if (std::string_view(key) == "extensionsUsed")
                for (const std::string& name : found)
                    if (std::ranges::find(names, Json(name)) == names.end()) names.push_back(name);
            document().erase(key);
            if (!names.empty()) document()[key] = std::move(names);
        }
    }

    /// Buffers or images with files that aren't baked ones, and buffers of the source that are to be written.
    void find_kept(const std::string& list_name) {
        const std::vector<JsonFields> list = JsonFields(document(), source_.name).objects(list_name);
        for (std::size_t i = 0; i < list.size(); ++i) {
            const std::string uri = list[i].text({"uri"}, ""), number = std::to_string(i);
            if (is_baked(uri)) continue;
            Kept kept{list_name, i, "", i == 0 ? "bin" : number + ".bin", {}};
            if (list_name == "buffers" && is_cut_)
                kept.stretches = covered_stretches(document(), i, source_.name);
            if (uri.empty() || uri.starts_with("data:")) {
                const bool is_chunk = uri.empty() && i == 0 && !gltf_.chunk.empty();
                if (list_name == "buffers" && (is_chunk || is_cut_)) kept_.push_back(std::move(kept));
                continue;
            }
            kept.path = parse::path_of_uri(uri);
            if (const auto refusal = parse::path_refusal(kept.path))
                throw parse::malformed(list[i].place() + "/uri", 0, "\"" + kept.path + "\" " + *refusal);
            if (list_name == "images") {
                const std::size_t dot = kept.path.find_last_of("./");
                const bool has_end = dot != kept.path.npos && kept.path[dot] == '.';
                kept.suffix = "image" + number + "." + (has_end ? kept.path.substr(dot + 1) : "bin");
            }
            kept_.push_back(std::move(kept));
        }
    }

    bool is_baked(const std::string& uri) const { return baked_uris_.contains(uri); }

    const SourceImage& source_;
    parse::GltfFile gltf_;
    std::set<std::string> baked_uris_;
    bool is_cut_ = false;  ///< buffers hold more than the document still reads
    std::vector<Kept> kept_;
};

}  // namespace

bool is_scene(const Json& bake) {
    const std::string end = parse::extension_of(bake.value("source", ""));
    return (end == ".gltf" || end == ".glb") && bake.value("material", "").empty() &&
           bake.value("format", "") == "gltf";
}

std::vector<Read> scene_reads(const Json& bake) {
    return {{"source", bake["source"].get<std::string>(), "", Read::As::text}};
}

std::vector<Read> scene_files(const Inputs& inputs) {
    std::vector<Read> files;
    const Scene scene(inputs);
    for (const Kept& kept : scene.kept())
        if (!kept.path.empty()) files.push_back({kept.field(), kept.path, "", Read::As::text});
    return files;
}

std::vector<std::string> scene_documents(const Inputs& inputs) {
    std::vector<std::string> suffixes{"gltf"};
    if (!inputs.contains("source")) return suffixes;
    const Scene scene(inputs);
    for (const Kept& kept : scene.kept()) suffixes.push_back(kept.suffix);
    return suffixes;
}

Product bake_scene(const Inputs& inputs, const std::string& product_file) {
    return Scene(inputs).product(inputs, product_file);
}

}  // namespace pbrbake::texture

// Materials of a glTF file with KHR_materials_pbrSpecularGlossiness (Khronos, archived): f0 and glossiness,
// diffuse dimmed by 1 - max(f0). Normals and occlusion are core glTF 2.0.

#include "bakers/parse/gltf_file.hpp"
#include "bakers/parse/json_fields.hpp"
#include "bakers/parse/materials.hpp"

namespace pbrbake::parse {
namespace {

constexpr const char* kExtension = "KHR_materials_pbrSpecularGlossiness";
constexpr int kClampToEdge = 33071;  ///< OpenGL's, as glTF has it

class Gltf {
  public:
    Gltf(const Json& json, const std::string& file)
        : root_(json, file),
          images_(root_.objects("images")),
          textures_(root_.objects("textures")),
          samplers_(root_.objects("samplers")) {}

    MaterialFile read() const {
        MaterialFile result;
        result.format = std::string("glTF ") + kExtension;
        const std::vector<JsonFields> list = root_.objects("materials");
        if (list.size() > kMostMaterials) root_.refuse("materials", "at most 100000 materials");
        std::size_t metallic = 0;
        for (std::size_t i = 0; i < list.size(); ++i) {
            const auto extensions = list[i].object({"extensions"});
            const auto gloss = extensions ? extensions->object({kExtension}) : std::nullopt;
            if (gloss)
                result.materials.push_back(read_material(list[i], *gloss, i));
            else
                ++metallic;
        }
        if (result.materials.empty() && metallic > 0)
            throw malformed(
                root_.place(), 0,
                std::string("has no material with ") + kExtension + "; they are metallic already");
        return result;
    }

  private:
    static double unit(const JsonFields& fields, const char* key, double fallback) {
        const double value = fields.number({key}, fallback);
        if (!(value >= 0 && value <= 1)) fields.refuse(key, "a number from 0 to 1");
        return value;
    }
    static std::vector<double> colour(const JsonFields& fields, const char* key,
                                      std::vector<double> fallback) {
        std::vector<double> values = fields.numbers({key}, fallback.size()).value_or(fallback);
        for (const double value : values)
            if (!(value >= 0 && value <= 1)) fields.refuse(key, "numbers from 0 to 1");
        return values;
    }

    MaterialMap map(const JsonFields& owner, const char* key, LegacyMaterial& material) const {
        const auto info = owner.object({key});
        if (!info) return {};
        const auto index = info->index("index", textures_.size());
        if (!index) info->refuse("index", "the index of a texture, which is missing");
        const JsonFields& texture = textures_[*index];
        if (const auto sampler = texture.index("sampler", samplers_.size()))
            material.is_clamped |= samplers_[*sampler].number({"wrapS"}, 0) == kClampToEdge;
        const auto source = texture.index("source", images_.size());
        if (!source) texture.refuse("source", "the index of an image (a PNG or JPEG), which is missing");
        const JsonFields& image = images_[*source];
        const bool is_inside = is_embedded(image);
        return {is_inside ? "#/images/" + std::to_string(*source) : path_of_uri(image.text({"uri"}, "")),
                texture.place() + " (" + key + ")", 0, transform(*info), is_inside};
    }

    static UvTransform transform(const JsonFields& info) {
        UvTransform result;
        result.set = info.number({"texCoord"}, 0);
        const auto extensions = info.object({"extensions"});
        const auto given = extensions ? extensions->object({"KHR_texture_transform"}) : std::nullopt;
        if (!given) return result;
        const auto pair = [&](const char* key, glm::dvec2& value) {
            if (const auto numbers = given->numbers({key}, 2)) value = {(*numbers)[0], (*numbers)[1]};
        };
        pair("offset", result.offset);
        pair("scale", result.scale);
        result.rotation = given->number({"rotation"}, 0);
        result.set = given->number({"texCoord"}, result.set);
        return result;
    }

    LegacyMaterial read_material(const JsonFields& fields, const JsonFields& gloss, std::size_t i) const {
        LegacyMaterial material;
        material.name = fields.text({"name"}, "material " + std::to_string(i));
        material.lobe = MaterialLobe::specular_gloss;
        const std::vector<double> diffuse = colour(gloss, "diffuseFactor", {1, 1, 1, 1}),
                                  specular = colour(gloss, "specularFactor", {1, 1, 1}),
                                  emissive = colour(fields, "emissiveFactor", {0, 0, 0});
        material.diffuse_factor = {diffuse[0], diffuse[1], diffuse[2]};
        material.specular_factor = glm::dvec3(specular[0], specular[1], specular[2]);
        material.glossiness = unit(gloss, "glossinessFactor", 1);
        material.opacity_factor = diffuse[3];
        material.diffuse = map(gloss, "diffuseTexture", material);
        material.specular = map(gloss, "specularGlossinessTexture", material);
        material.normal = map(fields, "normalTexture", material);
        material.occlusion = map(fields, "occlusionTexture", material);
        if (const auto normal = fields.object({"normalTexture"}))
            material.normal_scale = normal->number({"scale"}, 1);
        if (const auto occlusion = fields.object({"occlusionTexture"}))
            material.occlusion_strength = unit(*occlusion, "strength", 1);
        material.double_sided = fields.boolean("doubleSided", false);
        read_alpha(fields, material);
        material.emissive = map(fields, "emissiveTexture", material);
        material.emissive_factor = strength(fields) * glm::dvec3(emissive[0], emissive[1], emissive[2]);
        return material;
    }

    static double strength(const JsonFields& fields) {
        const auto extensions = fields.object({"extensions"});
        const auto given =
            extensions ? extensions->object({"KHR_materials_emissive_strength"}) : std::nullopt;
        const double value = given ? given->number({"emissiveStrength"}, 1) : 1;
        if (value < 0) given->refuse("emissiveStrength", "a number that is not negative");
        return value;
    }

    static void read_alpha(const JsonFields& fields, LegacyMaterial& material) {
        const std::string mode = fields.text({"alphaMode"}, "OPAQUE");
        if (mode == "MASK")
            material.alpha = AlphaMode::mask;
        else if (mode == "BLEND")
            material.alpha = AlphaMode::blend;
        else if (mode != "OPAQUE")
            fields.refuse("alphaMode", "\"OPAQUE\", \"MASK\", \"BLEND\"");
        material.alpha_cutoff = fields.number({"alphaCutoff"}, .5);
        if (material.alpha_cutoff < 0) fields.refuse("alphaCutoff", "a number that is not negative");
    }

    JsonFields root_;
    std::vector<JsonFields> images_, textures_, samplers_;
};

}  // namespace

MaterialFile parse_gltf_materials(const Json& json, const std::string& file) {
    return Gltf(json, file).read();
}

}  // namespace pbrbake::parse

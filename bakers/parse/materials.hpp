#pragma once
// Materials of older formats as plain models: what a file says, in its own terms. Nothing is converted here.

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bakers/baker.hpp"
#include "bakers/parse/diagnostic.hpp"
#include "bakers/parse/source_paths.hpp"

namespace pbrbake::parse {

/// Texture coordinates (u, v down) of glTF to those of a picture, as KHR_texture_transform has it.
struct UvTransform {
    glm::dvec2 offset{0}, scale{1};
    double rotation = 0;  ///< radians
    double set = 0;       ///< which of a mesh's sets of coordinates: TEXCOORD_0, …

    bool operator==(const UvTransform&) const = default;
    bool is_moved_like(const UvTransform& other) const {
        return offset == other.offset && scale == other.scale && rotation == other.rotation;
    }
};

/// A picture that a material names.
struct MaterialMap {
    std::string path;  ///< as the file has it, with forward slashes; "": none
    std::string said;  ///< the statement that names it: "map_Kd"
    int line = 0;      ///< counted from 1; 0: unknown
    UvTransform transform;
    bool is_embedded = false;  ///< in the file itself; the path is where: "#/images/3"
};

/// What reflects besides the diffuse term.
enum class MaterialLobe {
    none,            ///< Lambert's
    specular_gloss,  ///< f0 and glossiness (KHR_materials_pbrSpecularGlossiness)
    blinn_phong,     ///< ks and exponent about the half vector
    phong,           ///< ks and exponent about the mirror direction
    metallic,        ///< base colour, metallic and perceptual roughness: a PBR material already
    stated,          ///< plain JSON: as `fields` says
};

enum class AlphaMode { opaque, mask, blend };

/// One material. Factors are linear and multiply their maps.
struct LegacyMaterial {
    std::string name;
    std::string id;  ///< another name it goes by; "": none
    int line = 0;
    MaterialLobe lobe = MaterialLobe::none;
    MaterialMap diffuse, specular, gloss, normal, occlusion, opacity, emissive;
    MaterialMap metallic_map, roughness_map;  ///< of metallic, in place of their factors
    glm::dvec3 diffuse_factor{1};
    std::optional<glm::dvec3> specular_factor;  ///< nothing: the file doesn't say
    std::optional<double> exponent;             ///< of a Phong lobe; multiplies its map
    double glossiness = 1;                      ///< of specular_gloss; multiplies the alpha of its map
    double metallic = 0, perceptual_roughness = 1;
    double opacity_factor = 1;
    AlphaMode alpha = AlphaMode::opaque;
    double alpha_cutoff = .5;
    std::optional<glm::dvec3> emissive_factor;  ///< nothing: 0, or 1 beside a map
    double normal_scale = 1, occlusion_strength = 1;
    bool double_sided = false;
    bool is_clamped = false;  ///< its textures end at their edges
    Json fields = nullptr;    ///< plain JSON: fields of a texture bake, but for its maps
    std::vector<Diagnostic> diagnostics;
};

struct MaterialFile {
    std::string format;  ///< "Wavefront MTL"
    std::vector<LegacyMaterial> materials;
    std::vector<Diagnostic> diagnostics;
};

/// Largest count of materials that a file may hold.
inline constexpr std::size_t kMostMaterials = 100'000;

/// The end of a file's name from its last dot on, in small letters: ".gltf". Empty for none.
std::string extension_of(std::string_view file);

/// Whether parse_materials reads files that end so: ".mtl", ".gltf", ".glb", ".dae", ".json", in any case.
bool has_material_extension(std::string_view file);

/// Reads MTL, glTF, COLLADA and plain JSON, by extension. Throws Error(unreadable_input) for what is
/// malformed, and for a file without materials.
MaterialFile parse_materials(std::span<const std::byte> bytes, const std::string& file);

/// The material of a name, or else of an id. Throws Error(unreadable_input) that lists what there is.
const LegacyMaterial& find_material(const MaterialFile& materials, const std::string& name,
                                    const std::string& file);

/// The readers behind parse_materials.
MaterialFile parse_mtl(std::string_view text, const std::string& file);
MaterialFile parse_gltf_materials(const Json& json, const std::string& file);
MaterialFile parse_collada_materials(std::string_view text, const std::string& file);
MaterialFile parse_plain_materials(const Json& json, const std::string& file);

}  // namespace pbrbake::parse

// Materials of a COLLADA document: the common profile's effects (1.4.1 specification, "Rendering"): lambert,
// phong and blinn. A channel is a colour or a texture; a texture goes by sampler, surface and image.

#include <algorithm>
#include <map>
#include <pugixml.hpp>

#include "bakers/parse/collada_document.hpp"
#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/materials.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr double kLargest = 1e4, kLargestExponent = 1e6;

/// The id that "#id" refers to.
std::string reference(std::string_view url) { return std::string(url.substr(url.starts_with('#') ? 1 : 0)); }

class Collada : ColladaDocument {
  public:
    Collada(std::string_view text, const std::string& file) : ColladaDocument(text, file) {
        for (const pugi::xml_node image : root_.child("library_images").children("image"))
            images_.emplace(image.attribute("id").value(), image);
    }

    MaterialFile read() {
        MaterialFile result;
        result.format = "COLLADA common profile";
        std::map<std::string, pugi::xml_node> effects;
        for (const pugi::xml_node effect : root_.child("library_effects").children("effect"))
            effects.emplace(effect.attribute("id").value(), effect);
        for (const pugi::xml_node node : root_.child("library_materials").children("material")) {
            LegacyMaterial& material = begin(node, result);
            read_alone(material, [&] {
                const std::string url = reference(node.child("instance_effect").attribute("url").value());
                const auto found = effects.find(url);
                if (found == effects.end())
                    throw malformed(file_, line_of(node),
                                    "names the effect " + parse::quoted(url) + ", which isn't there");
                read_effect(found->second, material);
            });
        }
        if (result.materials.empty())  // a library of effects alone
            for (const pugi::xml_node effect : root_.child("library_effects").children("effect")) {
                LegacyMaterial& material = begin(effect, result);
                read_alone(material, [&] { read_effect(effect, material); });
            }
        return result;
    }

  private:
    LegacyMaterial& begin(const pugi::xml_node& named, MaterialFile& result) const {
        if (result.materials.size() == kMostMaterials)
            throw malformed(file_, line_of(named), "is past 100000 materials");
        LegacyMaterial& material = result.materials.emplace_back();
        material.id = named.attribute("id").value();
        material.name = named.attribute("name") ? named.attribute("name").value() : material.id;
        material.line = line_of(named);
        return material;
    }

    void read_effect(const pugi::xml_node& effect, LegacyMaterial& material) {
        profile_ = effect.child("profile_COMMON");
        const pugi::xml_node technique = profile_.child("technique");
        pugi::xml_node shader;
        for (const auto& [name, lobe] :
             {std::pair("lambert", MaterialLobe::none), std::pair("phong", MaterialLobe::phong),
              std::pair("blinn", MaterialLobe::blinn_phong)})
            if (const pugi::xml_node found = technique.child(name)) {
                shader = found;
                material.lobe = lobe;
            }
        if (!shader)
            throw malformed(file_, line_of(effect),
                            "the effect " + parse::quoted(effect.attribute("id").value()) +
                                " has no lambert, phong or blinn in its common profile");
        material.diffuse_factor = channel(shader.child("diffuse"), material.diffuse).value_or(glm::dvec3(1));
        if (material.lobe != MaterialLobe::none)
            material.specular_factor = channel(shader.child("specular"), material.specular);
        if (const pugi::xml_node shininess = shader.child("shininess").child("float"))
            read_shininess(shininess, material);
        material.emissive_factor = channel(shader.child("emission"), material.emissive);
        read_transparency(shader, material);
        for (const pugi::xml_node& owner : {technique, profile_, effect}) read_bump(owner, material);
        material.double_sided =
            trimmed(technique.child("extra").child("technique").child_value("double_sided")) == "1";
    }

    static void warn(LegacyMaterial& material, std::string code, std::string message) {
        material.diagnostics.push_back(
            {Severity::warning, std::move(code), material.line, std::move(message)});
    }

    void read_shininess(const pugi::xml_node& node, LegacyMaterial& material) const {
        material.exponent = number(node, trimmed(node.child_value()), kLargestExponent);
        if (*material.exponent > 0 && *material.exponent <= 1)
            warn(material, "shininess_scale",
                 "<shininess> is " + number_text(*material.exponent) +
                     ", which may be a share of the exporter's largest exponent; read as the exponent, so "
                     "state power");
    }

    /// The alpha of <transparent> times <transparency>, as the mode "A_ONE" has it; RGB_ZERO turns it round.
    void read_transparency(const pugi::xml_node& shader, LegacyMaterial& material) {
        const pugi::xml_node transparent = shader.child("transparent");
        if (!transparent) return;
        double amount = 1;
        if (const pugi::xml_node node = shader.child("transparency").child("float"))
            amount = number(node, trimmed(node.child_value()), 1);
        const bool is_zero =
            std::string_view(transparent.attribute("opaque").value()).starts_with("RGB_ZERO");
        if (transparent.child("texture")) {
            (void)channel(transparent, material.opacity);
            material.alpha = AlphaMode::blend;
            if (is_zero)
                warn(material, "transparent", "the texture of <transparent> is RGB_ZERO; read as opacity");
            // The colour's own texture: its alpha is meant.
            if (material.opacity.path == material.diffuse.path) material.opacity = {};
            return;
        }
        const std::vector<double> rgba = numbers(transparent.child("color"));
        if (amount == 0) {
            warn(material, "transparency",
                 "<transparency> 0 would hide it; read as opaque, which exporters mean by it");
            return;
        }
        const double value = is_zero ? (rgba[0] + rgba[1] + rgba[2]) / 3 : rgba[3];
        material.opacity_factor = std::clamp(is_zero ? 1 - value * amount : value * amount, 0., 1.);
        if (material.opacity_factor < 1) material.alpha = AlphaMode::blend;
    }

    void read_bump(const pugi::xml_node& owner, LegacyMaterial& material) {
        for (const pugi::xml_node extra : owner.children("extra"))
            for (const pugi::xml_node technique : extra.children("technique"))
                for (const char* name : {"bump", "normal"})
                    if (const pugi::xml_node bump = technique.child(name);
                        bump && material.normal.path.empty())
                        (void)channel(bump, material.normal);
    }

    double number(const pugi::xml_node& node, std::string_view word, double largest) const {
        const auto value = finite_number(word);
        if (!value || *value < 0 || *value > largest)
            throw malformed(file_, line_of(node),
                            "found " + parse::quoted(word) + " in <" + node.name() +
                                ">; allowed: numbers from 0 to " + number_text(largest));
        return *value;
    }

    /// Four numbers of a colour; alpha 1 where there are three.
    std::vector<double> numbers(const pugi::xml_node& colour) const {
        const std::string text = colour.child_value();
        const std::vector<std::string_view> lines = split_lines(text);
        Words words(lines, 0, file_);
        std::vector<double> list;
        while (const auto word = words.next()) list.push_back(number(colour, *word, kLargest));
        if (list.size() == 3) list.push_back(1);
        if (list.size() != 4)
            throw malformed(file_, line_of(colour),
                            "found " + std::to_string(list.size()) + " numbers in <color>; allowed: 4");
        return list;
    }

    /// A channel's colour, or 1 and its texture in `map`. Nothing where the channel is absent.
    std::optional<glm::dvec3> channel(const pugi::xml_node& node, MaterialMap& map) const {
        if (const pugi::xml_node texture = node.child("texture")) {
            map = texture_of(texture, node.name());
            return glm::dvec3(1);
        }
        if (!node.child("color")) return {};
        const std::vector<double> rgba = numbers(node.child("color"));
        return glm::dvec3(rgba[0], rgba[1], rgba[2]);
    }

    pugi::xml_node parameter(const std::string& sid) const {
        for (const pugi::xml_node node : profile_.children("newparam"))
            if (sid == node.attribute("sid").value()) return node;
        return {};
    }

    /// Sampler, surface and image, any of which an exporter may leave out (1.5 has no surfaces).
    MaterialMap texture_of(const pugi::xml_node& texture, const char* said) const {
        std::string id = texture.attribute("texture").value();
        if (const pugi::xml_node sampler = parameter(id).child("sampler2D")) {
            const pugi::xml_node image = sampler.child("instance_image");
            id = image ? reference(image.attribute("url").value())
                       : std::string(trimmed(sampler.child_value("source")));
        }
        if (const pugi::xml_node surface = parameter(id).child("surface"))
            id = trimmed(surface.child_value("init_from"));
        const auto image = images_.find(id);
        if (image == images_.end())
            throw malformed(file_, line_of(texture),
                            "names the image " + parse::quoted(id) + ", which isn't there");
        const pugi::xml_node from = image->second.child("init_from");
        const std::string_view uri =
            trimmed(from.child("ref") ? from.child_value("ref") : from.child_value());
        return {path_of_uri(uri), std::string("<").append(said).append(">"), line_of(from), {}};
    }

    pugi::xml_node profile_;
    std::map<std::string, pugi::xml_node> images_;
};

}  // namespace

MaterialFile parse_collada_materials(std::string_view text, const std::string& file) {
    return Collada(text, file).read();
}

}  // namespace pbrbake::parse

#include "bakers/texture/gloss.hpp"

#include <algorithm>
#include <optional>

#include "bakers/parse/materials.hpp"
#include "bakers/texture/names.hpp"
#include "bakers/texture/picture.hpp"

namespace pbrbake::texture {
namespace {

struct Place {
    GlossIn in;
    const char* field;
    int channel;
    bool is_guessed;  ///< with gloss_in auto
};
constexpr std::array kPlaces{
    Place{GlossIn::gloss, "gloss", 0, true},
    Place{GlossIn::automatic, "metallic_roughness", 1, true},
    Place{GlossIn::specular_alpha, "specular", 3, true},
    Place{GlossIn::diffuse_alpha, "diffuse", 3, false},
    Place{GlossIn::normal_alpha, "normal", 3, false},
    Place{GlossIn::metallic_alpha, "metallic", 3, false},
};

/// A map of gloss or of metallic and roughness, in which gloss_channel chooses; else an alpha.
bool is_map(GlossIn in) { return in == GlossIn::gloss || in == GlossIn::automatic; }

bool holds_exponents(GlossIs is) { return is == GlossIs::power || is == GlossIs::power_log2; }

/// Stated, or of a glTF material whose specular picture stores no alpha: it is 1
/// (KHR_materials_pbrSpecularGlossiness).
bool is_constant(const TextureParams& params, const Inputs& inputs) {
    const Picture specular = picture_of(inputs, "specular");
    const std::string end = parse::extension_of(params.source);
    return params.gloss_in == GlossIn::constant ||
           (params.gloss_in == GlossIn::specular_alpha && (end == ".gltf" || end == ".glb") && specular &&
            specular.channels() <= 3);
}

std::optional<Place> find_place(const TextureParams& params, const Inputs& inputs) {
    const bool is_auto = params.gloss_in == GlossIn::automatic,
               has_channel = params.gloss_channel != Channel::automatic;
    for (Place place : kPlaces) {
        if (is_auto ? !place.is_guessed : params.gloss_in != place.in) continue;
        const Picture picture = picture_of(inputs, place.field);
        if (!picture) continue;
        if (is_map(place.in) && has_channel) {
            place.channel = index_of(params.gloss_channel);
            require_channel(inputs, place.field, place.channel, "gloss_channel",
                            enum_name(params.gloss_channel));
        }
        if (!is_auto) require_channel(inputs, place.field, place.channel, "gloss_in", enum_name(place.in));
        if (!is_auto || is_map(place.in)) return place;
        // An alpha that is the same everywhere was added by a file format; a stated exponent is the set's,
        // unless gloss_is says that the alpha has exponents too.
        const bool is_wanted = params.power <= 0 || holds_exponents(params.gloss_is);
        if (is_wanted && picture.channels() > place.channel && picture.varies(place.channel)) return place;
    }
    if (is_auto || params.gloss_in == GlossIn::none) return {};
    throw Error(
        ExitCode::unreadable_input, "",
        "gloss_in: found \"" + std::string(enum_name(params.gloss_in)) + "\", but that map is absent");
}

bool is_phong(Model model) { return model == Model::blinn_phong || model == Model::phong; }

/// Of auto: the map's own name first, as it is the best that is known.
void assume(const TextureParams& params, GlossReading& gloss) {
    if (gloss.in == GlossIn::gloss) gloss.is = gloss_named(params.gloss);
    if (gloss.is != GlossIs::automatic) {
        gloss.reason = "the file's name";
    } else if (is_phong(params.model) && gloss.in != GlossIn::constant) {
        gloss.is = GlossIs::power;
        gloss.reason = "model " + std::string(enum_name(params.model)) + " has exponents";
        gloss.warning = std::string(enum_name(gloss.in)) +
                        " varies and is read as the exponent over power_scale; state gloss_is (power, "
                        "power_log2, smoothness, ...) and power_scale, or gloss_in none if it is no gloss";
    } else {
        gloss.is =
            params.model == Model::metallic_roughness ? GlossIs::perceptual_roughness : GlossIs::smoothness;
        gloss.reason = "model " + std::string(enum_name(params.model));
    }
}

}  // namespace

GlossIs gloss_named(const std::string& path) {
    for (const std::string& word : words_of(path)) {
        if (word == "rough" || word == "roughness") return GlossIs::perceptual_roughness;
        if (word == "gloss" || word == "glossiness" || word == "smooth" || word == "smoothness")
            return GlossIs::smoothness;
    }
    return GlossIs::automatic;
}

GlossReading find_gloss(const TextureParams& params, const Inputs& inputs) {
    GlossReading gloss;
    const bool is_everywhere = is_constant(params, inputs);
    const std::optional<Place> place = is_everywhere ? std::nullopt : find_place(params, inputs);
    if (params.gloss_channel != Channel::automatic && !(place && is_map(place->in)))
        throw Error(ExitCode::unreadable_input, "",
                    "gloss_channel: found \"" + std::string(enum_name(params.gloss_channel)) +
                        "\", but gloss is read from no map of its own; state gloss, or leave it auto");
    if (!place && !is_everywhere) {
        gloss.reason = params.power > 0 ? "stated by power" : "nothing";
        if (params.power <= 0)
            gloss.warning = "there is no gloss map and no power; perceptual roughness .5 is assumed";
        return gloss;
    }
    gloss.in = GlossIn::constant;
    if (place) {
        gloss.in = place->in;
        gloss.field = place->field;
        gloss.channel = place->channel;
    }
    gloss.is = params.gloss_is;
    gloss.reason = "stated by gloss_is";
    if (gloss.is == GlossIs::automatic) assume(params, gloss);
    return gloss;
}

}  // namespace pbrbake::texture

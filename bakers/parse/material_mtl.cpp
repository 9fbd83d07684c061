// Wavefront MTL ("Material Library File", Wavefront Technologies 1995): diffuse Kd, Blinn-Phong ks and
// exponent Ns about the half vector. Factors multiply their maps. Keywords count in any case, as writers
// vary. Pr and Pm are of Exocortex's PBR extension.

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "bakers/parse/materials.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr double kLargest = 1e4, kLargestExponent = 1e6;
constexpr std::string_view kBlanks = " \t";

std::string lower(std::string_view word) {
    std::string text(word);
    std::ranges::transform(text, text.begin(),
                           [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    return text;
}

/// Takes the first word off a line.
std::string_view take_word(std::string_view& line) {
    line = trimmed(line);
    const std::size_t end = std::min(line.find_first_of(kBlanks), line.size());
    const std::string_view word = line.substr(0, end);
    line = trimmed(line.substr(end));
    return word;
}

/// Arguments that a texture option takes at least and at most.
struct MapOption {
    std::string_view name;
    int least, most;
};
constexpr std::array<MapOption, 13> kMapOptions{{{"-blendu", 1, 1},
                                                 {"-blendv", 1, 1},
                                                 {"-bm", 1, 1},
                                                 {"-boost", 1, 1},
                                                 {"-cc", 1, 1},
                                                 {"-clamp", 1, 1},
                                                 {"-imfchan", 1, 1},
                                                 {"-mm", 2, 2},
                                                 {"-o", 1, 3},
                                                 {"-s", 1, 3},
                                                 {"-t", 1, 3},
                                                 {"-texres", 1, 1},
                                                 {"-type", 1, 1}}};

class Mtl {
  public:
    Mtl(std::string_view text, const std::string& file) : file_(file) {
        result_.format = "Wavefront MTL";
        const std::vector<std::string_view> lines = split_lines(text);
        std::string joined;  // a backslash at the end goes on in the next line
        for (std::size_t i = 0; i < lines.size(); ++i) {
            std::string_view line = trimmed(lines[i]);
            if (joined.empty()) line_ = static_cast<int>(i) + 1;
            if (line.ends_with('\\') && i + 1 < lines.size()) {
                joined.append(line.substr(0, line.size() - 1)).append(" ");
                continue;
            }
            joined += line;
            read_line(joined);
            joined.clear();
        }
    }

    /// Of materials of one name the first.
    MaterialFile result() {
        std::set<std::string> names;
        std::erase_if(result_.materials,
                      [&](const LegacyMaterial& each) { return !names.insert(each.name).second; });
        return std::move(result_);
    }

  private:
    void read_line(std::string_view line) {
        if (trimmed(line).starts_with('#')) return;
        said_ = take_word(line);
        const std::string key = lower(said_);
        if (key.empty()) return;
        if (key == "newmtl") {
            begin(line);
        } else if (result_.materials.empty()) {
            throw malformed(file_, line_, "found " + parse::quoted(key) + " before the first newmtl");
        } else {
            read_alone(material(), [&] {
                if (!read_map(key, line)) read_value(key, line);
            });
        }
    }

    LegacyMaterial& material() { return result_.materials.back(); }

    void begin(std::string_view name) {
        if (name.empty()) throw malformed(file_, line_, "found newmtl without a name");
        if (result_.materials.size() == kMostMaterials)
            throw malformed(file_, line_, "is past 100000 materials");
        result_.materials.emplace_back();
        material().name = name;
        material().line = line_;
        material().lobe = MaterialLobe::blinn_phong;
        states_d_ = false;
        if (!names_.insert(material().name).second)
            result_.diagnostics.push_back(
                {Severity::warning, "twice", line_,
                 "newmtl " + parse::quoted(name) + " is there twice; the first counts"});
    }

    void warn(std::string code, std::string message) {
        material().diagnostics.push_back({Severity::warning, std::move(code), line_, std::move(message)});
    }

    double number(std::string_view key, std::string_view word, double largest) const {
        const auto value = number_of(word);
        if (!value || *value < 0 || *value > largest)
            throw malformed(file_, line_,
                            "found " + parse::quoted(word) + " as " + parse::quoted(key) +
                                "; allowed: a number from 0 to " + number_text(largest));
        return *value;
    }

    /// R G B, or one number for all three. Nothing for spectral files and CIE XYZ, which are told of.
    std::optional<glm::dvec3> colour(std::string_view key, std::string_view line) {
        const std::string_view first = take_word(line);
        if (lower(first) == "spectral" || lower(first) == "xyz") {
            warn("colour_kind", std::string(key) + " " + std::string(first) + " isn't read; left out");
            return {};
        }
        const double red = number(key, first, kLargest);
        if (line.empty()) return glm::dvec3(red);
        const double green = number(key, take_word(line), kLargest);
        return glm::dvec3(red, green, number(key, take_word(line), kLargest));
    }

    void read_value(const std::string& key, std::string_view line) {
        if (key == "kd") {
            material().diffuse_factor = colour(key, line).value_or(glm::dvec3(1));
        } else if (key == "ks") {
            material().specular_factor = colour(key, line);
        } else if (key == "ke") {
            material().emissive_factor = colour(key, line);
        } else if (key == "ns") {
            material().exponent = number(key, take_word(line), kLargestExponent);
        } else if (key == "d") {
            std::string_view word = take_word(line);
            if (word == "-halo") {
                warn("halo", "d -halo fades with the angle; read as d");
                word = take_word(line);
            }
            set_opacity(number(key, word, 1));
            states_d_ = true;
        } else if (key == "tr") {
            set_transparency(number(key, take_word(line), 1));
        } else if (key == "illum") {
            set_illumination(take_word(line));
        } else if (key == "pr" || key == "pm") {
            material().lobe = MaterialLobe::metallic;
            (key == "pr" ? material().perceptual_roughness : material().metallic) =
                number(key, take_word(line), 1);
        }  // Ka, Ni, Tf, sharpness and the like have no part in what a surface reflects
    }

    void set_opacity(double opacity) {
        material().opacity_factor = opacity;
        if (opacity < 1) material().alpha = AlphaMode::blend;
    }

    /// Writers disagree whether Tr is 1 - d or d; one beside d says nothing new.
    void set_transparency(double transparency) {
        if (states_d_ && material().opacity_factor != 1 - transparency &&
            std::abs(material().opacity_factor - (1 - transparency)) > 1e-3)
            warn("transparency", "Tr " + number_text(transparency) + " isn't 1 - d; d counts");
        if (!states_d_) set_opacity(1 - transparency);
    }

    void set_illumination(std::string_view word) {
        const double model = number("illum", word, 10);
        if (model == 0) warn("unlit", "illum 0 is unlit; converted as a diffuse surface");
        if (model < 2 && material().lobe != MaterialLobe::metallic) material().lobe = MaterialLobe::none;
        if (model == 4 || model == 6 || model == 7 || model == 9)
            warn("glass", "illum " + std::string(word) + " is glass; what passes through it is left out");
    }

    bool read_map(const std::string& key, std::string_view line) {
        static const std::array<std::pair<std::string_view, MaterialMap LegacyMaterial::*>, 10> kMaps{
            {{"map_kd", &LegacyMaterial::diffuse},
             {"map_ks", &LegacyMaterial::specular},
             {"map_ns", &LegacyMaterial::gloss},
             {"map_ke", &LegacyMaterial::emissive},
             {"map_d", &LegacyMaterial::opacity},
             {"map_pm", &LegacyMaterial::metallic_map},
             {"map_pr", &LegacyMaterial::roughness_map},
             {"map_bump", &LegacyMaterial::normal},
             {"bump", &LegacyMaterial::normal},
             {"norm", &LegacyMaterial::normal}}};
        const auto found = std::ranges::find(kMaps, key, [](const auto& entry) { return entry.first; });
        if (found == kMaps.end())
            return key.starts_with("map_") || key == "disp" || key == "decal" || key == "refl";
        MaterialMap& map = material().*found->second;
        // norm says that it holds normals, which map_bump may or may not.
        if (key != "norm" && lower(map.said) == "norm") return true;
        map = {{}, said_, line_, {}};
        map.path = after_options(map, line);
        std::ranges::replace(map.path, '\\', '/');
        if (map.path.empty())
            throw malformed(file_, line_, "found " + parse::quoted(key) + " without a file");
        if (key == "map_d") material().alpha = AlphaMode::blend;
        if (key == "map_pr" || key == "map_pm") material().lobe = MaterialLobe::metallic;
        return true;
    }

    /// Reads the options of a map; what is left of its line is the file, whose name may hold blanks.
    std::string_view after_options(MaterialMap& map, std::string_view line) {
        glm::dvec3 offset(0), scale(1);
        while (line.starts_with('-')) {
            std::string_view rest = line;
            const std::string name = lower(take_word(rest));
            const auto option = std::ranges::find(kMapOptions, name, &MapOption::name);
            if (option == kMapOptions.end()) break;  // a file may begin with a dash
            const std::vector<std::string_view> words = arguments(*option, rest);
            if (name == "-clamp" && lower(words[0]) == "on") material().is_clamped = true;
            if (name == "-bm") material().normal_scale = signed_number(name, words[0]);
            if (name == "-s" || name == "-o")
                for (std::size_t i = 0; i < words.size(); ++i)
                    (name == "-s" ? scale : offset)[static_cast<int>(i)] = signed_number(name, words[i]);
            if (name == "-imfchan" || name == "-mm" || name == "-cc" || name == "-t")
                warn("texture_option", map.said + " " + name + " isn't applied");
            line = rest;
        }
        map.transform = downward(offset, scale);
        return line;
    }

    /// The words of an option; those that it may leave out are numbers.
    std::vector<std::string_view> arguments(const MapOption& option, std::string_view& rest) const {
        std::vector<std::string_view> words;
        for (int i = 0; i < option.most; ++i) {
            std::string_view after = rest;
            const std::string_view word = take_word(after);
            if (i >= option.least && !number_of(word)) break;
            if (word.empty())
                throw malformed(file_, line_, "found " + std::string(option.name) + " without its value");
            words.push_back(word);
            rest = after;
        }
        return words;
    }

    /// v goes up in MTL and down in pictures: u s + o is meant of 1 - v.
    static UvTransform downward(const glm::dvec3& offset, const glm::dvec3& scale) {
        return {{offset.x, 1 - scale.y - offset.y}, {scale.x, scale.y}, 0};
    }

    double signed_number(std::string_view key, std::string_view word) const {
        const auto value = number_of(word);
        if (!value || std::abs(*value) > kLargest)
            throw malformed(file_, line_,
                            "found " + parse::quoted(word) + " as " + parse::quoted(key) +
                                "; allowed: a number from " + number_text(-kLargest) + " to " +
                                number_text(kLargest));
        return *value;
    }

    const std::string& file_;
    MaterialFile result_;
    std::set<std::string> names_;
    int line_ = 0;
    std::string said_;  ///< the line's keyword
    bool states_d_ = false;
};

}  // namespace

MaterialFile parse_mtl(std::string_view text, const std::string& file) { return Mtl(text, file).result(); }

}  // namespace pbrbake::parse

// Lights of an OpenGEX file (Lengyel, Open Game Engine Exchange 1.1.2, "LightObject" and "Atten"), over the
// structures of OpenDDL. Curves, of distance, angle or its cosine: linear and smooth ramps from begin to end,
// inverse s / (kl x + kc s) and inverse_square s^2 / (kq x^2 + kl s x + kc s^2) for a scale s, at most 1;
// by angle, to the power p. Defaults are those of Lengyel's importer (OpenGEX.cpp, AttenStructure).

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/scene_transform.hpp"
#include "bakers/parse/text.hpp"
#include "pbr/numerics/elementary.hpp"

namespace pbrbake::parse {
namespace {

/// One OpenDDL structure: a type, a name, properties, and either data or more structures.
struct Structure {
    int line = 0;
    std::string type, name;
    std::map<std::string, std::string, std::less<>> properties;
    std::vector<double> numbers;
    std::vector<std::string> texts;  ///< strings and references
    std::vector<Structure> children;

    std::string property(std::string_view key, std::string fallback) const {
        const auto found = properties.find(key);
        return found == properties.end() ? fallback : found->second;
    }
    /// Data of the first child of a primitive type.
    const Structure* data() const { return children.empty() ? nullptr : &children.front(); }
};

bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '+' || c == '-' || c == '.' || c == '$' || c == '%';
}

class Ddl {
  public:
    Ddl(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    std::vector<Structure> read() {
        std::vector<Structure> list;
        while (!at_end()) list.push_back(structure(0));
        return list;
    }

  private:
    static constexpr int kDeepest = 128;
    /// Longest data kept: a matrix. Meshes are read over.
    static constexpr std::size_t kLongestData = 16;

    [[noreturn]] void refuse(const std::string& allowed) {
        throw malformed(
            file_, line_,
            (at_ == text_.size() ? std::string("ends") : "found " + parse::quoted(text_.substr(at_, 12))) +
                " where " + allowed + " should be");
    }

    bool at_end() {
        for (; at_ < text_.size(); ++at_) {
            const char c = text_[at_];
            if (text_.substr(at_, 2) == "//") {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (text_.substr(at_, 2) == "/*") {
                const std::size_t end = text_.find("*/", at_ + 2);
                if (end == text_.npos) throw malformed(file_, line_, "opens a comment that isn't closed");
                line_ += static_cast<int>(std::count(text_.begin() + static_cast<std::ptrdiff_t>(at_),
                                                     text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
                at_ = end + 1;
                continue;
            }
            if (at_ == text_.size()) return true;
            if (text_[at_] == '\n')
                ++line_;
            else if (c != ' ' && c != '\t' && c != '\r')
                return false;
        }
        return true;
    }
    bool peek(char c) { return !at_end() && text_[at_] == c; }
    bool take(char c) {
        if (!peek(c)) return false;
        ++at_;
        return true;
    }
    void expect(char c) {
        if (!take(c)) refuse(std::string("\"") + c + "\"");
    }
    std::string_view word() {
        at_end();
        const std::size_t begin = at_;
        while (at_ < text_.size() && is_word(text_[at_])) ++at_;
        return text_.substr(begin, at_ - begin);
    }
    std::string text_literal() {
        expect('"');
        std::string value;
        for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
            if (text_[at_] == '\n') throw malformed(file_, line_, "has a text that isn't closed on its line");
            if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
            value += text_[at_];
        }
        expect('"');
        return value;
    }

    Structure structure(int depth) {
        if (depth == kDeepest) throw malformed(file_, line_, "nests structures deeper than 128 levels");
        at_end();
        Structure s;
        s.line = line_;
        s.type = std::string(word());
        if (s.type.empty()) refuse("a structure");
        if (take('[')) {  // an array type, as float[3]
            if (word().empty()) refuse("a size");
            expect(']');
        }
        if (peek('$') || peek('%')) s.name = std::string(word());
        if (take('(')) properties(s);
        expect('{');
        const bool is_primitive = s.type.starts_with("float") || s.type.starts_with("int") ||
                                  s.type.starts_with("unsigned_int") || s.type == "double" ||
                                  s.type == "half" || s.type == "bool" || s.type == "string" ||
                                  s.type == "ref" || s.type == "type";
        if (is_primitive)
            data(s);
        else
            while (!peek('}')) {
                if (at_end()) refuse("\"}\"");
                s.children.push_back(structure(depth + 1));
            }
        expect('}');
        return s;
    }

    void properties(Structure& s) {
        while (!take(')')) {
            const std::string key(word());
            if (key.empty()) refuse("a property");
            expect('=');
            s.properties[key] = peek('"') ? text_literal() : std::string(word());
            take(',');
        }
    }

    /// Literals up to the closing brace, groups in braces of their own.
    void data(Structure& s) {
        int groups = 0;
        for (;;) {
            if (at_end()) refuse("\"}\"");
            const char c = text_[at_];
            if (c == '}') {
                if (groups == 0) return;
                --groups, ++at_;
            } else if (c == '{') {
                ++groups, ++at_;
            } else if (c == ',') {
                ++at_;
            } else if (c == '"') {
                s.texts.push_back(text_literal());
            } else {
                const std::string_view literal = word();
                if (literal.empty()) refuse("a number, a text or a reference");
                if (s.type == "ref" || s.type == "bool" || s.type == "type") {
                    s.texts.emplace_back(literal);
                } else if (s.numbers.size() < kLongestData) {
                    const auto value = finite_number(literal);
                    // Integers may be binary, octal, hexadecimal or characters; lights have none.
                    if (!value && (s.type.starts_with("float") || s.type == "double" || s.type == "half"))
                        throw malformed(file_, line_,
                                        "found " + parse::quoted(literal) + "; allowed: a finite number");
                    s.numbers.push_back(value.value_or(0));
                }
            }
        }
    }

    std::string_view text_;
    const std::string& file_;
    std::size_t at_ = 0;
    int line_ = 1;
};

double number_of_data(const Structure& s, const std::string& file) {
    const Structure* data = s.data();
    if (!data || data->numbers.empty())
        throw malformed(file, s.line, "has a " + s.type + " without a number");
    return data->numbers.front();
}

class Reader {
  public:
    explicit Reader(const std::string& file) : file_(file) {
        lights_.format = "OpenGEX";
        lights_.meaning =
            "an intensity of 1 lights a white surface that faces the light, where nothing fades it, "
            "to white; OpenGEX names no unit";
    }

    LightFile read(const std::vector<Structure>& structures) {
        for (const Structure& s : structures)
            if (s.type == "Metric") metric(s);
        for (const Structure& s : structures)
            if (s.type == "LightObject") objects_.push_back({s.name, read_light(s, angle_rad_), false});
        for (const Structure& s : structures) walk(s, glm::dmat4(1));
        for (const Object& object : objects_)
            if (!object.is_used) {
                LegacyLight light = object.light;
                light.diagnostics.push_back({Severity::note, "not_placed", light.line,
                                             "is on no node of the scene; converted at the origin"});
                lights_.lights.push_back(std::move(light));
            }
        return std::move(lights_);
    }

  private:
    struct Object {
        std::string name;
        LegacyLight light;
        bool is_used;
    };

    void metric(const Structure& s) {
        const std::string key = s.property("key", "");
        if (key == "distance") {
            lights_.unit_m = number_of_data(s, file_);
            lights_.unit_is_stated = true;
            if (!(lights_.unit_m > 0))
                throw malformed(file_, s.line, "states a distance metric that isn't above 0");
        }
        if (key == "angle") angle_rad_ = number_of_data(s, file_);
        if (key == "up" && s.data() && !s.data()->texts.empty())
            lights_.up = s.data()->texts.front() == "y" ? UpAxis::y : UpAxis::z;
    }

    LegacyLight read_light(const Structure& s, double angle) {
        if (objects_.size() == kMostLights) throw malformed(file_, s.line, "is past 100000 lights");
        LegacyLight light;
        light.line = s.line;
        light.name = s.name.empty() ? "light " + std::to_string(objects_.size()) : s.name.substr(1);
        const std::string type = s.property("type", "");
        if (type == "infinite")
            light.type = LightType::directional;
        else if (type == "spot")
            light.type = LightType::spot;
        else if (type != "point")
            throw malformed(
                file_, s.line,
                "found a light of type " + parse::quoted(type) + "; allowed: infinite, point, spot");
        for (const Structure& child : s.children) {
            if (child.type == "Name" && child.data() && !child.data()->texts.empty())
                light.name = child.data()->texts.front();
            if (child.type == "Param" && child.property("attrib", "") == "intensity")
                light.intensity = number_of_data(child, file_);
            if (child.type == "Color" && child.property("attrib", "light") == "light") {
                const Structure* data = child.data();
                if (!data || data->numbers.size() < 3)
                    throw malformed(file_, child.line, "has a colour of less than three numbers");
                light.colour = {data->numbers[0], data->numbers[1], data->numbers[2]};
            }
            if (child.type == "Atten") attenuate(child, angle, light);
        }
        if (light.type == LightType::spot && !light.spot) {
            light.spot = {pbr::SpotLaw::hard, 0, 45 * kRadPerDegree, 1};
            light.diagnostics.push_back({Severity::warning, "no_cone", light.line,
                                         "states no cone; a half-angle of 45 degrees is taken"});
        }
        return light;
    }

    /// An "Atten" with its parameters, lengths and angles in the file's units.
    struct Curve {
        std::string kind, curve;
        double begin = 0, end = 1, scale = 1, offset = 0, constant = 0, linear = 0, quadratic = 1, power = 1;
    };

    Curve curve_of(const Structure& s) const {
        Curve c{s.property("kind", "distance"), s.property("curve", "linear")};
        if (c.curve == "inverse") c.linear = 1;
        const std::pair<const char*, double*> known[] = {
            {"begin", &c.begin},       {"end", &c.end},
            {"scale", &c.scale},       {"offset", &c.offset},
            {"constant", &c.constant}, {"linear", &c.linear},
            {"power", &c.power},       {"quadratic", &c.quadratic}};
        for (const Structure& param : s.children)
            for (const auto& [word, target] : known)
                if (param.property("attrib", "") == word) *target = number_of_data(param, file_);
        return c;
    }

    void attenuate(const Structure& s, double angle, LegacyLight& light) const {
        const Curve curve = curve_of(s);
        if (curve.kind == "distance")
            fade_by_distance(curve, s.line, light);
        else if (curve.kind == "angle" || curve.kind == "cos_angle")
            fade_by_angle(curve, angle, s.line, light);
        else
            throw malformed(file_, s.line,
                            "found an attenuation of kind " + parse::quoted(curve.kind) +
                                "; allowed: distance, angle, cos_angle");
    }

    static void tell(LegacyLight& light, Severity severity, const char* code, int line, const char* message) {
        light.diagnostics.push_back({severity, code, line, message});
    }

    void fade_by_distance(const Curve& c, int line, LegacyLight& light) const {
        if (c.curve == "inverse" || c.curve == "inverse_square") {
            if (!(c.scale > 0)) throw malformed(file_, line, "has an attenuation scale that isn't above 0");
            if (c.offset != 0)
                tell(light, Severity::warning, "offset", line,
                     "has an attenuation offset, which is left out");
            light.falloff.constant = c.constant;
            light.falloff.linear = c.linear / c.scale;
            light.falloff.quadratic = c.curve == "inverse" ? 0 : c.quadratic / (c.scale * c.scale);
            light.falloff.floor = 1;
            return;
        }
        if (c.curve != "linear" && c.curve != "smooth")
            throw malformed(file_, line,
                            "found the curve " + parse::quoted(c.curve) +
                                "; allowed: linear, smooth, inverse, inverse_square");
        if (c.begin < 0 || c.begin == c.end)
            throw malformed(file_, line, "has an attenuation that begins below 0, or where it ends");
        if (c.begin > c.end)
            return tell(light, Severity::warning, "rises", line,
                        "has an attenuation that grows with distance, which no light does; it is left out");
        light.falloff.window =
            c.curve == "smooth" ? pbr::FalloffWindow::smoothstep : pbr::FalloffWindow::ramp;
        light.falloff.begin = c.begin;
        light.falloff.range = c.end;
    }

    static void fade_by_angle(const Curve& c, double angle, int line, LegacyLight& light) {
        if (c.curve != "linear" && c.curve != "smooth")
            return tell(light, Severity::warning, "angle_curve_unknown", line,
                        "fades by angle along a curve that is no ramp; it is left out");
        const auto law = c.curve == "smooth" ? pbr::SpotLaw::smoothstep : pbr::SpotLaw::cosine_ramp;
        if (c.kind == "angle") {
            light.spot = {law, c.begin * angle, c.end * angle, c.power};
            return tell(light, Severity::note, "angle_curve", line,
                        "fades evenly over its angle; taken as fading over the cosine");
        }
        const auto angle_of = [](double cosine) {
            const double bounded = std::clamp(cosine, -1., 1.);
            return pbr::atan2_exact(std::sqrt((1 - bounded) * (1 + bounded)), bounded);
        };
        light.spot = {law, angle_of(c.begin), angle_of(c.end), c.power};
        if (c.begin > c.end) return;
        light.spot->law = pbr::SpotLaw::cosine_power;
        tell(light, Severity::warning, "axis_dark", line,
             "is dark on its axis, as Maya's exporter writes its drop-off; read as that power of the cosine, "
             "within the "
             "cone");
    }

    std::vector<double> numbers_of(const Structure& s, std::size_t count) const {
        if (!s.data() || s.data()->numbers.size() != count)
            throw malformed(file_, s.line,
                            "has a " + s.type + " of other than " + std::to_string(count) + " numbers");
        return s.data()->numbers;
    }

    glm::dvec3 axis_of(const Structure& s, const std::string& kind) const {
        if (kind == "x") return {1, 0, 0};
        if (kind == "y") return {0, 1, 0};
        if (kind == "z") return {0, 0, 1};
        throw malformed(file_, s.line, "has a " + s.type + " of kind " + parse::quoted(kind));
    }

    /// Three numbers, or the one along an axis and `others` along the others.
    glm::dvec3 vector_of(const Structure& s, double others) const {
        const std::string kind = s.property("kind", "xyz");
        if (kind != "xyz") return glm::dvec3(others) + axis_of(s, kind) * (numbers_of(s, 1).front() - others);
        const std::vector<double> v = numbers_of(s, 3);
        return {v[0], v[1], v[2]};
    }

    glm::dmat4 rotation_of(const Structure& s) const {
        const std::string kind = s.property("kind", "axis");
        const double half_turns = angle_rad_ / std::numbers::pi;
        if (kind != "axis" && kind != "quaternion")
            return turn_about(axis_of(s, kind), numbers_of(s, 1).front() * half_turns);
        std::vector<double> v = numbers_of(s, 4);
        if (kind == "axis") return turn_about({v[1], v[2], v[3]}, v[0] * half_turns);
        const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
        if (!(length > 0)) return glm::dmat4(1);
        for (double& number : v) number /= length;
        return matrix_of(glm::dvec3(0), v, glm::dvec3(1));
    }

    /// One of a node's transformations, with the kinds and defaults of Lengyel's importer (MatrixStructure
    /// and its kin). The identity for any other structure.
    glm::dmat4 transformation(const Structure& s) const {
        if (s.type == "Transform") return matrix_of(numbers_of(s, 16));
        if (s.type == "Translation") return matrix_of(vector_of(s, 0), {0, 0, 0, 1}, glm::dvec3(1));
        if (s.type == "Scale") return matrix_of(glm::dvec3(0), {0, 0, 0, 1}, vector_of(s, 1));
        return s.type == "Rotation" ? rotation_of(s) : glm::dmat4(1);
    }

    void walk(const Structure& s, const glm::dmat4& above) {
        if (!s.type.ends_with("Node")) return;
        glm::dmat4 world = above, own(1);  // the latter is not handed down to nodes below
        std::string name;
        for (const Structure& child : s.children) {
            glm::dmat4& product = child.property("object", "false") == "true" ? own : world;
            product = product * transformation(child);
            if (child.type == "Name" && child.data() && !child.data()->texts.empty())
                name = child.data()->texts.front();
        }
        for (const Structure& child : s.children) {
            walk(child, world);
            if (s.type != "LightNode" || child.type != "ObjectRef" || !child.data() ||
                child.data()->texts.empty())
                continue;
            const auto found = std::find_if(objects_.begin(), objects_.end(), [&](const Object& object) {
                return object.name == child.data()->texts.front();
            });
            if (found == objects_.end())
                throw malformed(
                    file_, child.line,
                    "places the light " + parse::quoted(child.data()->texts.front()) + ", which isn't there");
            found->is_used = true;
            LegacyLight light = found->light;
            if (!name.empty()) light.name = name;
            place(light, world * own);
            lights_.lights.push_back(std::move(light));
        }
    }

    const std::string& file_;
    double angle_rad_ = 1;  ///< radians of an angle of 1
    std::vector<Object> objects_;
    LightFile lights_;
};

}  // namespace

LightFile parse_opengex_lights(std::string_view text, const std::string& file) {
    return Reader(file).read(Ddl(text, file).read());
}

}  // namespace pbrbake::parse

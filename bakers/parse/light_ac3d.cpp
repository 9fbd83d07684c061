// Lights of an AC3D model (AC3D file format, "OBJECT light"): a place in the tree of objects and nothing
// else. Colour, intensity and fading are those of an OpenGL light left alone: white, 1, constant.

#include <algorithm>

#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/scene_transform.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

/// An object whose children are still to come.
struct Open {
    glm::dmat4 world{1};
    int kids = 0;
};

class Reader {
  public:
    Reader(std::string_view text, const std::string& file) : lines_(split_lines(text)), file_(file) {
        result_.format = "AC3D";
        result_.meaning =
            "AC3D's lights have no numbers: white, 1, fading with nothing, as OpenGL's defaults";
    }

    LightFile read() {
        for (std::size_t i = 1; i < lines_.size(); ++i) {
            Words words(std::span<const std::string_view>(lines_).subspan(i, 1), 0, file_);
            const auto keyword = words.next();
            const int line = static_cast<int>(i) + 1;
            if (!keyword) continue;
            if (*keyword == "OBJECT") begin(words.next().value_or(""), line);
            if (!is_open_) continue;
            if (*keyword == "name") light_.name = unquoted(trimmed(lines_[i]).substr(4));
            if (*keyword == "loc") read_numbers(i, 3, [&](int k, double v) { local_[3][k] = v; });
            if (*keyword == "rot") read_numbers(i, 9, [&](int k, double v) { local_[k % 3][k / 3] = v; });
            if (*keyword == "data") i = after_data(i, words);
            if (*keyword == "kids") end(i);
        }
        if (is_open_ || !above_.empty())
            throw malformed(file_, static_cast<int>(lines_.size()),
                            "ends with objects missing; it may be truncated");
        return std::move(result_);
    }

  private:
    static std::string unquoted(std::string_view text) {
        text = trimmed(text);
        if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
            text = text.substr(1, text.size() - 2);
        return std::string(text);
    }

    void begin(std::string_view type, int line) {
        if (is_open_) throw malformed(file_, line, "begins an object inside one that has told no kids yet");
        is_open_ = true;
        is_light_ = type == "light";
        local_ = glm::dmat4(1);
        light_ = LegacyLight{};
        light_.line = line;
        light_.name = "light " + std::to_string(result_.lights.size());
    }

    template <class Set>
    void read_numbers(std::size_t i, int count, const Set& set) {
        Words words(std::span<const std::string_view>(lines_).subspan(0, i + 1), i, file_);
        words.next();
        for (int k = 0; k < count; ++k) set(k, words.number("a place"));
    }

    /// The line before the one that follows an object's text, which may look like anything.
    std::size_t after_data(std::size_t i, Words& words) {
        const auto word = words.next();
        const auto length = word ? finite_number(*word) : std::nullopt;
        if (!length || *length < 0)
            throw malformed(file_, static_cast<int>(i) + 1, "has a data line without a length");
        double left = *length + 1;
        while (left > 0 && i + 1 < lines_.size()) left -= static_cast<double>(lines_[++i].size()) + 1;
        return i;
    }

    void end(std::size_t i) {
        Words words(std::span<const std::string_view>(lines_).subspan(0, i + 1), i, file_);
        words.next();
        const int kids = words.integer("the count of kids", 0, 1'000'000);
        const glm::dmat4 world = (above_.empty() ? glm::dmat4(1) : above_.back().world) * local_;
        if (is_light_) {
            if (result_.lights.size() == kMostLights)
                throw malformed(file_, light_.line, "is past 100000 lights");
            light_.position = glm::dvec3(world[3]);
            result_.lights.push_back(light_);
        }
        is_open_ = false;
        if (!above_.empty()) --above_.back().kids;
        if (kids > 0) {
            if (above_.size() == 256)
                throw malformed(file_, light_.line, "nests objects deeper than 256 levels");
            above_.push_back({world, kids});
        }
        while (!above_.empty() && above_.back().kids == 0) above_.pop_back();
    }

    std::vector<std::string_view> lines_;
    const std::string& file_;
    LightFile result_;
    std::vector<Open> above_;
    glm::dmat4 local_{1};
    LegacyLight light_;
    bool is_open_ = false, is_light_ = false;
};

}  // namespace

LightFile parse_ac3d_lights(std::string_view text, const std::string& file) {
    return Reader(text, file).read();
}

}  // namespace pbrbake::parse

// The plain CSV format: a header that names columns, a light a line. Columns are the plain JSON's fields,
// vectors as x y z, dx dy dz and r g b.

#include <algorithm>
#include <cctype>
#include <map>

#include "bakers/parse/light_formats.hpp"
#include "bakers/parse/light_plain.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr const char* kColumns =
    "name, type, unit, intensity, r, g, b, x, y, z, dx, dy, dz, falloff, constant, linear, quadratic, "
    "exponent, range, window, inner_deg, outer_deg, spot_exponent, radius, width, height";

/// Cells of a line: parted by commas, in double quotes where they hold one, "" for a quote.
std::vector<std::string> cells_of(std::string_view line, std::string_view file, int number) {
    std::vector<std::string> cells(1);
    bool is_quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"')
            cells.back() += line[++i];
        else if (c == '"')
            is_quoted = !is_quoted;
        else if (c == ',' && !is_quoted)
            cells.emplace_back();
        else
            cells.back() += c;
    }
    if (is_quoted) throw malformed(file, number, "has a quote that isn't closed");
    for (std::string& cell : cells) cell = std::string(trimmed(cell));
    return cells;
}

/// One line, by column.
class Row {
  public:
    Row(const std::vector<std::string>& header, std::vector<std::string> cells, const std::string& file,
        int line)
        : file_(file), line_(line) {
        if (cells.size() != header.size())
            throw malformed(file, line,
                            "found " + std::to_string(cells.size()) + " cells; allowed: " +
                                std::to_string(header.size()) + ", as many as the header has");
        for (std::size_t i = 0; i < header.size(); ++i) cells_[header[i]] = std::move(cells[i]);
    }

    /// Whether the column is there, and this line has nothing in it.
    bool is_empty(const std::string& column) const {
        return cells_.contains(column) && cells_.at(column).empty();
    }
    bool has(const std::string& column) const { return cells_.contains(column) && !is_empty(column); }
    std::string text(const std::string& column, const std::string& fallback) const {
        return has(column) ? cells_.at(column) : fallback;
    }
    double number(const std::string& column, double fallback) const {
        if (!has(column)) return fallback;
        const auto value = finite_number(cells_.at(column));
        if (!value) refuse(column, "a finite number");
        return *value;
    }
    [[noreturn]] void refuse(const std::string& column, const std::string& allowed) const {
        throw malformed(
            file_, line_,
            "found " + parse::quoted(text(column, "")) + " as " + column + "; allowed: " + allowed);
    }

  private:
    std::map<std::string, std::string> cells_;
    const std::string& file_;
    int line_;
};

pbr::Falloff read_falloff(const Row& row, LightUnit unit) {
    PlainFalloff plain;
    plain.kind = row.text("falloff", "");
    plain.states_coefficients = row.has("constant") || row.has("linear") || row.has("quadratic");
    plain.constant = row.number("constant", 0);
    plain.linear = row.number("linear", 0);
    plain.quadratic = row.number("quadratic", 0);
    if (row.has("exponent")) plain.exponent = row.number("exponent", 0);
    if (row.has("range")) plain.range = row.number("range", 0);
    plain.window = row.text("window", "");
    pbr::Falloff law;
    if (const auto mistake = make_falloff(plain, unit, law))
        row.refuse(std::string(mistake->field), std::string(mistake->allowed));
    return law;
}

LegacyLight read_light(const Row& row, int line) {
    LegacyLight light;
    light.line = line;
    light.name = row.text("name", "line " + std::to_string(line));
    if (!read_light_type(row.text("type", "point"), light.type)) row.refuse("type", kLightTypeNames);
    const auto unit = light_unit(row.text("unit", "relative"));
    if (!unit || unit_for(light.type, *unit) != *unit) row.refuse("unit", kLightUnitNames);
    light.unit = *unit;
    if (row.is_empty("intensity")) row.refuse("intensity", "a finite number; without the column it is 1");
    light.intensity = row.number("intensity", 1);
    light.colour = {row.number("r", 1), row.number("g", 1), row.number("b", 1)};
    light.position = {row.number("x", 0), row.number("y", 0), row.number("z", 0)};
    if (row.has("dx") || row.has("dy") || row.has("dz"))
        light.direction = {row.number("dx", 0), row.number("dy", 0), row.number("dz", 0)};
    light.radius = row.number("radius", 0);
    light.width = row.number("width", 0);
    light.height = row.number("height", 0);
    if (light.type != LightType::directional && light.type != LightType::ambient)
        light.falloff = read_falloff(row, light.unit);
    if (light.type == LightType::spot) {
        pbr::SpotFalloff& spot = light.spot.emplace();
        spot.outer_rad = row.number("outer_deg", 45) * kRadPerDegree;
        spot.inner_rad = row.number("inner_deg", 0) * kRadPerDegree;
        spot.law = row.has("spot_exponent") ? pbr::SpotLaw::cosine_power
                   : row.has("inner_deg")   ? pbr::SpotLaw::cosine_ramp
                                            : pbr::SpotLaw::hard;
        spot.exponent = row.number("spot_exponent", 2);
    }
    if (const auto mistake = mistake_of_sizes(light))
        row.refuse(std::string(mistake->field), std::string(mistake->allowed));
    return light;
}

}  // namespace

LightFile parse_csv_lights(std::string_view text, const std::string& file) {
    LightFile lights;
    lights.format = "CSV";
    lights.meaning =
        "1 lights a white surface that faces the light, where nothing fades it, to white; lines "
        "may state a unit";
    const std::vector<std::string_view> lines = split_lines(text);
    std::vector<std::string> header;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const int number = static_cast<int>(i) + 1;
        const std::string_view line = trimmed(lines[i]);
        if (line.empty() || line.front() == '#') continue;
        if (!header.empty()) {
            if (lights.lights.size() == kMostLights)
                throw malformed(file, number, "holds more than 100000 lights");
            lights.lights.push_back(
                read_light(Row(header, cells_of(line, file, number), file, number), number));
            continue;
        }
        header = cells_of(line, file, number);
        const std::string known = std::string(", ") + kColumns + ",";
        for (std::string& name : header) {
            std::transform(name.begin(), name.end(), name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
            if (name.empty() || known.find(", " + name + ",") == std::string::npos)
                throw malformed(file, number,
                                "found the column " + parse::quoted(name) + "; allowed: " + kColumns);
            if (std::count(header.begin(), header.end(), name) > 1)
                throw malformed(file, number, "has the column " + parse::quoted(name) + " twice");
        }
    }
    if (header.empty())
        throw malformed(file, 0, std::string("has no header; its columns are among ") + kColumns);
    return lights;
}

}  // namespace pbrbake::parse

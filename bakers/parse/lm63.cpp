// IES LM-63, 1986 to 2019.

#include <algorithm>
#include <array>
#include <cctype>

#include "bakers/parse/grid.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr int kMostLamps = 1'000'000;
constexpr int kMostAngles = 1'000'000;  // the bytes left decide long before

std::string upper(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return out;
}

struct Edition {
    std::string_view tag;
    int year;
};
constexpr std::array<Edition, 5> kEditions{{{"IESNA86", 1986},
                                            {"IESNA91", 1991},
                                            {"IESNA:LM-63-1995", 1995},
                                            {"IESNA:LM-63-2002", 2002},
                                            {"IES:LM-63-2019", 2019}}};

/// The edition that the first line names; 1986 files have no such line.
std::optional<int> edition_of(std::string_view line, std::vector<Diagnostic>& diagnostics) {
    const std::string tag = upper(trimmed(line));
    for (const Edition& edition : kEditions)
        if (tag == edition.tag) return edition.year;
    if (!tag.starts_with("IES")) return {};
    const bool is_19 = tag.find("2019") != tag.npos || tag.ends_with("-19");
    const bool is_95 = tag.find("1995") != tag.npos || tag.ends_with("-95");
    const int year = is_19                        ? 2019
                     : is_95                      ? 1995
                     : tag.find("91") != tag.npos ? 1991
                     : tag.find("86") != tag.npos ? 1986
                                                  : 2002;
    if (tag.find("LM-63") == tag.npos && tag.size() > 10) return {};  // a sentence that begins so
    diagnostics.push_back({Severity::warning, "edition", 1,
                           std::string("names the edition ") + quoted(trimmed(line)) + "; read as LM-63-" +
                               std::to_string(year)});
    return year;
}

/// The part after TILT=, or nothing.
std::optional<std::string_view> tilt_value(std::string_view line) {
    std::string_view text = trimmed(line);
    if (upper(text.substr(0, 4)) != "TILT") return {};
    text = trimmed(text.substr(4));
    if (!text.starts_with('=')) return {};
    return trimmed(text.substr(1));
}

void read_keyword(std::string_view line, int number, Lm63Header& header,
                  std::vector<Diagnostic>& diagnostics) {
    const std::string_view text = trimmed(line);
    const std::size_t end = text.starts_with('[') ? text.find(']') : text.npos;
    if (end == text.npos) {
        if (header.edition > 1986 && !text.empty())
            diagnostics.push_back(
                {Severity::note, "no_keyword", number,
                 std::string("has the line ") + quoted(text) + " without a [KEYWORD]; kept"});
        if (header.edition <= 1986 || !text.empty()) header.keywords.push_back({"", std::string(text)});
        return;
    }
    const std::string name = upper(trimmed(text.substr(1, end - 1)));
    const std::string value(trimmed(text.substr(end + 1)));
    if (name == "MORE" && !header.keywords.empty())
        header.keywords.back().value += "\n" + value;
    else
        header.keywords.push_back({name, value});
}

TiltTable read_tilt(Words& words) {
    TiltTable table;
    table.geometry = words.integer("the tilt's lamp-to-luminaire geometry", 1, 3);
    const int pairs = words.integer("the number of tilt angles", 1, kMostAngles);
    table.angles_deg = words.numbers(static_cast<std::size_t>(pairs), "tilt angles");
    table.factors = words.numbers(static_cast<std::size_t>(pairs), "tilt factors");
    return table;
}

pbr::Photometry photometry_of(int code) {
    return code == 1   ? pbr::Photometry::type_c
           : code == 2 ? pbr::Photometry::type_b
                       : pbr::Photometry::type_a;
}

/// A factor that scales intensities: not negative, and a 0 that stands for "none" counts as 1.
double read_factor(Words& words, std::string_view what, std::string_view name,
                   std::vector<Diagnostic>& diagnostics) {
    const double value = words.number(what);
    if (value < 0)
        throw malformed(name, words.line(),
                        std::string("found ") + number_text(value) + " as " + std::string(what) +
                            "; allowed: a number above 0");
    if (value > 0) return value;
    diagnostics.push_back(
        {Severity::warning, "zero_factor", words.line(), "has 0 as " + std::string(what) + "; taken as 1"});
    return 1;
}

struct Counts {
    int vertical, horizontal;
};

Counts read_header_numbers(Words& words, std::string_view name, PhotometricFile& file, Lm63Header& header) {
    header.lamps = words.integer("the number of lamps", -kMostLamps, kMostLamps);
    header.lumens_per_lamp = words.number("the lumens per lamp");
    header.multiplier = read_factor(words, "the candela multiplier", name, file.diagnostics);
    Counts counts{};
    counts.vertical = words.integer("the number of vertical angles", 1, kMostAngles);
    counts.horizontal = words.integer("the number of horizontal angles", 1, kMostAngles);
    file.type = photometry_of(words.integer("the photometric type", 1, 3));
    const double units = words.number("the units type");
    header.units = units == 1 ? 1 : 2;
    if (units != 1 && units != 2)
        file.diagnostics.push_back({Severity::warning, "units", words.line(),
                                    std::string("has the units type ") + number_text(units) +
                                        "; 1 is feet, 2 metres: taken as metres"});
    header.width = words.number("the width of the opening");
    header.length = words.number("the length of the opening");
    header.height = words.number("the height of the opening");
    header.ballast_factor = read_factor(words, "the ballast factor", name, file.diagnostics);
    header.field_12 = words.number("field 12 (ballast-lamp factor, reserved, or generation type)");
    if (header.edition <= 1991 && header.field_12 <= 0) {
        file.diagnostics.push_back(
            {Severity::warning, "zero_factor", words.line(),
             std::string("has ") + number_text(header.field_12) + " as ballast-lamp factor; taken as 1"});
        header.field_12 = 1;
    } else if (header.edition > 1991 && header.edition < 2019 && header.field_12 != 1) {
        file.diagnostics.push_back(
            {Severity::suspicion, "field_12", words.line(),
             std::string("has ") + number_text(header.field_12) +
                 " in field 12, which since 1995 is reserved; intensities are not multiplied by it"});
    }
    return counts;
}

void read_grid(Words& words, std::string_view name, const Counts& counts, PhotometricFile& file) {
    const auto nv = static_cast<std::size_t>(counts.vertical),
               nh = static_cast<std::size_t>(counts.horizontal);
    if (nv * nh > words.bytes_left() / 2 + 1)
        throw malformed(name, file.values_line,
                        std::string("claims ") + std::to_string(nv) + " x " + std::to_string(nh) +
                            " angles, but only " + std::to_string(words.bytes_left()) +
                            " bytes follow; it may be truncated");
    file.vertical_deg = words.numbers(nv, "vertical angles");
    const int vertical_line = words.line();
    file.horizontal_deg = words.numbers(nh, "horizontal angles");
    const int horizontal_line = words.line();
    check_angles(file, name, vertical_line, horizontal_line);
    file.values = words.numbers(nv * nh, "candela values");
    if (const auto word = words.next())
        file.diagnostics.push_back(
            {Severity::suspicion, "trailing_data", words.line(),
             std::string("goes on with ") + quoted(*word) + " after the last candela value; ignored"});
}

}  // namespace

std::string_view Lm63Header::value_of(std::string_view name) const {
    const auto found = std::find_if(keywords.begin(), keywords.end(),
                                    [&](const Keyword& keyword) { return keyword.name == name; });
    return found == keywords.end() ? std::string_view() : std::string_view(found->value);
}

PhotometricFile parse_lm63(std::span<const std::byte> bytes, std::string_view name) {
    PhotometricFile file;
    const std::string text = decode_text(bytes, name, file.diagnostics);
    const std::vector<std::string_view> lines = split_lines(text);
    Lm63Header header;

    std::size_t at = 0;
    while (at < lines.size() && trimmed(lines[at]).empty()) ++at;
    const auto edition = at < lines.size() ? edition_of(lines[at], file.diagnostics) : std::nullopt;
    header.edition = edition.value_or(1986);
    if (edition) ++at;
    std::optional<std::string_view> tilt;
    for (; at < lines.size() && !(tilt = tilt_value(lines[at])); ++at)
        read_keyword(lines[at], static_cast<int>(at) + 1, header, file.diagnostics);
    if (!tilt) throw malformed(name, 0, "has no line that begins TILT=, which every LM-63 file has");

    Words words(lines, at + 1, name);
    const std::string kind = upper(*tilt);
    if (kind == "INCLUDE") {
        header.tilt = read_tilt(words);
    } else if (kind != "NONE") {
        header.tilt_file = std::string(*tilt);
        if (kind.empty())
            file.diagnostics.push_back(
                {Severity::warning, "tilt", static_cast<int>(at) + 1, "has an empty TILT=; taken as NONE"});
    }
    const Counts counts = read_header_numbers(words, name, file, header);
    header.watts = words.number("the input watts");
    file.values_line = words.line();
    read_grid(words, name, counts, file);
    file.header = std::move(header);
    return file;
}

TiltTable parse_tilt(std::span<const std::byte> bytes, std::string_view name) {
    std::vector<Diagnostic> unused;
    const std::string text = decode_text(bytes, name, unused);
    const std::vector<std::string_view> lines = split_lines(text);
    Words words(lines, 0, name);
    return read_tilt(words);
}

}  // namespace pbrbake::parse

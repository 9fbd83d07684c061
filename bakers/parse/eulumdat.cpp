// EULUMDAT (LDT): one field a line, in a fixed order. (Stockmar, "EULUMDAT - ein Leuchtendatenformat für den
// europäischen Beleuchtungsplaner", Licht 90.)

#include <algorithm>
#include <cmath>

#include "bakers/parse/grid.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr int kMostPlanes = 721, kMostAngles = 721, kMostLampSets = 20;  // the format's own: 721, 361, 20

/// Reads line after line.
class Fields {
  public:
    Fields(std::span<const std::string_view> lines, std::string_view file,
           std::vector<Diagnostic>& diagnostics)
        : lines_(lines), file_(file), diagnostics_(diagnostics) {}

    std::string_view text(std::string_view what) {
        if (at_ >= lines_.size())
            throw malformed(file_, static_cast<int>(lines_.size()),
                            "ends where " + std::string(what) + " should be; it may be truncated");
        return trimmed(lines_[at_++]);
    }

    double number(std::string_view what) {
        std::string field(text(what));
        if (std::count(field.begin(), field.end(), ',') == 1 && field.find('.') == field.npos) {
            field[field.find(',')] = '.';
            note_once("decimal_comma", "has decimal commas; read as points");
        }
        if (const auto value = number_of(field)) return *value;
        throw malformed(file_, line(),
                        std::string("found ") + quoted(field) + " as " + std::string(what) +
                            "; allowed: a finite number up to 1e10");
    }

    /// A number that doesn't matter to the light: an empty line, or one that is no number, counts as
    /// `fallback`.
    double lenient(std::string_view what, double fallback) {
        const std::size_t before = at_;
        const std::string field(text(what));
        if (!field.empty() && (number_of(field) || field.find(',') != field.npos)) {
            at_ = before;
            return number(what);
        }
        diagnostics_.push_back({Severity::warning, "no_number", line(),
                                std::string("has ") + quoted(field) + " as " + std::string(what) +
                                    "; taken as " + number_text(fallback)});
        return fallback;
    }

    int integer(std::string_view what, int low, int high) {
        const double value = number(what);
        if (value != std::floor(value) || value < low || value > high)
            throw malformed(file_, line(),
                            std::string("found ") + number_text(value) + " as " + std::string(what) +
                                "; allowed: a whole number from " + std::to_string(low) + " to " +
                                std::to_string(high));
        return static_cast<int>(value);
    }

    std::vector<double> numbers(std::size_t count, std::string_view what) {
        if (count > lines_.size() - at_)
            throw malformed(file_, static_cast<int>(lines_.size()),
                            std::string("has ") + std::to_string(lines_.size() - at_) + " lines left where " +
                                std::to_string(count) + " " + std::string(what) +
                                " should be; it may be truncated");
        std::vector<double> values(count);
        for (double& value : values) value = number(what);
        return values;
    }

    /// What the rest holds besides blank lines: "" if nothing.
    std::string_view rest() {
        while (at_ < lines_.size())
            if (const auto field = text("the rest"); !field.empty()) return field;
        return {};
    }

    int line() const { return static_cast<int>(at_); }

  private:
    void note_once(std::string code, std::string message) {
        for (const Diagnostic& diagnostic : diagnostics_)
            if (diagnostic.code == code) return;
        diagnostics_.push_back({Severity::note, std::move(code), line(), std::move(message)});
    }

    std::span<const std::string_view> lines_;
    std::string_view file_;
    std::vector<Diagnostic>& diagnostics_;
    std::size_t at_ = 0;
};

LampSet read_lamp_set(Fields& fields) {
    LampSet set;
    set.count = fields.number("the number of lamps");
    set.type = fields.text("the lamp type");
    set.flux_lm = fields.number("the total flux of the lamps");
    set.colour = fields.text("the colour temperature");
    set.rendering = fields.text("the colour rendering");
    set.watts = fields.lenient("the power", 0);
    return set;
}

struct Sizes {
    int planes, angles;
};

Sizes read_head(Fields& fields, EulumdatHeader& header) {
    header.company = fields.text("the company");
    header.type = fields.integer("the type indicator Ityp", 0, 3);
    header.symmetry = fields.integer("the symmetry indicator Isym", 0, 4);
    header.planes = fields.integer("the number of C-planes Mc", 1, kMostPlanes);
    header.plane_step_deg = fields.lenient("the distance of C-planes Dc", 0);
    const int angles = fields.integer("the number of angles Ng", 2, kMostAngles);
    header.angle_step_deg = fields.lenient("the distance of angles Dg", 0);
    header.report = fields.text("the report number");
    header.name = fields.text("the luminaire's name");
    header.number = fields.text("the luminaire's number");
    header.file = fields.text("the file name");
    header.date = fields.text("the date and user");
    header.length_mm = fields.lenient("the length", 0);
    header.width_mm = fields.lenient("the width", 0);
    header.height_mm = fields.lenient("the height", 0);
    header.opening_length_mm = fields.lenient("the opening's length", 0);
    header.opening_width_mm = fields.lenient("the opening's width", 0);
    for (double& height : header.opening_height_mm) height = fields.lenient("an opening's height", 0);
    header.downward_percent = fields.lenient("the downward flux fraction", 0);
    header.output_ratio_percent = fields.lenient("the light output ratio", 100);
    header.factor = fields.number("the conversion factor for intensities");
    header.tilt_deg = fields.lenient("the tilt while measuring", 0);
    const int sets = fields.integer("the number of lamp sets", 1, kMostLampSets);
    for (int i = 0; i < sets; ++i) header.lamp_sets.push_back(read_lamp_set(fields));
    for (double& ratio : header.direct_ratios) ratio = fields.lenient("a direct ratio", 0);
    return {header.planes, angles};
}

/// First plane and number of planes that the file has intensities for, of Mc.
struct Stored {
    int first, count;
};

Stored stored_planes(const EulumdatHeader& header) {
    const int mc = header.planes;
    switch (header.symmetry) {
        case 1:
            return {0, 1};
        case 2:
            return {0, mc / 2 + 1};
        case 3:
            return {3 * mc / 4, mc / 2 + 1};
        case 4:
            return {0, mc / 4 + 1};
        default:
            return {0, mc};
    }
}

/// Angles of the stored planes: those of Isym 3 run from 270 over 360 to 450.
std::vector<double> stored_angles(const EulumdatHeader& header, std::string_view name, int line) {
    const std::vector<double>& all = header.plane_angles_deg;
    if (header.symmetry == 1) return {0};
    const Stored stored = stored_planes(header);
    std::vector<double> angles;
    for (int i = 0; i < stored.count; ++i) {
        const int plane = stored.first + i;
        angles.push_back(all[static_cast<std::size_t>(plane % header.planes)] +
                         (plane >= header.planes ? 360 : 0));
    }
    const double begin = header.symmetry == 3 ? 270 : 0, end = header.symmetry == 2   ? 180
                                                               : header.symmetry == 3 ? 450
                                                                                      : 90;
    if (header.symmetry > 1 &&
        (std::abs(angles.front() - begin) > .01 || std::abs(angles.back() - end) > .01))
        throw malformed(name, line,
                        std::string("Isym ") + std::to_string(header.symmetry) + " needs C-planes from " +
                            number_text(begin) + " to " + number_text(end) +
                            std::string("; by their number these are ") + number_text(angles.front()) +
                            " to " + number_text(angles.back()));
    return angles;
}

void check_scale(const EulumdatHeader& header, std::string_view name) {
    if (header.factor < 0 || header.factor == 0)
        throw malformed(name, 24,
                        std::string("found ") + number_text(header.factor) +
                            " as conversion factor; allowed: a number above 0");
    for (std::size_t i = 0; i < header.lamp_sets.size(); ++i)
        if (header.lamp_sets[i].flux_lm <= 0)
            throw malformed(name, 29 + 6 * static_cast<int>(i),
                            std::string("found ") + number_text(header.lamp_sets[i].flux_lm) +
                                " as total flux of lamps; intensities are per 1000 of these lumens, so it "
                                "must be above 0");
}

}  // namespace

PhotometricFile parse_eulumdat(std::span<const std::byte> bytes, std::string_view name) {
    PhotometricFile file;
    const std::string text = decode_text(bytes, name, file.diagnostics);
    const std::vector<std::string_view> lines = split_lines(text);
    Fields fields(lines, name, file.diagnostics);
    EulumdatHeader header;
    const Sizes sizes = read_head(fields, header);
    check_scale(header, name);
    const int planes_line = fields.line() + 1;
    header.plane_angles_deg = fields.numbers(static_cast<std::size_t>(sizes.planes), "C-plane angles");
    file.vertical_deg = fields.numbers(static_cast<std::size_t>(sizes.angles), "angles");
    const int angles_line = fields.line();
    file.horizontal_deg = stored_angles(header, name, planes_line);
    check_angles(file, name, angles_line, planes_line);
    file.values_line = fields.line() + 1;
    file.values = fields.numbers(file.vertical_deg.size() * file.horizontal_deg.size(), "intensities");
    if (const auto rest = fields.rest(); !rest.empty())
        file.diagnostics.push_back(
            {Severity::suspicion, "trailing_data", fields.line(),
             std::string("goes on with ") + quoted(rest) + " after the last intensity; ignored"});
    file.header = std::move(header);
    return file;
}

PhotometricFile parse_photometry(std::span<const std::byte> bytes, std::string_view name) {
    std::vector<Diagnostic> unused;
    const std::string text = decode_text(bytes, name, unused);
    const std::vector<std::string_view> lines = split_lines(text);
    const auto begins = [](std::string_view line, std::string_view with) {
        line = trimmed(line);
        return line.size() >= with.size() &&
               std::equal(with.begin(), with.end(), line.begin(),
                          [](char a, char b) { return a == (b >= 'a' && b <= 'z' ? b - 32 : b); });
    };
    const auto is_tilt = [&](std::string_view line) {
        return begins(line, "TILT") && trimmed(trimmed(line).substr(4)).starts_with('=');
    };
    // EULUMDAT has no tag, but numbers in its second to seventh line; a later line may well be a name that
    // begins TILT=.
    const auto is_numeric = [](std::string_view line) {
        line = trimmed(line);
        return !line.empty() && line.find_first_not_of("0123456789.,+-") == line.npos;
    };
    const bool has_tag =
        !lines.empty() && (begins(lines[0], "IESNA") || begins(lines[0], "IES:") || is_tilt(lines[0]));
    if (!has_tag && lines.size() >= 7 && std::all_of(lines.begin() + 1, lines.begin() + 4, is_numeric))
        return parse_eulumdat(bytes, name);
    if (has_tag || std::any_of(lines.begin(), lines.end(), is_tilt)) return parse_lm63(bytes, name);
    throw malformed(
        name, 0, "is neither IES LM-63 (no line begins TILT=) nor EULUMDAT (lines 2 to 4 are not numbers)");
}

}  // namespace pbrbake::parse

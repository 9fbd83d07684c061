// Photometric files written: LM-63-2019 and EULUMDAT, each from either.

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "bakers/parse/grid.hpp"
#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

constexpr std::string_view kOwn = "_LDT_";  // keywords for what LM-63 has no field for
constexpr const char* kEnd = "\r\n";

/// Ten digits: far beyond any photometer, and short.
std::string ten_digits(double value) {
    std::array<char, 64> buffer;
    const auto result =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 10);
    return number_text(*number_of({buffer.data(), static_cast<std::size_t>(result.ptr - buffer.data())}));
}

std::string joined(const std::vector<double>& values, const char* separator) {
    std::string text;
    for (const double value : values) text.append(text.empty() ? "" : separator).append(number_text(value));
    return text;
}

std::string one_line(std::string_view text) {
    std::string out(text);
    std::replace(out.begin(), out.end(), '\n', ' ');
    return out;
}

/// Numbers of LM-63, ten a line, which keeps lines below the 256 characters it allows.
std::string wrapped(const double* values, std::size_t count) {
    std::string text;
    for (std::size_t i = 0; i < count; ++i)
        text.append(number_text(values[i])).append(i + 1 == count || i % 10 == 9 ? kEnd : " ");
    return text;
}

// --- EULUMDAT's header as keywords, and back

std::vector<Keyword> keywords_of(const EulumdatHeader& header, std::size_t lamp_set) {
    const auto own = [](const char* name, std::string value) {
        return Keyword{std::string(kOwn) + name, std::move(value)};
    };
    std::vector<Keyword> list{{"TEST", header.report},
                              {"TESTLAB", "unknown"},
                              {"ISSUEDATE", header.date},
                              {"MANUFAC", header.company},
                              {"LUMCAT", header.number},
                              {"LUMINAIRE", header.name},
                              {"LAMP", header.lamp_sets[lamp_set].type}};
    list.push_back(own("TYPE", number_text(header.type)));
    list.push_back(own("ISYM", number_text(header.symmetry)));
    list.push_back(own("STEPS", joined({header.plane_step_deg, header.angle_step_deg}, " ")));
    list.push_back(own("PLANES", joined(header.plane_angles_deg, " ")));
    list.push_back(own("FILE", header.file));
    list.push_back(own("SIZE", joined({header.length_mm, header.width_mm, header.height_mm}, " ")));
    std::vector<double> opening{header.opening_length_mm, header.opening_width_mm};
    opening.insert(opening.end(), header.opening_height_mm.begin(), header.opening_height_mm.end());
    list.push_back(own("OPENING", joined(opening, " ")));
    list.push_back(own(
        "FLUX",
        joined({header.downward_percent, header.output_ratio_percent, header.factor, header.tilt_deg}, " ")));
    list.push_back(own("RATIOS", joined(header.direct_ratios, " ")));
    for (const LampSet& set : header.lamp_sets) {
        list.push_back(own("LAMP", joined({set.count, set.flux_lm, set.watts}, " ")));
        list.push_back(own("LAMP_TYPE", set.type));
        list.push_back(own("LAMP_COLOUR", set.colour));
        list.push_back(own("LAMP_RENDERING", set.rendering));
    }
    return list;
}

std::vector<double> numbers_in(std::string_view text, std::size_t count) {
    const std::array<std::string_view, 1> lines{text};
    Words words(lines, 0, "");
    std::vector<double> values;
    while (const auto word = words.next())
        if (const auto value = number_of(*word)) values.push_back(*value);
    values.resize(count > 0 ? count : values.size());
    return values;
}

/// The header that keywords_of() put into keywords; nothing if it isn't all there.
std::optional<EulumdatHeader> header_in(const Lm63Header& lm63) {
    EulumdatHeader header;
    const auto own = [&](const char* name) { return lm63.value_of(std::string(kOwn) + name); };
    if (own("ISYM").empty() || own("LAMP").empty() || own("FLUX").empty()) return {};
    header.type = static_cast<int>(std::clamp(numbers_in(own("TYPE"), 1)[0], 0., 3.));
    header.symmetry = static_cast<int>(std::clamp(numbers_in(own("ISYM"), 1)[0], 0., 4.));
    const auto steps = numbers_in(own("STEPS"), 2), size = numbers_in(own("SIZE"), 3),
               opening = numbers_in(own("OPENING"), 6), flux = numbers_in(own("FLUX"), 4);
    header.plane_step_deg = steps[0], header.angle_step_deg = steps[1];
    header.plane_angles_deg = numbers_in(own("PLANES"), 0);
    header.file = own("FILE");
    header.length_mm = size[0], header.width_mm = size[1], header.height_mm = size[2];
    header.opening_length_mm = opening[0], header.opening_width_mm = opening[1];
    header.opening_height_mm.assign(opening.begin() + 2, opening.end());
    header.downward_percent = flux[0], header.output_ratio_percent = flux[1], header.factor = flux[2],
    header.tilt_deg = flux[3];
    header.direct_ratios = numbers_in(own("RATIOS"), 10);
    for (const Keyword& keyword : lm63.keywords) {
        if (keyword.name == "_LDT_LAMP") {
            const auto lamp = numbers_in(keyword.value, 3);
            header.lamp_sets.push_back({lamp[0], "", lamp[1], "", "", lamp[2]});
        }
        if (header.lamp_sets.empty()) continue;
        LampSet& set = header.lamp_sets.back();
        if (keyword.name == "_LDT_LAMP_TYPE") set.type = keyword.value;
        if (keyword.name == "_LDT_LAMP_COLOUR") set.colour = keyword.value;
        if (keyword.name == "_LDT_LAMP_RENDERING") set.rendering = keyword.value;
    }
    const bool sound =
        header.factor > 0 && header.lamp_sets[0].flux_lm > 0 && !header.plane_angles_deg.empty();
    return sound ? std::optional(header) : std::nullopt;
}

// --- LM-63

/// The grid as LM-63-2019 may have it: horizontal spans 0, 0-90, 0-180, 0-360 of type C.
struct Grid {
    std::vector<double> horizontal_deg;
    std::vector<std::size_t> planes;  ///< of the file's values
};

Grid standard_grid(const PhotometricFile& file) {
    const std::vector<double>& angles = file.horizontal_deg;
    std::vector<Diagnostic> unused;
    const pbr::HorizontalCover cover = horizontal_cover(file, unused);
    const bool keeps =
        file.type != pbr::Photometry::type_c || angles.size() == 1 || cover == pbr::HorizontalCover::range ||
        (cover == pbr::HorizontalCover::mirrored && std::abs(angles.front()) < .01) ||
        (cover == pbr::HorizontalCover::ring && std::abs(angles.front()) < .01 && angles.back() > 359.99);
    Grid grid;
    if (keeps) {
        grid.horizontal_deg = angles;
        for (std::size_t i = 0; i < angles.size(); ++i) grid.planes.push_back(i);
        return grid;
    }
    // Unfold: every angle in [0, 360) that the file shows, by asking a web whose intensities are plane
    // numbers.
    std::vector<double> numbers;
    for (std::size_t h = 0; h < angles.size(); ++h)
        for (int v = 0; v < 2; ++v) numbers.push_back(static_cast<double>(h));
    const pbr::PhotometricWeb full =
        pbr::PhotometricWeb(file.type, cover, {0, 180}, angles, std::move(numbers)).unfolded();
    std::vector<std::pair<double, std::size_t>> all;
    for (std::size_t h = 0; h + 1 < full.horizontal_deg().size(); ++h) {
        double angle = std::fmod(full.horizontal_deg()[h] + 720, 360.);
        if (angle > 359.995) angle = 0;
        all.emplace_back(angle, static_cast<std::size_t>(full.grid_cd(0, static_cast<int>(h))));
    }
    std::sort(all.begin(), all.end());
    all.emplace_back(360, all.front().second);
    for (const auto& [angle, plane] : all) {
        grid.horizontal_deg.push_back(angle);
        grid.planes.push_back(plane);
    }
    if (grid.horizontal_deg.front() > 0) grid.horizontal_deg.back() = grid.horizontal_deg.front() + 360;
    return grid;
}

std::string keyword_lines(const std::vector<Keyword>& keywords) {
    std::string text;
    for (const Keyword& keyword : keywords) {
        std::string_view rest = keyword.value;
        text.append("[").append(keyword.name.empty() ? "OTHER" : keyword.name).append("] ");
        while (true) {
            const std::size_t end = std::min(rest.find('\n'), rest.size());
            text.append(rest.substr(0, end)).append(kEnd);
            if (end == rest.size()) break;
            rest.remove_prefix(end + 1);
            text += "[MORE] ";
        }
    }
    return text;
}

/// An LM-63 header that says what a EULUMDAT one does.
Lm63Header lm63_header_of(const PhotometricFile& file, std::size_t lamp_set) {
    const EulumdatHeader& ldt = *file.eulumdat();
    const LampSet& set = ldt.lamp_sets[lamp_set];
    Lm63Header header;
    header.keywords = keywords_of(ldt, lamp_set);
    header.multiplier = candela_scale(file, lamp_set);
    header.lamps = set.count < 0 ? 1 : std::max(1., set.count);
    header.lumens_per_lamp = set.count < 0 ? -1 : set.flux_lm / header.lamps;
    const LuminousOpening opening = luminous_opening(file);
    const bool round = opening.shape == "disk" || opening.shape == "vertical_cylinder";
    header.width = round ? -opening.along_c90_m : opening.along_c90_m;
    header.length = round ? -opening.along_c0_m : opening.along_c0_m;
    header.height = opening.height_m;
    header.watts = set.watts;
    return header;
}

void add_required(std::vector<Keyword>& keywords) {
    for (const char* name : {"MANUFAC", "ISSUEDATE", "TESTLAB", "TEST"})
        if (std::none_of(keywords.begin(), keywords.end(),
                         [&](const Keyword& keyword) { return keyword.name == name; }))
            keywords.insert(keywords.begin(), {name, "unknown"});
}

// --- EULUMDAT

/// Isym that holds a cover, or -1: a part of a ring.
int symmetry_of(const PhotometricFile& file) {
    std::vector<Diagnostic> unused;
    const std::vector<double>& angles = file.horizontal_deg;
    switch (horizontal_cover(file, unused)) {
        case pbr::HorizontalCover::axial:
            return 1;
        case pbr::HorizontalCover::mirrored: {
            const bool half = angles.back() - angles.front() > 135, at_0 = std::abs(angles.front()) < .01;
            return at_0 ? (half ? 2 : 4) : 0;
        }
        case pbr::HorizontalCover::ring:
            return 0;
        case pbr::HorizontalCover::range:
            break;
    }
    return -1;
}

/// C-planes of a full turn, 360 left out, and the file's planes that Isym stores, in its order.
struct Planes {
    std::vector<double> all;
    std::vector<std::size_t> stored;
};

Planes eulumdat_planes(const PhotometricFile& file, int symmetry) {
    const Grid grid = standard_grid(file);
    Planes planes;
    if (symmetry == 1) return {{0}, {0}};
    if (symmetry == 2 || symmetry == 4) {
        const std::vector<double>& angles = grid.horizontal_deg;
        planes.stored = grid.planes;
        for (double turn = 0; turn < 360; turn += 2 * angles.back()) {
            for (const double angle : angles) planes.all.push_back(turn + angle);
            for (std::size_t i = angles.size() - 1; i-- > 1;)
                planes.all.push_back(turn + 2 * angles.back() - angles[i]);
        }
        return planes;
    }
    planes.all.assign(grid.horizontal_deg.begin(), grid.horizontal_deg.end() - 1);
    planes.stored.assign(grid.planes.begin(), grid.planes.end() - 1);
    if (symmetry == 3) {  // from C270 over C0 to C90
        const std::size_t mc = planes.all.size();
        const std::vector<std::size_t> ring = planes.stored;
        planes.stored.clear();
        for (std::size_t i = 0; i <= mc / 2; ++i) planes.stored.push_back(ring[(3 * mc / 4 + i) % mc]);
    }
    return planes;
}

EulumdatHeader eulumdat_header_of(const PhotometricFile& file, std::vector<std::string>& lost) {
    const Lm63Header& lm63 = *file.lm63();
    std::vector<Diagnostic> unused;
    const pbr::PhotometricWeb web = make_web(file, 0, unused);
    EulumdatHeader header;
    header.company = one_line(lm63.value_of("MANUFAC"));
    header.report = one_line(lm63.value_of("TEST"));
    header.name = one_line(lm63.value_of("LUMINAIRE"));
    header.number = one_line(lm63.value_of("LUMCAT"));
    header.date = one_line(lm63.value_of("ISSUEDATE"));
    for (const Keyword& keyword : lm63.keywords) {
        const bool kept = keyword.name == "MANUFAC" || keyword.name == "TEST" ||
                          keyword.name == "LUMINAIRE" || keyword.name == "LUMCAT" ||
                          keyword.name == "ISSUEDATE" || keyword.name == "LAMP";
        if (!kept) lost.push_back("[" + keyword.name + "] " + one_line(keyword.value));
    }
    if (lm63.tilt || !lm63.tilt_file.empty()) lost.push_back("TILT");
    header.symmetry = symmetry_of(file);
    header.type = header.symmetry == 1 ? 1 : 3;
    const double flux = web.flux_lm();
    const auto declared = declared_flux_lm(file);
    const bool relative = declared && *declared > 0;
    const double lamp_flux = relative ? *declared : std::max(1e-3, std::round(flux * 10) / 10);
    header.lamp_sets.push_back({relative ? std::abs(lm63.lamps) : -1, one_line(lm63.value_of("LAMP")),
                                lamp_flux, "", "", lm63.watts});
    header.output_ratio_percent = 100 * flux / lamp_flux;
    // A grid point on the horizon belongs to both hemispheres, so the fraction is exact only where there is
    // one.
    std::vector<double> below;
    double down = 0;
    for (const double angle : web.vertical_deg())
        if (angle <= 90) below.push_back(angle);
    if (below.size() > 1) {
        std::vector<double> candela;
        for (int h = 0; h < static_cast<int>(web.horizontal_deg().size()); ++h)
            for (int v = 0; v < static_cast<int>(below.size()); ++v) candela.push_back(web.grid_cd(v, h));
        down = pbr::PhotometricWeb(web.type(), web.cover(), below, web.horizontal_deg(), std::move(candela))
                   .flux_lm();
    }
    header.downward_percent = flux > 0 ? 100 * down / flux : 0;
    const LuminousOpening opening = luminous_opening(file);
    const bool round =
        opening.shape == "disk" || opening.shape == "vertical_cylinder" || opening.shape == "sphere";
    header.opening_length_mm = header.length_mm = opening.along_c90_m * 1000;
    header.opening_width_mm = header.width_mm = round ? 0 : opening.along_c0_m * 1000;
    header.height_mm = opening.height_m * 1000;
    header.opening_height_mm.assign(4, opening.height_m * 1000);
    return header;
}

double common_step(const std::vector<double>& angles) {
    for (std::size_t i = 2; i < angles.size(); ++i)
        if (std::abs(angles[i] - 2 * angles[i - 1] + angles[i - 2]) > 1e-6) return 0;
    return angles.size() > 1 ? angles[1] - angles[0] : 0;
}

std::string header_lines(const EulumdatHeader& header, std::size_t angles) {
    std::string text;
    const auto line = [&](std::string_view field) { text.append(field).append(kEnd); };
    const auto number = [&](double value) { line(ten_digits(value)); };
    line(header.company);
    number(header.type), number(header.symmetry), number(static_cast<double>(header.plane_angles_deg.size())),
        number(header.plane_step_deg);
    number(static_cast<double>(angles)), number(header.angle_step_deg);
    for (const std::string* field :
         {&header.report, &header.name, &header.number, &header.file, &header.date})
        line(*field);
    for (const double value : {header.length_mm, header.width_mm, header.height_mm, header.opening_length_mm,
                               header.opening_width_mm})
        number(value);
    for (const double value : header.opening_height_mm) number(value);
    for (const double value :
         {header.downward_percent, header.output_ratio_percent, header.factor, header.tilt_deg})
        number(value);
    number(static_cast<double>(header.lamp_sets.size()));
    for (const LampSet& set : header.lamp_sets) {
        number(set.count);
        line(one_line(set.type));
        number(set.flux_lm);
        line(set.colour);
        line(set.rendering);
        number(set.watts);
    }
    for (const double value : header.direct_ratios) number(value);
    return text;
}

}  // namespace

std::string write_lm63(const PhotometricFile& file, std::size_t lamp_set) {
    Lm63Header header = file.lm63() ? *file.lm63() : lm63_header_of(file, lamp_set);
    if (header.edition <= 1991) header.multiplier *= header.field_12;         // no field of 2019's
    if (header.edition < 2019 || file.eulumdat()) header.field_12 = 1.00001;  // how it was made is not known
    add_required(header.keywords);
    const Grid grid = standard_grid(file);
    std::string text = std::string("IES:LM-63-2019") + kEnd + keyword_lines(header.keywords);
    text.append("TILT=")
        .append(header.tilt                ? "INCLUDE"
                : header.tilt_file.empty() ? "NONE"
                                           : header.tilt_file)
        .append(kEnd);
    if (header.tilt) {
        text.append(number_text(header.tilt->geometry))
            .append(kEnd)
            .append(number_text(static_cast<double>(header.tilt->angles_deg.size())))
            .append(kEnd);
        text += wrapped(header.tilt->angles_deg.data(), header.tilt->angles_deg.size());
        text += wrapped(header.tilt->factors.data(), header.tilt->factors.size());
    }
    const double type = file.type == pbr::Photometry::type_c   ? 1
                        : file.type == pbr::Photometry::type_b ? 2
                                                               : 3;
    text += joined(
        {header.lamps, header.lumens_per_lamp, header.multiplier,
         static_cast<double>(file.vertical_deg.size()), static_cast<double>(grid.horizontal_deg.size()), type,
         static_cast<double>(header.units), header.width, header.length, header.height},
        " ");
    text.append(kEnd)
        .append(joined({header.ballast_factor, header.field_12, header.watts}, " "))
        .append(kEnd);
    text += wrapped(file.vertical_deg.data(), file.vertical_deg.size());
    text += wrapped(grid.horizontal_deg.data(), grid.horizontal_deg.size());
    for (const std::size_t plane : grid.planes)
        text += wrapped(&file.values[plane * file.vertical_deg.size()], file.vertical_deg.size());
    return text;
}

std::string write_eulumdat(const PhotometricFile& file, std::vector<std::string>& lost) {
    const auto refuse = [](const char* what) { throw Error(ExitCode::unwritable_output, "", what); };
    if (file.type != pbr::Photometry::type_c)
        refuse("EULUMDAT holds type C photometry alone; the source is type A or B");
    if (symmetry_of(file) < 0) refuse("EULUMDAT holds full turns alone; the source has a part of one");
    EulumdatHeader header;
    if (file.eulumdat())
        header = *file.eulumdat();
    else if (auto kept = header_in(*file.lm63())) {
        header = std::move(*kept);
        const Lm63Header& lm63 = *file.lm63();
        header.company = lm63.value_of("MANUFAC"), header.report = lm63.value_of("TEST"),
        header.name = lm63.value_of("LUMINAIRE");
        header.number = lm63.value_of("LUMCAT"), header.date = lm63.value_of("ISSUEDATE");
    } else {
        header = eulumdat_header_of(file, lost);
    }
    const Planes planes = eulumdat_planes(file, header.symmetry);
    if (!file.eulumdat() && header.plane_angles_deg.size() < planes.all.size())
        header.plane_angles_deg = planes.all;
    if (file.lm63() && header.plane_step_deg == 0)
        header.plane_step_deg = common_step(header.plane_angles_deg);
    if (file.lm63() && header.angle_step_deg == 0) header.angle_step_deg = common_step(file.vertical_deg);

    std::string text = header_lines(header, file.vertical_deg.size());
    for (const double angle : header.plane_angles_deg) text.append(ten_digits(angle)).append(kEnd);
    for (const double angle : file.vertical_deg) text.append(ten_digits(angle)).append(kEnd);
    const double to_per_klm =
        file.eulumdat() ? 1 : candela_scale(file) * 1000 / (header.lamp_sets[0].flux_lm * header.factor);
    const std::size_t nv = file.vertical_deg.size();
    std::vector<std::size_t> stored = planes.stored;
    if (file.eulumdat()) {
        stored.clear();
        for (std::size_t i = 0; i < file.horizontal_deg.size(); ++i) stored.push_back(i);
    }
    for (const std::size_t plane : stored)
        for (std::size_t v = 0; v < nv; ++v)
            text.append(ten_digits(file.values[plane * nv + v] * to_per_klm)).append(kEnd);
    return text;
}

}  // namespace pbrbake::parse

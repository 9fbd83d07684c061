// pbrbake inspect FILE: what a product holds.

#include "bakers/verify/inspect.hpp"

#include <cstdio>

#include "bakers/job/json_text.hpp"
#include "cli/options.hpp"

namespace pbrbake::cli {
namespace {

void print_levels(const verify::Inspection& inspection) {
    const bool is_cube = inspection.faces == 6 && !inspection.is_volume;
    std::printf("%-6s %-11s %-8s %11s %11s %11s%s\n", "level", "size", "channel", "min", "max", "mean",
                is_cube ? "      energy" : "");
    for (std::size_t i = 0; i < inspection.levels.size(); ++i) {
        const verify::LevelSummary& level = inspection.levels[i];
        const std::string size =
            std::to_string(level.width) + "x" + std::to_string(level.height) +
            (inspection.is_volume ? std::string("x").append(std::to_string(inspection.faces))
                                  : std::string());
        for (std::size_t c = 0; c < level.channels.size(); ++c) {
            const verify::ChannelSummary& channel = level.channels[c];
            std::printf("%-6s %-11s %-8s %11.5g %11.5g %11.5g", c == 0 ? std::to_string(i).c_str() : "",
                        c == 0 ? size.c_str() : "", inspection.channels[c].c_str(), channel.lowest,
                        channel.highest, channel.mean);
            if (is_cube) std::printf(" %11.5g", channel.energy);
            if (channel.non_finite > 0)
                std::printf("  %llu not finite", static_cast<unsigned long long>(channel.non_finite));
            std::printf("\n");
        }
    }
}

/// Shares of all texels, in percent; 80 columns at most.
void print_ranges(const std::vector<verify::RangeCheck>& ranges) {
    if (ranges.empty()) return;
    std::printf("\n%-30s %-12s %8s %8s %8s\n", "physical range", "", "texels", "below", "above");
    for (const verify::RangeCheck& check : ranges) {
        std::printf("%-30s %4g to %-4g %7.2f%% %7.2f%% %7.2f%%%s\n", check.what.c_str(), check.lowest,
                    check.highest, 100 * check.texels, 100 * check.below, 100 * check.above,
                    check.below + check.above > .01 ? "  outside" : "");
    }
}

void print_figure(const Json& figure) {
    const bool has_level = figure.contains("level"), has_interval = figure.contains("interval");
    std::printf("%-30s %9.3g  %-8s", figure["metric"].get<std::string>().c_str(),
                figure["value"].get<double>(), figure["evidence"].get<std::string>().c_str());
    if (has_level || has_interval)
        std::printf(" %6s", has_level ? std::to_string(figure["level"].get<int>()).c_str() : "");
    if (has_interval)
        std::printf("  %.3g to %.3g", figure["interval"][0].get<double>(),
                    figure["interval"][1].get<double>());
    std::printf("\n");
}

void print_certificate(const Json& record) {
    if (!record.is_object() || !record.contains("certificate")) {
        std::printf("certificate none: no record beside the file lists it\n");
        return;
    }
    try {
        const Json& certificate = record["certificate"];
        const Json headline = certificate.value("headline", Json());
        std::printf("%-30s %9s  %-8s %6s  95 %% within\n", "certificate, headline first", "value", "evidence",
                    "level");
        if (!headline.is_null()) print_figure(headline);
        for (const Json& figure : certificate.at("figures"))
            if (figure != headline) print_figure(figure);
        std::printf("\n");
        for (const auto& [effect, count] : certificate.at("work").items())
            std::printf("evaluations of %-20s %20llu\n", effect.c_str(),
                        static_cast<unsigned long long>(count.get<std::uint64_t>()));
    } catch (const Json::exception&) {
        std::printf("certificate unreadable: the record is not one of this version\n");
    }
}

void print(const std::string& file, const verify::Inspection& inspection) {
    std::printf("%s: %s, %s, %s, %zu level%s, scale %g, %s\n\n", file.c_str(), inspection.format.c_str(),
                inspection.is_volume    ? "volume"
                : inspection.faces == 6 ? "cube map"
                                        : "picture",
                inspection.pixel.c_str(), inspection.levels.size(), inspection.levels.size() == 1 ? "" : "s",
                inspection.scale, inspection.units.c_str());
    print_levels(inspection);
    print_ranges(inspection.ranges);
    std::printf("\n");
    print_certificate(inspection.record);
}

/// The pictures that the flags add to FILE, if any.
verify::SetFiles set_of(const std::string& file, const Given& given) {
    verify::SetFiles set;
    std::string others;
    for (const auto& [flag, map] : {std::pair{"metallic-roughness", &set.metallic_roughness},
                                    {"metallic", &set.metallic},
                                    {"specular", &set.specular}})
        if (const auto path = given.find(flag)) {
            if (set.is_set())
                throw Error(ExitCode::usage, std::string("--") + flag,
                            "found beside --" + others + "; allowed: one of the two");
            *map = *path;
            others = flag;
        }
    (set.is_specular_gloss() ? set.diffuse : set.base_color) = file;
    return set;
}

}  // namespace

ExitCode inspect_command(const Arguments& arguments) {
    Options options(
        "inspect", "[OPTIONS] FILE",
        "Shows what a product holds: size, range and mean of every level, its energy if it is a cube map "
        "(the integral over the sphere), how much of a texture set is outside of what surfaces reflect, and "
        "the certificate in the record beside it. Values are divided "
        "by the file's scale.");
    options.add_positional({{"file", "FILE", "An EXR, KTX2, DDS, PNG or HDR file; or a JPEG, TGA or TIFF."}});
    options.add({"a set without a record",
                 {{"metallic-roughness", "MAP",
                   "FILE is the base colour of this mask, metallic in blue as glTF has it."},
                  {"metallic", "MAP", "FILE is the base colour of this mask, metallic in red."},
                  {"specular", "MAP", "FILE is the diffuse colour beside this f0, of specular-gloss."}}});
    options.set_example("pbrbake inspect crate_base.png --metallic-roughness crate_orm.png");
    options.add({"output", {{"json", "", "Prints JSON.", true}}});
    const auto given = options.parse(arguments);
    if (!given) return ExitCode::done;
    const auto file = given->find("file");
    if (!file) throw Error(ExitCode::usage, "FILE", "missing; usage: pbrbake inspect [OPTIONS] FILE");

    const verify::Inspection inspection = verify::inspect(*file, set_of(*file, *given));
    if (given->is_on("json"))
        std::printf("%s", job::to_text(verify::inspection_json(inspection)).c_str());
    else
        print(*file, inspection);
    return ExitCode::done;
}

}  // namespace pbrbake::cli

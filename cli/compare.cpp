// pbrbake compare A B: products against reference products.

#include "bakers/verify/compare.hpp"

#include <cstdio>

#include "bakers/job/json_text.hpp"
#include "bakers/run/atomic_file.hpp"
#include "bakers/verify/compare_page.hpp"
#include "cli/execute.hpp"
#include "cli/options.hpp"

namespace pbrbake::cli {
namespace {

OptionGroup threshold_group() {
    OptionGroup group{"thresholds", {}};
    for (const verify::ThresholdFlag& flag : verify::threshold_flags())
        group.options.push_back({flag.name, flag.value, flag.help, flag.is_switch});
    group.options.push_back(
        {"thresholds", "FILE", "A JSON file of these, words joined by _; flags come before it."});
    return group;
}

verify::Thresholds thresholds_of(const Given& given) {
    std::vector<std::pair<std::string, std::string>> flags;
    for (const verify::ThresholdFlag& flag : verify::threshold_flags())
        if (const auto text = given.find(flag.name)) flags.emplace_back(flag.name, *text);
    std::optional<std::filesystem::path> file;
    if (const auto path = given.find("thresholds")) file = *path;
    return verify::read_thresholds(file, flags);
}

}  // namespace

ExitCode compare_command(const Arguments& arguments) {
    Options options(
        "compare", "[OPTIONS] A B",
        "Holds A against the reference B: two products, or two folders, manifests or records of them. "
        "Geometry and format first, then bytes, steps of the pixel type, errors of every level and face, "
        "energy, and HDR-FLIP of shaded spheres. Tells what a difference looks like where it knows. Ends "
        "with 0 if "
        "all products pass; with 6 if one fails or is missing, if a value is NaN or infinite, or if "
        "there was nothing to compare; with 4 if one can't be read.");
    options.add_positional({{"a", "A", "Products to judge."}, {"b", "B", "The reference."}});
    options.add({"output",
                 {{"json", "", "Prints JSON instead of a line a product.", true},
                  {"html", "FILE", "Writes a page that shows the differences."},
                  {"quiet", "", "Prints failures alone.", true}}});
    options.add({"running", {{"threads", "N", "Worker threads. [default: all processors]"}}});
    options.add(threshold_group());
    const auto given = options.parse(arguments);
    if (!given) return ExitCode::done;
    const auto a = given->find("a"), b = given->find("b");
    if (!a || !b)
        throw Error(ExitCode::usage, a ? "B" : "A", "missing; usage: pbrbake compare [OPTIONS] A B");

    const verify::Comparison comparison = verify::compare(*a, *b, thresholds_of(*given), threads_of(*given));
    if (const auto html = given->find("html"))
        run::write_atomically(*html, verify::comparison_page(comparison));
    if (given->is_on("json")) {
        std::printf("%s", job::to_text(verify::comparison_json(comparison)).c_str());
    } else {
        for (const verify::ProductComparison& product : comparison.products)
            if (!product.passed() || !given->is_on("quiet"))
                std::printf("%s\n", verify::verdict_line(product).c_str());
        std::printf("%s\n", verify::summary_line(comparison).c_str());
    }
    return comparison.code;
}

}  // namespace pbrbake::cli

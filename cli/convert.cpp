// pbrbake ies --convert: photometric files from one format to the other, without a bake.

#include <cstdio>

#include "bakers/io/io.hpp"
#include "bakers/parse/photometry.hpp"
#include "bakers/run/atomic_file.hpp"
#include "cli/command.hpp"
#include "cli/options.hpp"

namespace pbrbake::cli {
namespace {

/// What the file is written as, by the extension it is asked for.
std::string converted(const parse::PhotometricFile& file, const std::filesystem::path& output) {
    std::string extension = output.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    std::vector<std::string> lost;
    std::string text;
    if (extension == ".ies")
        text = parse::write_lm63(file);
    else if (extension == ".ldt")
        text = parse::write_eulumdat(file, lost);
    else
        throw Error(ExitCode::usage, "-o",
                    "found \"" + output.string() +
                        "\"; allowed with --convert: a file name that ends in .ies or .ldt");
    for (const std::string& field : lost)
        std::fprintf(stderr, "pbrbake: warning: %s: has no field for %s\n", output.string().c_str(),
                     field.c_str());
    return text;
}

}  // namespace

ExitCode convert_command(const Arguments& arguments) {
    Options options("ies --convert", "FILE -o FILE",
                    "A photometric file in the other format: LM-63-2019 (.ies) or EULUMDAT (.ldt).");
    options.add_positional({{"source", "FILE", "Photometric file: IES LM-63 of any edition, or EULUMDAT."}});
    options.add({"the file",
                 {{"o,output", "FILE", "The converted file; .ies or .ldt says which format."},
                  {"convert", "", "Convert instead of baking.", true}}});
    const auto given = options.parse(arguments);
    if (!given) return ExitCode::done;
    const auto source = given->find("source"), output = given->find("output");
    if (!source) throw Error(ExitCode::usage, "FILE", "missing; name the photometric file to convert");
    if (!output) throw Error(ExitCode::usage, "-o", "missing; give the file to write, as in -o lamp.ldt");
    const SourceImage file = io::read_text_source(*source);
    const parse::PhotometricFile photometry = parse::parse_photometry(file.bytes, file.name);
    for (const parse::Diagnostic& diagnostic : photometry.diagnostics)
        if (diagnostic.severity != parse::Severity::note)
            std::fprintf(stderr, "pbrbake: warning: %s: %s\n", file.name.c_str(), diagnostic.message.c_str());
    std::error_code error;
    if (std::filesystem::equivalent(*source, *output, error))
        throw Error(ExitCode::usage, "-o", "is the source itself; give another file");
    run::write_atomically(*output, converted(photometry, *output));
    return ExitCode::done;
}

}  // namespace pbrbake::cli

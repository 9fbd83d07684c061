#include "cli/command.hpp"

#include <algorithm>
#include <cstdio>

#include "bakers/job/flags.hpp"
#include "bakers/registry.hpp"

namespace pbrbake::cli {

std::vector<Command> commands() {
    std::vector<Command> list{{"bake", "Runs job files", bake_command}};
    for (const Baker& baker : bakers()) {
        const std::string kind(baker.kind);
        list.push_back({kind, job::title_of(kind), [kind](const Arguments& arguments) {
                            const bool converts =
                                kind == "ies" && std::ranges::find(arguments, "--convert") != arguments.end();
                            return converts ? convert_command(arguments) : one_shot_command(kind, arguments);
                        }});
    }
    list.push_back(
        {"inspect", "Shows what a product holds: levels, range, energy, certificate", inspect_command});
    list.push_back({"compare", "Holds products against reference products", compare_command});
    list.push_back({"study", "Shows what accuracy costs in time, method by method", study_command});
    list.push_back({"demo", "Bakes built-in inputs, and writes a page to look at", demo_command});
    return list;
}

void print_error(const Error& error) {
    const auto line = [](const char* text) { std::fprintf(stderr, "pbrbake: error: %s\n", text); };
    if (const auto* job_error = dynamic_cast<const job::JobError*>(&error))
        for (const Mistake& mistake : job_error->mistakes())
            line((mistake.pointer + ": " + mistake.message).c_str());
    else
        line(error.what());
}

}  // namespace pbrbake::cli

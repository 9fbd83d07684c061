// pbrbake: bakes assets for physically based rendering. The command line is a thin shell over bakers/.

#include <cstdio>
#include <string>

#include "bakers/job/words.hpp"
#include "bakers/run/run.hpp"
#include "cli/command.hpp"

namespace pbrbake::cli {
namespace {

void print_help() {
    std::printf(
        "pbrbake bakes assets for physically based rendering, and says how far they are\n"
        "from the truth.\n\n"
        "usage: pbrbake COMMAND [OPTIONS]\n\ncommands:\n");
    for (const Command& command : commands())
        std::printf("  %-9s %s\n", command.name.c_str(), command.summary.c_str());
    std::printf(
        "\n"
        "  pbrbake COMMAND --help   what a command takes\n"
        "  pbrbake --version\n"
        "\n"
        "exit codes:\n"
        "  0 done                         5 output could not be written\n"
        "  1 bakes failed in many ways    6 comparison above its threshold\n"
        "  2 wrong usage                  7 stated accuracy was not met\n"
        "  3 invalid job                130 interrupted\n"
        "  4 unreadable input\n");
}

ExitCode dispatch(const std::string& name, const Arguments& arguments) {
    if (name == "--help" || name == "-h" || name == "help") {
        print_help();
        return ExitCode::done;
    }
    if (name == "--version") {
        std::printf("%s\n", std::string(run::tool_version()).c_str());
        return ExitCode::done;
    }
    std::vector<std::string> names;
    for (const Command& command : commands()) {
        if (command.name == name) return command.run(arguments);
        names.push_back(command.name);
    }
    throw Error(ExitCode::usage, name,
                "unknown command; allowed: " + job::joined(names) + job::did_you_mean(name, names));
}

int run_main(int argc, char** argv) {
    try {
        if (argc < 2) throw Error(ExitCode::usage, "", "no command given; see pbrbake --help");
        return static_cast<int>(dispatch(argv[1], Arguments(argv + 2, argv + argc)));
    } catch (const Error& error) {
        print_error(error);
        return static_cast<int>(error.code());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "pbrbake: error: internal error, please report: %s\n", error.what());
        return static_cast<int>(ExitCode::mixed_failures);
    }
}

}  // namespace
}  // namespace pbrbake::cli

int main(int argc, char** argv) { return pbrbake::cli::run_main(argc, argv); }

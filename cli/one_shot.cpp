// pbrbake dfg, pbrbake probe, …: one bake from flags. The flags are the job schema's properties.

#include "bakers/job/flags.hpp"
#include "cli/execute.hpp"

namespace pbrbake::cli {
ExitCode one_shot_command(const std::string& kind, const Arguments& arguments) {
    std::vector<Option> required;
    OptionGroup bake{"the bake",
                     {{"o,output", "FILE", "The product; FILE.json beside it records how it was made."}}};
    if (kind == "ies")
        bake.options.push_back(
            {"convert", "",
             "Bakes nothing, and writes the source as LM-63-2019 (-o X.ies) or EULUMDAT (-o X.ldt).", true});
    std::string usage = "[OPTIONS] ";
    for (const job::Flag& flag : job::flags_of(kind))
        if (flag.is_required) {
            required.push_back({flag.name, flag.place, flag.help});
            usage += required.back().value + " ";
        } else {
            bake.options.push_back(
                {flag.name, flag.value, flag.help, flag.is_switch, false, flag.on_by_default});
        }
    Options options(kind, usage + "-o FILE", job::title_of(kind) + ".");
    options.add_positional(required);
    options.add(bake);
    options.add(run_option_group());
    options.set_example(job::example_of(kind));
    const auto given = options.parse(arguments);
    if (!given) return ExitCode::done;

    const auto output = given->find("output");
    if (!output)
        throw Error(
            ExitCode::usage, "-o",
            "missing; give the product's file, as in -o " + kind + (kind == "light" ? ".json" : ".exr"));
    std::vector<job::FlagText> flags;
    for (const auto& [name, text] : given->texts())
        if (name != "output" && !is_run_option(name)) flags.push_back({name, text});
    const job::Job job = job::from_flags(kind, flags, *output);
    return execute(std::span(&job, 1), *given);
}

}  // namespace pbrbake::cli

#include "cli/options.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cxxopts.hpp>

#include "bakers/job/words.hpp"

namespace pbrbake::cli {
namespace {

std::string long_name(const std::string& name) { return name.substr(name.find(',') == 1 ? 2 : 0); }

/// "--rotate_deg=30" -> "--rotate-deg=30"; "--no-fold" -> "--fold=false", if fold is a switch.
std::string as_parsed(std::string argument, const std::vector<Option>& options) {
    if (!argument.starts_with("--")) return argument;
    std::replace(argument.begin(), argument.begin() + std::min(argument.find('='), argument.size()), '_',
                 '-');
    for (const Option& option : options)
        if (option.is_switch && argument == "--no-" + long_name(option.name))
            return "--" + long_name(option.name) + "=false";
    return argument;
}

std::shared_ptr<cxxopts::Value> value_of(const Option& option) {
    if (option.repeats) return cxxopts::value<std::vector<std::string>>();
    auto value = cxxopts::value<std::string>();
    if (option.is_switch) value->implicit_value("true");
    return value;
}

}  // namespace

std::optional<std::string> Given::find(const std::string& name) const {
    for (const auto& [given, text] : texts_)
        if (given == name) return text;
    return std::nullopt;
}

std::vector<std::string> Given::all(const std::string& name) const {
    std::vector<std::string> list;
    for (const auto& [given, text] : texts_)
        if (given == name) list.push_back(text);
    return list;
}

bool Given::is_on(const std::string& name) const {
    const std::string text = find(name).value_or("false");
    if (text != "true" && text != "false")
        throw Error(ExitCode::usage, "--" + name, "found \"" + text + "\"; allowed: true, false");
    return text == "true";
}

std::vector<Option> Options::all_options() const {
    std::vector<Option> list = positionals_;
    for (const OptionGroup& group : groups_)
        list.insert(list.end(), group.options.begin(), group.options.end());
    list.push_back({"h,help", "", "Shows this.", true});
    return list;
}

std::optional<Given> Options::parse(const Arguments& arguments) const {
    cxxopts::Options parser(command_);
    parser.allow_unrecognised_options();
    for (const Option& option : all_options())
        parser.add_option("", cxxopts::Option(option.name, option.help, value_of(option)));
    std::vector<std::string> positional_names;
    for (const Option& option : positionals_) positional_names.push_back(option.name);
    parser.parse_positional(positional_names);

    std::vector<std::string> texts{command_};
    for (const std::string& argument : arguments) texts.push_back(as_parsed(argument, all_options()));
    std::vector<const char*> argv;
    for (const std::string& text : texts) argv.push_back(text.c_str());
    try {
        const auto result = parser.parse(static_cast<int>(argv.size()), argv.data());
        std::vector<std::pair<std::string, std::string>> texts_given;
        for (const auto& argument : result.arguments())
            texts_given.emplace_back(argument.key(), argument.value());
        Given given(std::move(texts_given));
        if (given.has("help")) {
            print_help();
            return std::nullopt;
        }
        check(given, result.unmatched());
        return given;
    } catch (const cxxopts::exceptions::exception& error) {
        throw Error(ExitCode::usage, "pbrbake " + command_, error.what());
    }
}

void Options::check(const Given& given, const std::vector<std::string>& unmatched) const {
    std::vector<std::string> flags;
    for (const Option& option : all_options()) flags.push_back("--" + long_name(option.name));
    std::vector<std::string> strays = unmatched;
    for (const Option& option : positionals_)
        for (const std::string& text : given.all(option.name)) strays.push_back(text);
    for (const std::string& stray : strays) {
        const std::string flag = stray.substr(0, stray.find('='));
        if (flag.size() > 1 && flag.starts_with('-'))
            throw Error(
                ExitCode::usage, flag,
                "unknown flag" + job::did_you_mean(flag, flags) + "; see pbrbake " + command_ + " --help");
    }
    if (!unmatched.empty())
        throw Error(ExitCode::usage, "\"" + unmatched.front() + "\"",
                    "one argument too many; usage: pbrbake " + command_ + " " + usage_);
    for (const Option& option : all_options())
        if (!option.repeats && given.all(long_name(option.name)).size() > 1)
            throw Error(ExitCode::usage, "--" + long_name(option.name), "given more than once");
}

void Options::print_help() const {
    std::vector<OptionGroup> groups;
    if (!positionals_.empty()) groups.push_back({"", {}});
    for (const Option& option : positionals_)
        groups.front().options.push_back({"", option.value, option.help});
    groups.insert(groups.end(), groups_.begin(), groups_.end());
    std::printf("%s", help_text("pbrbake " + command_ + " " + usage_, summary_, groups).c_str());
    if (!example_.empty()) std::printf("\nexample:\n  %s\n", example_.c_str());
}

int integer_option(const std::string& name, const std::string& text, int least, int most) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number < least || number > most)
        throw Error(ExitCode::usage, "--" + name,
                    "found \"" + text + "\"; allowed: integer " + std::to_string(least) + " to " +
                        std::to_string(most));
    return number;
}

}  // namespace pbrbake::cli

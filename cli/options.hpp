#pragma once
// One command's options: declared, parsed, and shown as help, 80 columns wide.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/command.hpp"

namespace pbrbake::cli {

struct Option {
    std::string name;   ///< "threads", or with a letter "o,output"
    std::string value;  ///< what stands for its value in the help; empty for a switch
    std::string help;
    bool is_switch = false;  ///< "true" if it is given without =value
    bool repeats = false;    ///< may be given several times
    bool is_on = false;      ///< of a switch: "false" is what one would give, as --no-name
};

/// What was given, in order.
class Given {
  public:
    explicit Given(std::vector<std::pair<std::string, std::string>> texts) : texts_(std::move(texts)) {}

    const std::vector<std::pair<std::string, std::string>>& texts() const { return texts_; }
    bool has(const std::string& name) const { return find(name).has_value(); }
    std::optional<std::string> find(const std::string& name) const;
    std::vector<std::string> all(const std::string& name) const;
    /// Of a switch. Throws Error(usage) for a text that is neither true nor false.
    bool is_on(const std::string& name) const;

  private:
    std::vector<std::pair<std::string, std::string>> texts_;  ///< long name -> text
};

/// A named set of options in a help text.
struct OptionGroup {
    std::string title;
    std::vector<Option> options;
};

/// A help text, at most 80 columns wide: usage, summary, then every option with what it takes and means.
std::string help_text(const std::string& usage, const std::string& summary,
                      const std::vector<OptionGroup>& groups);

/// The options of one command. Words may be joined by _ as well as by -: a flag is called as in the job file.
/// A switch X is off with --no-X, or --X=false.
class Options {
  public:
    /// `usage` is what follows the command's name: "[OPTIONS] JOB...".
    Options(std::string command, std::string usage, std::string summary)
        : command_(std::move(command)), usage_(std::move(usage)), summary_(std::move(summary)) {}

    /// A command line for the end of the help.
    void set_example(std::string example) { example_ = std::move(example); }
    void add(OptionGroup group) { groups_.push_back(std::move(group)); }
    /// Options that may be given without their names, in this order; one that repeats takes all that is left.
    void add_positional(std::vector<Option> options) { positionals_ = std::move(options); }

    /// Nothing if help was asked for, and printed. Throws Error(usage) for unknown flags and missing values.
    std::optional<Given> parse(const Arguments& arguments) const;

  private:
    std::vector<Option> all_options() const;
    void check(const Given& given, const std::vector<std::string>& unmatched) const;
    void print_help() const;

    std::string command_, usage_, summary_, example_;
    std::vector<OptionGroup> groups_;
    std::vector<Option> positionals_;
};

/// An integer option. Throws Error(usage) naming the option if the text is none, or out of range.
int integer_option(const std::string& name, const std::string& text, int least, int most);

}  // namespace pbrbake::cli

#include "cli/options.hpp"

namespace pbrbake::cli {
namespace {

constexpr std::size_t kWidth = 80;
constexpr std::size_t kHelpColumn = 26;

/// Words filled into lines that end before kWidth; those after the first start at the indent.
std::string filled(const std::string& text, std::size_t indent) {
    std::string lines;
    std::size_t column = indent;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find(' ', begin), text.size());
        const std::string word = text.substr(begin, end - begin);
        if (column > indent && column + 1 + word.size() > kWidth) {
            lines += "\n" + std::string(indent, ' ');
            column = indent;
        }
        if (column > indent) lines += " ";
        column += word.size() + (column > indent ? 1 : 0);
        lines += word;
        begin = end + 1;
    }
    return lines;
}

std::string spelling(const Option& option) {
    std::string text = "  ";
    if (option.name.find(',') == 1)
        text += std::string("-") + option.name[0] + ", --" + option.name.substr(2);
    else if (!option.name.empty())
        text += (option.is_on ? "--[no-]" : "--") + option.name;
    if (!option.value.empty()) text += (option.name.empty() ? "" : " ") + option.value;
    return text;
}

}  // namespace

std::string help_text(const std::string& usage, const std::string& summary,
                      const std::vector<OptionGroup>& groups) {
    std::string text = "usage: " + usage + "\n\n" + filled(summary, 0) + "\n";
    for (const OptionGroup& group : groups) {
        text += group.title.empty() ? "\n" : "\n" + group.title + ":\n";
        for (const Option& option : group.options) {
            std::string line = spelling(option);
            if (line.size() + 2 > kHelpColumn)
                text += line + "\n" + std::string(kHelpColumn, ' ');
            else
                text += line + std::string(kHelpColumn - line.size(), ' ');
            text += filled(option.help, kHelpColumn) + "\n";
        }
    }
    return text;
}

}  // namespace pbrbake::cli

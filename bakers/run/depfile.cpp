#include <set>

#include "bakers/run/run.hpp"

namespace pbrbake::run {
namespace {

/// As make and ninja read it: spaces and # after a backslash, $ doubled, backslashes before a space doubled.
std::string escaped(const std::string& path) {
    std::string text;
    std::size_t backslashes = 0;
    for (const char letter : path) {
        if (letter == ' ' || letter == '#') text.append(backslashes, '\\').append("\\");
        if (letter == '$') text += '$';
        backslashes = letter == '\\' ? backslashes + 1 : 0;
        text += letter;
    }
    return text;
}

}  // namespace

std::string depfile_text(const RunReport& report) {
    std::string text;
    for (const auto& manifest : report.manifests) text += escaped(manifest.generic_string()) + " ";
    std::set<std::string> sources;
    for (const BakeReport& bake : report.bakes) {
        for (const auto& file : bake.writes) text += escaped(file.generic_string()) + " ";
        for (const auto& file : bake.reads) sources.insert(file.generic_string());
        if (!bake.job->file.empty()) sources.insert(bake.job->file.generic_string());
    }
    if (!text.empty()) text.pop_back();
    text += ":";
    for (const std::string& source : sources) text += " \\\n  " + escaped(source);
    return text + "\n";
}

}  // namespace pbrbake::run

#include "bakers/texture/names.hpp"

namespace pbrbake::texture {
namespace {

/// Of ASCII, whatever the locale.
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::string_view file_name(std::string_view path) {
    const std::size_t slash = path.find_last_of("/\\");
    return slash == path.npos ? path : path.substr(slash + 1);
}

}  // namespace

std::vector<std::string> words_of(const std::string& path) {
    std::vector<std::string> words(1);
    for (const char stored : file_name(path)) {
        const char c = lower(stored);
        if (c >= 'a' && c <= 'z')
            words.back() += c;
        else if (!words.back().empty())
            words.emplace_back();
    }
    if (words.back().empty()) words.pop_back();
    return words;
}

bool matches(std::string_view pattern, std::string_view path) {
    if (pattern.find('/') == pattern.npos) path = file_name(path);
    // Only the last star needs to be tried again: what an earlier one could take, it can too.
    std::size_t p = 0, i = 0, star = pattern.npos, star_end = 0;
    while (i < path.size()) {
        if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            star_end = i;
        } else if (p < pattern.size() && (pattern[p] == '?' || lower(pattern[p]) == lower(path[i]))) {
            ++p;
            ++i;
        } else if (star != pattern.npos) {
            p = star + 1;
            i = ++star_end;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

}  // namespace pbrbake::texture

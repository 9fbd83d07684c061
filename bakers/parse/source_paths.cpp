#include "bakers/parse/source_paths.hpp"

#include <algorithm>

namespace pbrbake::parse {

std::optional<std::string> path_refusal(const std::string& path) {
    if (path.starts_with("data:")) return "is embedded";
    if (path.empty() || std::ranges::any_of(path, [](char c) { return static_cast<unsigned char>(c) < 32; }))
        return "is no path";
    if (path.starts_with('/') || path.find(':') != path.npos) return "is no file beside this one";
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        if (path.substr(begin, end - begin) == "..") return "leads out of the folder";
        begin = end + 1;
    }
    return {};
}

std::string path_of_uri(std::string_view uri) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool is_code =
            uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
        path += is_code          ? static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]))
                : uri[i] == '\\' ? '/'
                                 : uri[i];
        if (is_code) i += 2;
    }
    return path;
}

}  // namespace pbrbake::parse

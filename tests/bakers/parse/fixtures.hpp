#pragma once
// Files for tests: written here, or found in the folder of real assets.

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "bakers/parse/lights.hpp"
#include "bakers/parse/photometry.hpp"

namespace pbrbake::parse::test {

inline std::span<const std::byte> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::byte*>(text.data()), text.size()};
}

inline PhotometricFile parse(const std::string& text, const std::string& name = "lamp.ies") {
    return parse_photometry(bytes_of(text), name);
}

/// "code: what()" of what parsing throws, "" if it parses.
inline std::string error_of(const std::string& text) {
    try {
        parse(text);
    } catch (const Error& error) {
        return std::to_string(static_cast<int>(error.code())) + " " + error.what();
    }
    return "";
}

/// What a file of lights is refused with as unreadable input, "" if it is read.
inline std::string refusal_of_lights(const std::string& text, const std::string& name) {
    try {
        parse_lights(bytes_of(text), name);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unreadable_input) << error.what();
        return error.what();
    }
    return "";
}

inline bool has(const std::vector<Diagnostic>& diagnostics, const std::string& code) {
    for (const Diagnostic& diagnostic : diagnostics)
        if (diagnostic.code == code) return true;
    return false;
}

/// The folder of real photometric files, empty where it is absent.
inline std::filesystem::path real_files() {
    const char* stated = std::getenv("PBRBAKE_SHARED_DATA");
    const std::filesystem::path path =
        (stated ? std::filesystem::path(stated)
                : std::filesystem::path(PBRBAKE_SOURCE_DIR) / ".." / "shared" / "data") /
        "ies";
    return std::filesystem::is_directory(path) ? path : std::filesystem::path();
}

inline std::string read_text(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// The rows of a table of tab-parted columns, its header left out.
inline std::vector<std::vector<std::string>> read_table(const std::filesystem::path& path) {
    std::vector<std::vector<std::string>> rows;
    std::istringstream stream(read_text(path));
    for (std::string line; std::getline(stream, line);) {
        std::vector<std::string> cells(1);
        for (const char c : line)
            if (c == '\t')
                cells.emplace_back();
            else if (c != '\r')
                cells.back() += c;
        rows.push_back(std::move(cells));
    }
    if (!rows.empty()) rows.erase(rows.begin());
    return rows;
}

}  // namespace pbrbake::parse::test

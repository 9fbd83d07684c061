// Finds and loads the modules: beside the executable's tree first, then where they were installed.

#include <dlfcn.h>

#include <filesystem>
#include <string>
#include <vector>

#include "bakers/error.hpp"
#include "bakers/io/module_api.hpp"

namespace pbrbake::io {
namespace {

std::vector<std::filesystem::path> module_directories() {
    std::vector<std::filesystem::path> directories;
    std::error_code error;
    const auto executable = std::filesystem::read_symlink("/proc/self/exe", error);
    if (!error) {
        const auto folder = executable.parent_path();
        directories.push_back(folder.parent_path() / "lib" / "pbrbake");
        // Where an installed tree has it, wherever that tree now stands: lib may be lib64 or
        // lib/x86_64-linux-gnu.
        const auto installed = (folder / PBRBAKE_MODULE_DIR_FROM_PROGRAM).lexically_normal();
        if (installed != directories.front()) directories.push_back(installed);
    }
    directories.emplace_back(PBRBAKE_MODULE_DIR);
    return directories;
}

/// The table that `entry` of module `file` returns. `purpose` ends the error: "needed to …".
template <class Table>
const Table* load_table(const std::string& file, const char* entry, const std::string& purpose) {
    std::string looked_for;
    for (const auto& directory : module_directories()) {
        const std::string path = (directory / file).string();
        looked_for += (looked_for.empty() ? "" : ", ") + path;
        std::error_code error;
        if (!std::filesystem::exists(path, error)) continue;
        // Never closed: tables and readers live as long as the process.
        void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
        if (!library)
            throw Error(ExitCode::unreadable_input, path, std::string("could not be loaded: ") + dlerror());
        const auto table_of = reinterpret_cast<const Table* (*)()>(dlsym(library, entry));
        if (!table_of) throw Error(ExitCode::unreadable_input, path, std::string("has no ") + entry);
        const Table* table = table_of();
        if (table->abi != kModuleAbi)
            throw Error(ExitCode::unreadable_input, path,
                        "has interface version " + std::to_string(table->abi) + "; this program needs " +
                            std::to_string(kModuleAbi) + ": install both from one build");
        return table;
    }
    throw Error(ExitCode::unreadable_input, file,
                "module needed to " + purpose + " is absent; looked for " + looked_for);
}

}  // namespace

const OiioModule& oiio_module() {
    static const OiioModule* const table =
        load_table<OiioModule>("pbrbake_oiio.so", "pbrbake_oiio_module", "read HDR, PNG, TIFF, TGA and JPEG");
    return *table;
}

const OcioModule& ocio_module() {
    static const OcioModule* const table =
        load_table<OcioModule>("pbrbake_ocio.so", "pbrbake_ocio_module", "convert between colour spaces");
    return *table;
}

}  // namespace pbrbake::io

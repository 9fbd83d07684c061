// Any bytes as a job file: a job, or an error that says where.

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "bakers/job/job.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace pbrbake;
    static const std::string file =
        (std::filesystem::temp_directory_path() / ("job_fuzz_" + std::to_string(getpid()) + ".json"))
            .string();
    std::FILE* stream = std::fopen(file.c_str(), "wb");
    if (!stream || std::fwrite(data, 1, size, stream) != size) std::abort();
    std::fclose(stream);
    try {
        job::load(file);
    } catch (const Error& error) {
        if (error.message().empty()) std::abort();
    }
    return 0;
}

#include "bakers/verify/machine.hpp"

#include <fstream>
#include <thread>

namespace pbrbake::verify {

Machine this_machine() {
    Machine machine{"unknown", static_cast<int>(std::thread::hardware_concurrency()), ""};
#if defined(__clang__)
    machine.compiler = "clang " __clang_version__;
#else
    machine.compiler = "gcc " __VERSION__;
#endif
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);)
        if (line.starts_with("model name")) {
            machine.processor = line.substr(line.find(':') + 2);
            break;
        }
    return machine;
}

}  // namespace pbrbake::verify

#pragma once
// What times were measured on. For reports alone: nothing in a product depends on it.

#include <string>

namespace pbrbake::verify {

struct Machine {
    std::string processor;  ///< "AMD EPYC 9R14"; "unknown" where the system doesn't tell
    int threads = 1;        ///< that the system offers
    std::string compiler;   ///< "gcc 12.2.0"
};

Machine this_machine();

}  // namespace pbrbake::verify

#pragma once
// What a parser has to say: an Error for what is dangerous, a Diagnostic for what was tolerated.

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bakers/error.hpp"

namespace pbrbake::parse {

/// note: worth knowing. warning: something was assumed that may be wrong. suspicion: the file is likely
/// wrong.
enum class Severity { note, warning, suspicion };

/// One departure from the format, or one doubt, and what was assumed.
struct Diagnostic {
    Severity severity = Severity::note;
    std::string code;     ///< stable, for scripts: "open_ring"
    int line = 0;         ///< counted from 1; 0: of the whole file
    std::string message;  ///< what was found, and what was assumed
    bool operator==(const Diagnostic&) const = default;
};

/// A malformed file: "lamp.ies:12: found …; allowed: …". Line 0 leaves the number out.
inline Error malformed(std::string_view file, int line, std::string message) {
    std::string where(file);
    if (line > 0) where.append(":").append(std::to_string(line));
    return Error(ExitCode::unreadable_input, std::move(where), std::move(message));
}

}  // namespace pbrbake::parse

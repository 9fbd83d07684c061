#pragma once
// The one exception type of the bakers. It is caught once a bake, so that one bad asset never stops the
// others.

#include <stdexcept>
#include <string>
#include <utility>

namespace pbrbake {

/// Process exit codes; frozen, scripts rely on them.
enum class ExitCode : int {
    done = 0,
    mixed_failures = 1,     ///< bakes failed in different ways
    usage = 2,              ///< unknown command or flag, bad flag value
    invalid_job = 3,        ///< job file is not JSON or breaks the schema
    unreadable_input = 4,   ///< source missing, truncated, malformed or over a limit
    unwritable_output = 5,  ///< output could not be written
    comparison_failed = 6,
    accuracy_missed = 7,  ///< a bake stated max_error and its certificate is above it
    interrupted = 130,
};

/// A failure that a user can act on.
/// `where` is the file, or the file and JSON pointer ("job.json#/bakes/0/size"); `message` says what was
/// found, what is allowed, and where it helps, what to do. what() is "where: message".
class Error : public std::runtime_error {
  public:
    Error(ExitCode code, std::string where, std::string message)
        : std::runtime_error(where.empty() ? message : where + ": " + message),
          code_(code),
          where_(std::move(where)),
          message_(std::move(message)) {}

    ExitCode code() const noexcept { return code_; }
    const std::string& where() const noexcept { return where_; }
    const std::string& message() const noexcept { return message_; }

  private:
    ExitCode code_;
    std::string where_, message_;
};

}  // namespace pbrbake

#pragma once
// The built program, run as a user runs it.

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/bakers/job/temporary_folder.hpp"

namespace pbrbake::test {

/// A running pbrbake. Standard streams go to files.
class Program {
  public:
    explicit Program(const std::vector<std::string>& arguments) {
        std::vector<std::string> texts{PBRBAKE_PROGRAM};
        texts.insert(texts.end(), arguments.begin(), arguments.end());
        std::vector<char*> argv;
        for (std::string& text : texts) argv.push_back(text.data());
        argv.push_back(nullptr);

        posix_spawn_file_actions_t actions;
        posix_spawn_file_actions_init(&actions);
        const auto redirect = [&](int stream, const char* name) {
            posix_spawn_file_actions_addopen(&actions, stream, (streams_ / name).c_str(), O_WRONLY | O_CREAT,
                                             0600);
        };
        redirect(STDOUT_FILENO, "out");
        redirect(STDERR_FILENO, "err");
        const int failed = ::posix_spawn(&pid_, PBRBAKE_PROGRAM, &actions, nullptr, argv.data(), environ);
        posix_spawn_file_actions_destroy(&actions);
        if (failed) throw std::runtime_error("cannot start " PBRBAKE_PROGRAM);
    }

    ~Program() {
        if (ended_) return;
        ::kill(pid_, SIGKILL);
        wait();
    }
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    pid_t pid() const { return pid_; }

    /// Its exit code, or minus the signal that ended it.
    int wait() {
        int status = 0;
        ::waitpid(pid_, &status, 0);
        ended_ = true;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    }

    std::string out() const { return read_file(streams_ / "out"); }
    std::string err() const { return read_file(streams_ / "err"); }

  private:
    TemporaryFolder streams_;
    pid_t pid_ = -1;
    bool ended_ = false;
};

struct Outcome {
    int code;
    std::string out, err;
};

inline Outcome run_program(const std::vector<std::string>& arguments) {
    Program program(arguments);
    const int code = program.wait();
    return {code, program.out(), program.err()};
}

/// Names and bytes of all files in a folder.
inline std::vector<std::pair<std::string, std::string>> contents(const std::filesystem::path& folder) {
    std::vector<std::pair<std::string, std::string>> files;
    if (std::filesystem::exists(folder))
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            files.emplace_back(entry.path().filename().string(), read_file(entry.path()));
    std::sort(files.begin(), files.end());
    return files;
}

}  // namespace pbrbake::test

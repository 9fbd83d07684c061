#include "bakers/run/atomic_file.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "bakers/error.hpp"
#include "tests/bakers/job/temporary_folder.hpp"

namespace pbrbake::run {
namespace {

namespace fs = std::filesystem;

int files_in(const fs::path& folder) {
    return static_cast<int>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(WriteAtomically, MakesFoldersAndReplacesFiles) {
    const test::TemporaryFolder folder;
    write_atomically(folder / "a/b/c.txt", "one");
    write_atomically(folder / "a/b/c.txt", "two");
    EXPECT_EQ(test::read_file(folder / "a/b/c.txt"), "two");
    EXPECT_EQ(files_in(folder / "a/b"), 1) << "a temporary file was left behind";
}

TEST(WriteAtomically, TakesPermissionsFromUmask) {
    const test::TemporaryFolder folder;
    const mode_t before = ::umask(027);
    write_atomically(folder / "a.txt", "");
    ::umask(before);
    EXPECT_EQ(fs::status(folder / "a.txt").permissions(), fs::perms(0640));
}

void expect_unwritable(const fs::path& file) {
    try {
        write_atomically(file, "text");
        ADD_FAILURE() << file;
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::unwritable_output);
        EXPECT_EQ(error.where(), file.string());
    }
}

TEST(WriteAtomically, NamesTheFileThatCannotBeWritten) {
    const test::TemporaryFolder folder;
    folder.write("file", "kept");
    fs::create_directory(folder / "folder");
    expect_unwritable(folder / "file/a.txt");
    expect_unwritable(folder / "folder");
    expect_unwritable("/proc/a.txt");
    expect_unwritable(folder / std::string(300, 'n'));
    EXPECT_EQ(test::read_file(folder / "file"), "kept");
    EXPECT_EQ(files_in(folder.path()), 2);
}

TEST(WriteAtomically, LeavesTheOldFileWhenAWriteFails) {
    const test::TemporaryFolder folder;
    folder.write("a.txt", "old");
    const auto write_beyond_the_limit = [&] {
        ::signal(SIGXFSZ, SIG_IGN);
        rlimit limit{};
        limit.rlim_cur = limit.rlim_max = 1000;
        ::setrlimit(RLIMIT_FSIZE, &limit);
        try {
            write_atomically(folder / "a.txt", std::string(2000, 'x'));
        } catch (const Error& error) {
            ::_exit(static_cast<int>(error.code()));
        }
        ::_exit(0);
    };
    EXPECT_EXIT(write_beyond_the_limit(), testing::ExitedWithCode(5), "");
    EXPECT_EQ(test::read_file(folder / "a.txt"), "old");
    EXPECT_EQ(files_in(folder.path()), 1);
}

TEST(WriteAtomically, LeavesNothingBehindWhenKilled) {
    const test::TemporaryFolder folder;
    const int nameless = ::open(folder.path().c_str(), O_WRONLY | O_TMPFILE, 0600);
    if (nameless < 0) GTEST_SKIP() << "this file system knows no files without a name";
    ::close(nameless);
    const auto die_while_writing = [&] {
        const rlimit none{};
        ::setrlimit(RLIMIT_CORE, &none);
        rlimit limit{};
        limit.rlim_cur = limit.rlim_max = 1000;
        ::setrlimit(RLIMIT_FSIZE, &limit);
        ::signal(SIGXFSZ, SIG_DFL);
        write_atomically(folder / "a.txt", std::string(2000, 'x'));
    };
    EXPECT_EXIT(die_while_writing(), testing::KilledBySignal(SIGXFSZ), "");
    EXPECT_EQ(files_in(folder.path()), 0);
}

}  // namespace
}  // namespace pbrbake::run

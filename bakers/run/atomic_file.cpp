#include "bakers/run/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "bakers/error.hpp"

namespace pbrbake::run {
namespace fs = std::filesystem;
namespace {

[[noreturn]] void fail(const fs::path& file, const std::string& what, int error_number) {
    throw Error(ExitCode::unwritable_output, file.string(),
                what + ": " + std::generic_category().message(error_number));
}

/// A POSIX file descriptor that is closed at the end of its scope.
class Descriptor {
  public:
    explicit Descriptor(int descriptor) : descriptor_(descriptor) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    int get() const { return descriptor_; }
    int close() { return descriptor_ < 0 ? 0 : ::close(std::exchange(descriptor_, -1)); }

  private:
    int descriptor_;
};

/// Removes a file at the end of its scope, if it is there.
struct Temporary {
    fs::path path;
    bool exists = false;
    ~Temporary() {
        if (exists) ::unlink(path.c_str());
    }
};

fs::path temporary_name(const fs::path& file) {
    static std::atomic<unsigned> count{0};
    std::string name = ".";
    name += file.filename().string();
    name.append(".")
        .append(std::to_string(::getpid()))
        .append("-")
        .append(std::to_string(count++))
        .append(".tmp");
    return file.parent_path() / name;
}

const char* c_path(const fs::path& folder) { return folder.empty() ? "." : folder.c_str(); }

constexpr const char* kOpenFiles = "/proc/self/fd";
constexpr mode_t kAsUmaskSays = 0666;

/// Opens a file that has no name yet, so that it vanishes if the process is killed. -1 where there is no such
/// thing, as on network file systems.
int open_nameless(const fs::path& folder) {
    if (::access(kOpenFiles, X_OK) != 0) return -1;  // give_name would fail
    return ::open(c_path(folder), O_WRONLY | O_TMPFILE | O_CLOEXEC, kAsUmaskSays);
}

/// link() never replaces a file, hence a temporary name for what was nameless too.
bool give_name(int descriptor, const fs::path& name) {
    const fs::path nameless = fs::path(kOpenFiles) / std::to_string(descriptor);
    return ::linkat(AT_FDCWD, nameless.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

void write_all(int descriptor, std::span<const std::byte> bytes, const fs::path& file) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail(file, "cannot be written", errno);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

/// So that the rename survives a power cut. Not every file system can; a failure here loses nothing that was
/// promised.
void flush_folder(const fs::path& folder) {
    const Descriptor descriptor(::open(c_path(folder), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (descriptor.get() >= 0) ::fsync(descriptor.get());
}

}  // namespace

void write_atomically(const fs::path& file, std::span<const std::byte> bytes) {
    std::error_code error;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
    if (error) fail(file, "its folder cannot be made", error.value());
    if (fs::is_directory(file, error)) fail(file, "is in the way", EISDIR);

    Temporary temporary{temporary_name(file)};
    int opened = open_nameless(file.parent_path());
    const bool nameless = opened >= 0;
    if (!nameless) {
        opened = ::open(temporary.path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kAsUmaskSays);
        if (opened < 0) fail(file, "cannot be created", errno);
        temporary.exists = true;
    }
    Descriptor descriptor(opened);
    write_all(descriptor.get(), bytes, file);
    if (::fsync(descriptor.get()) != 0) fail(file, "cannot be flushed to disk", errno);
    if (nameless) {
        if (!give_name(descriptor.get(), temporary.path)) fail(file, "cannot be named", errno);
        temporary.exists = true;
    }
    if (descriptor.close() != 0) fail(file, "cannot be closed", errno);
    if (::rename(temporary.path.c_str(), file.c_str()) != 0) fail(file, "cannot be put in place", errno);
    temporary.exists = false;
    flush_folder(file.parent_path());
}

void write_atomically(const fs::path& file, std::string_view text) {
    write_atomically(file, std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace pbrbake::run

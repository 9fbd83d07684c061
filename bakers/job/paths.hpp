#pragma once
// Which files a job may touch.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace pbrbake::job {

/// What a path names: a file, or a picture inside a glTF file, "scene.glb#/images/3".
struct Place {
    std::string file;                  ///< "scene.glb"
    std::optional<std::size_t> image;  ///< 3

    /// The path without its folder: records hold none that is absolute.
    std::string name() const;
};
Place place_of(const std::string& path);

/// Resolves paths against a folder, and keeps them inside it and the roots, symbolic links followed.
class Fence {
  public:
    /// A fence around the folder and the roots; relative roots start at the folder.
    Fence(std::filesystem::path folder, const std::vector<std::filesystem::path>& roots);
    /// No fence: relative paths start at the current folder, all are trusted.
    static Fence open();

    std::filesystem::path resolve(const std::string& path) const {
        return (folder_ / path).lexically_normal();
    }
    /// Why a path is refused, in words; nothing if it is allowed.
    std::optional<std::string> refusal(const std::string& path) const;
    /// The path of a file that is allowed: as given, or else as it is spelt on disk where the case of letters
    /// differs (the first such name in byte order); "" where there is none.
    std::string find(const std::string& path) const;

  private:
    Fence() = default;
    std::filesystem::path folder_;
    std::vector<std::filesystem::path> allowed_;
    bool fenced_ = false;
};

}  // namespace pbrbake::job

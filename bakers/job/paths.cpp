#include "bakers/job/paths.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <system_error>

namespace pbrbake::job {
namespace fs = std::filesystem;
namespace {

/// Absolute, links followed as far as the path exists. weakly_canonical leaves a relative path relative where
/// nothing of it exists, so it starts from the current folder.
fs::path real_path(const fs::path& path) {
    std::error_code error;
    const fs::path absolute = fs::absolute(path.empty() ? "." : path, error);
    const fs::path real = fs::weakly_canonical(absolute, error);
    return (error ? absolute : real).lexically_normal();
}

bool is_inside(const fs::path& path, const fs::path& folder) {
    const auto [end, unused] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    return end == folder.end() || (std::next(end) == folder.end() && end->empty());  // a trailing slash
}

std::string lower_case(std::string text) {
    for (char& letter : text)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return text;
}

/// The entry of a folder that `name` is but for the case of its letters, or "".
std::string nearest_entry(const fs::path& folder, const std::string& name) {
    std::string best;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string found = entry->path().filename().string();
        if (lower_case(found) == lower_case(name) && (best.empty() || found < best)) best = found;
    }
    return best;
}

constexpr std::string_view kInside = "#/images/";

}  // namespace

std::string Place::name() const {
    const std::string file_name = fs::path(file).filename().string();
    return image ? file_name + std::string(kInside) + std::to_string(*image) : file_name;
}

Place place_of(const std::string& path) {
    const std::size_t at = path.rfind(kInside), begin = at + kInside.size();
    std::size_t image = 0;
    if (at != path.npos && begin < path.size()) {
        const char* end = path.data() + path.size();
        if (const auto [stop, error] = std::from_chars(path.data() + begin, end, image);
            stop == end && error == std::errc())
            return {path.substr(0, at), image};
    }
    return {path, {}};
}

Fence::Fence(fs::path folder, const std::vector<fs::path>& roots)
    : folder_(std::move(folder)), fenced_(true) {
    allowed_.push_back(real_path(folder_));
    for (const fs::path& root : roots) allowed_.push_back(real_path(folder_ / root));
}

Fence Fence::open() { return {}; }

std::optional<std::string> Fence::refusal(const std::string& path) const {
    if (path.find('\0') != std::string::npos) return "holds a NUL character";
    if (!fenced_) return std::nullopt;
    if (fs::path(path).is_absolute())
        return "is absolute; give it relative to the job file, so that the job means the same everywhere";
    const fs::path real = real_path(resolve(path));
    const auto inside = [&](const fs::path& folder) { return is_inside(real, folder); };
    if (std::any_of(allowed_.begin(), allowed_.end(), inside)) return std::nullopt;
    return "leads outside the job file's folder, to " + real.string() +
           "; allowed: that folder and its roots (add one to \"roots\", or with --root DIR)";
}

std::string Fence::find(const std::string& path) const {
    fs::path found;
    std::error_code error;
    for (const fs::path& part : fs::path(path)) {
        const fs::path exact = found / part;
        if (refusal(exact.string())) return "";
        if (fs::exists(resolve(exact.string()), error)) {
            found = exact;
            continue;
        }
        const std::string entry = nearest_entry(resolve(found.string()), part.string());
        if (entry.empty()) return "";
        found /= entry;
    }
    return fs::is_regular_file(resolve(found.string()), error) && !refusal(found.string()) ? found.string()
                                                                                           : "";
}

}  // namespace pbrbake::job

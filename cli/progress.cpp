#include "cli/progress.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace pbrbake::cli {
namespace {

constexpr auto kRedrawEvery = std::chrono::milliseconds(60);

/// Columns of the terminal behind stderr.
int terminal_width() {
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

std::string headline_text(const run::BakeReport& report) {
    if (!report.entry.contains("certificate") || !report.entry["certificate"].contains("headline")) return "";
    const Json& headline = report.entry["certificate"]["headline"];
    char number[32];
    std::snprintf(number, sizeof number, "%.2g", headline["value"].get<double>());
    return "  " + headline["metric"].get<std::string>() + " " + number + " (" +
           headline["evidence"].get<std::string>() + ")";
}

}  // namespace

Progress::Progress(bool quiet) : quiet_(quiet), has_bar_(!quiet && ::isatty(STDERR_FILENO) == 1) {}

void Progress::started(const job::Bake& bake) {
    title_ = bake.name + "  " + bake.kind;
    start_ = Clock::now();
    drawn_ = start_;  // what ends at once gets no bar
}

void Progress::progress(run::Stage stage, double fraction) {
    if (!has_bar_ || Clock::now() - drawn_ < kRedrawEvery) return;
    char tail[64];
    std::snprintf(tail, sizeof tail, "] %3.0f %%  %.1f s  %s", 100 * fraction, seconds(),
                  std::string(run::kStageNames[static_cast<std::size_t>(stage)]).c_str());
    const int room = terminal_width() - 1 - static_cast<int>(std::string(tail).size()) - 3;
    const std::string title = title_.substr(0, static_cast<std::size_t>(std::max(0, room - 10)));
    const int cells = std::clamp(room - static_cast<int>(title.size()), 0, 40);
    const int filled = static_cast<int>(fraction * cells);
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(cells - filled), ' ');
    std::fprintf(stderr, "\r\033[K%s  [%s%s", title.c_str(), bar.c_str(), tail);
    std::fflush(stderr);
    is_drawn_ = true;
    drawn_ = Clock::now();
}

void Progress::clear() {
    if (is_drawn_) std::fprintf(stderr, "\r\033[K");
    is_drawn_ = false;
}

void Progress::finished(const run::BakeReport& report) {
    clear();
    const char* name = report.bake->name.c_str();
    if (!report.error.empty()) std::fprintf(stderr, "pbrbake: error: %s: %s\n", name, report.error.c_str());
    if (!quiet_ && report.status != run::Status::failed)  // warnings are of a product
        for (const std::string& warning : report.warnings)
            std::fprintf(stderr, "pbrbake: warning: %s: %s\n", name, warning.c_str());
    if (!quiet_ && !report.entry.is_null() && !report.writes.empty())
        std::fprintf(stderr, "%s  %s  %.2f s%s\n", name, report.writes.front().c_str(), seconds(),
                     headline_text(report).c_str());
}

}  // namespace pbrbake::cli

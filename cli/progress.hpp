#pragma once
// How a run goes, on stderr: a bar that redraws itself on a terminal, and a line for each finished bake
// anywhere.

#include <chrono>
#include <string>

#include "bakers/run/run.hpp"

namespace pbrbake::cli {

class Progress : public run::Observer {
  public:
    /// `quiet` leaves errors alone.
    explicit Progress(bool quiet);

    void started(const job::Bake& bake) override;
    void progress(run::Stage stage, double fraction) override;
    void finished(const run::BakeReport& report) override;

  protected:
    /// Wipes the bar.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;
    double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

    bool quiet_, has_bar_;
    bool is_drawn_ = false;
    std::string title_;
    Clock::time_point start_, drawn_;
};

}  // namespace pbrbake::cli

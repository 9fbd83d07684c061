// Outputs are old, new or absent, whatever ends the program.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <map>
#include <thread>

#include "tests/cli/program.hpp"

namespace pbrbake::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEndless = R"({"version": 1, "output": "out", "bakes": [
    {"kind": "dfg", "name": "endless", "size": 4096, "integrator": "is", "samples": 1024, "certify": "none"}]})";

std::string three_tables(int size) {
    std::string bakes;
    for (const char* name : {"a", "b", "c"})
        bakes += std::string(bakes.empty() ? "" : ",") + R"({"kind": "dfg", "certify": "none", "name": ")" +
                 name + "\", \"size\": " + std::to_string(size) + "}";
    return "{\"version\": 1, \"output\": \"out\", \"bakes\": [" + bakes + "]}";
}

int interrupted(int signal, const fs::path& job) {
    Program program({"bake", job});
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    ::kill(program.pid(), signal);
    return program.wait();
}

TEST(Interruption, ExitsWith130AndLeavesNothing) {
    const TemporaryFolder folder;
    const fs::path job = folder.write("job.json", kEndless);
    EXPECT_EQ(interrupted(SIGINT, job), 130);
    EXPECT_EQ(interrupted(SIGTERM, job), 130);
    EXPECT_TRUE(contents(folder / "out").empty());
}

TEST(Interruption, KilledRunsTearNoFile) {
    const TemporaryFolder folder;
    const std::map<int, fs::path> jobs{{31, folder.write("old.json", three_tables(31))},
                                       {32, folder.write("new.json", three_tables(32))}};
    std::map<std::string, std::vector<std::string>> whole;  // file -> the bytes it may have
    std::chrono::duration<double> duration{};
    for (const auto& [size, job] : jobs) {
        const auto start = std::chrono::steady_clock::now();
        ASSERT_EQ(run_program({"bake", job}).code, 0);
        duration = std::chrono::steady_clock::now() - start;
        for (const auto& [name, bytes] : contents(folder / "out")) whole[name].push_back(bytes);
    }
    const auto undisturbed = contents(folder / "out");

    constexpr int kKills = 30;
    for (int i = 0; i < kKills; ++i) {
        Program program({"bake", jobs.at(i % 2 == 0 ? 31 : 32)});
        std::this_thread::sleep_for(duration * (1.2 * ((i * 17) % kKills) / kKills));
        ::kill(program.pid(), SIGKILL);
        program.wait();
        for (const auto& [name, bytes] : contents(folder / "out")) {
            if (name.ends_with(".tmp")) continue;
            EXPECT_THAT(whole[name], testing::Contains(bytes)) << name << " is torn";
        }
    }
    for (const auto& entry : fs::directory_iterator(folder / "out"))
        if (entry.path().extension() == ".tmp") fs::remove(entry.path());
    ASSERT_EQ(run_program({"bake", jobs.at(32)}).code, 0);
    EXPECT_EQ(contents(folder / "out"), undisturbed);
}

}  // namespace
}  // namespace pbrbake::test

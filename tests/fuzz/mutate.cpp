// Runs a fuzz harness without libFuzzer: the corpus as it is, then mutations of it for some seconds. What CI
// can do with any compiler; the deep search is ./dev fuzz.
//
//     mutate_NAME SECONDS CORPUS
//
// A harness that aborts leaves its input in the file mutate_failure, for libFuzzer to minimise.

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "pbr/numerics/sequence.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<Bytes> read_corpus(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    std::vector<Bytes> corpus;
    for (const auto& path : paths) {
        std::ifstream stream(path, std::ios::binary);
        corpus.emplace_back(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    }
    return corpus;
}

/// One to eight small changes, all from a counter: number `n` is the same input in every run.
Bytes mutated(const std::vector<Bytes>& corpus, std::uint64_t n) {
    std::uint64_t draw = 0;
    const auto below = [&](std::size_t end) {
        return static_cast<std::size_t>(pbr::random_bits(n, draw++) % std::max<std::size_t>(end, 1));
    };
    static const std::string kTokens[] = {
        "-1",           "0", "1e308", "1e-320", "nan", "inf",      "2147483648",       "18446744073709551616",
        "37.0",         ",", "\r",    "\n",     " ",   "\0\0\0\0", "\xff\xff\xff\xff", "\xef\xbb\xbf",
        "TILT=INCLUDE", "{", "]",     "\""};
    Bytes bytes = corpus[below(corpus.size())];
    for (std::size_t left = 1 + below(8); left > 0; --left) {
        const std::size_t at = below(bytes.size() + 1);
        const auto place = bytes.begin() + static_cast<std::ptrdiff_t>(at);
        const std::size_t run = std::min(bytes.size() - at, 1 + below(16));
        const auto end = place + static_cast<std::ptrdiff_t>(run);
        switch (below(6)) {
            case 0:
                if (at < bytes.size()) bytes[at] ^= static_cast<std::uint8_t>(1u << below(8));
                break;
            case 1:
                bytes.erase(place, end);
                break;
            case 2: {
                const Bytes copy(place, end);
                const std::size_t to = below(bytes.size() + 1);
                bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(to), copy.begin(), copy.end());
                break;
            }
            case 3: {
                const std::string& token = kTokens[below(std::size(kTokens))];
                bytes.insert(place, token.begin(), token.end());
                break;
            }
            case 4:
                bytes.resize(at);
                break;
            default: {
                const Bytes& other = corpus[below(corpus.size())];
                bytes.erase(place, bytes.end());
                bytes.insert(bytes.end(),
                             other.begin() + static_cast<std::ptrdiff_t>(std::min(other.size(), at)),
                             other.end());
            }
        }
    }
    return bytes;
}

const Bytes* current = nullptr;

void keep_input(int) {
    if (std::FILE* file = current ? std::fopen("mutate_failure", "wb") : nullptr) {
        std::fwrite(current->data(), 1, current->size(), file);
        std::fclose(file);
    }
    std::signal(SIGABRT, SIG_DFL);
    std::abort();
}

void run(const Bytes& bytes) {
    current = &bytes;
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::fprintf(stderr, "usage: %s SECONDS CORPUS\n", argv[0]);
        return 2;
    }
    const std::vector<Bytes> corpus = read_corpus(argv[2]);
    if (corpus.empty()) {
        std::fprintf(stderr, "%s: holds no file\n", argv[2]);
        return 2;
    }
    std::signal(SIGABRT, keep_input);
    for (const Bytes& bytes : corpus) run(bytes);
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(std::atof(argv[1]));
    std::uint64_t n = 0;
    for (; std::chrono::steady_clock::now() < end; ++n) {
        run(mutated(corpus, n));
    }
    std::printf("%llu mutations of %zu files\n", static_cast<unsigned long long>(n), corpus.size());
}

#include "bakers/job/json_text.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <iterator>
#include <set>
#include <system_error>
#include <vector>

namespace pbrbake::job {
namespace {

/// Follows a parse, keeps the keys of every open object, and refuses what nlohmann's parser lets through.
class StrictReading {
  public:
    StrictReading(const std::string& file, int deepest) : file_(file), deepest_(deepest) {}

    bool operator()(int depth, Json::parse_event_t event, const Json& parsed) {
        using Event = Json::parse_event_t;
        switch (event) {
            case Event::object_start:
            case Event::array_start:
                step();
                if (depth >= deepest_)
                    throw Error(ExitCode::invalid_job, file_,
                                "nested deeper than " + std::to_string(deepest_) + " levels");
                open_.push_back({});
                open_.back().is_array = event == Event::array_start;
                break;
            case Event::object_end:
            case Event::array_end:
                open_.pop_back();
                break;
            case Event::key:
                open_.back().key = parsed.get<std::string>();
                if (!open_.back().keys.insert(open_.back().key).second)
                    throw Error(ExitCode::invalid_job, file_ + "#" + here(),
                                "key given twice; keep one of them");
                break;
            case Event::value:
                step();
                break;
        }
        return true;
    }

  private:
    struct Open {
        bool is_array = false;
        std::size_t elements = 0;
        std::string key;
        std::set<std::string> keys;
    };

    void step() {
        if (!open_.empty()) ++open_.back().elements;
    }

    std::string here() const {
        Json::json_pointer pointer;
        for (const Open& open : open_)
            if (open.is_array)
                pointer /= open.elements - 1;
            else
                pointer /= open.key;
        return pointer.to_string();
    }

    const std::string& file_;
    int deepest_;
    std::vector<Open> open_;
};

/// "file:line:column" of a byte, both from 1.
std::string position(const std::string& file, std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte == 0 ? 0 : byte - 1, text.size()));
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t newline = before.rfind('\n');
    const std::size_t column =
        newline == std::string_view::npos ? before.size() + 1 : before.size() - newline;
    return file + ":" + std::to_string(line) + ":" + std::to_string(column);
}

/// Reads up to the number that is out of range: unlike a parse, this tells where.
class NumberSearch final : public nlohmann::json_sax<Json> {
  public:
    std::size_t byte() const { return byte_; }

    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(number_integer_t) override { return true; }
    bool number_unsigned(number_unsigned_t) override { return true; }
    bool number_float(number_float_t, const string_t&) override { return true; }
    bool string(string_t&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool key(string_t&) override { return true; }
    bool end_object() override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t end, const std::string& token, const Json::exception&) override {
        byte_ = end - std::min(end, token.size()) + 1;
        return false;
    }

  private:
    std::size_t byte_ = 0;  ///< the first of the number, counted from 1
};

/// nlohmann's message without its own prefix and position: "while parsing value - unexpected ']'; expected
/// …".
std::string reason(std::string_view what) {
    for (const std::string_view prefix : {"] ", "syntax error "})
        if (const std::size_t at = what.find(prefix); at != std::string_view::npos)
            what.remove_prefix(at + prefix.size());
    return std::string(what);
}

}  // namespace

Json parse_json(std::string_view text, const std::string& file, int deepest) {
    try {
        return Json::parse(text, StrictReading(file, deepest));
    } catch (const Json::parse_error& error) {
        throw Error(ExitCode::invalid_job, position(file, text, error.byte),
                    "not JSON: " + reason(error.what()));
    } catch (const Json::exception& error) {  // a number out of range
        NumberSearch search;
        Json::sax_parse(text, &search);
        throw Error(ExitCode::invalid_job, position(file, text, search.byte()),
                    "not JSON: " + reason(error.what()));
    }
}

std::string read_text(const std::filesystem::path& file, std::size_t largest) {
    std::error_code status_error;
    const auto status = std::filesystem::status(file, status_error);
    if (!std::filesystem::exists(status))
        throw Error(ExitCode::unreadable_input, file.string(), "no such file");
    if (std::filesystem::is_directory(status))
        throw Error(ExitCode::unreadable_input, file.string(), "is a folder; give a file");
    std::ifstream stream(file, std::ios::binary);
    if (!stream)
        throw Error(ExitCode::unreadable_input, file.string(),
                    "cannot be opened: " + std::generic_category().message(errno));
    std::string text;
    std::array<char, 65536> piece;
    while (text.size() <= largest && (stream.read(piece.data(), piece.size()) || stream.gcount() > 0))
        text.append(piece.data(), static_cast<std::size_t>(stream.gcount()));
    if (text.size() > largest)
        throw Error(ExitCode::unreadable_input, file.string(),
                    "larger than the " + std::to_string(largest >> 20) + " MiB that it may have");
    return text;
}

std::string to_text(const Json& value) {
    return value.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string to_line(const Json& value) { return value.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace pbrbake::job

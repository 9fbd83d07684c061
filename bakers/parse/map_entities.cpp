#include "bakers/parse/map_entities.hpp"

#include <algorithm>

#include "bakers/parse/text.hpp"

namespace pbrbake::parse {
namespace {

/// Braces, quoted texts and other words, with their lines.
class Tokens {
  public:
    enum class Kind { open, close, quoted, word, end };

    Tokens(std::string_view text, std::string_view file) : text_(text), file_(file) {}

    Kind next() {
        skip_blanks();
        if (at_ == text_.size()) return Kind::end;
        const char c = text_[at_];
        if (c == '{' || c == '}') {
            ++at_;
            return c == '{' ? Kind::open : Kind::close;
        }
        if (c == '"') return quoted_text();
        const std::size_t end = std::min(text_.find_first_of(" \t\r\n{}\"", at_), text_.size());
        token_ = text_.substr(at_, end - at_);
        at_ = end;
        return Kind::word;
    }

    std::string_view token() const { return token_; }
    int line() const { return line_; }

  private:
    void skip_blanks() {
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '\n') {
                ++line_, ++at_;
            } else if (c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f') {
                ++at_;
            } else if (text_.substr(at_, 2) == "//") {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else {
                return;
            }
        }
    }

    Kind quoted_text() {
        const std::size_t end = text_.find_first_of("\"\n", at_ + 1);
        if (end == text_.npos || text_[end] == '\n')
            throw malformed(file_, line_, "has a quote that isn't closed on its line");
        token_ = text_.substr(at_ + 1, end - at_ - 1);
        at_ = end + 1;
        return Kind::quoted;
    }

    std::string_view text_, file_, token_;
    std::size_t at_ = 0;
    int line_ = 1;
};

}  // namespace

std::vector<MapEntity> read_map_entities(std::string_view text, std::string_view file) {
    constexpr int kDeepest = 64;
    Tokens tokens(text, file);
    std::vector<MapEntity> entities;
    std::vector<int> open;  // lines of braces that wait for their end
    std::string key;
    bool has_key = false;
    for (;;) {
        switch (tokens.next()) {
            case Tokens::Kind::open:
                if (open.size() == kDeepest)
                    throw malformed(file, tokens.line(), "nests blocks deeper than 64 levels");
                if (has_key)
                    throw malformed(file, tokens.line(),
                                    "found a brace where the value of " + parse::quoted(key) + " should be");
                open.push_back(tokens.line());
                if (open.size() == 1) entities.push_back({tokens.line(), {}});
                break;
            case Tokens::Kind::close:
                if (open.empty()) throw malformed(file, tokens.line(), "closes a brace that none opened");
                if (has_key)
                    throw malformed(file, tokens.line(),
                                    "found a brace where the value of " + parse::quoted(key) + " should be");
                open.pop_back();
                break;
            case Tokens::Kind::quoted:
                if (open.size() != 1) break;
                if (has_key)
                    entities.back().pairs[key] = std::string(tokens.token());
                else
                    key = std::string(tokens.token());
                has_key = !has_key;
                break;
            case Tokens::Kind::word:
                if (has_key)
                    throw malformed(file, tokens.line(),
                                    "found " + parse::quoted(tokens.token()) + " where the value of " +
                                        parse::quoted(key) + " should be; allowed: a text in quotes");
                break;
            case Tokens::Kind::end:
                if (!open.empty())
                    throw malformed(file, open.back(),
                                    "opens a brace that isn't closed; it may be truncated");
                if (has_key)
                    throw malformed(file, tokens.line(),
                                    "ends where the value of " + parse::quoted(key) + " should be");
                return entities;
        }
    }
}

}  // namespace pbrbake::parse

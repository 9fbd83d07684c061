// Every public function of libpbr has a docstring.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace pbrbake::test {
namespace {

namespace fs = std::filesystem;

/// Reads a header as a list of declarations. Knows just enough of C++ for headers in this house's layout:
/// namespaces, classes with access specifiers, functions and their bodies; `///` lines and blank lines count.
class Scanner {
  public:
    explicit Scanner(std::istream& header) {
        int number = 0;
        for (std::string line; std::getline(header, line);) read_line(line, ++number);
    }
    /// "12: name" of every public function without a docstring.
    const std::vector<std::string>& undocumented() const { return undocumented_; }
    int functions() const { return functions_; }

  private:
    enum class Scope { open, hidden, body };  ///< declarations are public; private; no declarations at all

    void read_line(const std::string& line, int number) {
        const std::size_t first = line.find_first_not_of(' ');
        if (first == std::string::npos) {
            if (statement_.empty()) documented_ = false, previous_.clear();
            return;
        }
        if (line.compare(first, 3, "///") == 0) {
            if (statement_.empty()) documented_ = true;
            return;
        }
        if (line[first] == '#') return;
        static const std::regex comment("//.*$"), text(R"("(\\.|[^"\\])*"|'(\\.|[^'\\])')");
        for (const char c : std::regex_replace(std::regex_replace(line, text, "\"\""), comment, ""))
            read(c, number);
    }

    void read(char c, int number) {
        if (statement_.empty()) {
            if (std::isspace(static_cast<unsigned char>(c))) return;
            line_ = number;
        }
        if (c == '(') ++parentheses_;
        if (c == ')') --parentheses_;
        if (c == '{' && parentheses_ == 0) return enter();
        if (c == '}' && parentheses_ == 0) return leave();
        if (c == ';' && parentheses_ == 0) return finish();
        statement_ += c;
        static const std::regex access(R"(^(public|private|protected)\s*:$)");
        std::smatch match;
        if (c == ':' && std::regex_match(statement_, match, access)) {
            scopes_.back() = match[1] == "public" ? Scope::open : Scope::hidden;
            statement_.clear();
        }
    }

    void enter() {
        static const std::regex names(R"(^(inline )?namespace\b|^extern\b)");
        static const std::regex type(R"(^(template\s*<.*>\s*)?(class|struct|union)\b[^(]*$)");
        const bool inside = scope() == Scope::open;
        if (inside && std::regex_search(statement_, names))
            scopes_.push_back(statement_.find("detail") == std::string::npos ? Scope::open : Scope::hidden);
        else if (inside && std::regex_search(statement_, type))
            scopes_.push_back(statement_.find("class ") != std::string::npos &&
                                      !std::regex_search(statement_, std::regex(R"(\bstruct\b)"))
                                  ? Scope::hidden
                                  : Scope::open);
        else {
            check();
            scopes_.push_back(Scope::body);
        }
        begin_statement();
    }

    void leave() {
        if (!scopes_.empty()) scopes_.pop_back();
        begin_statement();
    }

    void finish() {
        check();
        begin_statement();
    }

    void begin_statement() {
        statement_.clear();
        documented_ = false;
    }

    /// The statement read, if it declares a public function, needs a docstring or stands beside its overload.
    void check() {
        static const std::regex function(R"(([A-Za-z_]\w*|operator\s*[^\s(]+)\s*\()");
        static const std::regex exempt(
            R"(^(using|static_assert|typedef|friend|return|if|for)\b|=\s*(default|delete)$)");
        std::string text = std::regex_replace(statement_, std::regex(R"(\s+$)"), "");
        std::smatch match;
        if (scope() != Scope::open || std::regex_search(text, exempt)) return;
        const std::string declaration = strip_template(text);
        if (!std::regex_search(declaration, match, function)) return;
        const std::string before = match.prefix();
        if (before.find('=') != std::string::npos && match[1].str().rfind("operator", 0) != 0)
            return;  // a variable
        if (before.size() >= 2 && before.compare(before.size() - 2, 2, "::") == 0)
            return;  // defined elsewhere
        const std::string name = match[1];
        ++functions_;
        if (!documented_ && name != previous_) undocumented_.push_back(std::to_string(line_) + ": " + name);
        previous_ = name;
    }

    static std::string strip_template(const std::string& text) {
        if (text.rfind("template", 0) != 0) return text;
        int depth = 0;
        for (std::size_t i = text.find('<'); i < text.size(); ++i) {
            depth += text[i] == '<' ? 1 : text[i] == '>' ? -1 : 0;
            if (depth == 0) return text.substr(i + 1);
        }
        return text;
    }

    Scope scope() const {
        for (const Scope s : scopes_)
            if (s != Scope::open) return s;
        return Scope::open;
    }

    std::vector<Scope> scopes_;
    std::string statement_;
    std::string previous_;  ///< the function declared last, if nothing but code lies between
    bool documented_ = false;
    int line_ = 0;
    int parentheses_ = 0;
    int functions_ = 0;
    std::vector<std::string> undocumented_;
};

std::vector<std::string> undocumented(const std::string& header) {
    std::istringstream stream(header);
    return Scanner(stream).undocumented();
}

TEST(Docstrings, AreOnEveryPublicFunctionOfLibpbr) {
    const fs::path root = fs::path(PBRBAKE_SOURCE_DIR) / "libpbr/include";
    std::vector<std::string> found;
    int functions = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
        if (entry.path().extension() != ".hpp") continue;
        std::ifstream stream(entry.path());
        const Scanner scanner(stream);
        functions += scanner.functions();
        for (const std::string& place : scanner.undocumented())
            found.push_back(entry.path().lexically_relative(root).generic_string() + ":" + place);
    }
    EXPECT_THAT(found, testing::IsEmpty());
    EXPECT_GT(functions, 70);
}

TEST(Docstrings, ScannerFindsFunctionsWithoutOne) {
    EXPECT_THAT(undocumented("namespace pbr {\nint f(int a);\n}\n"), testing::ElementsAre("2: f"));
    EXPECT_THAT(undocumented("namespace pbr {\n/// Doc.\nint f(int a);\n}\n"), testing::IsEmpty());
    EXPECT_THAT(
        undocumented("namespace pbr {\n/// Doc.\n\ntemplate <class T>\nT f(T a) {\n    return g(a);\n}\n}\n"),
        testing::ElementsAre("4: f"));
}

TEST(Docstrings, ScannerLetsOverloadsShareOne) {
    EXPECT_THAT(undocumented("/// Doc.\nint f(int a);\nint f(double a);\n"), testing::IsEmpty());
    EXPECT_THAT(undocumented("/// Doc.\nint f(int a);\n\nint f(double a);\n"), testing::ElementsAre("4: f"));
    EXPECT_THAT(undocumented("/// Doc.\nint f(int a);\nint g(double a);\n"), testing::ElementsAre("3: g"));
}

TEST(Docstrings, ScannerSeesWhatIsPublicInClasses) {
    EXPECT_THAT(undocumented("class A {\n  public:\n    A(int a);\n  private:\n    int hidden();\n};\n"),
                testing::ElementsAre("3: A"));
    EXPECT_THAT(undocumented("struct A {\n    int f() const { return g(1); }\n    int x = h(2);\n};\n"),
                testing::ElementsAre("2: f"));
    EXPECT_THAT(undocumented("struct A {\n    bool operator==(const A&) const = default;\n};\n"),
                testing::IsEmpty());
}

}  // namespace
}  // namespace pbrbake::test

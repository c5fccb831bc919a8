#include "harness/run/bare_case.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <charconv>
#include <string>

namespace crossray {

namespace {

constexpr int kMaxDepth = 64;

// Goes through JSON once, without a tree of it.
class Reader {
  public:
    explicit Reader(std::string_view text) : text_(text) {}

    // Calls `read(key)`, which has to consume the value, for each entry of an object.
    template <typename Read>
    void readObject(const Read& read)
    {
        enter('{');
        if (!take('}')) {
            do {
                skipSpace();
                const std::string_view key = skipString();
                expect(':');
                skipSpace();
                read(key);
            } while (take(','));
            expect('}');
        }
        --depth_;
    }

    template <typename Read>
    void readList(const Read& read)
    {
        enter('[');
        if (!take(']')) {
            do {
                skipSpace();
                read();
            } while (take(','));
            expect(']');
        }
        --depth_;
    }

    std::string readString()
    {
        const size_t start = at_;
        const std::string_view content = skipString();
        if (content.find('\\') == std::string_view::npos) return std::string(content);
        try {
            return nlohmann::json::parse(text_.substr(start, at_ - start)).get<std::string>();
        } catch (const nlohmann::json::exception& error) {
            throw InputError(error.what());
        }
    }

    double readNumber()
    {
        double number = 0;
        const size_t start = at_;
        skipNumber();
        std::from_chars(text_.data() + start, text_.data() + at_, number);
        return number;
    }

    void skipValue()
    {
        switch (peek()) {
        case '{':
            return readObject([&](std::string_view) { skipValue(); });
        case '[':
            return readList([&] { skipValue(); });
        case '"':
            skipString();
            return;
        case 't':
            return skipWord("true");
        case 'f':
            return skipWord("false");
        case 'n':
            return skipWord("null");
        default:
            return skipNumber();
        }
    }

    void expectEnd()
    {
        skipSpace();
        if (at_ != text_.size()) fail("the end");
    }

  private:
    [[noreturn]] void fail(std::string_view expected) const
    {
        throw InputError(fmt::format("{} is expected at byte {} of a case", expected, at_));
    }

    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

    void skipSpace()
    {
        while (peek() == ' ' || peek() == '\n' || peek() == '\t' || peek() == '\r')
            ++at_;
    }

    bool take(char character)
    {
        skipSpace();
        if (peek() != character) return false;
        ++at_;
        return true;
    }

    void expect(char character)
    {
        if (!take(character)) fail(std::string_view(&character, 1));
    }

    void enter(char bracket)
    {
        expect(bracket);
        if (++depth_ > kMaxDepth) fail("a shallower value");
    }

    // Returns what stands between the quotes.
    std::string_view skipString()
    {
        if (peek() != '"') fail("a string");
        const size_t start = ++at_;
        while (peek() != '"') {
            if (static_cast<unsigned char>(peek()) < 0x20) fail("a string's end");
            at_ += peek() == '\\' ? 2 : 1;
        }
        return text_.substr(start, at_++ - start);
    }

    void skipWord(std::string_view word)
    {
        if (text_.substr(at_, word.size()) != word) fail(word);
        at_ += word.size();
    }

    void skipDigits()
    {
        if (peek() < '0' || peek() > '9') fail("a value");
        while (peek() >= '0' && peek() <= '9')
            ++at_;
    }

    void skipNumber()
    {
        if (peek() == '-') ++at_;
        skipDigits();
        if (peek() == '.') {
            ++at_;
            skipDigits();
        }
        if (peek() != 'e' && peek() != 'E') return;
        ++at_;
        if (peek() == '+' || peek() == '-') ++at_;
        skipDigits();
    }

    std::string_view text_;
    size_t at_ = 0;
    int depth_ = 0;
};

SourcePosition readPosition(Reader& reader)
{
    SourcePosition position;
    reader.readObject([&](std::string_view key) {
        if (key == "file") {
            position.file = reader.readString();
        } else if (key == "line") {
            position.line = static_cast<int>(reader.readNumber());
        } else if (key == "column") {
            position.column = static_cast<int>(reader.readNumber());
        } else {
            reader.skipValue();
        }
    });
    return position;
}

BackendResult readBackend(Reader& reader)
{
    BackendResult result;
    bool hasVerdict = false;
    reader.readObject([&](std::string_view key) {
        if (key == "backend") {
            result.backend = reader.readString();
        } else if (key == "verdict") {
            const std::string name = reader.readString();
            const auto verdict = findVerdict(name);
            if (!verdict) throw InputError(fmt::format("\"{}\" is no verdict", name));
            result.verdict = *verdict;
            hasVerdict = true;
        } else if (key == "reason") {
            result.reason = reader.readString();
        } else if (key == "times") {
            reader.readObject([&](std::string_view time) {
                if (time == "worker") {
                    result.times.worker = reader.readNumber();
                } else {
                    reader.skipValue();
                }
            });
        } else if (key == "planes") {
            result.planesFile = reader.readString();
        } else if (key == "trace") {
            result.traceFile = reader.readString();
        } else {
            reader.skipValue();
        }
    });
    if (result.backend.empty() || !hasVerdict) throw InputError("a backend has no name or no verdict");
    return result;
}

} // namespace

CaseResult parseBareCase(std::string_view text)
{
    CaseResult result;
    Reader reader(text);
    reader.readObject([&](std::string_view key) {
        if (key == "name") {
            result.name = reader.readString();
        } else if (key == "position") {
            result.position = readPosition(reader);
        } else if (key == "expected") {
            result.expectedFile = reader.readString();
        } else if (key == "conditioning") {
            reader.readObject([&](std::string_view field) {
                if (field == "file") {
                    result.conditioning.emplace().file = reader.readString();
                } else {
                    reader.skipValue();
                }
            });
        } else if (key == "backends") {
            reader.readList([&] { result.backends.push_back(readBackend(reader)); });
        } else {
            reader.skipValue();
        }
    });
    reader.expectEnd();
    if (result.name.empty()) throw InputError("a case has no name");
    return result;
}

} // namespace crossray

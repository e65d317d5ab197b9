// Text of unknown origin: what a terminal would obey is shown, what it would show is left alone.
#include "host/commands/command_text.h"
#include "host/error.h"
#include "host/json_text.h"
#include "host/safe_text.h"

#include <catch2/catch.hpp>

#include <array>
#include <cstdio>

using namespace parhelion;

namespace {

/// UTF-8 of a code point, by the definition (The Unicode Standard 15.0, table 3-6).
std::string utf8(unsigned code) {
    if (code < 0x80) return {static_cast<char>(code)};
    if (code < 0x800)
        return {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
    if (code < 0x10000)
        return {static_cast<char>(0xe0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3f)),
                static_cast<char>(0x80 | (code & 0x3f))};
    return {static_cast<char>(0xf0 | code >> 18), static_cast<char>(0x80 | (code >> 12 & 0x3f)),
            static_cast<char>(0x80 | (code >> 6 & 0x3f)), static_cast<char>(0x80 | (code & 0x3f))};
}

/// What bash makes of a word, byte by byte.
std::string echoed_by_bash(const std::string& word) {
    std::FILE* pipe =
        ::popen(("bash <<'END_OF_TEST'\nprintf %s " + word + "\nEND_OF_TEST\n").c_str(), "r");
    REQUIRE(pipe);
    std::string text;
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;)
        text += static_cast<char>(c);
    REQUIRE(::pclose(pipe) == 0);
    return text;
}

} // namespace

TEST_CASE("Safe text: every control character is an escape, on one line line ends too") {
    for (unsigned code = 0; code < 0xa0; code++) {
        const std::string text = "a" + utf8(code) + "b";
        const bool control = code < 0x20 || code >= 0x7f, blank = code == '\n' || code == '\t';
        CAPTURE(code);
        CHECK((safe_text(text) == text) == (!control || blank));
        CHECK((as_one_line(text) == text) == !control);
        // What is left has no control character, in 7 or in 8 bits.
        for (unsigned char c : as_one_line(text))
            CHECK((c >= 0x20 && c < 0x7f));
    }
    CHECK(as_one_line("\x1b[31m\a\n") == "\\u001b[31m\\u0007\\n");
    CHECK(safe_text(utf8(0x9b) + "31m") == "\\u009b31m");
    CHECK(safe_text(utf8(0x202e) + "gpj.exe") == "\\u202egpj.exe"); // right to left
    CHECK(safe_text(utf8(0x2066)) == "\\u2066");
    CHECK(as_one_line(utf8(0x2028)) == "\\u2028");
}

TEST_CASE("Safe text: what is UTF-8 stays, what is none is told byte by byte") {
    for (unsigned code : {0xa0u, 0xe9u, 0x7ffu, 0x800u, 0x20acu, 0xd7ffu, 0xe000u, 0xffffu,
                          0x10000u, 0x1f600u, 0x10ffffu})
        CHECK(safe_text(utf8(code)) == utf8(code));
    CHECK(safe_text("\xff") == "\\xff");
    CHECK(safe_text("\xc3") == "\\xc3");          // its second byte is missing
    CHECK(safe_text("\xc3(") == "\\xc3(");        // is another character
    CHECK(safe_text("\xc0\xaf") == "\\xc0\\xaf"); // a longer form of '/'
    CHECK(safe_text("\xc1\x9b") == "\\xc1\\x9b");
    CHECK(safe_text("\xe0\x80\x9b") == "\\xe0\\x80\\x9b");          // of a control character
    CHECK(safe_text(utf8(0xd800)) == "\\xed\\xa0\\x80");            // half a surrogate pair
    CHECK(safe_text("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80"); // beyond U+10FFFF
    CHECK(safe_text("\x9b"
                    "31m") == "\\x9b"
                              "31m"); // a terminal of 8 bits obeys it
    CHECK(safe_text("").empty());
}

TEST_CASE("Safe text: errors and JSON are fit for a terminal, and JSON stays JSON") {
    CHECK(std::string(InputError("a\x1b[2Jb\n").what()) == "a\\u001b[2Jb\\n");
    CHECK(std::string(OutputError("\x7f").what()) == "\\u007f");
    const nlohmann::json json{{"id", "a\x1b\x7f" + utf8(0x9b) + utf8(0x202e) + "\n\té"},
                              {"broken", "x\xffy"}};
    const std::string text = json_text(json);
    CHECK(safe_text(text) == text);
    const nlohmann::json read = nlohmann::json::parse(text);
    CHECK(read.at("id") == json.at("id"));
    CHECK(read.at("broken") == "x" + utf8(0xfffd) + "y");
}

TEST_CASE("Safe text: a shell reads back every byte of a quoted name") {
    std::string all;
    for (int byte = 1; byte < 256; byte++)
        all += static_cast<char>(byte);
    for (const std::string& name : {all, std::string("plain"), std::string("a b'c\\d"),
                                    std::string("\x1b"
                                                "1"),
                                    std::string("caf\xc3\xa9"),
                                    std::string("\xff"
                                                "f'\n")}) {
        const std::string quoted = quoted_for_shell(name);
        CHECK(as_one_line(quoted) == quoted);
        CHECK(echoed_by_bash(quoted) == name);
    }
}

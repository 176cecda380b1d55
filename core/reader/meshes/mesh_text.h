// The text of a mesh file in memory, and a cursor over it that keeps track of line and column; shared by the mesh readers.
#pragma once

#include "core/base/printable.h"
#include "core/base/vec.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>

namespace neumann {

// Vertices and triangles have 32-bit numbers.
inline constexpr std::size_t max_mesh_count = std::numeric_limits<std::uint32_t>::max();

struct OpenFile {
    struct Close {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };
    std::unique_ptr<std::FILE, Close> file;
    std::uint64_t size;
};
// Throws InputError as expect_input() does.
OpenFile open_mesh_file(const std::string& path);

// "1 vertex", "2 vertices", "2 normals".
std::string counted(std::size_t count, std::string_view noun);
// The end of a message that begins with "vertex index 9".
std::string out_of_range(std::size_t available, std::string_view noun);

class MeshText {
public:
    struct LineColumn {
        std::size_t line = 1, column = 1;
    };

    // In OBJ syntax a backslash at the end of a line continues it, and a token that begins with # ends the line. The text must
    // outlive the cursor.
    enum class Syntax { plain, obj };
    MeshText(std::string file, std::string_view text, Syntax syntax);

    const std::string& file() const { return file_; }
    bool at_end() const { return at_ == end_; }
    const char* position() const { return at_; }
    std::size_t remaining() const { return static_cast<std::size_t>(end_ - at_); }
    // The position of the token read last.
    LineColumn place() const { return {line_, static_cast<std::size_t>(token_ - line_start_) + 1}; }

    void skip_blanks() {
        while (!at_end()) {
            if (is_blank(*at_)) {
                ++at_;
            } else if (is_continuation(at_)) {
                ++at_;
                newline();
            } else {
                return;
            }
        }
    }
    // Skips blanks and sets place().
    bool at_line_end() {
        skip_blanks();
        token_ = at_;
        return at_end() || is_newline(*at_) || is_comment(at_);
    }
    // Moves to the end of the line, past continuations.
    void skip_line();
    // Moves to the beginning of the next line, past the rest of this one, such as a comment.
    void next_line();
    // Whether the cursor is at a line end that is a single CR.
    bool at_lone_cr() const { return !at_end() && *at_ == '\r' && (at_ + 1 == end_ || at_[1] != '\n'); }

    // Returns the text up to the next blank; empty at the end of the line.
    std::string_view token() {
        at_line_end();
        while (!is_delimiter(at_)) ++at_;
        return {token_, static_cast<std::size_t>(at_ - token_)};
    }
    bool accept_token(std::string_view expected) {
        if (token() == expected) return true;
        at_ = token_;
        return false;
    }
    double number();
    // Reads an integer. `expected` names it: "expected an integer, found '1.5'".
    template <class Integer>
    Integer integer(const char* expected);
    // Reads a number as a prefix of a token; returns false and does not move if there is none. begin_token() skips blanks and marks
    // the token.
    void begin_token() { at_line_end(); }
    bool integer_prefix(std::int64_t& value) {
        const auto [next, error] = std::from_chars(at_, end_, value);
        if (error != std::errc()) return false;
        at_ = next;
        return true;
    }
    bool accept(char c) {
        if (at_end() || *at_ != c) return false;
        ++at_;
        return true;
    }
    bool at_delimiter() const { return is_delimiter(at_); }
    // The place of the cursor, also within a token.
    LineColumn place_here() const { return {line_, static_cast<std::size_t>(at_ - line_start_) + 1}; }

    void expect_line_end() {
        if (!at_line_end()) fail_expected("the end of the line");
    }

    [[noreturn]] void fail(const std::string& what) const { fail(place(), what); }
    [[noreturn]] void fail(const LineColumn& place, const std::string& what) const;
    // Throws InputError "expected …, found 'token'".
    [[noreturn]] void fail_expected(std::string_view expected) const;

private:
    static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
    static bool is_newline(char c) { return c == '\n' || c == '\r'; }
    bool is_comment(const char* p) const { return *p == '#' && obj_; }
    bool is_continuation(const char* p) const { return *p == '\\' && obj_ && p + 1 != end_ && is_newline(p[1]); }
    bool is_delimiter(const char* p) const { return p == end_ || is_blank(*p) || is_newline(*p) || is_continuation(p); }
    // Skips LF, CR LF or CR.
    void newline() {
        if (*at_++ == '\r' && !at_end() && *at_ == '\n') ++at_;
        ++line_;
        line_start_ = at_;
    }

    std::string file_;
    const char* at_;
    const char* end_;
    const char* line_start_;
    const char* token_;
    std::size_t line_ = 1;
    bool obj_;
};

inline double MeshText::number() {
    if (at_line_end()) fail_expected("a number");
    // from_chars takes no plus sign.
    const bool plus = *at_ == '+' && end_ - at_ > 1 && at_[1] != '-';
    double value = 0.0;
    const auto [next, error] = std::from_chars(at_ + (plus ? 1 : 0), end_, value);
    if (error == std::errc::invalid_argument || !is_delimiter(next)) fail_expected("a number");
    if (error != std::errc()) fail("number '" + printable(token()) + "' is beyond the range of double precision");
    at_ = next;
    return value;
}

template <class Integer>
Integer MeshText::integer(const char* expected) {
    Integer value = 0;
    if (at_line_end()) fail_expected(expected);
    const auto [next, error] = std::from_chars(at_, end_, value);
    if (error != std::errc() || !is_delimiter(next)) fail_expected(expected);
    at_ = next;
    return value;
}

}  // namespace neumann

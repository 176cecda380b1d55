#include "core/reader/formats/pbrt/tokens.h"

#include "core/reader/meshes/mesh_text.h"

#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

bool is_token_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

}  // namespace

std::string Token::shown() const {
    return is_string ? fmt::format("\"{}\"", glimpse_of(text)) : fmt::format("'{}'", glimpse_of(text));
}

Tokens::Tokens(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {
    if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
}

const std::optional<Token>& Tokens::peek() {
    if (!ahead_) ahead_ = read();
    return *ahead_;
}

std::optional<Token> Tokens::next() {
    std::optional<Token> token = ahead_ ? *std::exchange(ahead_, std::nullopt) : read();
    return token;
}

Location Tokens::place() {
    if (const std::optional<Token>& token = peek()) return place(*token);
    return {file_, line_, static_cast<int>(at_ - line_start_) + 1};
}

void Tokens::skip_blanks() {
    bool in_comment = false;
    for (; at_ < text_.size(); ++at_) {
        const char c = text_[at_];
        if (c == '\n') {
            ++line_;
            line_start_ = at_ + 1;
            in_comment = false;
        } else if (c == '#') {
            in_comment = true;
        } else if (!in_comment && !is_token_blank(c)) {
            return;
        }
    }
}

std::optional<Token> Tokens::read() {
    skip_blanks();
    if (at_ == text_.size()) return std::nullopt;
    Token token;
    token.line = line_;
    token.column = static_cast<int>(at_ - line_start_) + 1;
    const std::size_t first = at_++;
    if (text_[first] == '"') {
        read_string(token);
    } else {
        if (text_[first] != '[' && text_[first] != ']')
            while (at_ < text_.size() && !is_token_blank(text_[at_]) &&
                   std::string_view("\"[]#").find(text_[at_]) == std::string::npos)
                ++at_;
        token.text = text_.substr(first, at_ - first);
    }
    return token;
}

void Tokens::take_plain_numbers(bool whole, std::vector<double>& values) {
    while (!ahead_) {
        skip_blanks();
        const char *const begin = text_.data() + at_, *const end = text_.data() + text_.size();
        double value = 0.0;
        std::int32_t whole_value = 0;
        const auto [behind, error] = whole ? std::from_chars(begin, end, whole_value) : std::from_chars(begin, end, value);
        const bool ends = behind == end || is_token_blank(*behind) || *behind == ']';
        if (error != std::errc() || !ends || !std::isfinite(value)) return;
        values.push_back(whole ? whole_value : value);
        at_ += static_cast<std::size_t>(behind - begin);
    }
}

// A backslash escapes a quote or a backslash. Before anything else it is itself, as in file names on Windows; pbrt has
// \n and the like, which no scene needs.
void Tokens::read_string(Token& token) {
    token.is_string = true;
    for (; at_ < text_.size() && text_[at_] != '\n'; ++at_) {
        if (text_[at_] == '"') {
            ++at_;
            return;
        }
        const bool is_escape = text_[at_] == '\\' && at_ + 1 < text_.size() && (text_[at_ + 1] == '"' || text_[at_ + 1] == '\\');
        if (is_escape) ++at_;
        token.text += text_[at_];
    }
    throw InputError(place(token), "the string does not end on its line, expected \"");
}

}  // namespace neumann::reader

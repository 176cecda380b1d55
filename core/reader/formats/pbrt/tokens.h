// The words of a pbrt file: strings in quotes, brackets, and whatever else stands between blanks. # begins a comment.
#pragma once

#include "core/base/error.h"

#include <optional>
#include <string>
#include <vector>

namespace neumann::reader {

struct Token {
    std::string text;  // of a string without its quotes
    bool is_string = false;
    int line = 0, column = 0;

    bool is(const char* word) const { return !is_string && text == word; }
    std::string shown() const;  // as in the file, for messages; a few characters
};

class Tokens {
public:
    // `text` is that of the file with this name.
    Tokens(std::string file, std::string text);

    // The next token, or nothing at the end. Throws InputError for a string that does not end on its line.
    const std::optional<Token>& peek();
    std::optional<Token> next();

    // Appends numbers, or whole numbers of 32 bits, as long as they are finite and end at a blank or a ]; the next
    // token is the first that is not. This is a fast way through long lists.
    void take_plain_numbers(bool whole, std::vector<double>& values);

    const std::string& file() const { return file_; }
    Location place(const Token& token) const { return {file_, token.line, token.column}; }
    // The place of the next token, or of the end.
    Location place();

private:
    std::optional<Token> read();
    void skip_blanks();
    void read_string(Token& token);

    std::string file_, text_;
    std::size_t at_ = 0, line_start_ = 0;
    int line_ = 1;
    std::optional<std::optional<Token>> ahead_;
};

}  // namespace neumann::reader

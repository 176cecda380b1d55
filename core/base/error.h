// Errors that a user can act on. The program prints what() and nothing else.
#pragma once

#include <stdexcept>
#include <string>

namespace neumann {

// A place in a file; line and column count from 1, 0 means unknown.
struct Location {
    std::string file;
    int line = 0;
    int column = 0;
    std::string pointer = {};  // JSON pointer (RFC 6901) in place of a line: "/materials/3/name"
};

// "file:line:column", leaving out what is unknown, or "file#/materials/3/name".
std::string to_string(const Location& place);

// The command or the scene is wrong (exit code 2): "file:line:column: what is wrong, what was expected".
class InputError : public std::runtime_error {
public:
    explicit InputError(const std::string& what) : std::runtime_error(what) {}
    InputError(const Location& place, const std::string& what) : std::runtime_error(to_string(place) + ": " + what) {}
};

// The value of an option is wrong: "tail 0.1: the series …". `what` follows the option's name, with a value or without
// it; the code that reports the error decides how the name is spelled, such as "--tail".
class OptionError : public InputError {
public:
    OptionError(const std::string& option, const std::string& what)
        : InputError(option + (what.starts_with(':') || what.starts_with(' ') ? "" : " ") + what) {}
};

// All errors of a scene are things in it that are not known; a lenient reader reads it without them.
class UnknownError : public InputError {
    using InputError::InputError;
};

// Something failed while running, such as a disk that is full (exit code 1).
class RunError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace neumann

// The one description of every option of a method: what it is called, what it may be, what it means, and which methods have it.
// The command line and its help, run.json, replays, studies and Python are made from it.
#pragma once

#include "operators/methods/method.h"

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace neumann {

struct MethodOption {
    enum class Kind { text, number, flag };  // a number is whole; a flag "true" or "false"
    Kind kind;
    std::string name, type, help;
    // What is wrong with a text, in words; empty where it can be read.
    std::function<std::string(const std::string&)> wrong;
    std::function<bool(const Method&)> belongs_to;
    // The method has it, and the text is right.
    std::function<void(Method&, const std::string&)> read;
    // As read() takes it; empty where the method does not have it, or it is left open.
    std::function<std::string(const Method&)> text;
};

// In the order of the help.
std::span<const MethodOption> method_options();
std::vector<std::string> method_names();
// Of all methods, in a few words each.
const std::string& method_help();

// A method as it is asked for, option by option.
struct MethodText {
    std::string name = "walk";
    std::vector<std::pair<std::string, std::string>> options = {};
};
// Throws InputError where a name or a text is unknown, an option does not belong to the method, or two of them exclude each other.
Method make_method(const MethodText& text);
// The same in one word: "walk:direct=bsdf:lights=power".
Method read_method(const std::string& word);
// What --direct calls it.
std::string name_of(const DirectLightSettings& direct);
// All options that are not left open; make_method() makes the same method of it.
MethodText text_of(const Method& method);
// Those of them that are not as they are without being asked for.
MethodText differences_of(const Method& method);

}  // namespace neumann

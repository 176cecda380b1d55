// The only table of the methods' options: name, legal values, help text, and which methods have the option. The command
// line with its help, run.json, replays, studies and Python use it.
#pragma once

#include "operators/render/methods/method.h"

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace neumann {

struct MethodOption {
    enum class Kind { text, number, flag };  // a number is a whole number; a flag is "true" or "false"
    Kind kind;
    std::string name, type, help;
    // Returns what is wrong with a text, in words, or an empty string if read() accepts it.
    std::function<std::string(const std::string&)> wrong;
    std::function<bool(const Method&)> belongs_to;
    // Sets the option. Requires that the method has it and that wrong(text) is empty.
    std::function<void(Method&, const std::string&)> read;
    // The value in the form that read() accepts; empty if the method does not have the option or leaves it open.
    std::function<std::string(const Method&)> text;
    std::vector<std::string> words = {};  // all words that read() accepts, if it accepts nothing else
};

// All options, in the order of the help.
std::span<const MethodOption> method_options();
std::vector<std::string> method_names();
// Explains what is wrong with the name of a method, and which name may be meant; "" if there is such a method.
std::string wrong_method(const std::string& name);
// Help texts: for a method in a few words, and for the choice of a method.
const char* help_of(const Method& method);
const std::string& method_help();

// A method as text: its name, and the options that are given.
struct MethodText {
    std::string name = {};  // empty: auto, or walk if an option is given that auto does not have
    std::vector<std::pair<std::string, std::string>> options = {};
};
// Throws InputError for an unknown name or text, an option of other methods, and options that exclude each other.
Method make_method(const MethodText& text);
// Reads a method from one word: "walk:direct=bsdf:lights=power".
Method read_method(const std::string& word);
// The value of --direct for these settings, and whether it has light samples, for which lights are chosen.
std::string name_of(const DirectLightSettings& direct);
bool samples_lights(const DirectLightSettings& direct);
// The inverse of make_method(): all options that are not left open.
MethodText text_of(const Method& method);
// Like text_of(), but only with options that differ from their defaults.
MethodText differences_of(const Method& method);

}  // namespace neumann

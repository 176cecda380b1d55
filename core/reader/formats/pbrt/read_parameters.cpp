// Reads the syntax of parameters: "type name" value, or "type name" [ value value … ].
#include "core/base/did_you_mean.h"
#include "core/reader/formats/pbrt/parameters.h"
#include "core/reader/meshes/mesh_text.h"
#include "core/reader/xml/element.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

// How many numbers make a value; 0 if the values are texts.
const std::map<std::string, std::size_t>& sizes_of_types() {
    static const std::map<std::string, std::size_t> sizes = {
        {"blackbody", 1}, {"bool", 1},   {"float", 1},   {"integer", 1}, {"normal", 3},  {"point2", 2},  {"point3", 3},
        {"rgb", 3},       {"string", 0}, {"texture", 0}, {"vector2", 2}, {"vector3", 3}, {"spectrum", 2}};
    return sizes;
}

// The usual name of a type that has several.
std::string usual_type(const std::string& type) {
    if (type == "point") return "point3";
    if (type == "vector") return "vector3";
    return type == "normal3" ? "normal" : type;
}

std::vector<std::string> words_of(const std::string& text) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : text + ' ') {
        if (c != ' ' && c != '\t') {
            word += c;
        } else if (!word.empty()) {
            words.push_back(std::move(word));
            word.clear();
        }
    }
    return words;
}

// Integers have 32 bits, as in pbrt; larger ones would not be exact doubles, either.
double parse_value(const Token& token, const std::string& type, const Location& place) {
    if (type == "bool") {
        if (token.text == "true") return 1.0;
        if (token.text == "false") return 0.0;
        throw InputError(place, fmt::format("expected true or false, found {}", token.shown()));
    }
    const char *begin = token.text.data(), *end = begin + token.text.size();
    if (token.text.size() > 1 && *begin == '+' && begin[1] != '-') ++begin;  // from_chars takes no plus sign
    if (type == "integer") {
        std::int32_t value = 0;
        const auto [at, error] = std::from_chars(begin, end, value);
        if (token.is_string || at != end || error != std::errc())
            throw InputError(place, fmt::format("expected an integer, found {}", token.shown()));
        return value;
    }
    double value = 0.0;
    const auto [at, error] = std::from_chars(begin, end, value);
    if (token.is_string || at != end || error == std::errc::invalid_argument)
        throw InputError(place, fmt::format("expected a number, found {}", token.shown()));
    if (error != std::errc() || !std::isfinite(value))
        throw InputError(place, fmt::format("the number {} is beyond the range of double precision", token.shown()));
    return value;
}

// A directive begins with a capital letter outside of quotes.
bool is_directive(const Token& token) { return !token.is_string && token.text[0] >= 'A' && token.text[0] <= 'Z'; }

}  // namespace

void Parameters::read(Tokens& tokens) {
    while (tokens.peek() && tokens.peek()->is_string) {
        const Token declaration = *tokens.next();
        problems_->attempt(place_, [&] { read_one(tokens, declaration); });
    }
    // These brackets remain of a parameter that could not be read.
    while (tokens.peek() && (tokens.peek()->is("[") || tokens.peek()->is("]"))) {
        problems_->add(
            InputError(tokens.place(), fmt::format("unexpected {} after the parameters of {}", tokens.peek()->shown(), title_)),
            place_);
        while (tokens.peek() && !tokens.peek()->is("]") && !tokens.peek()->is_string) tokens.next();
        if (tokens.peek() && tokens.peek()->is("]")) tokens.next();
    }
}

void Parameters::read_one(Tokens& tokens, const Token& declaration) {
    const std::vector<std::string> words = words_of(declaration.text);
    Parameter parameter{words.empty() ? "" : usual_type(words[0]), words.size() < 2 ? "" : words[1], tokens.place(declaration)};
    try {
        read_values(tokens, parameter);
        if (words.size() != 2)
            throw InputError(parameter.place, fmt::format("{} is not a type and a name, expected for example \"float radius\"",
                                                          declaration.shown()));
        check_count(parameter);
        if (const auto same = std::find_if(
                all_.begin(), all_.end(), [&](const Parameter& p) { return p.name == parameter.name && p.type == parameter.type; });
            same != all_.end())
            throw InputError(parameter.place, fmt::format("parameter '{}' of {} is given twice, first at {}",
                                                          printable(parameter.name), title_, to_string(same->place)));
    } catch (const InputError&) {
        spoilt_.insert(parameter.name);
        throw;
    }
    all_.push_back(std::move(parameter));
}

// Reads all values, also those of a parameter with a problem, so that what follows can be understood.
void Parameters::read_values(Tokens& tokens, Parameter& parameter) {
    const auto size = sizes_of_types().find(parameter.type);
    std::optional<InputError> problem;
    const auto take = [&](const Token& token) {
        if (size == sizes_of_types().end() || problem) return;
        try {
            const bool is_text = size->second == 0 || (parameter.type == "spectrum" && token.is_string);
            if (!is_text)
                parameter.numbers.push_back(parse_value(token, parameter.type, tokens.place(token)));
            else if (token.is_string)
                parameter.texts.push_back(token.text);
            else
                throw InputError(tokens.place(token), fmt::format("expected a string in quotes, found {}", token.shown()));
        } catch (const InputError& e) {
            problem = e;
        }
    };
    if (tokens.peek() && tokens.peek()->is("[")) {
        const Token bracket = *tokens.next();
        if (size != sizes_of_types().end() && size->second > 0 && parameter.type != "bool")
            tokens.take_plain_numbers(parameter.type == "integer", parameter.numbers);
        while (tokens.peek() && !tokens.peek()->is("]")) {
            if (tokens.peek()->is("["))
                throw InputError(tokens.place(), fmt::format("[ within the values of '{}', which begin at {}",
                                                             printable(parameter.name), to_string(tokens.place(bracket))));
            take(*tokens.next());
        }
        if (!tokens.next()) throw InputError(tokens.place(bracket), "[ without ]");
    } else if (tokens.peek() && !is_directive(*tokens.peek())) {
        take(*tokens.next());
    }  // otherwise check_count() reports that there is no value
    if (size == sizes_of_types().end()) {
        std::vector<std::string> types;
        for (const auto& [type, count] : sizes_of_types()) types.push_back(type);
        throw InputError(parameter.place,
                         fmt::format("unknown type '{}'; {}", printable(parameter.type), allowed_instead(parameter.type, types)));
    }
    if (problem) throw *problem;
}

void Parameters::check_count(Parameter& parameter) {
    const std::size_t count = parameter.numbers.size(), texts = parameter.texts.size();
    if (count + texts == 0)
        throw InputError(parameter.place, fmt::format("{} of {} has no value", printable(parameter.name), title_));
    if (texts > 0 && count > 0)
        throw InputError(parameter.place, fmt::format("{} of {} has numbers and strings", printable(parameter.name), title_));
    const std::size_t size = sizes_of_types().at(parameter.type);
    if (size > 1 && count % size != 0)
        throw InputError(parameter.place,
                         fmt::format("{} of {} has {} numbers, expected {} for each {}", printable(parameter.name), title_, count,
                                     size, parameter.type == "spectrum" ? "wavelength" : parameter.type));
}

}  // namespace neumann::reader

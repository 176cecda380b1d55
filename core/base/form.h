// The textual form of a value, as users give it on the command line, in Python, and in files.
#pragma once

#include "core/base/named_values.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace neumann {

template <class Value>
struct Form {
    std::function<std::optional<Value>(const std::string&)> read;  // nothing if the text is wrong
    std::function<std::string(const Value&)> print;                // the text from which read() gets the value
    std::function<std::string(const std::string&)> wrong;          // what is wrong with a text that is not read, in words
    bool is_number = false;                                        // whether the value is also a number in JSON
};

inline auto not_a(std::string expected) {
    return [expected = std::move(expected)](const std::string& text) { return fmt::format("'{}' is not {}", text, expected); };
}

template <class Number>
std::optional<Number> number_in(const std::string& text) {
    Number value{};
    const bool has_plus = std::is_floating_point_v<Number> && text.starts_with('+') && !text.starts_with("+-");
    const auto [end, error] = std::from_chars(text.data() + (has_plus ? 1 : 0), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

inline Form<std::string> any_text() {
    const auto as_it_is = [](const std::string& text) { return text; };
    return {as_it_is, as_it_is, [](const std::string&) { return std::string(); }};
}

inline Form<std::string> one_of(std::vector<std::string> words) {
    Form<std::string> form = any_text();
    form.read = [words](const std::string& text) {
        return std::find(words.begin(), words.end(), text) != words.end() ? std::optional(text) : std::nullopt;
    };
    form.wrong = [words](const std::string& text) { return not_in(text, words); };
    return form;
}

template <class Number = std::uint64_t>
Form<Number> whole_from(std::uint64_t low, std::uint64_t high) {
    const auto read = [=](const std::string& text) -> std::optional<Number> {
        const auto n = number_in<std::uint64_t>(text);
        return n && *n >= low && *n <= high ? std::optional(static_cast<Number>(*n)) : std::nullopt;
    };
    return {read, [](const Number& n) { return fmt::format("{}", n); },
            not_a(fmt::format("a whole number from {} to {}", low, high)), true};
}

inline Form<double> real(std::function<bool(double)> fits, std::string expected) {
    const auto read = [=](const std::string& text) {
        const auto x = number_in<double>(text);
        return x && std::isfinite(*x) && fits(*x) ? x : std::nullopt;
    };
    return {read, [](const double& x) { return fmt::format("{}", x); }, not_a(std::move(expected)), true};
}

inline Form<double> above_zero(std::string expected = "a number above 0") {
    return real([](double x) { return x > 0.0; }, std::move(expected));
}

inline Form<bool> yes_or_no() {
    return {
        [](const std::string& text) { return text == "true" || text == "false" ? std::optional(text == "true") : std::nullopt; },
        [](bool on) { return on ? "true" : ""; }, not_a("true or false")};
}

template <class Value>
Form<Value> one_of_named(const Named<Value>& all) {
    return {[&all](const std::string& text) { return value(all, text); }, [&all](const Value& v) { return name(all, v); },
            [&all](const std::string& text) { return not_in(text, names(all)); }};
}

// Two whole numbers with a sign between them: "3/16", "19,160".
inline std::optional<std::array<int, 2>> two_whole(const std::string& text, char sign) {
    const std::size_t between = text.find(sign);
    if (between == text.npos) return std::nullopt;
    const auto a = number_in<int>(text.substr(0, between)), b = number_in<int>(text.substr(between + 1));
    return a && b ? std::optional(std::array{*a, *b}) : std::nullopt;
}

}  // namespace neumann

// Entries of the table of options, made from the members of methods that hold their values.
#pragma once

#include "operators/render/methods/method_options.h"
#include "operators/render/methods/named_values.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

namespace neumann {

template <class Number>
std::optional<Number> number(const std::string& text) {
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(value) : std::nullopt;
}

inline std::optional<double> read_length(const std::string& text) {
    const auto length = number<double>(text);
    return length && *length > 0.0 && std::isfinite(*length) ? length : std::nullopt;
}

// Makes an option. `get` reads its value from a method; a method has the option if it can be passed to `get`. `set` writes the
// value. `read` parses a text and returns nothing if the text is wrong.
template <class Get, class Set, class Read, class Print>
MethodOption option(MethodOption::Kind kind, std::string name, std::string type, std::string help, Get get, Set set, Read read,
                    Print print, std::string expected) {
    MethodOption o;
    o.kind = kind;
    o.name = std::move(name);
    o.type = std::move(type);
    o.help = std::move(help);
    o.wrong = [=](const std::string& text) { return read(text) ? "" : fmt::format("'{}' is not {}", text, expected); };
    o.belongs_to = [](const Method& method) {
        return std::visit([]<class M>(const M&) { return std::is_invocable_v<Get, const M&>; }, method);
    };
    o.read = [=](Method& method, const std::string& text) {
        std::visit(
            [&]<class M>(M& m) {
                if constexpr (std::is_invocable_v<Get, const M&>) set(m, *read(text));
            },
            method);
    };
    o.text = [=](const Method& method) {
        return std::visit(
            [&]<class M>(const M& m) -> std::string {
                if constexpr (std::is_invocable_v<Get, const M&>)
                    return print(get(m));
                else
                    return "";
            },
            method);
    };
    return o;
}

template <class Value, class Get, class Set>
MethodOption choice(std::string option_name, std::string type, std::string help, const Named<Value>& all, Get get, Set set) {
    MethodOption o = option(
        MethodOption::Kind::text, std::move(option_name), std::move(type), std::move(help), get, set,
        [&all](const std::string& text) { return value(all, text); },
        [&all](const std::optional<Value>& v) { return v ? name(all, *v) : ""; }, "");
    o.wrong = [&all](const std::string& text) { return value(all, text) ? "" : not_in(text, names(all)); };
    o.words = names(all);
    return o;
}

template <class Get, class Set>
MethodOption flag(std::string name, std::string help, Get get, Set set) {
    return option(
        MethodOption::Kind::flag, std::move(name), "", std::move(help), get, set,
        [](const std::string& text) { return text == "true" || text == "false" ? std::optional(text == "true") : std::nullopt; },
        [](bool on) { return on ? "true" : ""; }, "true or false");
}

template <class Number, class Get, class Set>
MethodOption whole(std::string name, std::string type, std::string help, std::uint64_t low, std::uint64_t high, Get get, Set set) {
    return option(
        MethodOption::Kind::number, std::move(name), std::move(type), std::move(help), get, set,
        [=](const std::string& text) -> std::optional<Number> {
            const auto n = number<std::uint64_t>(text);
            return n && *n >= low && *n <= high ? std::optional(static_cast<Number>(*n)) : std::nullopt;
        },
        [](const std::optional<Number>& n) { return n ? fmt::format("{}", *n) : std::string(); },
        fmt::format("a whole number from {} to {}", low, high));
}

}  // namespace neumann

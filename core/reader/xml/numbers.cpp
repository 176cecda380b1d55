#include "core/reader/xml/numbers.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

namespace neumann::reader {

namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string_view trim(std::string_view text) {
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// from_chars takes no plus sign.
std::string_view without_plus(std::string_view text) {
    return text.size() > 1 && text[0] == '+' && text[1] != '-' ? text.substr(1) : text;
}

double number(std::string_view text, const Attribute& a) {
    const std::string_view digits = without_plus(text);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
        throw InputError(a.place, fmt::format("'{}' is not a number", text));
    if (error == std::errc::result_out_of_range)
        throw InputError(a.place, fmt::format("'{}' is outside the range of double precision", text));
    if (!std::isfinite(value)) throw InputError(a.place, fmt::format("'{}' is not a finite number", text));
    return value;
}

}  // namespace

double parse_number(const Attribute& a) { return number(trim(a.value), a); }

std::int64_t parse_integer(const Attribute& a) {
    const std::string_view text = trim(a.value), digits = without_plus(text);
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error == std::errc::invalid_argument || end != digits.data() + digits.size())
        throw InputError(a.place, fmt::format("'{}' is not an integer", text));
    if (error == std::errc::result_out_of_range)
        throw InputError(a.place, fmt::format("'{}' is outside the range of 64-bit integers", text));
    return value;
}

bool parse_boolean(const Attribute& a) {
    std::string text(trim(a.value));
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (text == "true") return true;
    if (text == "false") return false;
    throw InputError(a.place, fmt::format("'{}' is not a boolean, expected true or false", a.value));
}

std::vector<std::string> split(const std::string& text) {
    constexpr std::string_view separators = " ,\t\r\n";
    std::vector<std::string> words;
    for (std::size_t at = text.find_first_not_of(separators); at != std::string::npos;
         at = text.find_first_not_of(separators, at)) {
        const std::size_t end = std::min(text.find_first_of(separators, at), text.size());
        words.push_back(text.substr(at, end - at));
        at = end;
    }
    return words;
}

std::vector<double> parse_numbers(const Attribute& a) {
    std::vector<double> values;
    for (const std::string& word : split(a.value)) values.push_back(number(word, a));
    return values;
}

Vec3 parse_triple(const Attribute& a) {
    const std::vector<double> v = parse_numbers(a);
    if (v.size() != 3) throw InputError(a.place, fmt::format("'{}' has {} numbers, expected 3", a.value, v.size()));
    return {v[0], v[1], v[2]};
}

Vec3 parse_xyz(const Element& e, double missing) {
    const Attribute *value = e.find("value"), *x = e.find("x"), *y = e.find("y"), *z = e.find("z");
    if (!value) return {x ? parse_number(*x) : missing, y ? parse_number(*y) : missing, z ? parse_number(*z) : missing};
    if (x || y || z)
        throw InputError(value->place, fmt::format("<{}> has both 'value' and x, y or z, expected one of them", e.tag));
    const std::vector<double> v = parse_numbers(*value);
    if (v.size() == 1) return Vec3(v[0]);
    if (v.size() == 3) return {v[0], v[1], v[2]};
    throw InputError(value->place, fmt::format("'{}' has {} numbers, expected 1 or 3", value->value, v.size()));
}

}  // namespace neumann::reader

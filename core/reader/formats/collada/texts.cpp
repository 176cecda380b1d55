#include "core/reader/formats/collada/texts.h"

#include "core/reader/xml/source_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/format.h>

namespace neumann::reader::collada {

namespace {

constexpr std::string_view blanks = " \t\r\n";

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// The offset behind a comment or the like that begins at `at`, or `at` itself.
std::size_t behind_markup(const std::string& text, std::size_t at) {
    constexpr std::string_view comment = "<!--", data = "<![CDATA[";
    const std::string_view rest = std::string_view(text).substr(at);
    if (rest.starts_with(data)) return at + data.size();
    if (rest.starts_with("]]>")) return at + 3;
    if (!rest.starts_with(comment)) return at;
    const std::size_t end = text.find("-->", at + comment.size());
    return end == std::string::npos ? text.size() : end + 3;
}

// The place of a word of an element's text. The file is read again, because only errors need it.
Location place_of_word(const Element& e, std::size_t word) {
    try {
        const SourceText source(e.place.file);
        const std::string& text = source.text();
        std::size_t at = text.find('>', source.offset(e.place));
        if (at == std::string::npos) return e.place;
        for (++at; at < text.size();) {
            if (const std::size_t behind = behind_markup(text, at); behind != at) {
                at = behind;
            } else if (is_blank(text[at])) {
                ++at;
            } else if (text[at] == '<') {
                break;
            } else if (word-- == 0) {
                return source.place(at);
            } else {
                while (at < text.size() && !is_blank(text[at]) && text[at] != '<') ++at;
            }
        }
    } catch (const InputError&) {
    }
    return e.place;
}

[[noreturn]] void fail_word(const Element& e, std::size_t number, const char* begin, const char* end, const std::string& what) {
    constexpr std::ptrdiff_t longest = 60;
    const std::string word(begin, std::min(std::find_if(begin, end, is_blank), begin + longest));
    throw InputError(place_of_word(e, number), fmt::format("'{}' {}", word, what));
}

// Calls take(begin, end) with the rest of the text at each word; `take` returns the end of the word it has read.
template <class Take>
void read_words(const Element& e, const Take& take) {
    const char *at = e.text.data(), *const end = at + e.text.size();
    for (std::size_t number = 0;; ++number) {
        while (at < end && is_blank(*at)) ++at;
        if (at == end) return;
        at = take(at, end, number);
    }
}

}  // namespace

std::string trimmed_text(const Element& e) {
    const std::size_t first = e.text.find_first_not_of(blanks);
    return first == std::string::npos ? "" : e.text.substr(first, e.text.find_last_not_of(blanks) - first + 1);
}

std::vector<double> read_numbers(const Element& e) {
    std::vector<double> values;
    read_words(e, [&](const char* begin, const char* end, std::size_t number) {
        double value = 0.0;
        const char* digits = *begin == '+' && begin + 1 < end && begin[1] != '-' ? begin + 1 : begin;  // from_chars takes no plus
        const auto [next, error] = std::from_chars(digits, end, value);
        if (error == std::errc::invalid_argument || (next < end && !is_blank(*next)))
            fail_word(e, number, begin, end, "is not a number");
        if (error == std::errc::result_out_of_range) fail_word(e, number, begin, end, "is outside the range of double precision");
        if (!std::isfinite(value)) fail_word(e, number, begin, end, "is not a finite number");
        values.push_back(value);
        return next;
    });
    return values;
}

std::vector<double> read_numbers(const Element& e, std::size_t expected) {
    std::vector<double> values = read_numbers(e);
    if (values.size() != expected) throw wrong_count(e, values.size(), fmt::format("{}", expected));
    return values;
}

double read_number(const Element& e) { return read_numbers(e, 1).front(); }

std::vector<std::uint32_t> read_indices(const Element& e) {
    std::vector<std::uint32_t> values;
    read_words(e, [&](const char* begin, const char* end, std::size_t number) {
        std::uint32_t value = 0;
        const auto [next, error] = std::from_chars(begin, end, value);
        if (error != std::errc() || (next < end && !is_blank(*next)))
            fail_word(e, number, begin, end, "is not an index, expected a whole number from 0");
        values.push_back(value);
        return next;
    });
    return values;
}

Color read_color(const Element& e) {
    const std::vector<double> v = read_numbers(e);
    if (v.size() != 3 && v.size() != 4) throw wrong_count(e, v.size(), "3 or 4");
    for (std::size_t i = 0; i < 3; ++i)
        if (v[i] < 0.0) throw InputError(place_of_word(e, i), fmt::format("a colour is negative: {}", v[i]));
    return {{v[0], v[1], v[2]}, v.size() == 4 ? v[3] : 1.0};
}

InputError wrong_count(const Element& e, std::size_t found, const std::string& expected) {
    return {e.place, fmt::format("<{}> has {} number{}, expected {}", e.tag, found, found == 1 ? "" : "s", expected)};
}

std::size_t read_count(const Attribute& a) {
    std::uint32_t value = 0;
    const char* end = a.value.data() + a.value.size();
    const auto [next, error] = std::from_chars(a.value.data(), end, value);
    if (error != std::errc() || next != end)
        throw InputError(a.place, fmt::format("{} is '{}', expected a whole number from 0", a.name, a.value));
    return value;
}

}  // namespace neumann::reader::collada

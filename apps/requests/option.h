// The options of a request: one table for the command line, its help, Python's keywords and the requests on disk.
#pragma once

#include "core/base/error.h"
#include "core/base/form.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace neumann {

// The description of an option, for any request. Values are texts: one, several for some options, "true" for a flag.
struct OptionWords {
    enum class Kind { flag, one, many };
    Kind kind = Kind::one;
    std::string name, type, help;  // "spp", "N", "Samples a pixel"; a flag has no type
    // Explains what is wrong with a text, in words; "" if it can be read.
    std::function<std::string(const std::string&)> wrong;
    bool is_number = false;  // in JSON
    bool lasts = true;       // also applies to a render that is resumed

    // The spelling on the command line: "--spp", or "-n" with a letter, or "SCENE" if it stands by itself.
    char letter = 0;
    bool stands_alone = false, is_required = false;
    std::pair<int, int> count{0, 0};           // number of texts, if several stand alone; 0: any
    char comma = 0;                            // the separator of several values
    std::optional<std::string> bare = {};      // the meaning without a value
    std::vector<std::string> excludes, needs;  // names of other options
    bool shows_default = false;                // in the help

    std::string spelled() const {
        std::string text = name;
        if (stands_alone) std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
        return stands_alone ? text : letter ? std::string{'-', letter} : "--" + name;
    }
};

template <class Request>
struct Option : OptionWords {
    // Sets the member. Requires that no text is wrong. Throws InputError for texts that exclude each other.
    std::function<void(Request&, const std::vector<std::string>&)> read;
    // The texts from which read() makes the same value; none if it is left open.
    std::function<std::vector<std::string>(const Request&)> texts;

    Option with_letter(char c) const { return with(&Option::letter, c); }
    Option alone() const { return with(&Option::stands_alone, true); }
    Option required() const { return with(&Option::is_required, true); }
    Option counting(int least, int most) const { return with(&Option::count, std::pair(least, most)); }
    Option with_commas() const { return with(&Option::comma, ','); }
    Option meaning_without_value(std::string text) const { return with(&Option::bare, std::optional(std::move(text))); }
    Option not_with(std::string other) const { return with(&Option::excludes, std::vector{std::move(other)}); }
    Option only_with(std::string other) const { return with(&Option::needs, std::vector{std::move(other)}); }
    Option showing_default() const { return with(&Option::shows_default, true); }
    Option of_this_run() const { return with(&Option::lasts, false); }

private:
    template <class Member, class Value>
    Option with(Member member, Value value) const {
        Option other = *this;
        other.*member = std::move(value);
        return other;
    }
};

template <class Request>
struct Options {
    std::string command, about;  // "render", "Render the bounces …"
    std::vector<Option<Request>> all;

    // Finds an option by its name or as the command line spells it; null if there is none.
    const Option<Request>* find(const std::string& name) const {
        const auto found = std::ranges::find_if(all, [&](const auto& o) { return o.name == name || o.spelled() == name; });
        return found == all.end() ? nullptr : &*found;
    }
};

// The given options: their names and texts.
using Given = std::vector<std::pair<std::string, std::vector<std::string>>>;

namespace detail {

template <class Value>
struct Held {
    using One = Value;
    static constexpr bool is_many = false;
    static std::vector<Value> values(const Value& value) { return {value}; }
    static void set(Value& to, std::vector<Value> values) { to = std::move(values.front()); }
};
template <class Value>
struct Held<std::optional<Value>> : Held<Value> {
    static std::vector<Value> values(const std::optional<Value>& value) {
        return value ? std::vector{*value} : std::vector<Value>();
    }
    static void set(std::optional<Value>& to, std::vector<Value> values) { to = std::move(values.front()); }
};
template <class Value>
struct Held<std::vector<Value>> {
    using One = Value;
    static constexpr bool is_many = true;
    static std::vector<Value> values(const std::vector<Value>& all) { return all; }
    static void set(std::vector<Value>& to, std::vector<Value> values) { to = std::move(values); }
};

}  // namespace detail

// Makes an option. `member`: a member of a request, &Request::x, or a function that returns a reference. Its type
// determines whether the option has one value, may be left open, or has several. An empty text is left open.
template <class Request, class Member, class Value>
Option<Request> option(std::string name, std::string type, std::string help, Member member, Form<Value> form) {
    using Holder = std::remove_cvref_t<std::invoke_result_t<Member, Request&>>;
    using H = detail::Held<Holder>;
    Option<Request> o;
    o.kind = H::is_many ? OptionWords::Kind::many : OptionWords::Kind::one;
    o.name = std::move(name);
    o.type = std::move(type);
    o.help = std::move(help);
    o.wrong = [form](const std::string& text) { return form.read(text) ? std::string() : form.wrong(text); };
    o.read = [=](Request& request, const std::vector<std::string>& texts) {
        std::vector<typename H::One> values;
        for (const std::string& text : texts) values.push_back(static_cast<typename H::One>(*form.read(text)));
        H::set(std::invoke(member, request), std::move(values));
    };
    o.texts = [=](const Request& request) {
        std::vector<std::string> texts;
        for (const auto& value : H::values(std::invoke(member, request)))
            if (std::string text = form.print(static_cast<Value>(value)); !text.empty()) texts.push_back(std::move(text));
        return texts;
    };
    o.is_number = form.is_number;
    return o;
}

template <class Request, class Member>
Option<Request> flag(std::string name, std::string help, Member member) {
    Option<Request> o = option<Request>(std::move(name), "", std::move(help), member, yes_or_no());
    o.kind = OptionWords::Kind::flag;
    return o;
}

// Makes an option of a request from one of a request inside it.
template <class Outer, class Inner>
Option<Outer> of_inner(const Option<Inner>& inner, Inner Outer::*member) {
    Option<Outer> o;
    static_cast<OptionWords&>(o) = inner;
    o.read = [=](Outer& outer, const std::vector<std::string>& texts) { inner.read(outer.*member, texts); };
    o.texts = [=](const Outer& outer) { return inner.texts(outer.*member); };
    return o;
}

// The spelling of an option in the place where it was given.
using Spelling = std::function<std::string(const OptionWords&)>;

// Sets the given options. Throws InputError, which begins with the option's name as `spell` returns it.
template <class Request>
void take(const Options<Request>& options, const Given& given, Request& request, const Spelling& spell) {
    const auto is_given = [&](const std::string& name) {
        return std::ranges::any_of(given, [&](const auto& g) { return g.first == name; });
    };
    for (const auto& [name, texts] : given) {
        const Option<Request>* o = options.find(name);
        if (!o) throw InputError(fmt::format("'{}' is no option of {}", name, options.command));
        if (o->kind != OptionWords::Kind::many && texts.size() != 1)
            throw InputError(fmt::format("{}: expected one value, not {}", spell(*o), texts.size()));
        for (const std::string& text : texts)
            if (const std::string wrong = o->wrong(text); !wrong.empty()) throw InputError(fmt::format("{}: {}", spell(*o), wrong));
        for (const std::string& other : o->excludes)
            if (is_given(other)) throw InputError(fmt::format("{} excludes {}", spell(*o), spell(*options.find(other))));
        for (const std::string& other : o->needs)
            if (!is_given(other)) throw InputError(fmt::format("{} requires {}", spell(*o), spell(*options.find(other))));
        o->read(request, texts);
    }
}

}  // namespace neumann

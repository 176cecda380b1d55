#include "core/reader/xml/definitions.h"

#include "core/reader/xml/problems.h"

#include <fmt/format.h>

namespace neumann::reader {

namespace {

// Limits the length, because defaults may contain defaults, each twice as long as the one before.
constexpr std::size_t max_length = std::size_t(1) << 24;

bool is_name_character(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_'; }

}  // namespace

Definitions::Definitions(const std::map<std::string, std::string>& from_command_line) {
    for (const auto& [name, text] : from_command_line) values_[name] = {text, true, false};
}

void Definitions::add_default(const std::string& name, const std::string& value) { values_.try_emplace(name, Value{value}); }

void Definitions::lose_default(const std::string& name) {
    if (name.empty())
        lost_ = true;
    else
        values_.try_emplace(name, Value{"", false, false, true});
}

std::map<std::string, Definitions::Value>::iterator Definitions::longest(std::string_view text) {
    auto best = values_.end();
    for (auto i = values_.begin(); i != values_.end(); ++i)
        if (text.starts_with(i->first) && (best == values_.end() || i->first.size() > best->first.size())) best = i;
    return best;
}

void Definitions::substitute(Attribute& a) {
    if (a.value.find('$') == std::string::npos) return;
    const std::string_view text = a.value;
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        if (text.substr(i).starts_with("\\$")) {
            result += '$';
            i += 2;
        } else if (text[i] != '$') {
            result += text[i++];
        } else if (const auto found = longest(text.substr(i + 1)); found != values_.end()) {
            if (found->second.lost) throw AlreadyReported();
            found->second.used = true;
            result += found->second.text;
            i += 1 + found->first.size();
        } else {
            if (lost_) throw AlreadyReported();
            std::size_t end = i + 1;
            while (end < text.size() && is_name_character(text[end])) ++end;
            throw InputError(a.place, fmt::format("{} is not defined; {}", text.substr(i, end - i), names()));
        }
        if (result.size() > max_length)
            throw InputError(a.place,
                             fmt::format("the value is longer than {} characters once its parameters are put in", max_length));
    }
    a.value = result;
}

std::string Definitions::names() const {
    std::vector<std::string> all;
    for (const auto& [name, value] : values_) all.push_back(name);
    return all.empty() ? "no parameter is" : "defined: " + join(all);
}

void Definitions::use(const std::string& name) {
    if (const auto found = values_.find(name); found != values_.end()) found->second.used = true;
}

void Definitions::check_used(const std::string& file) const {
    std::vector<std::string> others;
    for (const auto& [name, value] : values_)
        if (!value.from_command_line || value.used) others.push_back(name);
    for (const auto& [name, value] : values_) {
        if (!value.from_command_line || value.used) continue;
        throw InputError(Location{file, 0, 0},
                         fmt::format("-D {}={}: nothing in the scene uses ${}; {}", name, value.text, name,
                                     others.empty() ? "it has no parameters" : "its parameters: " + join(others)));
    }
}

}  // namespace neumann::reader

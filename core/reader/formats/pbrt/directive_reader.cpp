// Reads files, keeps the stack of states, and reads what is common to all directives.
#include "core/reader/formats/pbrt/directive_reader.h"

#include "core/base/did_you_mean.h"
#include "core/reader/formats/find_file.h"
#include "core/reader/formats/pbrt/transforms.h"
#include "core/reader/formats/pbrt/unpack.h"
#include "core/reader/meshes/mesh_text.h"
#include "core/reader/xml/element.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>

#include <fmt/format.h>

namespace neumann::reader::pbrt {

namespace {

constexpr std::size_t max_depth = 32, max_files = 10000;

constexpr const char* upgrade = "this is pbrt-v3, expected pbrt-v4, into which 'pbrt --upgrade' of pbrt-v4 converts it";

// The place of a line that begins with WorldEnd, as scenes of pbrt-v3 end.
std::optional<Location> end_of_v3(const std::string& path, const std::string& text) {
    constexpr std::string_view word = "WorldEnd";
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const std::size_t line_start = text.rfind('\n', at) + 1;  // 0 where there is none
        if (text.find_first_not_of(" \t\r", line_start) != at) continue;
        const auto before = text.begin() + static_cast<std::ptrdiff_t>(at);
        return Location{path, static_cast<int>(std::count(text.begin(), before, '\n')) + 1, static_cast<int>(at - line_start) + 1};
    }
    return std::nullopt;
}

bool is_of_v3(const std::string& word) { return word == "SurfaceIntegrator" || word == "Renderer" || word == "Volume"; }

const char* beginning_of(char kind) { return kind == 'a' ? "AttributeBegin" : kind == 'o' ? "ObjectBegin" : "TransformBegin"; }

}  // namespace

DirectiveReader::DirectiveReader(PbrtScene& scene, Warnings& warnings, Problems& problems)
    : scene_(scene), warnings_(warnings), problems_(problems) {
    add_options();
    add_state_directives();
    add_world_directives();
}

void DirectiveReader::before_world(const std::string& name, Directive directive) {
    directives_[name] = [this, directive = std::move(directive)](const std::string& word, const Location& place) {
        directive(word, place);
        if (is_in_world_) throw InputError(place, word + " after WorldBegin, expected before it");
    };
}

void DirectiveReader::in_world(const std::string& name, Directive directive) {
    directives_[name] = [this, directive = std::move(directive)](const std::string& word, const Location& place) {
        directive(word, place);
        if (!is_in_world_) throw InputError(place, word + " before WorldBegin, expected after it");
    };
}

void DirectiveReader::read_file(const std::string& path) {
    std::string text = read_unpacked(path);
    // This error is reported alone, because most of such a file is wrong in pbrt-v4.
    if (const std::optional<Location> end = end_of_v3(path, text))
        throw InputError(*end, fmt::format("WorldEnd is no directive; {}", upgrade));
    Tokens tokens(path, std::move(text));
    scene_.files.push_back(path);
    files_.push_back({path, &tokens});
    // After a string without an end nothing can be understood.
    problems_.attempt({path, 1, 1}, [&] {
        if (const std::optional<Token>& first = tokens.peek(); first && !may_begin(*first))
            throw InputError(tokens.place(*first), fmt::format("expected a directive of pbrt, found {}", first->shown()));
        while (const std::optional<Token> token = tokens.next())
            if (!problems_.attempt(tokens.place(*token), [&] { execute(*token); })) skip_to_directive();
    });
    files_.pop_back();
}

void DirectiveReader::execute(const Token& token) {
    const auto found = token.is_string ? directives_.end() : directives_.find(token.text);
    if (found == directives_.end()) fail_unknown(token);
    found->second(token.text, tokens().place(token));
}

void DirectiveReader::fail_unknown(const Token& token) {
    const Location place = tokens().place(token);
    if (is_of_v3(token.text)) throw InputError(place, fmt::format("{} is no directive; {}", token.text, upgrade));
    if (token.is_string || !std::ranges::all_of(token.text, [](unsigned char c) { return std::isalpha(c); }))
        throw InputError(place, fmt::format("expected a directive, found {}", token.shown()));
    throw Unknown(place, fmt::format("unknown directive '{}'", printable(token.text)), did_you_mean(token.text, known_directives()),
                  "left out");
}

std::vector<std::string> DirectiveReader::known_directives() const {
    std::vector<std::string> known;
    for (const auto& [name, directive] : directives_) known.push_back(name);
    return known;
}

bool DirectiveReader::may_begin(const Token& first) const {
    if (first.is_string) return false;
    return directives_.contains(first.text) || is_of_v3(first.text) || !did_you_mean(first.text, known_directives()).empty();
}

// Skips to the next directive, also one that is not known, so that it is reported, too.
void DirectiveReader::skip_to_directive() {
    const auto is_directive = [](const Token& t) { return !t.is_string && t.text[0] >= 'A' && t.text[0] <= 'Z'; };
    while (tokens().peek() && !is_directive(*tokens().peek())) tokens().next();
}

void DirectiveReader::check_end() {
    for (const Pushed& p : pushed_)
        problems_.add(InputError(p.place, fmt::format("{} without an end", beginning_of(p.kind))), p.place);
    if (!is_in_world_)
        problems_.add(InputError(scene_.start.file + ": has no WorldBegin, which stands between the camera and the shapes"),
                      scene_.start);
}

std::string DirectiveReader::string_argument(const std::string& directive, const Location& place, const char* what) {
    const std::optional<Token>& next = tokens().peek();
    // Programs sometimes write brackets around the string.
    const bool in_brackets = next && next->is("[");
    if (in_brackets) tokens().next();
    if (!tokens().peek() || !tokens().peek()->is_string)
        throw InputError(place, fmt::format("{} without {} in quotes", directive, what));
    const std::string text = tokens().next()->text;
    if (in_brackets && tokens().peek() && tokens().peek()->is("]")) tokens().next();
    return text;
}

std::vector<double> DirectiveReader::number_arguments(const std::string& directive, const Location& place, std::size_t count) {
    const bool in_brackets = count > 0 && tokens().peek() && tokens().peek()->is("[");
    if (in_brackets) tokens().next();
    std::vector<double> numbers;
    while (numbers.size() < count) {
        const std::optional<Token>& next = tokens().peek();
        const std::string digits = next ? (next->text.starts_with('+') ? next->text.substr(1) : next->text) : "";
        double value = 0.0;
        const auto [at, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (!next || next->is_string || at != digits.data() + digits.size() || error != std::errc() || !std::isfinite(value))
            throw InputError(next ? tokens().place() : place,
                             fmt::format("{} has {} of its {} numbers{}", directive, numbers.size(), count,
                                         next ? ", then comes " + next->shown() : ""));
        numbers.push_back(value);
        tokens().next();
    }
    if (in_brackets) {
        if (!tokens().peek() || !tokens().peek()->is("]"))
            throw InputError(tokens().place(), fmt::format("expected ] after the {} numbers of {}", count, directive));
        tokens().next();
    }
    return numbers;
}

Parameters DirectiveReader::parameters(const std::string& title, const Location& place, const std::string& defaults) {
    Parameters p(title, place, problems_);
    p.read(tokens());
    if (const auto found = state_.defaults.find(defaults); found != state_.defaults.end()) p.add_defaults(*found->second);
    return p;
}

Entity DirectiveReader::entity(const std::string& directive, const Location& place, const std::string& noun,
                               const std::string& defaults) {
    const std::string type = string_argument(directive, place, "a type");
    return {type, parameters(fmt::format("{} '{}'", noun, printable(type)), place, defaults), state_.to_world};
}

void DirectiveReader::push(char kind, const Location& place) { pushed_.push_back({kind, place, state_}); }

void DirectiveReader::pop(char kind, const std::string& directive, const Location& place) {
    if (pushed_.empty()) throw InputError(place, fmt::format("{} without {}", directive, beginning_of(kind)));
    Pushed& top = pushed_.back();
    if (top.kind != kind)
        throw InputError(place, fmt::format("{} without {}; the {} at {} has not ended", directive, beginning_of(kind),
                                            beginning_of(top.kind), to_string(top.place)));
    // TransformBegin saves only these.
    if (kind == 't') {
        state_.to_world = top.state.to_world;
        state_.moves_end_only = top.state.moves_end_only;
    } else {
        state_ = std::move(top.state);
    }
    pushed_.pop_back();
}

void DirectiveReader::include(const std::string& directive, const Location& place) {
    const std::string name = string_argument(directive, place, "the name of a file");
    const std::string path = find_file(name, scene_.files.front(), place);
    for (std::size_t i = 0; i < files_.size(); ++i) {
        std::error_code error;
        if (!std::filesystem::equivalent(files_[i].path, path, error)) continue;
        std::string cycle;
        for (std::size_t j = i; j < files_.size(); ++j) cycle += files_[j].path + " includes ";
        throw InputError(place, fmt::format("include cycle: {}{}", cycle, path));
    }
    if (files_.size() > max_depth) throw InputError(place, fmt::format("includes are nested more than {} deep", max_depth));
    if (scene_.files.size() > max_files) throw InputError(place, fmt::format("more than {} files are included", max_files));
    if (directive == "Include") {
        read_file(path);
        return;
    }
    // The state changes that an imported file makes end with it.
    const GraphicsState outer = state_;
    const std::size_t depth = pushed_.size();
    read_file(path);
    for (; pushed_.size() > depth; pushed_.pop_back())
        problems_.add(InputError(pushed_.back().place, fmt::format("{} without an end", beginning_of(pushed_.back().kind))),
                      pushed_.back().place);
    state_ = outer;
}

}  // namespace neumann::reader::pbrt

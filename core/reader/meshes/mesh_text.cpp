#include "core/reader/meshes/mesh_text.h"

#include "core/base/error.h"
#include "core/base/input_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace neumann {

OpenFile open_mesh_file(const std::string& path) {
    expect_input(path);
    std::error_code error;
    OpenFile result{decltype(OpenFile::file)(std::fopen(path.c_str(), "rb")), 0};
    if (!result.file) throw InputError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
    result.size = std::filesystem::file_size(path, error);
    if (error) throw InputError(fmt::format("{}: cannot be read: {}", path, error.message()));
    return result;
}

std::string counted(std::size_t count, std::string_view noun) {
    if (count == 1) return fmt::format("1 {}", noun);
    return fmt::format("{} {}", count, noun == "vertex" ? "vertices" : std::string(noun) + (noun == "mesh" ? "es" : "s"));
}

std::string out_of_range(std::size_t available, std::string_view noun) {
    return fmt::format("is out of range, the file has {}", counted(available, noun));
}

MeshText::MeshText(std::string file, std::string_view text, Syntax syntax)
    : file_(std::move(file)),
      at_(text.data()),
      end_(text.data() + text.size()),
      line_start_(at_),
      token_(at_),
      obj_(syntax == Syntax::obj) {}

void MeshText::skip_line() {
    while (!at_end() && !is_newline(*at_)) {
        const bool continues = is_continuation(at_++);
        if (continues) newline();
    }
}

void MeshText::next_line() {
    while (!at_end() && !is_newline(*at_)) ++at_;
    if (!at_end()) newline();
}

void MeshText::fail(const LineColumn& place, const std::string& what) const {
    const auto as_int = [](std::size_t n) { return static_cast<int>(std::min<std::size_t>(n, std::numeric_limits<int>::max())); };
    throw InputError(Location{file_, as_int(place.line), as_int(place.column)}, what);
}

void MeshText::fail_expected(std::string_view expected) const {
    const char* stop = token_;
    while (!is_delimiter(stop)) ++stop;
    if (token_ == end_) fail(fmt::format("expected {}, found the end of the file", expected));
    if (stop == token_ || is_comment(token_)) fail(fmt::format("expected {}, found the end of the line", expected));
    fail(fmt::format("expected {}, found '{}'", expected, glimpse_of({token_, stop})));
}

}  // namespace neumann

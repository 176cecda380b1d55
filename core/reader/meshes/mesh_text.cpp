#include "core/reader/meshes/mesh_text.h"

#include "core/base/error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace neumann {

OpenFile open_mesh_file(const std::string& path) {
    // Only regular files are accepted: pipes and devices may have no end, and directories open without an error.
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (std::filesystem::is_directory(status)) throw InputError(path + ": cannot be opened: Is a directory");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw InputError(path + ": cannot be opened: Not a regular file");
    }

    OpenFile result{decltype(OpenFile::file)(std::fopen(path.c_str(), "rb")), 0};
    if (!result.file) throw InputError(fmt::format("{}: cannot be opened: {}", path, std::strerror(errno)));
    result.size = std::filesystem::file_size(path, error);
    if (error) throw InputError(fmt::format("{}: cannot be read: {}", path, error.message()));
    return result;
}

std::string read_mesh_bytes(const std::string& path) {
    const OpenFile open = open_mesh_file(path);
    std::string bytes(open.size, '\0');
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), open.file.get()));
    if (std::ferror(open.file.get()) != 0) throw InputError(fmt::format("{}: cannot be read: {}", path, std::strerror(errno)));
    return bytes;
}

std::string printable(std::string_view text) {
    constexpr std::size_t longest = 40;
    std::string result(text.substr(0, longest));
    for (char& c : result) {
        if (c < ' ' || c > '~') c = '?';
    }
    if (text.size() > longest) result += "...";
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

void MeshText::fail(const Place& place, const std::string& what) const {
    const auto as_int = [](std::size_t n) { return static_cast<int>(std::min<std::size_t>(n, std::numeric_limits<int>::max())); };
    throw InputError(Location{file_, as_int(place.line), as_int(place.column)}, what);
}

void MeshText::fail_expected(std::string_view expected) const {
    const char* stop = token_;
    while (!is_delimiter(stop)) ++stop;
    if (token_ == end_) fail(fmt::format("expected {}, found the end of the file", expected));
    if (stop == token_ || is_comment(token_)) fail(fmt::format("expected {}, found the end of the line", expected));
    fail(fmt::format("expected {}, found '{}'", expected, printable({token_, stop})));
}

}  // namespace neumann

#include "core/base/input_file.h"

#include "core/base/error.h"

#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

namespace neumann {

namespace fs = std::filesystem;

namespace {

std::string beginning_of(std::istream& file) {
    std::array<char, 256> bytes{};
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return {bytes.data(), static_cast<std::size_t>(file.gcount())};
}

// The size of the file for which a Git LFS pointer stands, by the specification of Git LFS; nothing if the text is no pointer.
std::optional<std::uint64_t> size_of_pointed(std::string_view beginning) {
    constexpr std::string_view first = "version https://git-lfs.github.com/spec/", size = "\nsize ";
    if (!beginning.starts_with(first)) return std::nullopt;
    std::uint64_t bytes = 0;
    if (const std::size_t at = beginning.find(size); at != std::string_view::npos)
        std::from_chars(beginning.data() + at + size.size(), beginning.data() + beginning.size(), bytes);
    return bytes;
}

std::string cannot_be_read(int error) { return "cannot be read: " + std::generic_category().message(error != 0 ? error : EIO); }

}  // namespace

std::optional<std::string> why_not_input(const std::string& path, const std::string& expected) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) return "there is no such file";
    if (!fs::exists(status)) return cannot_be_read(error.value());
    if (fs::is_directory(status)) return "is a folder, expected " + expected;
    if (!fs::is_regular_file(status)) return "is a pipe or a device, expected " + expected;
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    const std::string beginning = file ? beginning_of(file) : "";
    if (!file.is_open() || file.bad()) return cannot_be_read(errno);
    if (beginning.empty()) return "is empty, expected " + expected;
    if (const auto bytes = size_of_pointed(beginning))
        return "is a Git LFS pointer of " + std::to_string(*bytes) + " bytes, not the file; git lfs pull brings it";
    return std::nullopt;
}

void expect_input(const std::string& path, const std::string& expected) {
    if (const auto why = why_not_input(path, expected)) throw InputError(Location{path, 0, 0}, *why);
}

std::ifstream open_if_there(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status))
        throw InputError(Location{path.string(), 0, 0}, "is a pipe or a device, expected a file");
    return std::ifstream(path, std::ios::binary);
}

std::string read_input(const std::string& path, const std::string& expected) {
    expect_input(path, expected);
    std::error_code error;
    std::string bytes(fs::file_size(path, error), '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    if (error || file.bad() || !file.is_open()) throw InputError(Location{path, 0, 0}, "cannot be read");
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

}  // namespace neumann

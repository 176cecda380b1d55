// The file of an unfinished render: the line "neumann state 3", the size of the header (8 bytes, little-endian), the
// header (JSON), a hash of these (XXH3, 8 bytes), the numbers that the header counts, and a hash of everything. A file
// is refused if it is cut off, has another byte anywhere, or is of another version of the program.
#pragma once

#include "apps/output/files/output_folder.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace neumann {

class StateHash;

template <class T>
std::string_view bytes_of(const T* first, std::size_t count) {
    static_assert(std::is_trivially_copyable_v<T>);
    return {reinterpret_cast<const char*>(first), count * sizeof(T)};
}

// Calls `write` with the pieces of the file.
void write_state(nlohmann::ordered_json header, std::vector<std::string_view> numbers,
                 const std::function<void(std::span<const std::string_view>)>& write);
// Writes the state of an unfinished render.
void write_state(OutputFolder& folder, nlohmann::ordered_json header, std::vector<std::string_view> numbers);

// Reads a state file in order. Throws InputError ("out/x/render.unfinished: damaged: …") if it is not complete.
class StateFile {
public:
    explicit StateFile(const std::filesystem::path& path);
    ~StateFile();
    StateFile(const StateFile&) = delete;

    const nlohmann::ordered_json& header() const { return header_; }
    template <class T>
    std::vector<T> numbers(std::uint64_t count) {
        if (count > left_ / sizeof(T)) damaged("it ends too early");
        std::vector<T> all(count);
        read(all.data(), count * sizeof(T));
        return all;
    }
    // Compares the hash. The data are valid only if this does not throw.
    void expect_end();
    [[noreturn]] void damaged(const std::string& why) const;

private:
    void read(void* to, std::size_t bytes);
    void expect_hash();

    std::filesystem::path path_;
    std::ifstream file_;
    std::uint64_t left_ = 0;
    std::unique_ptr<StateHash> hash_;
    nlohmann::ordered_json header_;
};

}  // namespace neumann

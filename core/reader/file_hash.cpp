#include "core/reader/file_hash.h"

#include "core/base/error.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fmt/format.h>
#include <fstream>
#include <memory>

namespace neumann::reader {

std::string hash_files(const std::vector<std::string>& paths, std::string_view text) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(), XXH3_freeState);
    XXH3_128bits_reset(state.get());
    std::vector<char> buffer(1 << 16);
    for (const std::string& path : paths) {
        std::ifstream file(path, std::ios::binary);
        if (!file) throw InputError(path + ": cannot be read");
        while (file.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || file.gcount() > 0)
            XXH3_128bits_update(state.get(), buffer.data(), static_cast<std::size_t>(file.gcount()));
    }
    XXH3_128bits_update(state.get(), text.data(), text.size());
    const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
    return fmt::format("xxh3-128:{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace neumann::reader
